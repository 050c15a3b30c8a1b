#include "player/output/other.h"

#include <algorithm>
#include <filesystem>

#include "formats/core/color.h"
#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "formats/pack/deferred.h"
#include "formats/query/camera_notes.h"
#include "player/navigation/lamps.h"
#include "player/navigation/poses.h"
#include "player/output/fit_picture.h"
#include "player/output/split.h"

namespace oriel {
namespace {

constexpr float kLight = 1, kAsShown = 2;  // alpha of FrameTarget::light

bool is_picture(const std::string& path) {
  return is_linear_file(path) || std::filesystem::path(path).extension() == ".png";
}

FloatImage linear(const ByteImage& shown) {
  FloatImage out{shown.width, shown.height, 3, {}};
  const std::size_t pixels = std::size_t{shown.width} * shown.height;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.pixels.push_back(linear_from_srgb8(shown.pixels[i * shown.channels + (shown.channels >= 3 ? c : 0)]));
  return out;
}

}  // namespace

Result<std::unique_ptr<Other>> Other::open(const std::string& path, const gpu::Device& device,
                                           const LoadingOptions& loading) {
  std::unique_ptr<Other> other(new Other);
  other->path_ = path;
  if (is_picture(path)) {
    ORIEL_TRY_VOID(other->read_picture());
  } else {
    if (std::filesystem::path(path).extension() != ".oriel")
      return fail(ErrorCode::kUsage, path,
                  "found '{}', expected a pack (.oriel) or a picture (.exr, .png) beside the pack",
                  std::filesystem::path(path).extension().string());
    ORIEL_TRY(DeferredPack pack, open_pack(path));
    ORIEL_TRY(other->scene_, GpuScene::create(std::move(pack), device, loading));
  }
  ORIEL_TRY(other->renderer_, Renderer::create(device));
  return other;
}

Status Other::read_picture() {
  if (is_linear_file(path_)) {
    ORIEL_TRY(LayeredImage image, read_layered_exr(path_));
    const auto layer = image.layers.find("");
    if (layer == image.layers.end()) return invalid(path_, "has no channels R, G and B outside layers");
    picture_ = std::move(layer->second);
    notes_ = std::move(image.attributes);
    if (picture_.channels < 3)
      return invalid(path_, "found {} channel, expected red, green and blue", picture_.channels);
    // What no display shows of broken pixels.
    for (float& v : picture_.pixels) v = v > 0 ? std::min(v, 1e30f) : 0.0f;
    return {};
  }
  ORIEL_TRY(const ByteImage shown, read_png(path_));
  ORIEL_TRY(notes_, read_png_texts(path_));
  picture_ = linear(shown);
  as_shown_ = true;
  return {};
}

std::optional<Camera> Other::camera(const DVec3& origin) const {
  return scene_ ? std::nullopt : camera_of_notes(notes_, origin);
}

Status Other::draw(const Seen& seen) {
  if (!scene_) {
    if (laid_ && renderer_->frame_size() == IVec2(seen.width, seen.height)) return {};
    const auto width = static_cast<std::uint32_t>(seen.width), height = static_cast<std::uint32_t>(seen.height);
    ORIEL_TRY_VOID(renderer_->take_light(fit_picture(picture_, width, height, as_shown_ ? kAsShown : kLight)));
    laid_ = true;
    return {};
  }
  const Pack& pack = scene_->pack();
  FrameOptions options = seen.options;
  std::vector<MoverMove> moves(seen.moves.begin(), seen.moves.end());
  std::erase_if(moves, [&](const MoverMove& move) {
    return std::ranges::find(pack.movers, move.node, &Mover::name) == pack.movers.end() &&
           std::ranges::find(pack.light_groups, move.node, &LightGroup::name) == pack.light_groups.end();
  });
  ORIEL_TRY(options.poses, poses_at(pack, moves, seen.time_s));
  ORIEL_TRY(options.lamps, lamps_at(pack, moves, seen.time_s));
  Camera camera = seen.camera;
  camera.eye = Vec3(DVec3(camera.eye) + seen.origin - pack.mesh.origin);
  const View view = make_view(camera, seen.width, seen.height, bounds_with_movers(*scene_, options.poses));
  ORIEL_TRY_VOID(renderer_->render(*scene_, view, options));
  return {};
}

Result<ByteImage> Other::shown_beside(Renderer& first, float divider, const PictureNotes& notes, std::uint32_t n) {
  ORIEL_TRY(const ByteImage left, shown_picture(first, notes, n));
  ORIEL_TRY(const ByteImage right, shown_picture(*renderer_, notes, n));
  return join_split(left, right, divider);
}

Status Other::write_beside(Renderer& first, float divider, const std::string& path, const PictureNotes& notes,
                           std::uint32_t n) {
  if (!is_linear_file(path)) {
    ORIEL_TRY(const ByteImage shown, shown_beside(first, divider, notes, n));
    return write_shown(path, shown, notes);
  }
  return write_light(path, join_split(light_picture(first, n), light_picture(*renderer_, n), divider), notes);
}

}  // namespace oriel
