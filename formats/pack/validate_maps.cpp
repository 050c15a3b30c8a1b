// The maps: textures, lightmaps, reflectors with their radiance maps, curved ones with what surrounds them.
#include <algorithm>
#include <bit>

#include "formats/pack/issues.h"

namespace oriel {
namespace {

// Sides and array lengths; false where the arrays must not be looked at.
bool check_area(int number, std::uint32_t width, std::uint32_t height, std::initializer_list<std::size_t> lengths,
                IssueList& list) {
  bool good = width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide;
  if (!good) list.error(number, "found {} x {} texels, expected 1 to {} a side", width, height, kMaxSide);
  for (const std::size_t length : lengths)
    if (good && length != std::size_t{width} * height) {
      list.error(number, "found an array of {} texels, expected {} x {}", length, width, height);
      good = false;
    }
  return good;
}

const auto is_light = [](const Vec3& v) { return not_negative(v); };
constexpr std::size_t kMuch = 1 << 17;  // texels: looking at them takes longer than starting threads

bool is_rigid(const Mat4& m) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(m[column][row])) return false;
  const DMat3 r = DMat3(Mat3(m));
  const DMat3 square = glm::transpose(r) * r;
  double off = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) off = std::max(off, std::abs(square[column][row] - (row == column ? 1.0 : 0.0)));
  return off <= 1e-3 && glm::determinant(r) > 0 && m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

template <class AnyReflector>
void check_triangles(int number, const Pack& pack, std::size_t i, const AnyReflector& r, IssueList& list) {
  const std::vector<std::uint32_t>& indices = r.indices;
  const auto bad = std::count_if(indices.begin(), indices.end(),
                                 [&](std::uint32_t index) { return index >= pack.mesh.positions.size(); });
  if (bad > 0 || indices.size() % 3 != 0)
    list.error(number,
               "reflector {} ('{}'): found {} indices, {} of them out of range, expected a multiple of 3 below {}", i,
               r.name, indices.size(), bad, pack.mesh.positions.size());
}

// Codes of validity, 0 to 2.
void check_validity(int number, const std::vector<std::uint8_t>& valid, IssueList& list) {
  list.each(
      number, "pixels of validity", valid, [](std::uint8_t v) { return v <= 2; }, "0, 1 or 2");
}

void validate_reflector(const Pack& pack, std::size_t i, const Reflector& r, IssueList& list) {
  if (r.material >= pack.materials.size())
    list.error(401, "reflector {} ('{}'): found material {}, expected less than {}", i, r.name, r.material,
               pack.materials.size());
  if (!is_rigid(r.pack_from_reflector))
    list.error(402, "reflector {} ('{}'): pack_from_reflector is not a rotation and a translation", i, r.name);
  if (!is_finite(r.lower) || !is_finite(r.upper) || !(r.lower.x <= r.upper.x) || !(r.lower.y <= r.upper.y))
    list.error(403, "reflector {} ('{}'): found bounds {} to {}, expected finite and rising", i, r.name,
               text_of(r.lower), text_of(r.upper));
  if (!not_negative(r.area_m2) || !not_negative(r.flatness_m))
    list.error(404, "reflector {} ('{}'): found area {} and flatness {}, expected {}", i, r.name, r.area_m2,
               r.flatness_m, kNotNegative);
  check_triangles(405, pack, i, r, list);
  if (std::uint64_t{r.first_map} + r.map_count > pack.radiance_maps.size()) {
    list.error(406, "reflector {} ('{}'): found radiance maps {} to {}, expected at most {}", i, r.name, r.first_map,
               std::uint64_t{r.first_map} + r.map_count, pack.radiance_maps.size());
    return;
  }
  if (r.map_count > 0 && (r.elements_x == 0 || r.elements_y == 0))
    list.error(407, "reflector {} ('{}'): found {} x {} elements with {} radiance maps, expected at least 1 x 1", i,
               r.name, r.elements_x, r.elements_y, r.map_count);
}

