#include "player/output/video.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>
#include <vector>

#include "formats/core/process.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

// Raw frames in, the same film out each time: no date and no version in it.
std::vector<std::string> command(const fs::path& output, int width, int height, double frames_per_s) {
  return {"ffmpeg",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          fmt::format("{}x{}", width, height),
          "-r",
          fmt::format("{:.9g}", frames_per_s),
          "-i",
          "-",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-pix_fmt",
          "yuv420p",
          "-map_metadata",
          "-1",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "file:" + output.string()};
}

}  // namespace

bool has_ffmpeg() {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
  return false;
}

Result<std::unique_ptr<VideoWriter>> VideoWriter::create(const fs::path& path, int width, int height,
                                                         double frames_per_s) {
  std::unique_ptr<VideoWriter> out(new VideoWriter);
  out->path_ = path;
  // ffmpeg takes the kind of file from its extension.
  out->partial_ =
      path.parent_path() / fmt::format("{}.tmp-{}{}", path.stem().string(), ::getpid(), path.extension().string());
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(ErrorCode::kRuntime, "ffmpeg", "no pipe to it: {}", std::strerror(errno));
  out->pipe_ = ends[1];
  const Result<pid_t> started =
      start_program(command(out->partial_, width, height, frames_per_s), {ends[0], STDOUT_FILENO, STDERR_FILENO});
  ::close(ends[0]);
  if (!started) return tl::unexpected(started.error());
  out->process_ = *started;
  ::signal(SIGPIPE, SIG_IGN);  // write() tells when it has ended
  return out;
}

VideoWriter::~VideoWriter() {
  if (process_ < 0 && pipe_ < 0) return;
  (void)wait();
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

Status VideoWriter::add(const ByteImage& frame) {
  for (std::size_t done = 0; done < frame.pixels.size();) {
    const ssize_t n = ::write(pipe_, frame.pixels.data() + done, frame.pixels.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return fail(ErrorCode::kRuntime, "ffmpeg", "ended before the last frame: {}", std::strerror(errno));
    done += static_cast<std::size_t>(n);
  }
  return {};
}

Status VideoWriter::wait() {
  if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
  if (process_ < 0) return {};
  const int status = wait_for(std::exchange(process_, -1));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return fail(ErrorCode::kRuntime, "ffmpeg", "failed to make {}", path_.string());
}

Status VideoWriter::finish() {
  std::error_code error;
  if (const Status done = wait(); !done) {
    fs::remove(partial_, error);
    return done;
  }
  fs::rename(partial_, path_, error);
  if (error) return fail(ErrorCode::kIo, path_.string(), "cannot be written: {}", error.message());
  return {};
}

}  // namespace oriel
