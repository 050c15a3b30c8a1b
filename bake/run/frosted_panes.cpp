#include "bake/run/frosted_panes.h"

#include "bake/radiance/frosted_panes.h"

namespace oriel {

Status list_frosted_panes(const BakeTask& bake, const AssembledMesh& mesh, std::vector<Warning>& omissions) {
  if (!bake.options.with_radiance) return {};
  Pack& pack = bake.pack;
  std::vector<std::string> omitted;
  ORIEL_TRY(std::vector<FoundReflector> panes, find_lit_panes(bake.accel(), bake.context, pack.emitters, omitted));
  for (FoundReflector& pane : panes) {
    pane.reflector.indices = mesh_indices(mesh, pane.triangles);
    pack.frosted_panes.push_back(std::move(pane.reflector));
  }
  omissions.insert(omissions.end(), omitted.begin(), omitted.end());
  return {};
}

}  // namespace oriel
