// A frame has a price: which reflectors get an image of their own, for what they show by millisecond.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "player/navigation/culling.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

// Milliseconds that an image of a reflector takes.
struct ImagePrices {
  float image_ms = 0, part_us = 0, triangle_us = 0, pixel_us = 0;  // by image, draw, triangle drawn and pixel
  float of(std::uint64_t parts, std::uint64_t triangles, std::uint64_t pixels) const;
};
// renderer: gpu::Device::renderer.
ImagePrices image_prices(const std::string& renderer);
// Of a whole frame of 1280 x 720 pixels, unless the user tells: milliseconds.
float device_budget_ms(const std::string& renderer);
// What images may cost in a frame of that size, where they may cost that at 1280 x 720. coarse: while something moves.
float frame_budget_ms(float budget_ms, int width, int height, bool coarse);
bool is_software(const std::string& renderer);

struct PricedImage {
  float worth = 0;      // any unit
  float price_ms = 0;   // positive
  bool needed = false;  // is drawn whatever it costs
};

struct ImageAllowance {
  bool drawn = false;
  float within_ms = 0;  // for images in it
};

// Needed images, then others in the order of worth over price, as long as the budget covers them. What is left goes to
// the images in them, by worth. An infinite budget draws all.
std::vector<ImageAllowance> afford_images(std::span<const PricedImage> images, float budget_ms);

// R of a material at 60 degrees, largest channel; 0 where nothing is known.
float reflectance_of(const Pack& pack, std::uint32_t material);

// What a reflector shows for each pixel of that rectangle beside its R at 60 degrees: more where it is looked along, as
// polished wood is a mirror then; less where its lobe is wide.
float image_gain(const GpuScene& scene, const View& view, const GpuReflector& reflector, const NdcRect& screen);

}  // namespace oriel
