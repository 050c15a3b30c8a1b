// M: the mirrored world from a reflector's radiance maps, as points in quadtrees (Bastos et al. 1999, section 8.1.3).
#pragma once

#include <map>

#include "player/gpu/program.h"
#include "player/reflections/image_target.h"
#include "player/scene/frame_context.h"
#include "study/bastos1999/point_tree.h"

namespace oriel::study {

// A map as points, float RGBA: radiance, and disparity, which is -1 where the pixel saw nothing usable.
gpu::Texture2d upload_points(const RadianceMap& map);

// A reflector's image, where it lies, and the maps that it is made of.
struct PointImage {
  const GpuReflector& reflector;
  const std::vector<ReflectorElement>& elements;
  const std::vector<RadianceMap>& maps;
  const ImageRect& rect;
  const ImageTarget& target;
};

class PointsPass {
 public:
  static Result<PointsPass> create(const gpu::Device& device);

  // Clears the image and draws the chosen maps of all elements that it shows. The reflector's front faces the eye.
  // Holes keep a = 0. context.options.maps_per_element: how many of each.
  void draw(const FrameContext& context, const PointImage& image);

 private:
  struct MapPoints {
    gpu::Texture2d texels;
    std::vector<PointNode> nodes;
  };
  void draw_map(const RadianceMap& map, const MapPoints& points, const SplatView& view, FrameStats& stats) const;
  gpu::Program program_;
  gpu::VertexArray instances_;
  float point_max_ = 1;
  std::map<const RadianceMap*, MapPoints> points_;  // uploaded on first use
};

}  // namespace oriel::study
