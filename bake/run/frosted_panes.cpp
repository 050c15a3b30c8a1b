#include "bake/run/frosted_panes.h"

#include "bake/radiance/frosted_panes.h"

namespace oriel {

Result<std::vector<Reflector>> list_frosted_panes(const BakeTask& bake, const AssembledMesh& mesh,
                                                  const std::function<bool()>& late, std::vector<Emitter>& emitters,
                                                  std::vector<Warning>& omissions) {
  std::vector<Reflector> listed;
  if (!bake.options.with_radiance) return listed;
  std::vector<std::string> omitted;
  std::vector<FoundReflector> panes;
  std::vector<Emitter> more = emitters;
  ORIEL_TRY(
      const bool found, done_in_time(bake.context, late, [&] {
        return find_lit_panes(bake.accel(), bake.context, more, omitted).map([&](auto all) { panes = std::move(all); });
      }));
  const Warning late_panes("lamps behind frosted panes: left out, --time was over", "time-over");
  if (!found) omissions.push_back(late_panes);
  if (found) emitters = std::move(more), omissions.insert(omissions.end(), omitted.begin(), omitted.end());
  for (FoundReflector& pane : panes) {
    pane.reflector.indices = mesh_indices(mesh, pane.triangles);
    listed.push_back(std::move(pane.reflector));
  }
  return listed;
}

}  // namespace oriel
