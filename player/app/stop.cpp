#include "player/app/stop.h"

#include <csignal>

namespace oriel {
namespace {

volatile std::sig_atomic_t g_stop = 0;

// A second signal ends the program at once, should it not come back to ask.
void on_signal(int number) {
  g_stop = 1;
  std::signal(number, SIG_DFL);
}

}  // namespace

void install_stop_handler() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool stop_requested() {
  return g_stop != 0;
}

}  // namespace oriel
