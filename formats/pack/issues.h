// Collects issues. Used by validate's parts only.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "formats/core/parallel.h"
#include "formats/core/vec.h"
#include "formats/pack/layout.h"
#include "formats/pack/validate.h"

namespace oriel {

// What was found, in a message.
inline std::string text_of(float v) {
  return fmt::format("{}", v);
}
inline std::string text_of(const Vec2& v) {
  return fmt::format("({}, {})", v.x, v.y);
}
inline std::string text_of(const Vec3& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
inline std::string text_of(const Vec4& v) {
  return fmt::format("({}, {}, {}), {}", v.x, v.y, v.z, v.w);
}
template <std::unsigned_integral T>
std::string text_of(T v) {
  return fmt::format("{}", v);
}

class IssueList {
 public:
  // What is added next is about this section.
  void in_section(std::uint32_t kind, std::uint64_t nth = 0) { section_ = section_label(kind, nth), kind_ = kind; }

  template <class... Args>
  void error(int number, fmt::format_string<Args...> format, Args&&... args) {
    issues.push_back({number, Severity::kError, section_, fmt::format(format, std::forward<Args>(args)...), kind_});
  }
  template <class... Args>
  void warning(int number, fmt::format_string<Args...> format, Args&&... args) {
    issues.push_back({number, Severity::kWarning, section_, fmt::format(format, std::forward<Args>(args)...), kind_});
  }
  // One error for all elements that are not good: "3 of 120 vertices: the first is 7, found …, expected …".
  template <class Element, class Good>
  void each(int number, const char* elements, const std::vector<Element>& values, const Good& good,
            const char* expected) {
    std::size_t bad = 0, first = 0;
    for (const Element& value : values) bad += !good(value);
    if (bad == 0) return;
    while (good(values[first])) ++first;
    error(number, "{} of {} {}: the first is number {}, found {}, expected {}", bad, values.size(), elements, first,
          text_of(values[first]), expected);
  }

  // check(i, list) for i below count, side by side where there is much to look at; issues come by i.
  void side_by_side(std::size_t count, bool much, const std::function<void(std::size_t, IssueList&)>& check) {
    std::vector<IssueList> parts(much ? count : 0);
    for_each_parallel(parts.size(), core_count(), [&](std::size_t i) { check(i, parts[i]); });
    for (const IssueList& part : parts) issues.insert(issues.end(), part.issues.begin(), part.issues.end());
    for (std::size_t i = 0; !much && i < count; ++i) check(i, *this);
  }

  std::vector<Issue> issues;

 private:
  std::string section_;
  std::uint32_t kind_ = 0;
};

inline bool is_finite(const Vec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
inline constexpr const char* kNotNegative = "finite numbers from 0 up";
inline constexpr float kLengthLimit = 1e18f;  // of lengths, so that their squares stay finite
// Comparisons with NaN are false, so NaN is never within.
inline bool within(float v, float low, float high) {
  return static_cast<int>(v >= low) & static_cast<int>(v <= high);
}
inline bool within(const Vec3& v, float low, float high) {
  return within(v.x, low, high) && within(v.y, low, high) && within(v.z, low, high);
}
inline bool bounded(const Vec3& v) {
  return within(v, -kLengthLimit, kLengthLimit);
}
inline bool not_negative(float v) {
  return within(v, 0, std::numeric_limits<float>::max());
}
// Without branches: whole maps are asked.
inline bool not_negative(const Vec3& v) {
  return static_cast<int>(not_negative(v.x)) & static_cast<int>(not_negative(v.y)) &
         static_cast<int>(not_negative(v.z));
}

// The parts of validate(), by section.
void validate_mesh(const Pack& pack, IssueList& list);
// The pack's own mesh or a mover's, in the section that the list is in.
void validate_mesh(const Pack& pack, const Mesh& mesh, IssueList& list);
void validate_movers(const Pack& pack, IssueList& list);
void validate_light_field(const Pack& pack, IssueList& list);
void validate_light_groups(const Pack& pack, IssueList& list);
void validate_materials(const Pack& pack, IssueList& list);
void validate_solids(const Pack& pack, IssueList& list);
void validate_emission_textures(const Pack& pack, IssueList& list);
void validate_metalness(const Pack& pack, IssueList& list);
void validate_textures(const Pack& pack, ImagePixels pixels, IssueList& list);
void validate_lightmaps(const Pack& pack, ImagePixels pixels, IssueList& list);
// Of the pack's reflectors and frosted panes.
void validate_reflectors(const Pack& pack, IssueList& list);
void validate_radiance_maps(const Pack& pack, ImagePixels pixels, IssueList& list);
// Of one image, in the section that the list is in.
void validate_pixels(const Texture& texture, IssueList& list);
void validate_pixels(const LightmapPage& page, IssueList& list);
// Of a page of that size: that each lies in its image of details.
void validate_cells(std::span<const std::uint32_t> cells, const IVec2& size, const IVec2& details, IssueList& list);
void validate_sharp_light(const Pack& pack, IssueList& list);
// By word: 0, or 1 and how many splits are below the record that begins there. None behind one that makes no sense.
std::vector<std::uint8_t> sharp_records(const SharpLight& light);
// Of a page: that each is of one of those records.
void validate_sharp_places(std::span<const std::uint32_t> places, std::span<const std::uint8_t> records,
                           IssueList& list);
void validate_pixels(const RadianceMap& map, IssueList& list);
void validate_pixels(const SurroundMap& map, IssueList& list);
void validate_elements(const Pack& pack, IssueList& list);
void validate_map_meshes(const Pack& pack, IssueList& list);
void validate_curved_reflectors(const Pack& pack, IssueList& list);
void validate_surround_maps(const Pack& pack, ImagePixels pixels, IssueList& list);
void validate_kernels(const Pack& pack, IssueList& list);
void validate_fresnel_maps(const Pack& pack, IssueList& list);
void validate_emitters(const Pack& pack, IssueList& list);
// Of movers and of lamps.
void validate_motion(const std::string& whose, const MoverPose& rest, const std::vector<MoverKey>& keys,
                     IssueList& list);
void validate_kernel_fits(const Pack& pack, IssueList& list);
void validate_walk_grids(const Pack& pack, IssueList& list);
void validate_visible_sets(const Pack& pack, IssueList& list);
void validate_reflected_sets(const Pack& pack, IssueList& list);
void validate_cameras(const Pack& pack, IssueList& list);
void validate_texts(const Pack& pack, IssueList& list);
void validate_unknown(const Pack& pack, IssueList& list);

}  // namespace oriel
