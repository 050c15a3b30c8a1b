#include "formats/pack/pack.h"

namespace oriel {

Pack::Pack() = default;
Pack::~Pack() = default;
Pack::Pack(const Pack&) = default;
Pack::Pack(Pack&&) noexcept = default;
Pack& Pack::operator=(const Pack&) = default;
Pack& Pack::operator=(Pack&&) noexcept = default;

}  // namespace oriel
