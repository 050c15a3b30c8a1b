// Ctrl-C and SIGTERM as a flag.
#pragma once

namespace oriel {

void install_stop_handler();
bool stop_requested();

}  // namespace oriel
