// Lamps that shine otherwise than they were baked, or from elsewhere.
#include <algorithm>
#include <atomic>

#include "player/scene/gpu_scene.h"
#include "player/scene/live_lamps.h"

namespace oriel {
namespace {

// A part's vertices where its lamp is.
void place_part(const Mesh& baked, const MeshPart& part, const Mat4& pose, std::vector<Vec3>& positions,
                std::vector<Vec3>& normals) {
  for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
    const std::uint32_t v = baked.indices[i];
    positions[v] = Vec3(pose * Vec4(baked.positions[v], 1));
    normals[v] = Mat3(pose) * baked.normals[v];
  }
}

bool contains(const std::vector<std::uint32_t>& list, std::uint32_t wanted) {
  return std::ranges::find(list, wanted) != list.end();
}

}  // namespace

std::uint64_t next_scene_serial() {
  static std::atomic<std::uint64_t> scenes{0};
  return ++scenes;
}

GpuScene::~GpuScene() = default;

bool GpuScene::has_live_news() const {
  return live_->ready() || images_->has_light_news();
}

std::vector<LiveReport> GpuScene::take_live_reports() {
  return live_->take_reports();
}

Status GpuScene::set_lamps(std::span<const Vec3> factors, std::span<const MoverPose> poses, const LiveSettings& live) {
  images_->begin_frame();
  const std::size_t groups = pack_.light_groups.size();
  std::vector<Vec3> wanted(groups, Vec3(1));
  if (factors.size() == groups) wanted.assign(factors.begin(), factors.end());
  std::vector<MoverPose> places(groups);
  if (poses.size() == groups) places.assign(poses.begin(), poses.end());
  // What is switched off gives nothing from wherever it is.
  std::vector<MoverPose> lit = places;
  for (std::size_t g = 0; g < groups; ++g)
    if (wanted[g] == Vec3(0)) lit[g] = {};
  ORIEL_TRY(const bool other_light, live_->place(lit, live));
  if (wanted == lights_ && !other_light && places == lamps_) return {};
  lights_ = std::move(wanted);
  serial_ = next_scene_serial();
  std::vector<Vec3> before;  // by emitter
  for (const Emitter& e : pack_.emitters) before.push_back(e.radiance);
  const bool moves = places != lamps_;
  baked_.scale_light(lights_, pack_);
  if (moves) move_lamps(places);
  bright_lights_ = placed_lights(pack_, lamps_);
  for (GpuReflector& r : reflectors_) list_emitters(r, pack_.reflectors[r.index], true);
  const auto changes = [&](std::uint32_t e) { return pack_.emitters[e].radiance != before[e]; };
  for (GpuReflector& pane : frosted_panes_)  // there may be hundreds
    if (const Reflector& side = pack_.frosted_panes[pane.index]; moves || std::ranges::any_of(side.emitters, changes))
      list_emitters(pane, side, false);
  sharp_light_.shine(pack_.sharp_light, factors_of_sharp_light());
  return images_->set_lights(lights_, factors_of_maps(), live_->changes(lights_));
}

// What changes() has of lamps that moved stands for their sharp light too.
std::vector<Vec3> GpuScene::factors_of_sharp_light() const {
  if (pack_.sharp_light.empty()) return {};
  std::vector<Vec3> out = lights_;
  for (std::size_t g = 0; g < out.size(); ++g)
    if (live_->has_changed(g)) out[g] = Vec3(0);
  return out;
}

// Those of lamps that have moved where they are seen from now, once that is known; until then maps and images have
// them.
void GpuScene::list_emitters(GpuReflector& reflector, const Reflector& baked, bool views) const {
  ListedEmitters listed = listed_by(baked);
  std::vector<std::uint8_t> visibility;
  reflector.listed.clear();
  const auto add = [&](std::uint32_t emitter, std::span<const std::uint8_t> nodes) {
    reflector.listed.push_back(emitter);
    visibility.insert(visibility.end(), nodes.begin(), nodes.end());
  };
  const auto has_moved = [&](std::uint32_t emitter) {
    for (std::size_t g = 0; g < lamps_.size(); ++g)
      if (!is_rest(lamps_[g]) && contains(pack_.light_groups[g].emitters, emitter)) return true;
    return false;
  };
  const std::size_t nodes = std::size_t{baked.visibility_x} * baked.visibility_y;
  for (std::size_t k = 0; k < baked.emitters.size(); ++k)
    if (!has_moved(baked.emitters[k])) add(baked.emitters[k], listed.visibility.subspan(k * nodes, nodes));
  for (std::size_t g = 0; views && g < lamps_.size(); ++g)
    for (const EmitterView& view : live_->views(g)) {
      if (view.reflector != reflector.index) continue;
      if (reflector.listed.size() + view.polygons.size() > kMaxReflectorEmitters) continue;
      listed.visibility_x = view.x, listed.visibility_y = view.y;
      const std::span<const std::uint8_t> seen = view.visibility;
      const std::size_t each = seen.size() / view.polygons.size();
      for (std::size_t p = 0; p < view.polygons.size(); ++p)
        add(pack_.light_groups[g].emitters[view.polygons[p]], seen.subspan(p * each, each));
    }
  listed.emitters = reflector.listed, listed.visibility = visibility;
  reflector.emitters = upload_emitters(pack_, listed, reflector.reflector_from_pack, reflector.size);
}

