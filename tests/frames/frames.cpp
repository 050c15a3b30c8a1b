#include "tests/frames/frames.h"

#include <sys/wait.h>

#include <cstdlib>

namespace oriel::test {

int run(const std::filesystem::path& folder, const std::string& command) {
  const std::string line = "cd '" + folder.string() + "' && '" + ORIEL_BIN_DIR + "'/" + command + " >>log 2>&1";
  const int status = std::system(line.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

FloatImage diffuse(const ReferenceFrame& frame) {
  FloatImage sum = frame.direct;
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += frame.indirect.pixels[i];
  return sum;
}

}  // namespace oriel::test