void validate_map_place(const Pack& pack, std::size_t i, IssueList& list) {
  const RadianceMap& map = pack.radiance_maps[i];
  if (map.reflector >= pack.reflectors.size()) {
    list.error(412, "found reflector {}, expected less than {}", map.reflector, pack.reflectors.size());
    return;
  }
  const Reflector& r = pack.reflectors[map.reflector];
  if (i < r.first_map || i - r.first_map >= r.map_count)
    list.error(412, "is of reflector {}, which counts maps {} to {} as its own", map.reflector, r.first_map,
               std::uint64_t{r.first_map} + r.map_count);
  if (!is_finite(map.eye) || !(map.eye.z < 0))
    list.error(413, "found eye {}, expected it behind the reflector (z < 0)", text_of(map.eye));
  const bool rises =
      is_finite(map.lower) && is_finite(map.upper) && map.lower.x < map.upper.x && map.lower.y < map.upper.y;
  // Elements that were laid out in floats may pass the bounds by a rounding.
  const Vec2 slack = 1e-3f * (r.upper - r.lower);
  const bool inside = map.lower.x >= r.lower.x - slack.x && map.lower.y >= r.lower.y - slack.y &&
                      map.upper.x <= r.upper.x + slack.x && map.upper.y <= r.upper.y + slack.y;
  if (!rises || !inside)
    list.error(414, "found element {} to {}, expected rising and inside the reflector's {} to {}", text_of(map.lower),
               text_of(map.upper), text_of(r.lower), text_of(r.upper));
}

}  // namespace

void validate_textures(const Pack& pack, ImagePixels pixels, IssueList& list) {
  const auto check = [&](std::uint32_t kind, const std::vector<Texture>& textures) {
    for (std::size_t i = 0; i < textures.size(); ++i) {
      list.in_section(kind, i);
      if (pixels == ImagePixels::kHere)
        validate_pixels(textures[i], list);
      else
        check_area(211, textures[i].width, textures[i].height, {}, list);
    }
  };
  check(kTextureSection, pack.textures);
  check(kNormalTextureSection, pack.normal_textures);
}

void validate_pixels(const Texture& texture, IssueList& list) {
  if (check_area(211, texture.width, texture.height, {}, list) &&
      texture.texels.size() != std::size_t{4} * texture.width * texture.height)
    list.error(211, "found {} bytes of texels, expected 4 x {} x {}", texture.texels.size(), texture.width,
               texture.height);
}

void validate_lightmaps(const Pack& pack, ImagePixels pixels, IssueList& all) {
  std::size_t texels = 0;
  for (const LightmapPage& page : pack.lightmaps) texels += page.irradiance.size();
  const std::vector<std::uint8_t> records = sharp_records(pack.sharp_light);
  all.side_by_side(pack.lightmaps.size(), texels > kMuch, [&](std::size_t i, IssueList& list) {
    const LightmapPage& page = pack.lightmaps[i];
    list.in_section(kLightmapSection, i);
    if (pixels == ImagePixels::kHere)
      validate_pixels(page, list), validate_sharp_places(page.sharp_at, records, list);
    else
      check_area(301, page.width, page.height, {}, list);
  });
}

void validate_cells(std::span<const std::uint32_t> cells, const IVec2& size, const IVec2& details, IssueList& list) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == 0) continue;
    const DetailBlock block = DetailBlock::of(cells[i]);
    const auto x = static_cast<int>(i % static_cast<std::size_t>(size.x)),
               y = static_cast<int>(i / static_cast<std::size_t>(size.x));
    const auto end = [&](std::uint32_t at) { return static_cast<int>(at + block.side()); };
    if (block.side() >= 2 && block.side() <= kMostDetail && end(block.x) < details.x && end(block.y) < details.y &&
        x + 1 < size.x && y + 1 < size.y)
      continue;
    list.error(306,
               "cell {} at ({}, {}): found {} steps a side from ({}, {}) on, expected 2, 4, 8, 16 or 32 within {} x {} "
               "points, "
               "and texels on all its corners",
               i, x, y, block.side(), block.x, block.y, details.x, details.y);
    return;
  }
}

static void validate_sharp(const LightmapPage& page, IssueList& list) {
  if ((page.sharp.empty() && page.sharp_at.empty()) ||
      !check_area(309, page.width, page.height, {page.sharp.size(), page.sharp_at.size()}, list))
    return;
  list.each(309, "texels of sharp light", page.sharp, is_light, kNotNegative);
  const float rounding = 1.001f;
  for (std::size_t i = 0; i < page.sharp.size(); ++i)
    if (glm::any(glm::greaterThan(page.sharp[i], rounding * page.irradiance[i]))) {
      list.error(309, "texel {}: found sharp light {}, expected at most all light, {}", i, text_of(page.sharp[i]),
                 text_of(page.irradiance[i]));
      return;
    }
}

