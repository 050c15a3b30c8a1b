// Whole sections of known kinds.
#pragma once

#include "formats/pack/index.h"
#include "formats/pack/sections.h"

namespace oriel {

// A pack with as many elements as there are sections of one each: each section has its place from the start, so that
// all can be decoded side by side.
Pack pack_of(const PackIndex& index);
// raw: its decompressed bytes. Error kInvalid names the section.
Status decode_section(std::span<const std::byte> raw, const SectionInfo& section, Pack& pack);

// The end of a section: neither bytes missing nor bytes left over.
Status check_end(const ByteReader& in, const SectionInfo& section);

// The only element of a section.
template <class T>
Status decode_element(std::span<const std::byte> raw, const SectionInfo& section, T& element) {
  ByteReader in(raw);
  if (auto status = decode(in, element); !status && in.ok())
    return invalid(section.label, "element 0: {}", status.error().message);
  return check_end(in, section);
}

}  // namespace oriel
