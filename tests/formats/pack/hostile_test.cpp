// Damaged and forged packs: refused with a place and a reason, never a crash and never a number that is not finite.
#include <gtest/gtest.h>

#include <random>

#include "formats/pack/reader.h"
#include "formats/pack/validate.h"
#include "formats/pack/writer.h"
#include "formats/query/light_at.h"
#include "tests/formats/pack/hostile.h"

namespace oriel {
namespace {

using namespace testing;

template <class Change>
Bytes with_header(const Change& change) {
  Bytes file = tiny_file();
  FileHeader header;
  std::memcpy(&header, file.data(), sizeof(header));
  change(header);
  std::memcpy(file.data(), &header, sizeof(header));
  return file;
}

TEST(Hostile, ForgeItselfChangesNothing) {
  const Bytes file = tiny_file();
  EXPECT_EQ(Forge::from(file).file(), file);
}

TEST(Hostile, EveryPrefixIsRefused) {
  const Bytes file = tiny_file();
  for (std::size_t n = 0; n < file.size(); ++n) {
    const auto pack = decode_pack(std::span(file).first(n));
    ASSERT_FALSE(pack) << n << " of " << file.size();
    ASSERT_EQ(pack.error().code, ErrorCode::kInvalid);
    ASSERT_FALSE(pack.error().where.empty());
  }
}

TEST(Hostile, TruncationNamesTheSection) {
  const Bytes file = tiny_file();
  const auto index = *read_index(file);
  for (const auto& section : index.sections) {
    Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(section.offset + section.stored_bytes - 1));
    expect_refusal(cut, section.label + ": the file is truncated");
  }
}

TEST(Hostile, ExtraBytesAreRefused) {
  Bytes file = tiny_file();
  file.push_back(std::byte{0});
  expect_refusal(file, "found 1 bytes after the last section");
}

TEST(Hostile, EveryBitFlipIsRefused) {
  Bytes file = tiny_file();
  for (std::size_t i = 0; i < file.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      file[i] ^= std::byte{1} << bit;
      ASSERT_FALSE(decode_pack(file)) << "byte " << i << " bit " << bit;
      file[i] ^= std::byte{1} << bit;
    }
  EXPECT_TRUE(decode_pack(file)) << "the flips were taken back";
}

TEST(Hostile, HeaderFields) {
  expect_refusal({}, "is not an .oriel pack");
  expect_refusal(Bytes(100), "is not an .oriel pack");
  expect_refusal(with_header([](FileHeader& h) { h.version = 2; }),
                 "found format version 2, this program reads version 1");
  expect_refusal(with_header([](FileHeader& h) { h.flags = 4; }), "found flags 0x4");
  expect_refusal(with_header([](FileHeader& h) { h.section_count = 0xffffffffu; }), "found 4294967295 sections");
  expect_refusal(with_header([](FileHeader& h) { h.section_count = 1000; }), "inside the table of 1000 sections");
  expect_refusal(with_header([](FileHeader& h) { h.table_offset = 128; }), "found the table at byte 128");
  expect_refusal(with_header([](FileHeader& h) { h.record_bytes = 32; }), "found 32 bytes a table record");
  expect_refusal(with_header([](FileHeader& h) { h.reserved[1] = 1; }), "reserved");
  expect_refusal(with_header([](FileHeader& h) { h.checksum ^= 1; }), "section table: header and table have checksum");
  Bytes longer = with_header([](FileHeader& h) { h.file_bytes += 1; });
  Forge::seal(longer);
  expect_refusal(longer, "found a file length of");
}

TEST(Hostile, RecordFields) {
  const std::string mesh = "section MESH (mesh): ";
  using R = SectionRecord;
  expect_refusal(with_record(kMeshSection, [](R& r) { r.codec = 9; }), mesh + "found codec 9");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.flags = 1; }), mesh + "found it marked as optional");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.flags = 2; }), mesh + "found reserved bits");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.reserved1 = 1; }), mesh + "found reserved bits");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.offset += 64; }), mesh + "found it at byte");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.offset = ~0ull - 8; }), mesh + "found it at byte");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.stored_bytes = ~0ull; }), mesh + "the file is truncated");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.raw_bytes = ~0ull; }),
                 mesh + "found 18446744073709551615 raw bytes");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.raw_bytes += 1; }), mesh + "its zstd frame holds");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.count = 2; }), mesh + "found 2 elements");
  expect_refusal(with_record(kLightmapSection, [](R& r) { r.count = 0; }), "(lightmap page): found 0 elements");
  expect_refusal(with_record(kMeshSection, [](R& r) { r.kind = fourcc("MESX"); }),
                 "section MESX (unknown): is of a kind");
  expect_refusal(with_record(kMaterialSection, [](R& r) { r.kind = kMeshSection; }), mesh + "is there more than once");
  expect_refusal(with_record(kMaterialSection, [](R& r) { r.count = 1u << 30; }), "(materials): its counts need more");
  expect_refusal(with_record(kMaterialSection, [](R& r) { r.count = 1; }), "(materials): holds");
  expect_refusal(with_record(kMaterialSection, [](R& r) { r.count = ~0ull; }), "(materials): its counts need more");
}