void validate_pixels(const LightmapPage& page, IssueList& list) {
  if (!check_area(301, page.width, page.height, {page.irradiance.size(), page.standard_error.size(), page.state.size()},
                  list))
    return;
  validate_sharp(page, list);
  list.each(302, "texels of irradiance", page.irradiance, is_light, kNotNegative);
  list.each(303, "texels of standard error", page.standard_error, is_light, kNotNegative);
  const IVec2 size(page.width, page.height), details(page.detail_width, page.detail_height);
  if (page.detail.size() != std::size_t{page.detail_width} * page.detail_height || page.detail_width > kMaxDetailSide ||
      page.detail_height > kMaxDetailSide || page.cell.size() != (page.detail.empty() ? 0 : page.state.size())) {
    list.error(305,
               "found {} points and {} cells, expected details of {} x {} and a cell for each of {} texels, or none",
               page.detail.size(), page.cell.size(), page.detail_width, page.detail_height, page.state.size());
    return;
  }
  list.each(305, "points of details", page.detail, is_light, kNotNegative);
  validate_cells(page.cell, size, details, list);
  if (page.direction.empty() || !check_area(304, page.width, page.height, {page.direction.size()}, list)) return;
  list.each(
      304, "directions", page.direction, [](const Vec3& d) { return is_finite(d) && length2(d) <= 1.001f; },
      "length 1 at most");
}

void validate_reflectors(const Pack& pack, IssueList& list) {
  list.in_section(kReflectorSection);
  for (std::size_t i = 0; i < pack.reflectors.size(); ++i) validate_reflector(pack, i, pack.reflectors[i], list);
  list.in_section(kFrostedPaneSection);
  for (std::size_t i = 0; i < pack.frosted_panes.size(); ++i) {
    const Reflector& pane = pack.frosted_panes[i];
    validate_reflector(pack, i, pane, list);
    if (pane.map_count > 0)
      list.error(430, "frosted pane {} ('{}'): found {} radiance maps, expected none", i, pane.name, pane.map_count);
  }
}

void validate_radiance_maps(const Pack& pack, ImagePixels pixels, IssueList& all) {
  std::size_t texels = 0;
  for (const RadianceMap& map : pack.radiance_maps) texels += map.radiance.size();
  all.side_by_side(pack.radiance_maps.size(), texels > kMuch, [&](std::size_t i, IssueList& list) {
    const RadianceMap& map = pack.radiance_maps[i];
    list.in_section(kRadianceMapSection, i);
    validate_map_place(pack, i, list);
    if (pixels == ImagePixels::kHere)
      validate_pixels(map, list);
    else
      check_area(411, map.width, map.height, {}, list);
  });
}

void validate_pixels(const RadianceMap& map, IssueList& list) {
  if (!check_area(411, map.width, map.height, {map.radiance.size(), map.disparity.size(), map.valid.size()}, list))
    return;
  list.each(415, "pixels of radiance", map.radiance, is_light, kNotNegative);
  list.each(
      416, "pixels of disparity", map.disparity, [](float d) { return within(d, 0, 1); }, "0 to 1");
  check_validity(417, map.valid, list);
}

void validate_curved_reflectors(const Pack& pack, IssueList& list) {
  list.in_section(kCurvedReflectorSection);
  for (std::size_t i = 0; i < pack.curved_reflectors.size(); ++i) {
    const CurvedReflector& r = pack.curved_reflectors[i];
    if (r.material >= pack.materials.size() || r.map >= pack.surround_maps.size())
      list.error(431, "curved reflector {} ('{}'): found material {} and map {}, expected less than {} and {}", i,
                 r.name, r.material, r.map, pack.materials.size(), pack.surround_maps.size());
    check_triangles(432, pack, i, r, list);
  }
}

void validate_surround_maps(const Pack& pack, ImagePixels pixels, IssueList& list) {
  for (std::size_t i = 0; i < pack.surround_maps.size(); ++i) {
    const SurroundMap& map = pack.surround_maps[i];
    list.in_section(kSurroundMapSection, i);
    if (!bounded(map.centre)) list.error(441, "found centre {}, expected finite numbers", text_of(map.centre));
    if (!std::has_single_bit(map.size)) list.error(442, "found {} texels a side, expected a power of two", map.size);
    if (pixels == ImagePixels::kHere)
      validate_pixels(map, list);
    else
      check_area(442, map.size, map.size, {}, list);
  }
}

void validate_pixels(const SurroundMap& map, IssueList& list) {
  if (!check_area(442, map.size, map.size, {map.radiance.size(), map.inverse_distance.size(), map.valid.size()}, list))
    return;
  list.each(443, "texels of radiance", map.radiance, is_light, kNotNegative);
  list.each(
      444, "texels of inverse distance", map.inverse_distance, [](float d) { return within(d, 0, kLengthLimit); },
      "0 to 1e18");
  check_validity(445, map.valid, list);
}

}  // namespace oriel
