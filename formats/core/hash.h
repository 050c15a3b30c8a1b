// XXH3: checksums of pack sections and names of inputs. Not for security.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace oriel {

std::uint64_t hash64(std::span<const std::byte> bytes);
// 32 lower-case hexadecimal digits of XXH3-128.
std::string hash128_hex(std::span<const std::byte> bytes);

}  // namespace oriel
