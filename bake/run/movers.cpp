#include "bake/run/movers.h"

#include "bake/jobs/units.h"
#include "bake/run/baked_light.h"
#include "bake/run/inputs.h"
#include "formats/query/mover_pose.h"

namespace oriel {
namespace {

constexpr float kHeadroom_m = 2.5f;  // of the light field over walkable floors
constexpr float kMostCoarse = 0.1f;  // of a mover's surface, before it is warned of
constexpr float kMostLost = 0.02f;   // by compression

// Transfer in the order of the mesh's vertices.
void reorder(const std::vector<std::uint32_t>& scene_vertex, CompressedTransfer& t) {
  const auto components = static_cast<std::size_t>(t.components);
  std::vector<std::uint8_t> cluster;
  std::vector<std::int16_t> weight;
  for (const std::uint32_t v : scene_vertex) {
    cluster.push_back(t.cluster[v]);
    const auto first = t.weight.begin() + static_cast<std::ptrdiff_t>(v * components);
    weight.insert(weight.end(), first, first + static_cast<std::ptrdiff_t>(components));
  }
  t.cluster = std::move(cluster);
  t.weight = std::move(weight);
}

void warn_about(const MoverReport& r, Context& context) {
  if (r.coarse_share > kMostCoarse)
    context.warning("mover-light",
                    fmt::format("mover \"{}\": over {:.0f} % of its surface vertices are too far apart for the shadows "
                                "it casts on itself; a finer mesh shows them",
                                r.name, 100 * r.coarse_share));
  if (r.compression_error > kMostLost)
    context.warning("mover-light", fmt::format("mover \"{}\": compression loses {:.2g} % of the transfer", r.name,
                                               100 * r.compression_error));
}

class MoverBox {
 public:
  void add(const Vec3& p) {
    box_.lower = empty_ ? p : glm::min(box_.lower, p);
    box_.upper = empty_ ? p : glm::max(box_.upper, p);
    empty_ = false;
  }
  bool empty() const { return empty_; }
  const FieldBox& get() const { return box_; }

 private:
  FieldBox box_;
  bool empty_ = true;
};

FieldBox field_box(const Scene& scene, std::span<const WalkGrid> grids, std::span<const TakenMover> taken) {
  MoverBox box;
  for (const WalkGrid& grid : grids)
    for (std::size_t cell = 0; cell < grid.floor_y.size(); ++cell) {
      if (!grid.walkable(cell)) continue;
      const Vec3 floor = grid.eye(cell) - Vec3(0, grid.eye_height_m, 0),
                 half(0.5f * grid.cell_m, 0, 0.5f * grid.cell_m);
      box.add(floor - half);
      box.add(floor + half + Vec3(0, kHeadroom_m, 0));
    }
  if (box.empty()) {
    box.add(scene.lower);
    box.add(scene.upper);
  }
  for (const TakenMover& t : taken) {
    std::vector<MoverKey> keys = t.mover.keys;
    keys.push_back({0, t.mover.rest});
    for (const MoverKey& key : keys) {
      const DMat4 scene_from = pack_from_object(key.pose);
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 upper(corner & 1, corner >> 1 & 1, corner >> 2);
        box.add(Vec3(scene_from * DVec4(DVec3(glm::mix(t.scene.lower, t.scene.upper, upper)), 1)));
      }
    }
  }
  return box.get();
}

}  // namespace

Result<BakedMovers> bake_movers(const BakeTask& bake, double seconds, MaterialMaps& materials, std::uint64_t& rays) {
  const BakeOptions& options = bake.options;
  const ElapsedTime clock;
  TransferOptions how = options.transfer;
  how.enough = [&] { return clock.spent() > seconds; };
  Context& context = bake.context;
  BakedMovers baked;
  std::atomic<std::uint64_t> counted{0};
  for (const TakenMover& t : bake.prepared.movers) {
    ORIEL_TRY(const Accel accel, Accel::build(t.scene, {options.reproducible, context.threads}));
    const StageInputs inputs(context, SurfacesOf{t.scene}, options.transfer);
    ORIEL_TRY(const VertexTransfer transfer, bake_transfer(accel, how, {context, &counted}));
    Mover mover;
    mover.name = t.mover.name;
    mover.rest = t.mover.rest;
    mover.keys = t.mover.keys;
    ORIEL_TRY_VOID(one_unit(
        context, "compression", [&](Archive& key) { key(transfer.coefficients, options.compress); },
        [&]() -> Status {
          ORIEL_TRY(mover.transfer, compress_transfer(transfer, options.compress, context));
          return {};
        },
        [&](Archive& archive) { archive(mover.transfer); }));
    Atlas none;
    none.page.assign(t.scene.triangles.size(), -1);
    AssembledMesh mesh = assemble_mesh(t.scene, none);
    reorder(mesh.scene_vertex, mover.transfer);
    mover.mesh = std::move(mesh.mesh);
    baked.reports.push_back({mover.name, mover.mesh.positions.size(), transfer.standard_error, mover.transfer.error,
                             mover.transfer.bytes_per_vertex(), coarse_share(t.scene, transfer)});
    warn_about(baked.reports.back(), context);
    baked.movers.push_back(std::move(mover));
    const std::vector<MaterialSummary> summaries = summarize_materials(t.scene);
    for (const Surface& surface : t.scene.surfaces) materials.summaries[surface.material] = summaries[surface.material];
  }
  rays += counted;
  return baked;
}

Result<LightField> bake_light_field(const BakeTask& bake, std::span<const WalkGrid> floors,
                                    std::function<double()> left, std::uint64_t& rays) {
  const BakedScene baked = bake.baked();
  const SurfaceRadiance radiance = [&](const Hit& hit, const Vec3& towards_eye, bool with_emission) {
    return baked_radiance(baked, {.hit = hit, .towards_eye = towards_eye, .emission = with_emission});
  };
  ProbeOptions probes = bake.options.probes;
  probes.bands = bake.options.transfer.bands;
  probes.left = std::move(left);
  const FieldBox box = field_box(bake.scene(), floors, bake.prepared.movers);
  const StageInputs inputs(bake.context, LitScene{baked}, box.lower, box.upper, probes);
  std::atomic<std::uint64_t> counted{0};
  ORIEL_TRY(LightField field,
            bake_probes({baked.accel, baked.lights, radiance}, box, probes, {bake.context, &counted}));
  rays += counted;
  return field;
}

}  // namespace oriel
