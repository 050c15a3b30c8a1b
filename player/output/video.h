// Frames as a film, by ffmpeg as a process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>

#include "formats/core/result.h"
#include "formats/image/image.h"

namespace oriel {

// Whether there is a program of the name "ffmpeg" on PATH.
bool has_ffmpeg();

// Takes frames one by one; finish() makes the file, whole or not at all. Its kind is that of its extension; H.264 and
// its like want even sides, so that an odd one gets a black row or column more.
class VideoWriter {
 public:
  // Errors: kRuntime where ffmpeg does not start.
  static Result<std::unique_ptr<VideoWriter>> create(const std::filesystem::path& path, int width, int height,
                                                     double frames_per_s);
  ~VideoWriter();  // unfinished: removes what there is
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  // Of the size told, RGB. Errors: kRuntime where ffmpeg has ended before its time; it says why on stderr.
  Status add(const ByteImage& frame);
  // Errors: kRuntime, kIo.
  Status finish();

 private:
  VideoWriter() = default;
  Status wait();

  std::filesystem::path path_, partial_;
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace oriel
