#include "bake/material/lobe.h"

namespace oriel {

Microfacet microfacet(KernelModel model, double alpha) {
  return {model == KernelModel::kGgxDg ? FacetModel::kGgx : FacetModel::kBeckmann, alpha};
}

LobeFunction microfacet_lobe(KernelModel model, LobeForm form, double alpha) {
  const Microfacet facets = microfacet(model, alpha);
  if (form == LobeForm::kLobe)
    return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) { return facets.f_cos(wo, wi, h); };
  return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    if (wi.z <= 0) return 0.0;
    return facets.d(h) * (form == LobeForm::kDg ? v_cavity_g(wo, wi, h) : 1.0) / (4 * wo.z);
  };
}

}  // namespace oriel
