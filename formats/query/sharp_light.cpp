#include "formats/query/sharp_light.h"

#include <array>
#include <bit>

#include "formats/core/half.h"

namespace oriel {
namespace {

constexpr float kEndStep = 1e-7f;  // sine

// A lamp as a point sees it.
struct ShiningLamp {
  Vec3 towards{0};     // unit
  float distance = 0;  // 0: a sun's
  float spread = 0;    // tangent of a sun's radius
  Vec3 light{0};       // lux, without shadows
};

ShiningLamp shining(const SharpLight& light, const SharpLamp& lamp, const SharpPlace& at,
                    std::span<const Vec3> factors) {
  const Vec3 power = lamp.light_group < factors.size() ? lamp.intensity * factors[lamp.light_group] : lamp.intensity;
  const Vec3 &p = at.position, &normal = at.normal;
  if (lamp.sun)
    return {-lamp.direction, 0, std::tan(lamp.angular_radius_rad),
            power * std::max(-glm::dot(normal, lamp.direction), 0.0f)};
  const Vec3 to = lamp.position - p;
  const float distance2 = std::max(length2(to), 1e-12f), distance = std::sqrt(distance2);
  const Vec3 towards = to / distance;
  const float cone =
      std::clamp((-glm::dot(lamp.direction, towards) - lamp.cos_outer) * lamp.inverse_falloff, 0.0f, 1.0f);
  const float share = lamp.profile < 0
                          ? cone * cone
                          : candela_of(light.profiles[static_cast<std::size_t>(lamp.profile)], lamp, -towards);
  return {towards, distance, 0, power * (share * std::max(glm::dot(normal, towards), 0.0f) / distance2)};
}

// One of a triangle's edges as a point sees it: a plane through both.
struct SeenEdge {
  Vec3 inwards{0};  // unit
  float hard = 0;   // sine below which rounding is all that parts a direction from the plane
  bool ends = false;

  SeenEdge(const Vec3& a, const Vec3& b, float turn, bool shadow_ends) : ends(shadow_ends) {
    const Vec3 across = turn * glm::cross(a, b);
    const float size = std::max(glm::length(across), 1e-20f);
    inwards = across / size;
    hard = 1e-6f * (length2(a) + length2(b)) / size;
  }
  // How far it is on the triangle's side, of a sine.
  float inside(float sine) const {
    if (!ends) return sine >= -hard ? 1.0f : 0.0f;
    return std::clamp(sine / kEndStep + 0.5f, 0.0f, 1.0f);
  }
};
using SeenEdges = std::array<SeenEdge, 3>;

float covered_by(const SeenEdges& edges, const Vec3& towards) {
  float in_all = 1;
  for (const SeenEdge& edge : edges) in_all = std::min(in_all, edge.inside(glm::dot(edge.inwards, towards)));
  return in_all;
}

// Of a sun's places, by bit.
std::uint64_t covered_of_disk(const SeenEdges& edges, const ShiningLamp& lamp) {
  const Vec3& to = lamp.towards;
  const Vec3 u = glm::normalize(std::abs(to.x) < 0.7f ? Vec3(0, to.z, -to.y) : Vec3(-to.z, 0, to.x));
  const Vec3 v = glm::cross(to, u);
  std::uint64_t in_all = ~std::uint64_t{0};
  for (const SeenEdge& edge : edges) {
    const float sine = glm::dot(edge.inwards, to) + (edge.ends ? 0 : edge.hard);
    const Vec2 slope = lamp.spread * Vec2(glm::dot(edge.inwards, u), glm::dot(edge.inwards, v));
    for (std::size_t i = 0; i < kSunPlaces.size(); ++i)
      if (sine + glm::dot(slope, kSunPlaces[i]) < 0) in_all &= ~(std::uint64_t{1} << i);
  }
  return in_all;
}

// How much of a lamp those triangles leave.
float visible_share(const SharpLight& light, const ShiningLamp& lamp, std::span<const std::uint32_t> words,
                    const Vec3& p) {
  float covered = 0;
  std::uint64_t of_disk = 0;
  for (const std::uint32_t word : words) {
    const auto& corners = light.triangles[word & ((1u << kSharpEdgeShift) - 1)];
    const Vec3 a = corners[0] - p, b = corners[1] - p, c = corners[2] - p, normal = glm::cross(b - a, c - a);
    // The triangle's plane must lie between the point and the lamp.
    const float height = glm::dot(normal, a);
    const float of_lamp = glm::dot(normal, lamp.towards) * (lamp.distance > 0 ? lamp.distance : 1e20f);
    if (height * (of_lamp - height) <= 0) continue;
    const float turn = height > 0 ? 1.0f : -1.0f;
    const auto ends = [word](int edge) { return (word >> (kSharpEdgeShift + edge) & 1u) != 0; };
    const SeenEdges edges = {SeenEdge(a, b, turn, ends(0)), SeenEdge(b, c, turn, ends(1)),
                             SeenEdge(c, a, turn, ends(2))};
    if (lamp.spread > 0)
      of_disk |= covered_of_disk(edges, lamp);
    else if ((covered = std::max(covered, covered_by(edges, lamp.towards))) >= 1)
      return 0;
  }
  if (lamp.spread > 0) covered = static_cast<float>(std::popcount(of_disk)) / static_cast<float>(kSunPlaces.size());
  return 1 - covered;
}

// Where in `words` the record of that place begins; 0: there is none.
std::uint32_t record_at(const SharpLight& light, const LightmapPage& page, const Vec2& uv) {
  const UVec2 size(page.width, page.height);
  const Vec2 at = glm::clamp(uv, Vec2(0), Vec2(1)) * Vec2(size);
  const UVec2 texel = glm::min(UVec2(at), size - 1u);
  std::uint32_t place = page.sharp_at[std::size_t{texel.y} * page.width + texel.x];
  Vec2 within = at - Vec2(texel);
  while (place != 0 && light.words[place] == kSharpSplit) {
    within *= 2.0f;
    const UVec2 quarter(glm::min(within, Vec2(1)));
    within -= Vec2(quarter);
    place = light.words[place + 1 + quarter.x + 2 * quarter.y];
  }
  return place;
}

}  // namespace

// Vogel 1979.
const std::array<Vec2, 64> kSunPlaces = [] {
  std::array<Vec2, 64> places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float turn = static_cast<float>(i) * kPi * (3 - std::sqrt(5.0f));
    places[i] = std::sqrt((static_cast<float>(i) + 0.5f) / 64) * Vec2(std::cos(turn), std::sin(turn));
  }
  return places;
}();

