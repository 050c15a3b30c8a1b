// SHA-256 (FIPS 180-4), for what browsers compare: integrity attributes know no other family.
#pragma once

#include <array>
#include <span>
#include <string>

#include "formats/core/bytes.h"

namespace oriel {

std::array<std::uint8_t, 32> sha256(std::span<const std::byte> bytes);

// "sha256-" and the digest in base64 (W3C, Subresource Integrity, section 3.5).
std::string integrity_of(std::span<const std::byte> bytes);

}  // namespace oriel