TEST(Hostile, MissingAndUnknownSections) {
  Forge without_mesh = Forge::from(tiny_file());
  std::erase_if(without_mesh.sections, [](const auto& s) { return s.record.kind == kMeshSection; });
  expect_refusal(without_mesh.file(), "has no section MESH (mesh)");
  Forge required = Forge::from(tiny_file());
  required.find(fourcc("XTRA")).record.flags = 0;
  expect_refusal(required.file(), "section XTRA (unknown): is of a kind that this program does not know");
}

TEST(Hostile, ZstdFrames) {
  Forge trailing = Forge::from(tiny_file());
  trailing.find(kMeshSection).stored.push_back(std::byte{0});
  expect_refusal(trailing.file(), "is not exactly one zstd frame");
  Forge garbage = Forge::from(tiny_file());
  for (auto& b : garbage.find(kMeshSection).stored) b = std::byte{0x55};
  expect_refusal(garbage.file(), "is not a zstd frame");
  // A frame of zeros that expands more than the limit allows.
  Forge bomb = Forge::from(tiny_file());
  auto& mesh = bomb.find(kMeshSection);
  Forge::set_compressed(mesh, Bytes(1 << 22));
  mesh.record.raw_bytes = std::uint64_t{1} << 33;
  expect_refusal(bomb.file(), "raw bytes for");
}

TEST(Hostile, CountsInsideSections) {
  // Mesh: counts of vertices, indices and parts follow the origin.
  expect_refusal(with_raw(kMeshSection, 24, ~0u), "section MESH (mesh): its counts need more");
  expect_refusal(with_raw(kMeshSection, 28, ~0u), "section MESH (mesh): its counts need more");
  expect_refusal(with_raw(kMeshSection, 32, ~0u), "section MESH (mesh): its counts need more");
  expect_refusal(with_raw(kMeshSection, 36, 4u), "found mesh flags 0x4");
  expect_refusal(with_raw(kMaterialSection, 0, ~0u), "section MATL (materials): its counts need more");
  expect_refusal(with_raw(kLightmapSection, 0, ~0u), "found 4294967295 x 4 texels");
  expect_refusal(with_raw(kLightmapSection, 0, 0u), "found 0 x 4 texels");
  expect_refusal(with_raw(kLightmapSection, 0, 32768u), "section LMAP 0 (lightmap page): its counts need more");
  expect_refusal(with_raw(kLightmapSection, 20, 113), "found scale exponent 113");
  expect_refusal(with_raw(kRadianceMapSection, 52, 31), "found disparity shift 31");
  expect_refusal(with_raw(kKernelSection, 0, std::uint8_t{3}), "element 0: found kernel model 3");
  expect_refusal(with_raw(kKernelSection, 20, ~0u), "section KERN (kernels): its counts need more");
  expect_refusal(with_raw(kFresnelSection, 8, ~0u), "section FRES (Fresnel maps): its counts need more");
}

TEST(Hostile, EveryCutOfEverySectionIsRefused) {
  const Forge whole = Forge::from(tiny_file());
  for (std::size_t i = 0; i < whole.sections.size(); ++i) {
    const std::uint32_t kind = whole.sections[i].record.kind;
    if (!find_section_kind(kind) || kind == kProvenanceSection || kind == kPlanSection) continue;
    const Bytes raw = Forge::raw(whole.sections[i]);
    for (std::size_t n = 0; n < raw.size(); ++n) {
      Forge forge = whole;
      Forge::set_raw(forge.sections[i], Bytes(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(n)));
      ASSERT_NE(refusal(forge.file()).find("its counts need more than the"), std::string::npos) << kind_text(kind);
    }
  }
}

