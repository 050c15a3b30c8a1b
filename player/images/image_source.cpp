#include "player/images/image_source.h"

#include <algorithm>

#include <new>

#include "formats/core/color.h"

namespace oriel {
namespace {

// Coarser ones serve nobody.
constexpr int kCoarsest = 5, kCoarsestMap = 2;

template <class Image>
IVec2 size_of(const Image& image) {
  return {static_cast<int>(image.width), static_cast<int>(image.height)};
}

IVec2 coarser_size(const IVec2& size, int coarser) {
  return glm::max(size >> coarser, IVec2(1));
}

}  // namespace

std::size_t PreparedImage::bytes() const {
  std::size_t sum = 0;
  for (const TextureData& data : textures) sum += data.bytes();
  return sum;
}

ImageSource::ImageSource(const Pack& pack, std::shared_ptr<const DeferredImages> deferred,
                         std::vector<std::vector<ReflectorElement>> elements)
    : baked_(&pack),
      pack_(deferred ? nullptr : &pack),
      deferred_(std::move(deferred)),
      elements_(std::move(elements)),
      page_groups_(pack.page_groups),
      users_(pack.textures.size()),
      map_light_(std::make_unique<MapLight>(pack)) {
  for (const Material& m : pack.materials)
    if (m.base_color_texture >= 0) users_[static_cast<std::size_t>(m.base_color_texture)].push_back(m);
  for (const Texture& texture : pack.textures) textures_.push_back(size_of(texture));
  for (const Texture& texture : pack.normal_textures) normal_textures_.push_back(size_of(texture));
  for (const LightmapPage& page : pack.lightmaps) {
    pages_.push_back(size_of(page));
    details_.emplace_back(page.detail_width, page.detail_height);
  }
  for (std::size_t i = 0; i < pack.lightmaps.size(); ++i) {
    directional_.push_back(deferred_ ? deferred_->directional(i) : !pack.lightmaps[i].direction.empty());
    sharp_.push_back(deferred_ ? !pack.sharp_light.empty() : !pack.lightmaps[i].sharp_at.empty());
  }
  for (const RadianceMap& map : pack.radiance_maps) maps_.push_back(size_of(map));
  for (const SurroundMap& map : pack.surround_maps) surrounds_.push_back(map.size);
}

std::array<std::size_t, 5> ImageSource::counts() const {
  return {textures_.size(), normal_textures_.size(), pages_.size(), elements_.size(), surrounds_.size()};
}

int ImageSource::coarsest(const ImageName& name) const {
  const auto halves = [](const IVec2& size, int most) { return std::min(gpu::mip_levels(size.x, size.y) - 1, most); };
  switch (name.kind) {
    case ImageKind::kColor:
      return halves(textures_[name.index], kCoarsest);
    case ImageKind::kNormal:
      return halves(normal_textures_[name.index], kCoarsest);
    case ImageKind::kLight:
      return halves(pages_[name.index], kCoarsest);
    case ImageKind::kMaps:
      return kCoarsestMap;
    case ImageKind::kSurround:
      return 0;
  }
  return 0;
}

std::size_t ImageSource::bytes(const ImageName& name, int coarser) const {
  switch (name.kind) {
    case ImageKind::kColor:
      return mipmapped_bytes(textures_[name.index], coarser);
    case ImageKind::kNormal:
      return mipmapped_bytes(normal_textures_[name.index], coarser);
    case ImageKind::kLight:
      return light_page_bytes(pages_[name.index], details_[name.index], directional_[name.index], sharp_[name.index],
                              coarser);
    case ImageKind::kMaps: {
      std::size_t sum = 0;
      for (const ReflectorElement& element : elements_[name.index]) sum += map_array_bytes(map_sizes(element, coarser));
      return sum;
    }
    case ImageKind::kSurround:
      return surround_bytes(surrounds_[name.index]);
  }
  return 0;
}

std::vector<IVec2> ImageSource::map_sizes(const ReflectorElement& element, int coarser) const {
  std::vector<IVec2> sizes;
  for (const std::uint32_t map : element.maps) sizes.push_back(coarser_size(maps_[map], coarser));
  return sizes;
}

Result<PreparedImage> ImageSource::prepare(const ImageName& name, int coarser) const {
  return guarded(name, coarser, Parts::kAll);
}

Result<PreparedImage> ImageSource::guarded(const ImageName& name, int coarser, Parts parts) const {
  try {
    return make(name, coarser, parts);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, "images", "there is not enough memory for the next one");
  }
}

Result<PreparedImage> ImageSource::make(const ImageName& name, int coarser, Parts parts) const {
  PreparedImage out;
  switch (name.kind) {
    case ImageKind::kColor: {
      if (deferred_) {
        ORIEL_TRY(out.texture, deferred_->texture(name.index));
      }
      out.textures.push_back(
          color_texture_data(deferred_ ? out.texture : pack_->textures[name.index], users_[name.index], coarser));
      return out;
    }
    case ImageKind::kNormal: {
      Texture deferred;
      if (deferred_) {
        ORIEL_TRY(deferred, deferred_->normal_texture(name.index));
      }
      out.textures.push_back(normal_texture_data(deferred_ ? deferred : pack_->normal_textures[name.index], coarser));
      return out;
    }
    case ImageKind::kLight: {
      ORIEL_TRY(HalfPage page, light_of_page(name.index, otherwise(name.index, out.lights)));
      LightData data = light_data(std::move(page), coarser);
      out.textures.push_back(std::move(data.light));
      out.directional = data.direction.has_value(), out.detailed = data.detail.has_value();
      out.sharp = data.sharp_at.has_value();
      if (data.direction) out.textures.push_back(std::move(*data.direction));
      if (data.detail) {
        out.textures.push_back(std::move(*data.cells));
        out.textures.push_back(std::move(*data.detail));
      }
      if (data.sharp_at) out.textures.push_back(std::move(*data.sharp_at));
      out.scale = data.scale;
      out.mean_lux = data.mean_lux;
      return out;
    }
    case ImageKind::kMaps:
      return make_maps(name.index, coarser, parts);
    case ImageKind::kSurround:
      return make_surround(name.index, parts);
  }
  return out;
}

