// The bytes of an .oriel pack, format version 1. docs/notes/format.md is the specification; both change together.
//
//   FileHeader | SectionRecord x section_count | padding | section | padding | section …
//
// Little-endian. Sections lie in the order of the table, each at the next multiple of kSectionAlignment after the one
// before (the first: after the table); padding is zero; the file ends with the last section's last byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace oriel {

// A byte above 127, and both line ends, so that transfers as text are noticed.
inline constexpr std::array<std::uint8_t, 8> kPackMagic = {0x8F, 'O', 'R', 'I', '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t kPackVersion = 1;
inline constexpr std::uint64_t kSectionAlignment = 64;
// The first place from `offset` on where a section may begin.
constexpr std::uint64_t section_offset_from(std::uint64_t offset) {
  return (offset + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
}

struct FileHeader {
  std::array<std::uint8_t, 8> magic;
  std::uint32_t version;
  std::uint32_t flags;  // reserved: 0
  std::uint32_t section_count;
  std::uint32_t record_bytes;  // sizeof(SectionRecord)
  std::uint64_t table_offset;  // sizeof(FileHeader)
  std::uint64_t file_bytes;
  std::array<std::uint64_t, 2> reserved;  // 0
  std::uint64_t checksum;                 // XXH3-64 of the header before this field, followed by the table
};
static_assert(sizeof(FileHeader) == 64);
static_assert(offsetof(FileHeader, version) == 8 && offsetof(FileHeader, flags) == 12);
static_assert(offsetof(FileHeader, section_count) == 16 && offsetof(FileHeader, record_bytes) == 20);
static_assert(offsetof(FileHeader, table_offset) == 24 && offsetof(FileHeader, file_bytes) == 32);
static_assert(offsetof(FileHeader, reserved) == 40 && offsetof(FileHeader, checksum) == 56);

struct SectionRecord {
  std::uint32_t kind;       // fourcc
  std::uint32_t codec;      // Codec
  std::uint32_t flags;      // bit 0: optional (a reader that does not know the kind may skip it); the others are 0
  std::uint32_t reserved0;  // 0
  std::uint64_t offset;     // from the file's first byte
  std::uint64_t stored_bytes;
  std::uint64_t raw_bytes;  // after decompression
  std::uint64_t count;      // elements inside
  std::uint64_t checksum;   // XXH3-64 of the stored bytes
  std::uint64_t reserved1;  // 0
};
static_assert(sizeof(SectionRecord) == 64);
static_assert(offsetof(SectionRecord, codec) == 4 && offsetof(SectionRecord, flags) == 8);
static_assert(offsetof(SectionRecord, reserved0) == 12 && offsetof(SectionRecord, offset) == 16);
static_assert(offsetof(SectionRecord, stored_bytes) == 24 && offsetof(SectionRecord, raw_bytes) == 32);
static_assert(offsetof(SectionRecord, count) == 40 && offsetof(SectionRecord, checksum) == 48);
static_assert(offsetof(SectionRecord, reserved1) == 56);

enum class Codec : std::uint32_t { kNone = 0, kZstd = 1 };
inline constexpr std::uint32_t kSectionOptional = 1;

// The four characters in file order.
constexpr std::uint32_t fourcc(const char (&text)[5]) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(text[i]);
  return value;
}

struct SectionKind {
  std::uint32_t kind;
  const char* meaning;
  bool optional;  // what bit 0 of the flags says
  bool required;  // exactly one in every pack
  bool one_each;  // a section an element, in order; of the other kinds there is at most one section
};

inline constexpr std::uint32_t kProvenanceSection = fourcc("PROV");
inline constexpr std::uint32_t kPlanSection = fourcc("PLAN");
inline constexpr std::uint32_t kSceneSection = fourcc("SCNE");
inline constexpr std::uint32_t kMeshSection = fourcc("MESH");
inline constexpr std::uint32_t kMaterialSection = fourcc("MATL");
inline constexpr std::uint32_t kSolidSection = fourcc("GLAS");
inline constexpr std::uint32_t kEmissionTextureSection = fourcc("ETEX");
inline constexpr std::uint32_t kTextureSection = fourcc("TEXR");
inline constexpr std::uint32_t kLightmapSection = fourcc("LMAP");
inline constexpr std::uint32_t kSharpLightSection = fourcc("SHRP");
inline constexpr std::uint32_t kNormalTextureSection = fourcc("NTEX");
inline constexpr std::uint32_t kReflectorSection = fourcc("RFLT");
inline constexpr std::uint32_t kRadianceMapSection = fourcc("RMAP");
inline constexpr std::uint32_t kMapMeshSection = fourcc("MMSH");
inline constexpr std::uint32_t kEmitterSection = fourcc("EMIT");
inline constexpr std::uint32_t kFrostedPaneSection = fourcc("PANE");
inline constexpr std::uint32_t kCurvedReflectorSection = fourcc("CRFL");
inline constexpr std::uint32_t kSurroundMapSection = fourcc("SMAP");
inline constexpr std::uint32_t kKernelSection = fourcc("KERN");
inline constexpr std::uint32_t kFresnelSection = fourcc("FRES");
inline constexpr std::uint32_t kCameraSection = fourcc("CAMS");
inline constexpr std::uint32_t kPathSection = fourcc("PATH");
inline constexpr std::uint32_t kWalkSection = fourcc("WALK");
inline constexpr std::uint32_t kVisibleSetsSection = fourcc("PVIS");
inline constexpr std::uint32_t kReflectedSetsSection = fourcc("RVIS");
inline constexpr std::uint32_t kMoverSection = fourcc("MOVR");
inline constexpr std::uint32_t kLightFieldSection = fourcc("PROB");
inline constexpr std::uint32_t kLightGroupSection = fourcc("LGRP");
inline constexpr std::uint32_t kPageGroupsSection = fourcc("GLMP");
inline constexpr std::uint32_t kDaySection = fourcc("DAYH");
inline constexpr std::uint32_t kSkyMapSection = fourcc("SKYM");
inline constexpr std::uint32_t kMetalnessSection = fourcc("METL");

// In the order in which the writer puts them; unknown sections follow.
inline constexpr std::array<SectionKind, 32> kSectionKinds = {{
    {kProvenanceSection, "provenance", true, false, false},
    {kPlanSection, "plan", true, false, false},
    {kSceneSection, "scene", false, true, false},
    {kMeshSection, "mesh", false, true, false},
    {kMaterialSection, "materials", false, false, false},
    {kSolidSection, "solid glass", true, false, false},
    {kEmissionTextureSection, "emission textures", true, false, false},
    {kTextureSection, "texture", false, false, true},
    {kLightmapSection, "lightmap page", false, false, true},
    {kSharpLightSection, "sharp light", false, false, false},
    {kNormalTextureSection, "normal texture", true, false, true},
    {kReflectorSection, "reflectors", false, false, false},
    {kRadianceMapSection, "radiance map", false, false, true},
    {kMapMeshSection, "map mesh", true, false, true},
    {kEmitterSection, "emitters", true, false, false},
    {kFrostedPaneSection, "frosted panes", true, false, false},
    {kCurvedReflectorSection, "curved reflectors", true, false, false},
    {kSurroundMapSection, "surround map", true, false, true},
    {kKernelSection, "kernels", false, false, false},
    {kFresnelSection, "Fresnel maps", false, false, false},
    {kCameraSection, "cameras", true, false, false},
    {kPathSection, "camera paths", true, false, false},
    {kWalkSection, "walk grids", true, false, false},
    {kVisibleSetsSection, "visible sets", true, false, false},
    {kReflectedSetsSection, "reflected sets", true, false, false},
    {kMoverSection, "mover", true, false, true},
    {kLightFieldSection, "light field", true, false, false},
    {kLightGroupSection, "light groups", true, false, false},
    {kPageGroupsSection, "light of groups on a page", true, false, true},
    {kDaySection, "hours of a day", true, false, false},
    {kSkyMapSection, "sky map", true, false, false},
    {kMetalnessSection, "metalness", true, false, false},
}};

// nullptr for a kind that this version does not know.
constexpr const SectionKind* find_section_kind(std::uint32_t kind) {
  for (const auto& known : kSectionKinds)
    if (known.kind == kind) return &known;
  return nullptr;
}

// Limits, so that a hostile file cannot make a reader allocate without end (docs/notes/format.md gives the reasons).
inline constexpr std::uint32_t kMaxSections = 1u << 20;
inline constexpr std::uint64_t kMaxRawBytes = std::uint64_t{1} << 34;   // of all sections together
inline constexpr std::uint64_t kMaxExpansion = std::uint64_t{1} << 16;  // raw bytes for a stored byte
inline constexpr std::uint32_t kMaxSide = 32768;                        // texels of any map
inline constexpr std::uint32_t kMaxSlices = 256;                        // of a kernel by incidence
inline constexpr std::uint32_t kMaxGroups = 1u << 16;                   // of triangles that are seen together

// "LMAP"; characters that are not printable ASCII as hexadecimal.
std::string kind_text(std::uint32_t kind);
// "section LMAP 2 (lightmap page)"; nth counts sections of kinds with one each.
std::string section_label(std::uint32_t kind, std::uint64_t nth);

}  // namespace oriel