// Lamps that have moved do not shine where maps show them.
MapFactors GpuScene::factors_of_maps() const {
  MapFactors out;
  out.sharp = factors_of_sharp_light();
  out.materials.resize(pack_.materials.size());
  for (std::size_t m = 0; m < pack_.materials.size(); ++m)
    if (pack_.materials[m].unlit) out.materials[m] = Vec3(1);  // whatever the lamps do
  for (std::size_t g = 0; g < pack_.light_groups.size(); ++g)
    for (const std::uint32_t m : pack_.light_groups[g].materials)
      out.materials[m] = is_rest(lamps_[g]) ? lights_[g] : Vec3(0);
  for (std::size_t g = 0; g < pack_.light_groups.size(); ++g)
    if (const LightGroup& group = pack_.light_groups[g]; !is_rest(lamps_[g]))
      out.moved.push_back(std::make_shared<const MovedLamp>(pack_, group, lamps_[g]));
  if (!out.moved.empty()) out.geometry = geometry_serial_;
  for (int c = 0; c < 3; ++c)
    if (baked_.sky()[c] > 0) out.sky[c] = pack_.sky[c] / baked_.sky()[c];
  for (std::size_t r = 0; r < pack_.reflectors.size(); ++r)
    out.reflectors.push_back(mean_factor(pack_, lights_, &LightGroup::reflectors, r));
  for (std::size_t m = 0; m < pack_.surround_maps.size(); ++m)
    out.surrounds.push_back(mean_factor(pack_, lights_, &LightGroup::surrounds, m));
  return out;
}

// What is drawn of them. The pack's mesh stays as it was baked: poses count from there.
void GpuScene::move_lamps(std::span<const MoverPose> poses) {
  make_fewer();  // it reads ranges meanwhile
  baked_.place(poses, pack_);
  geometry_serial_ = next_scene_serial();
  std::vector<Vec3> positions = pack_.mesh.positions, normals = pack_.mesh.normals;
  std::vector<Bounds> bounds(pack_.materials.size());  // of moved materials, each of one group
  for (std::size_t g = 0; g < poses.size(); ++g) {
    const Mat4 pose(pack_from_object(poses[g]));
    const LampShape shape = shape_of_lamp(pack_, pack_.light_groups[g]);
    if (is_rest(poses[g]) && is_rest(lamps_[g])) continue;
    for (const std::uint32_t p : shape.parts) {
      const MeshPart& part = pack_.mesh.parts[p];
      place_part(pack_.mesh, part, pose, positions, normals);
      for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
        bounds[part.material].extend(positions[pack_.mesh.indices[i]]);
    }
  }
  const auto follow = [&](std::vector<DrawRange>& ranges) {
    for (DrawRange& range : ranges) {
      if (bounds[range.material].empty()) continue;
      range.bounds = bounds[range.material];
      range.group = DrawRange::kNoGroup;  // seen from elsewhere too
      bounds_.extend(range.bounds);
    }
  };
  follow(opaque_), follow(transparent_);
  for (std::vector<DrawRange>& ranges : emitters_) follow(ranges);
  if (fewer_) fewer_->follow(bounds);
  buffers_[0].replace(GLenum{GL_ARRAY_BUFFER}, std::span<const Vec3>(positions));
  buffers_[1].replace(GLenum{GL_ARRAY_BUFFER}, std::span<const Vec3>(normals));
  lamps_.assign(poses.begin(), poses.end());
}

}  // namespace oriel
