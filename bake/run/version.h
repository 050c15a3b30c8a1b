#pragma once

namespace oriel {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace oriel
