#include "formats/query/group_light.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "formats/core/color.h"
#include "formats/core/half.h"

namespace oriel {
namespace {

constexpr int kHalfExponent = 15;  // of 2: halves reach beyond it, codes of what is rounded up too

GroupCode code_of(const Vec3& light, float inverse) {
  GroupCode code;
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t half = half_from_float(light[c] * inverse);
    const std::uint32_t rounded = (half + (1u << (kGroupCodeShift - 1))) >> kGroupCodeShift;
    code[static_cast<std::size_t>(c)] = static_cast<std::uint16_t>(std::min<std::uint32_t>(rounded, kLargestGroupCode));
  }
  return code;
}

float light_of(std::uint16_t code) {
  return float_from_positive_half(static_cast<std::uint16_t>(code << kGroupCodeShift));
}

// of(group): its light by texel or point; rest: by these, 0. A texel whose group is the rest keeps the code before,
// which costs no bytes.
template <class Of>
void divide(std::size_t groups, const Of& of, float inverse, std::vector<std::uint8_t>& rest,
            const std::function<std::vector<GroupCode>&(std::size_t)>& codes_of) {
  const std::size_t count = rest.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t g = 1; g < groups; ++g)
      if (luminance(of(g)[i]) > luminance(of(rest[i])[i])) rest[i] = static_cast<std::uint8_t>(g);
  // Where there is no light at all the rest is whoever was it before.
  for (std::size_t i = 1; i < count; ++i)
    if (!(luminance(of(rest[i])[i]) > 0)) rest[i] = rest[i - 1];
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<GroupCode>& codes = codes_of(g);
    GroupCode before{};
    for (std::size_t i = 0; i < count; ++i)
      codes.push_back(before = rest[i] == g ? before : code_of(of(g)[i], inverse));
  }
}

bool is_dark(const GroupTexels& group) {
  const auto dark = [](const std::vector<GroupCode>& codes) {
    return std::ranges::all_of(codes, [](const GroupCode& code) { return code == GroupCode{}; });
  };
  return dark(group.light) && dark(group.detail);
}

}  // namespace

PageGroups groups_of_page(const LightmapPage& page, std::uint32_t number,
                          std::span<const std::vector<LightmapPage>> light) {
  PageGroups out;
  out.page = number, out.width = page.width, out.height = page.height;
  out.detail_width = page.detail_width, out.detail_height = page.detail_height;
  std::vector<std::vector<Vec3>> smooth;  // by group
  for (const auto& pages : light) smooth.push_back(without_sharp(pages[number]));
  float brightest = 0;
  for (std::size_t g = 0; g < light.size(); ++g)
    for (const std::vector<Vec3>* values : {&std::as_const(smooth[g]), &light[g][number].detail})
      for (const Vec3& value : *values) brightest = std::max(brightest, max_component(value));
  if (brightest > 0) out.exponent = std::clamp(std::ilogb(brightest) + 1 - kHalfExponent, -94, 112);
  const float inverse = std::ldexp(1.0f, -out.exponent);
  out.others.resize(light.size());
  for (std::uint32_t g = 0; g < light.size(); ++g) out.others[g].group = g;
  out.rest.resize(page.irradiance.size()), out.rest_of_detail.resize(page.detail.size());
  divide(
      light.size(), [&](std::size_t g) -> const std::vector<Vec3>& { return smooth[g]; }, inverse, out.rest,
      [&](std::size_t g) -> std::vector<GroupCode>& { return out.others[g].light; });
  divide(
      light.size(), [&](std::size_t g) -> const std::vector<Vec3>& { return light[g][number].detail; }, inverse,
      out.rest_of_detail, [&](std::size_t g) -> std::vector<GroupCode>& { return out.others[g].detail; });
  std::erase_if(out.others, [](const GroupTexels& group) { return is_dark(group); });
  return out;
}

void relight(const PageGroups& page, bool details, GroupFactors factors, std::size_t first, std::span<Vec3> whole) {
  const std::vector<std::uint8_t>& rest = details ? page.rest_of_detail : page.rest;
  const float scale = std::ldexp(1.0f, page.exponent);
  // Σ f_g E_g = f_r E + Σ (f_g - f_r) E_g, r being the rest.
  std::vector<Vec3> change(whole.size(), Vec3(0));
  for (const GroupTexels& other : page.others) {
    const std::vector<GroupCode>& codes = details ? other.detail : other.light;
    const Vec3 factor = factors[other.group] * scale;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const std::uint8_t r = rest[first + i];
      const Vec3 more = factor - factors[r] * scale;
      if (r == other.group || more == Vec3(0)) continue;
      const GroupCode& code = codes[first + i];
      change[i] += more * Vec3(light_of(code[0]), light_of(code[1]), light_of(code[2]));
    }
  }
  for (std::size_t i = 0; i < whole.size(); ++i)
    whole[i] = glm::max(factors[rest[first + i]] * whole[i] + change[i], Vec3(0));
}

}  // namespace oriel