// What a cut leaves of a transfer's sizes is not multiplied.
TEST(Hostile, ATransferThatEndsInItsSizes) {
  Forge forge = Forge::from(tiny_file());
  auto& section = forge.find(kMoverSection);
  Bytes raw = Forge::raw(section);
  const CompressedTransfer t = tiny_mapped_pack().movers[0].transfer;
  const std::size_t after_sizes =
      4 + 4 * (t.basis.size() + t.weight_scale.size()) + t.vertices() * static_cast<std::size_t>(t.bytes_per_vertex());
  raw.resize(raw.size() - after_sizes - 1);  // inside the last of the four sizes
  for (std::size_t i = raw.size() - 7; i < raw.size(); ++i) raw[i] = std::byte{0xff};
  Forge::set_raw(section, raw);
  expect_refusal(forge.file(), "section MOVR 0 (mover): its counts need more");
}

TEST(Hostile, HalvesThatAreNotFinite) {
  Forge forge = Forge::from(tiny_file());
  auto& section = forge.find(kLightmapSection);
  Bytes raw = Forge::raw(section);
  raw[24 + 32] = std::byte{0x7c};  // the first byte of red's high plane: infinity or NaN
  Forge::set_raw(section, raw);
  expect_refusal(forge.file(), "section LMAP 0 (lightmap page): element 0: found irradiance half 0x7c");
}

TEST(Hostile, DirectionsAndNormalMapping) {
  const std::string page = "section LMAP 0 (lightmap page): element 0: ";
  expect_refusal(with_raw(kLightmapSection, 8, 4u), page + "found lightmap flags 0x4");
  const std::size_t directions = 24 + 6 * 32;
  expect_refusal(with_raw(kLightmapSection, directions + 32, std::uint8_t{0xfc}), page + "found direction half 0xfc");
  const Mesh mesh = tiny_mapped_pack().mesh;
  const std::size_t n = mesh.positions.size();
  const std::size_t sides = 40 + n * (12 + 4 + 8 + 8 + (mesh.colors.empty() ? 0 : 4) + 8 + 4);
  expect_refusal(with_raw(kMeshSection, sides, std::int8_t{2}), "found side 2 of vertex 0's");
}

TEST(Hostile, KernelsByIncidence) {
  const std::string kernels = "section KERN (kernels): ";
  const std::size_t at = 40 + 24 + 4 * 25;  // behind the weights of the second kernel
  const std::size_t slice = at + 8, radial = slice + 48;
  expect_refusal(with_raw(kKernelSection, at, 4u), kernels + "element 1: found slices of size 4, expected an odd one");
  expect_refusal(with_raw(kKernelSection, at, ~0u), kernels + "element 1: found slices of size 4294967295");
  expect_refusal(with_raw(kKernelSection, at, 32767u), kernels + "its counts need more");
  expect_refusal(with_raw(kKernelSection, at + 4, ~0u), kernels + "element 1: found 4294967295 slices");
  expect_refusal(with_raw(kKernelSection, at + 4, 257u), kernels + "element 1: found 257 slices, expected at most 256");
  expect_refusal(with_raw(kKernelSection, at + 4, 256u), kernels + "its counts need more");
  expect_refusal(with_raw(kKernelSection, radial, ~0u), kernels + "its counts need more");
  expect_refusal(with_raw(kKernelSection, radial + 7, std::uint8_t{0x7c}),
                 kernels + "element 1: found radial share half");
  expect_refusal(with_raw(kKernelSection, radial + 16, std::uint8_t{0xbc}), kernels + "element 1: found weight half");
}

TEST(Hostile, SkyMap) {
  const std::string sky = "section SKYM (sky map): ";
  expect_refusal(with_raw(kSkyMapSection, 0, 0u), sky + "found 0 x 2 texels");
  expect_refusal(with_raw(kSkyMapSection, 0, 2049u), sky + "found 2049 x 2 texels, expected at most 2048 x 1024");
  expect_refusal(with_raw(kSkyMapSection, 4, 1024u), sky + "its counts need more");
}

