// Mutations of packs behind their checksums: mostly of one section's bytes as they are once decompressed, with every
// size, offset and checksum put right again. Of plain mutations all but a few end at the first checksum.
#include <random>

#include "tests/formats/pack/forge.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace oriel;
using testing::Forge;
using testing::ForgedSection;

constexpr std::size_t kMaxRaw = std::size_t{1} << 16;  // a section's bytes: small ones are mutated more often

Bytes mutated(Bytes bytes) {
  const std::size_t size = bytes.size();
  bytes.resize(size + 64);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
  return bytes;
}

void mutate_record(SectionRecord& record) {
  LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(&record), sizeof(record), sizeof(record));
}

// Whether the decompressed bytes can be had.
bool opens(const ForgedSection& section) {
  return section.record.raw_bytes <= kMaxRaw && section.record.codec <= 1;
}

void mutate(Forge& forge, std::minstd_rand& random) {
  const std::size_t at = random() % forge.sections.size(), other = random() % forge.sections.size();
  ForgedSection& section = forge.sections[at];
  switch (random() % 16) {
    case 0:
      return mutate_record(section.record);
    case 1:
      section.stored = mutated(section.stored);
      return;
    case 2:
      forge.sections.push_back(ForgedSection(section));
      return;
    case 3:
      forge.sections.erase(forge.sections.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 4:
      return std::swap(section, forge.sections[other]);
    default:
      if (!opens(section)) return mutate_record(section.record);
      const Bytes raw = mutated(Forge::raw(section));
      if (random() % 4 == 0)
        Forge::set_compressed(section, raw);
      else
        Forge::set_raw(section, raw);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  const auto bytes = std::as_bytes(std::span(data, size));
  const Bytes file(bytes.begin(), bytes.end());
  const auto index = read_index(file);
  if (!index || index->sections.empty() || random() % 16 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Forge forge = Forge::from(file);
  for (std::size_t i = 0; i <= random() % 3 && !forge.sections.empty(); ++i) mutate(forge, random);
  const Bytes result = forge.file();
  if (result.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, result.data(), result.size());
  return result.size();
}
