// Radiance and surround maps as lamps shine now.
#include <algorithm>

#include "formats/core/parallel.h"
#include "player/images/image_source.h"

namespace oriel {
namespace {

// Over the pixels of maps that come one after the other.
class MeanOfMaps {
 public:
  void add(const RadianceMap& map) {
    for (std::size_t i = 0; i < map.radiance.size(); ++i) {
      if (map.valid[i] == 0 || !is_finite(map.radiance[i])) continue;
      radiance_ += DVec3(map.radiance[i]);
      count_ += 1;
    }
  }
  Vec3 mean() const { return count_ > 0 ? Vec3(radiance_ / count_) : Vec3(0); }

 private:
  DVec3 radiance_{0};
  double count_ = 0;
};

bool is_one(const Vec3& factor) {
  return factor == Vec3(1);
}

bool as_baked(const MapFactors& factors) {
  return factors.moved.empty() && is_one(factors.sky) &&
         std::ranges::all_of(factors.materials,
                             [](const std::optional<Vec3>& factor) { return is_one(factor.value_or(Vec3(1))); });
}

LightmapPage as_lightmap(const HalfPage& page, std::vector<Vec3> sharp) {
  LightmapPage out;
  out.width = page.width, out.height = page.height;
  out.cell = page.cell, out.detail_width = page.detail_width, out.detail_height = page.detail_height;
  PageChange light = light_of(page);
  out.irradiance = std::move(light.light), out.detail = std::move(light.detail);
  for (std::size_t i = 0; i < sharp.size(); ++i) out.irradiance[i] += sharp[i];
  out.sharp = std::move(sharp);
  return out;
}

// Threads of one of several jobs in the background, each with a map.
constexpr unsigned kMapsAtOnce = 4;

}  // namespace

// of: what its lights and geometry is is put there.
ImageSource::LightOfMaps ImageSource::light_of_maps(PreparedImage& of) const {
  const std::scoped_lock lock(followed_->mutex);
  Shining now;
  MapFactors of_maps;
  {
    const std::scoped_lock shining(lights_->mutex);
    now = lights_->now, of_maps = lights_->of_maps;
  }
  of.lights = now.changes, of.geometry = of_maps.geometry;
  if (followed_->lights != of.lights) {
    followed_->light = make_light_of_maps(now, of_maps);
    followed_->lights = of.lights;
    if (!followed_->light) followed_->baked.reset();
  }
  return followed_->light;
}

std::uint64_t ImageSource::geometry() const {
  const std::scoped_lock lock(lights_->mutex);
  return lights_->of_maps.geometry;
}

std::vector<Vec3> ImageSource::sharp_of_page(std::uint32_t page, const HalfPage& light,
                                             std::span<const Vec3> factors) const {
  if (light.sharp_at.empty()) return {};
  const Result<LightmapPage> whole = whole_page(page);
  if (!whole) return {};
  return factors.empty() ? whole->sharp : sharp_texels(baked_->sharp_light, baked_->mesh, page, *whole, factors);
}

// A page that cannot be read has no texels: what shows it follows on average.
ImageSource::LightOfMaps ImageSource::make_light_of_maps(const Shining& now, const MapFactors& of_maps) const {
  if (as_baked(of_maps) && std::ranges::all_of(now.factors, is_one) && !now.added) return {};
  if (!followed_->baked) {
    auto pages = std::make_shared<std::vector<LightmapPage>>();
    for (std::uint32_t p = 0; p < pages_.size(); ++p) {
      const auto page = baked_page(p);
      pages->push_back(page ? as_lightmap(**page, sharp_of_page(p, **page, {})) : LightmapPage());
    }
    followed_->baked = std::move(pages);
  }
  auto out = std::make_shared<MapLights>();
  out->factors = of_maps;
  out->baked = followed_->baked;
  out->reflectance = map_light_->reflectance();
  for (std::uint32_t p = 0; p < pages_.size(); ++p) {
    const auto page = light_of_page(p, otherwise(p, now));
    out->now.push_back(page ? as_lightmap(*page, sharp_of_page(p, *page, now.sharp)) : LightmapPage());
  }
  return out;
}

Result<RadianceMap> ImageSource::radiance_map(std::uint32_t index) const {
  if (deferred_) return deferred_->radiance_map(index);
  return pack_->radiance_maps[index];
}

Result<PreparedImage> ImageSource::make_maps(std::uint32_t reflector, int coarser, Parts parts) const {
  PreparedImage out;
  const LightOfMaps light = light_of_maps(out);
  MeanOfMaps mean;
  for (const ReflectorElement& element : elements_[reflector]) {
    std::vector<RadianceMap> maps(element.maps.size());
    std::vector<Status> loaded(maps.size());
    for_each_parallel(maps.size(), kMapsAtOnce, [&](std::size_t m) {
      if (*abandoned_) {
        loaded[m] = fail(ErrorCode::kStopped, "images", "nobody waits for them any more");
        return;
      }
      Result<RadianceMap> map = radiance_map(element.maps[m]);
      if (map && light) map_light_->shine(*light, element.maps[m], *map);
      if (map)
        maps[m] = std::move(*map);
      else
        loaded[m] = tl::unexpected<Error>(std::move(map).error());
    });
    for (const Status& status : loaded) ORIEL_TRY_VOID(status);
    std::vector<const RadianceMap*> layers;
    std::vector<IVec2> sizes;
    for (RadianceMap& map : maps) {
      mean.add(map);
      if (coarser > 0) map = coarser_map(map, coarser);
      layers.push_back(&map);
      sizes.emplace_back(static_cast<int>(map.width), static_cast<int>(map.height));
    }
    MapArrayData data = parts == Parts::kAll ? MapArrayData::make(layers) : MapArrayData::light_of(layers);
    out.textures.push_back(std::move(data.light));
    if (parts == Parts::kAll) out.textures.push_back(std::move(data.disparity));
    out.map_scales.push_back(std::move(data.scale));
    out.map_sizes.push_back(std::move(sizes));
  }
  out.mean_radiance = mean.mean();
  return out;
}

Result<PreparedImage> ImageSource::make_surround(std::uint32_t index, Parts parts) const {
  PreparedImage out;
  const LightOfMaps light = light_of_maps(out);
  ORIEL_TRY(SurroundMap map,
            deferred_ ? deferred_->surround_map(index) : Result<SurroundMap>(pack_->surround_maps[index]));
  if (light) map_light_->shine(*light, index, map);
  SurroundData data = surround_data(map);
  out.textures.push_back(std::move(data.light));
  if (parts == Parts::kAll) out.textures.push_back(std::move(data.inverse_distance));
  out.surround = std::move(data.place);
  return out;
}

Result<PreparedImage> ImageSource::prepare_light(const ImageName& maps, int coarser) const {
  return guarded(maps, coarser, Parts::kLight);
}

std::size_t ImageSource::light_bytes(const ImageName& maps, int coarser) const {
  if (maps.kind != ImageKind::kMaps) return bytes(maps, coarser);
  std::size_t sum = 0;
  for (const ReflectorElement& element : elements_[maps.index]) sum += map_light_bytes(map_sizes(element, coarser));
  return sum;
}

void ImageSource::forget(const ImageName& maps) const {
  if (maps.kind == ImageKind::kSurround) map_light_->forget_surround(maps.index);
  if (maps.kind != ImageKind::kMaps) return;
  for (const ReflectorElement& element : elements_[maps.index])
    for (const std::uint32_t map : element.maps) map_light_->forget_map(map);
}

}  // namespace oriel