TEST(Hostile, VisibleSets) {
  const std::string sets = "section PVIS (visible sets): ";
  expect_refusal(with_raw(kVisibleSetsSection, 0, 0u), sets + "found 0 groups of triangles, expected 1 to 65536");
  expect_refusal(with_raw(kVisibleSetsSection, 0, ~0u), sets + "found 4294967295 groups");
  expect_refusal(with_raw(kVisibleSetsSection, 0, 65536u), sets + "its counts need more");
  expect_refusal(with_raw(kVisibleSetsSection, 4, ~0u), sets + "its counts need more");
  expect_refusal(with_raw(kVisibleSetsSection, 8, 0u), sets + "found eye cells of 0 walk cells a side");
  expect_refusal(with_raw(kVisibleSetsSection, 20, ~0u), sets + "its counts need more");
  expect_refusal(with_raw(kVisibleSetsSection, 20, 2u), sets + "holds 1 bytes more");
  expect_refusal(with_raw(kReflectedSetsSection, 0, ~0u), "section RVIS (reflected sets): its counts need more");
}

TEST(Hostile, WhatReflectionsNeed) {
  const std::string walk = "section WALK (walk grids): ", emitters = "section EMIT (emitters): ",
                    reflectors = "section RFLT (reflectors): ";
  expect_refusal(with_raw(kWalkSection, 16, 0u), walk + "element 0: found 0 x 2 texels");
  expect_refusal(with_raw(kWalkSection, 16, 32768u), walk + "its counts need more");
  expect_refusal(with_raw(kWalkSection, 24, std::uint8_t{2}), walk + "element 0: found floor 0 with walkable flag 2");
  Forge infinite = Forge::from(tiny_file());
  Bytes floors = Forge::raw(infinite.find(kWalkSection));
  floors[24 + 6 + 12] = std::byte{0x80};  // the third and the last byte of the first floor's height
  floors[24 + 6 + 18] = std::byte{0x7f};
  Forge::set_raw(infinite.find(kWalkSection), floors);
  expect_refusal(infinite.file(), walk + "element 0: found floor inf with walkable flag 1 in cell 0");
  expect_refusal(with_raw(kEmitterSection, 0, std::uint8_t{5}), emitters + "element 0: found 5 corners");
  expect_refusal(with_raw(kEmitterSection, 1, std::uint8_t{2}), emitters + "element 0: found two-sided flag 2");
  const Reflector reflector = tiny_mapped_pack().reflectors[0];
  const std::size_t at = 4 + reflector.name.size() + 4 + 64 + 16 + 8 + 16 + 4 + 4 * reflector.indices.size();
  expect_refusal(with_raw(kReflectorSection, at, 65u),
                 reflectors + "element 0: found 65 emitters, expected at most 64");
  expect_refusal(with_raw(kReflectorSection, at + 4, 32769u), reflectors + "element 0: found visibility from 32769 x");
  expect_refusal(with_raw(kReflectorSection, at + 4, 32768u), reflectors + "its counts need more");
  expect_refusal(with_raw(kRadianceMapSection, 17, std::uint8_t{2}), "element 0: found unread flag 2");
}

TEST(Hostile, CurvedReflectors) {
  const std::string reflectors = "section CRFL (curved reflectors): ", map = "section SMAP 0 (surround map): ";
  expect_refusal(with_raw(kCurvedReflectorSection, 4 + 4 + 8, ~0u), reflectors + "its counts need more");
  expect_refusal(with_raw(kSurroundMapSection, 12, 3u), map + "element 0: found 3 texels a side");
  expect_refusal(with_raw(kSurroundMapSection, 12, 65536u), map + "element 0: found 65536 texels a side");
  expect_refusal(with_raw(kSurroundMapSection, 12, 32768u), map + "its counts need more");
  expect_refusal(with_raw(kSurroundMapSection, 16, 113), map + "element 0: found scale exponent 113");
}

TEST(Hostile, MapMeshes) {
  const std::string mesh = "section MMSH 0 (map mesh): ";
  expect_refusal(with_raw(kMapMeshSection, 0, 31), mesh + "element 0: found disparity shift 31, expected 0 to 30");
  expect_refusal(with_raw(kMapMeshSection, 4, ~0u), mesh + "its counts need more");
  expect_refusal(with_raw(kMapMeshSection, 8, 9u), mesh + "its counts need more");
  // The first index of six, by planes of bytes behind four vertices.
  expect_refusal(with_raw(kMapMeshSection, 12 + 24, std::uint8_t{1}),
                 mesh + "element 0: found index 4294967295 at 0, expected less than 4 vertices");
}

