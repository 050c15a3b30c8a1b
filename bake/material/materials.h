// K and R for a whole scene, shared between the materials that need the same.
#pragma once

#include "bake/jobs/context.h"
#include "bake/material/kernel.h"
#include "bake/material/reflectance.h"
#include "bake/material/slices.h"
#include "bake/scene/scene.h"

namespace oriel {

// A material's parameters averaged over the surface that it covers (by area), textures and vertex colours applied.
// A material that covers nothing keeps its factors.
struct MaterialSummary {
  Vec3 base_color{1};  // linear
  Vec3 diffuse{0};     // (1 - metallic) (1 - transmission) base colour
  float metallic = 0;
  float roughness_deviation = 0;  // of its texture, standard
  float roughness = 1;   // of the lobe that shows an image: the coat's where it reflects as much as what it covers
  float alpha = 1;       // GGX width: the square of that roughness; of an anisotropic lobe the mean √(αx αy)
  float base_alpha = 1;  // of the lobe under the coat
  Vec3 f0{0.04f};
  float f90 = 1;
  FresnelCurve curve;
  float coat = 0, coat_alpha = 0;  // a clear coat's share and GGX width
  float transmission = 0;
  float coverage = 1;
  Vec3 emission{0};  // cd/m²
  double area_m2 = 0;
};

// Textured materials are sampled at a fixed number of points spread over their triangles in proportion to area: the
// same scene gives the same bytes.
std::vector<MaterialSummary> summarize_materials(const Scene& scene);

// Of its dielectric, by its factors: what metals have instead is their colour.
Vec3 dielectric_f0(const SceneMaterial& material);

struct MaterialOptions {
  KernelOptions kernel;
  SliceOptions slices;
  float max_roughness = 0.5f;  // rougher lobes have a kernel where they show highlights
  FresnelMapOptions fresnel;
  double error = 0.02;  // by which a map may differ from a material's own for the material to share it, see share.h
};

// What R is computed of.
SpecularLayers layers_of(const MaterialSummary& summary);

struct MaterialMaps {
  std::vector<MaterialSummary> summaries;  // by material, as are the two below
  std::vector<std::int32_t> kernel;        // into kernels; -1: no specular lobe, too faint and rough, or unlit
  std::vector<std::int32_t> fresnel_map;   // into fresnel_maps; -1: no specular lobe (f0 = f90 = 0), or unlit
  std::vector<BrdfKernel> kernels;
  std::vector<FresnelMap> fresnel_maps;
};

// Materials that reflect an image, and whose roughness differs over their texture, which the player does not show.
std::vector<std::string> averaged_roughness(const Scene& scene, const MaterialMaps& maps);

// Materials whose needs agree to within options.error share a kernel and a Fresnel map (share.h). Error kStopped only.
Result<MaterialMaps> bake_materials(const Scene& scene, const MaterialOptions& options, Context& context);

}  // namespace oriel
