#include "player/images/map_light.h"

#include <algorithm>

#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr float kDark = 1e-3f;        // lux: what is reflected of less says little of the surface
constexpr unsigned kThreadsAMap = 2;  // of one map; several are made at once

bool has_page(const MapLights& lights, std::size_t page) {
  return page < lights.now.size() && !lights.now[page].irradiance.empty() && !(*lights.baked)[page].irradiance.empty();
}

template <class Map>
void shine_all(const MapLights& lights, const std::vector<SeenPlace>& places, const Vec3& mean, Map& map) {
  const std::size_t count = std::min(places.size(), map.radiance.size());
  for_each_run(count, kThreadsAMap, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      if (map.valid[i] != 0) map.radiance[i] = light_now(map.radiance[i], places[i], lights, mean);
  });
}

// Where lamps were is what was behind, by the light there and by its colour without texture.
void uncover(const MapLights& lights, const SeenPixels& seen, SurroundMap& map) {
  for (const SeenPixels::Behind& behind : seen.behind) {
    const std::uint16_t lamp = seen.places[behind.pixel].material;
    if (std::ranges::none_of(lights.factors.moved, [&](const auto& moved) { return moved->has(lamp); })) continue;
    if (!has_page(lights, behind.place.page) || behind.place.material >= lights.reflectance.size()) continue;
    map.radiance[behind.pixel] = lights.reflectance[behind.place.material] / kPi *
                                 irradiance_at(lights.now[behind.place.page], behind.place.uv());
    set_distance(map, behind.pixel, behind.distance);
  }
}

void show(std::span<const std::shared_ptr<const MovedLamp>> lamps, SurroundMap& map) {
  for_each_run(map.radiance.size(), kThreadsAMap, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (map.valid[i] == 0) continue;
      SeenRay ray = seen_ray(map, i);
      for (const auto& lamp : lamps)
        if (const auto seen = lamp->along(ray.from, ray.direction, ray.distance)) {
          ray.distance = seen->distance;
          map.radiance[i] = seen->radiance;
          set_distance(map, i, seen->distance);
        }
    }
  });
}

Vec3 factor_of(const std::vector<Vec3>& factors, std::size_t index) {
  return index < factors.size() ? factors[index] : Vec3(1);
}

}  // namespace

Vec3 light_now(const Vec3& baked, const SeenPlace& place, const MapLights& lights, const Vec3& mean) {
  if (!is_finite(baked)) return baked;
  if (place.material == SeenPlace::kSky) return baked * lights.factors.sky;
  const auto& materials = lights.factors.materials;
  const bool known = place.material < materials.size(), shines = known && materials[place.material].has_value();
  const Vec3 beyond = shines ? *materials[place.material] : mean;
  if (!has_page(lights, place.page)) return baked * beyond;
  const Vec3 was = irradiance_at((*lights.baked)[place.page], place.uv());
  const Vec3 is = irradiance_at(lights.now[place.page], place.uv());
  const Vec3 colour = place.material < lights.reflectance.size() ? lights.reflectance[place.material] : Vec3(0.5f);
  const Vec3 most = shines ? colour / kPi : Vec3(1 / kPi);
  const Vec3 share = glm::min((baked + kDark / kPi * colour) / (was + kDark), most);
  const Vec3 rest = glm::max(baked - share * was, Vec3(0));
  return glm::max(baked + share * (is - was) + rest * (beyond - 1.0f), Vec3(0));
}

MapLight::MapLight(const Pack& pack) : pack_(pack), materials_(pack.materials) {
  for (const Material& m : materials_) reflectance_.push_back(glm::mix(m.base_color, m.f0, m.metallic));
}

const SeenPlaces& MapLight::finder() {
  std::call_once(made_, [&] {
    finder_ = std::make_unique<const SeenPlaces>(pack_.mesh, materials_, pack_.reflectors, pack_.fresnel_maps);
  });
  return *finder_;
}

template <class Find>
MapLight::Pixels MapLight::pixels(std::map<std::uint32_t, Pixels>& of, std::uint32_t index, const Find& find) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto at = of.find(index); at != of.end()) return at->second;
  }
  auto found = std::make_shared<const SeenPixels>(find());
  const std::scoped_lock lock(mutex_);
  return of.emplace(index, std::move(found)).first->second;
}

void MapLight::shine(const MapLights& lights, std::uint32_t index, RadianceMap& map) {
  const Reflector& reflector = pack_.reflectors[map.reflector];
  const Pixels seen = pixels(maps_, index, [&] { return finder().of(map, reflector); });
  shine_all(lights, seen->places, factor_of(lights.factors.reflectors, map.reflector), map);
}

void MapLight::shine(const MapLights& lights, std::uint32_t index, SurroundMap& map) {
  const Pixels seen = pixels(surrounds_, index, [&] { return finder().of(map); });
  shine_all(lights, seen->places, factor_of(lights.factors.surrounds, index), map);
  if (lights.factors.moved.empty()) return;
  uncover(lights, *seen, map);
  show(lights.factors.moved, map);
}

void MapLight::forget_map(std::uint32_t index) {
  const std::scoped_lock lock(mutex_);
  maps_.erase(index);
}

void MapLight::forget_surround(std::uint32_t index) {
  const std::scoped_lock lock(mutex_);
  surrounds_.erase(index);
}

}  // namespace oriel
