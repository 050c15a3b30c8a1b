// How much memory there is.
#pragma once

#include <cstdint>

namespace oriel {

// Bytes that a program can take without the system having to swap or to kill: what is available of the machine (Linux's
// MemAvailable), no more than what the control group leaves. 0: not known.
std::uint64_t free_memory();

}  // namespace oriel