// Sections may come in any order.
TEST(Hostile, OrderOfSectionsDoesNotMatter) {
  Forge forge = Forge::from(tiny_file());
  std::reverse(forge.sections.begin(), forge.sections.end());
  // All but the radiance maps and their meshes, whose number is their order; and what counts reflectors.
  std::erase_if(forge.sections, [](const auto& s) {
    return s.record.kind == kRadianceMapSection || s.record.kind == kReflectorSection ||
           s.record.kind == kLightGroupSection || s.record.kind == kPageGroupsSection || s.record.kind == kDaySection ||
           s.record.kind == kMapMeshSection || s.record.kind == kReflectedSetsSection;
  });
  const auto pack = decode_pack(forge.file());
  ASSERT_TRUE(pack) << pack.error().text();
  EXPECT_EQ(pack->lightmaps[1].direction.size(), 32u);  // their order is their number
  EXPECT_EQ(pack->materials[1].normal_texture, 0);
  EXPECT_EQ(pack->kernels[1].slices.size(), 2u);
  EXPECT_EQ(pack->kernels[1].fits.size(), 2u);
  EXPECT_TRUE(validate(*pack).empty());
}

bool all_finite(const Pack& pack) {
  const auto finite = [](const std::vector<Vec3>& values) {
    for (const Vec3& v : values)
      if (!is_finite(v)) return false;
    return true;
  };
  for (const auto& page : pack.lightmaps)
    if (!finite(page.irradiance) || !finite(page.standard_error) || !finite(page.direction)) return false;
  for (const auto& map : pack.radiance_maps)
    if (!finite(map.radiance)) return false;
  if (pack.light_field.bands > 0)  // the lookup meets what was accepted
    for (const float v : light_at(pack.light_field, Vec3(0.3f)).sh)
      if (!std::isfinite(v)) return false;
  for (const auto& kernel : pack.kernels)
    for (const auto& slice : kernel.slices)
      for (const double v : {0.0, 1.0})
        if (const DVec2 u = slice_point(slice, {v, v}); !std::isfinite(u.x) || !std::isfinite(u.y)) return false;
  return finite(pack.mesh.positions) && finite(pack.mesh.normals);
}

bool has_errors(const Pack& pack) {
  for (const auto& issue : validate(pack))
    if (issue.severity == Severity::kError) return true;
  return false;
}

// Deterministic fuzzing of the decoders: raw bytes of a section are changed, cut or lengthened, and everything around
// is made right again. What is accepted must be safe, and must survive another round.
TEST(Hostile, MutationsBehindTheChecksums) {
  const Bytes file = tiny_file();
  const Forge whole = Forge::from(file);
  std::mt19937 random(2024);
  int accepted = 0, refused = 0, meaningless = 0;
  for (int round = 0; round < 6000; ++round) {
    Forge forge = whole;
    auto& section = forge.sections[random() % forge.sections.size()];
    if (section.record.kind == fourcc("XTRA")) continue;
    Bytes raw = Forge::raw(section);
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < changes && !raw.empty(); ++i) {
      const std::size_t at = random() % raw.size();
      static constexpr unsigned char kTelling[] = {0, 1, 0x7f, 0x80, 0xff};
      raw[at] = static_cast<std::byte>(random() % 2 == 0 ? kTelling[random() % 5] : random());
    }
    if (random() % 8 == 0) raw.resize(random() % (raw.size() + 1));
    if (random() % 16 == 0) raw.resize(raw.size() + random() % 64);
    if (round % 2 == 0)
      Forge::set_raw(section, raw);
    else
      Forge::set_compressed(section, raw);
    const auto pack = decode_pack(forge.file());
    if (!pack) {
      ++refused;
      ASSERT_EQ(pack.error().code, ErrorCode::kInvalid);
      continue;
    }
    if (has_errors(*pack)) {
      ++meaningless;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(all_finite(*pack));
    const auto again = encode_pack(*pack);
    ASSERT_TRUE(again) << again.error().text();
    const auto back = decode_pack(*again);
    ASSERT_TRUE(back) << back.error().text();
    const auto third = encode_pack(*back);
    ASSERT_TRUE(third && *third == *again) << "round " << round;
  }
  // All three ends are reached, or this test proves nothing.
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused, 300);
  EXPECT_GT(meaningless, 300);
}

// The compressed bytes themselves are changed: zstd's decoder meets them.
TEST(Hostile, MutationsOfFrames) {
  const Forge whole = Forge::from(tiny_file());
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    Forge forge = whole;
    auto& section = forge.sections[random() % forge.sections.size()];
    if (section.stored.empty()) continue;
    section.stored[random() % section.stored.size()] = static_cast<std::byte>(random());
    const auto pack = decode_pack(forge.file());
    if (pack) validate(*pack);
  }
}

}  // namespace
}  // namespace oriel
