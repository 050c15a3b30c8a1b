// A bake beside the window: oriel-bake as a child process.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "formats/core/result.h"

namespace oriel {

class BackgroundBake {
 public:
  BackgroundBake() = default;
  ~BackgroundBake();  // ends it
  BackgroundBake(const BackgroundBake&) = delete;
  BackgroundBake& operator=(const BackgroundBake&) = delete;

  // words: the program and its arguments, which should ask for --json-log. One that runs is ended. Error kRuntime.
  Status start(std::vector<std::string> words);
  void stop();
  // Reads what it told since the last call, without waiting. True once, when it ended well.
  bool ended_well();

  bool runs() const { return child_ > 0; }
  const std::string& stage() const { return stage_; }
  double fraction() const { return fraction_; }  // of the stage
  double left_s() const { return left_s_; }      // of all; < 0: not known
  const std::string& failure() const { return failure_; }

 private:
  void take_line(const std::string& line);
  void read_pipe();

  pid_t child_ = -1;
  int pipe_ = -1;
  std::string text_, stage_, failure_, last_error_;
  double fraction_ = 0, left_s_ = -1;
};

}  // namespace oriel
