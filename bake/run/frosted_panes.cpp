#include "bake/run/frosted_panes.h"

#include "bake/radiance/frosted_panes.h"

namespace oriel {

Result<std::vector<Reflector>> list_frosted_panes(const BakeTask& bake, const AssembledMesh& mesh,
                                                  std::vector<Emitter>& emitters, std::vector<Warning>& omissions) {
  std::vector<Reflector> listed;
  if (!bake.options.with_radiance) return listed;
  std::vector<std::string> omitted;
  ORIEL_TRY(std::vector<FoundReflector> panes, find_lit_panes(bake.accel(), bake.context, emitters, omitted));
  for (FoundReflector& pane : panes) {
    pane.reflector.indices = mesh_indices(mesh, pane.triangles);
    listed.push_back(std::move(pane.reflector));
  }
  omissions.insert(omissions.end(), omitted.begin(), omitted.end());
  return listed;
}

}  // namespace oriel