float candela_of(const LampProfile& profile, const SharpLamp& lamp, const Vec3& direction) {
  const Vec2 across(glm::dot(lamp.right, direction), glm::dot(lamp.over, direction));
  const float vertical = std::atan2(glm::length(across), glm::dot(lamp.direction, direction)) * (180 / kPi);
  // What was measured at 90° must still be found there.
  if (vertical < profile.first_deg - 1e-4f || vertical > profile.last_deg + 1e-4f) return 0;
  const float last = static_cast<float>(profile.rows - 1);
  const float y =
      std::clamp((vertical - profile.first_deg) / (profile.last_deg - profile.first_deg), 0.0f, 1.0f) * last;
  const float turns = std::atan2(across.y, across.x) / (2 * kPi);
  const float x = (turns - std::floor(turns)) * static_cast<float>(profile.columns);
  const std::uint32_t row = std::min(static_cast<std::uint32_t>(y), profile.rows - 2),
                      column = std::min(static_cast<std::uint32_t>(x), profile.columns - 1),
                      next = (column + 1) % profile.columns;
  const float down = y - static_cast<float>(row);
  const auto at = [&](std::uint32_t c) {
    const float* candela = &profile.candela[std::size_t{row} * profile.columns + c];
    return glm::mix(candela[0], candela[profile.columns], down);
  };
  return glm::mix(at(column), at(next), x - static_cast<float>(column));
}

Vec3 sharp_irradiance(const SharpLight& light, const LightmapPage& page, const SharpPlace& at,
                      std::span<const Vec3> factors) {
  if (page.sharp_at.empty()) return Vec3(0);
  const std::uint32_t place = record_at(light, page, at.uv);
  if (place == 0) return Vec3(0);
  std::span<const std::uint32_t> words = std::span(light.words).subspan(place + 1);
  Vec3 sum(0);
  for (std::uint32_t lamps = light.words[place]; lamps > 0; --lamps) {
    const SharpShine shine = SharpShine::of(words[0]);
    const Vec3 tint = shine.tinted ? rgb_from_rgb9e5(words[1]) : Vec3(1);
    words = words.subspan(shine.tinted ? 2 : 1);
    const ShiningLamp lamp = shining(light, light.lamps[shine.lamp], at, factors);
    if (max_component(lamp.light) > 0)
      sum += lamp.light * tint * visible_share(light, lamp, words.first(shine.count), at.position);
    words = words.subspan(shine.count);
  }
  return sum;
}

}  // namespace oriel