void ImageSource::set_lights(std::span<const Vec3> factors, MapFactors of_maps,
                             std::shared_ptr<const PageChanges> changes) {
  const std::scoped_lock lock(lights_->mutex);
  lights_->now.sharp = of_maps.sharp;
  lights_->of_maps = std::move(of_maps);
  lights_->now.factors.assign(factors.begin(), factors.end());
  lights_->now.added = std::move(changes);
  ++lights_->now.changes;
}

std::uint64_t ImageSource::lights() const {
  const std::scoped_lock lock(lights_->mutex);
  return lights_->now.changes;
}

// Kept: its lamps change again and again.
Result<std::shared_ptr<const HalfPage>> ImageSource::baked_page(std::uint32_t page) const {
  {
    const std::scoped_lock lock(lights_->mutex);
    if (const auto at = lights_->baked.find(page); at != lights_->baked.end()) return at->second;
  }
  ORIEL_TRY(HalfPage baked, deferred_ ? deferred_->light(page) : Result<HalfPage>(half_page(pack_->lightmaps[page])));
  auto known = std::make_shared<const HalfPage>(std::move(baked));
  const std::scoped_lock lock(lights_->mutex);
  return lights_->baked.emplace(page, std::move(known)).first->second;
}

ImageSource::Otherwise ImageSource::otherwise(std::uint32_t page, std::uint64_t& lights) const {
  Shining now;
  {
    const std::scoped_lock lock(lights_->mutex);
    now = lights_->now;
  }
  lights = now.changes;
  return otherwise(page, now);
}

ImageSource::Otherwise ImageSource::otherwise(std::uint32_t page, const Shining& now) const {
  Otherwise of;
  of.factors = now.factors, of.added = now.added, of.sharp = now.sharp;
  const auto groups = std::ranges::find(page_groups_, page, &PageGroups::page);
  const bool as_baked = std::ranges::all_of(of.factors, [](const Vec3& factor) { return factor == Vec3(1); });
  if (groups != page_groups_.end() && !as_baked) of.groups = &*groups;
  if (of.added && page < of.added->size() && !(*of.added)[page].empty()) of.change = &(*of.added)[page];
  return of;
}

Result<HalfPage> ImageSource::light_of_page(std::uint32_t page, const Otherwise& of) const {
  if (!of.groups && !of.change)
    return deferred_ ? deferred_->light(page) : Result<HalfPage>(half_page(pack_->lightmaps[page]));
  ORIEL_TRY(const auto known, baked_page(page));
  HalfPage lit = of.groups ? relit(*known, *of.groups, of.factors) : *known;
  return of.change ? changed(std::move(lit), *of.change) : Result<HalfPage>(std::move(lit));
}

Result<PageChange> ImageSource::light_of_group(std::uint32_t page, std::size_t group) const {
  ORIEL_TRY(const auto known, baked_page(page));
  const auto groups = std::ranges::find(page_groups_, page, &PageGroups::page);
  if (groups == page_groups_.end()) return PageChange{};
  std::size_t count = group + 1;
  for (const GroupTexels& other : groups->others) count = std::max<std::size_t>(count, other.group + 1);
  for (const std::uint8_t rest : groups->rest) count = std::max<std::size_t>(count, rest + std::size_t{1});
  std::vector<Vec3> factors(count, Vec3(0));
  factors[group] = Vec3(1);
  return light_of(relit(*known, *groups, factors));
}

std::vector<Vec3> ImageSource::sharp_of_group(const LightmapPage& page, std::span<const PagePoint> points,
                                              std::size_t group) const {
  std::vector<Vec3> factors(baked_->light_groups.size(), Vec3(0));
  factors[group] = Vec3(1);
  return sharp_at_points(baked_->sharp_light, page, points, factors);
}

Result<LightmapPage> ImageSource::whole_page(std::uint32_t page) const {
  return deferred_ ? deferred_->lightmap(page) : Result<LightmapPage>(pack_->lightmaps[page]);
}

Result<LightmapPage> ImageSource::lit_page(std::uint32_t page, std::uint64_t& lights) const {
  try {
    return make_lit_page(page, lights);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, "images", "there is not enough memory for a page of light");
  }
}

Result<LightmapPage> ImageSource::make_lit_page(std::uint32_t page, std::uint64_t& lights) const {
  const Otherwise of = otherwise(page, lights);
  ORIEL_TRY(LightmapPage out, whole_page(page));
  if (!of.groups && !of.change && of.sharp.empty()) return out;
  ORIEL_TRY(const HalfPage light, light_of_page(page, of));
  PageChange now = light_of(light);
  out.sharp = sharp_texels(baked_->sharp_light, baked_->mesh, page, out, of.sharp);
  for (std::size_t i = 0; i < out.sharp.size(); ++i) now.light[i] += out.sharp[i];
  for (std::size_t i = 0; i < out.irradiance.size(); ++i) {
    const float baked = luminance(out.irradiance[i]);
    if (baked > 0) out.standard_error[i] *= luminance(now.light[i]) / baked;
    out.irradiance[i] = now.light[i];
  }
  out.detail = now.detail;
  return out;
}

}  // namespace oriel
