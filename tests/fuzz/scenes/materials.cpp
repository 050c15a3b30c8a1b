#include "tests/fuzz/scenes/materials.h"

#include "scenes/kit/textures.h"

namespace oriel::fuzz {
namespace {

Json factors(const Vec3& color, float metallic, float roughness) {
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", {color.r, color.g, color.b, 1}},
            {"metallicFactor", metallic},
            {"roughnessFactor", roughness}}}};
}

float any_roughness(Random& random) {
  constexpr float kOften[] = {0, 1, 1e-3f, 0.05f};
  return random.chance(0.5f) ? kOften[random.below(4)] : random.unit();
}

}  // namespace

int plain(Glb& glb, float albedo) {
  Json m = factors(Vec3(albedo), 0, 1);
  m["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0}};
  return glb.add_material(std::move(m));
}

int white(Glb& glb, Random& random) {
  const float albedo = random.chance(0.3f) ? 1 : random.between(0.9f, 1);
  if (random.chance(0.3f)) return plain(glb, albedo);
  return glb.add_material(factors(Vec3(albedo), 0, any_roughness(random)));
}

int metal(Glb& glb, Random& random) {
  const Vec3 color = random.chance(0.5f) ? Vec3(1) : random.in_box(Vec3(0.5f), Vec3(1));
  return glb.add_material(factors(color, 1, any_roughness(random)));
}

int glass(Glb& glb, Random& random) {
  Json m = factors(random.chance(0.5f) ? Vec3(1) : random.in_box(Vec3(0), Vec3(1)), 0, any_roughness(random));
  m["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", random.chance(0.5f) ? 1 : random.unit()}};
  if (random.chance(0.3f)) m["extensions"]["KHR_materials_ior"] = {{"ior", random.between(1, 2.5f)}};
  if (random.chance(0.4f)) {
    Json volume = {{"thicknessFactor", random.unit()}};
    if (random.chance(0.5f)) volume["attenuationDistance"] = random.between(0.01f, 10);
    if (random.chance(0.5f)) volume["attenuationColor"] = {random.unit(), 1, random.unit()};
    m["extensions"]["KHR_materials_volume"] = std::move(volume);
  }
  if (random.chance(0.5f)) m["doubleSided"] = true;
  return glb.add_material(std::move(m));
}

int lamp(Glb& glb, Random& random, float radiance, bool textured) {
  Json m = factors(Vec3(random.chance(0.5f) ? 0 : random.between(0, 0.8f)), 0, 1);
  m["emissiveFactor"] = {1, random.chance(0.5f) ? 1 : random.unit(), random.chance(0.5f) ? 1 : random.unit()};
  m["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", radiance}};
  if (textured) m["emissiveTexture"] = {{"index", glb.add_texture(sample::painting_circles(16).png)}};
  if (random.chance(0.3f)) m["doubleSided"] = true;
  return glb.add_material(std::move(m));
}

int any_material(Glb& glb, Random& random) {
  switch (random.below(6)) {
    case 0:
      return metal(glb, random);
    case 1:
      return glass(glb, random);
    case 2:
      return white(glb, random);
    case 3:
      return plain(glb, random.chance(0.5f) ? 0 : random.unit());
    default:
      break;
  }
  Json m = factors(random.in_box(Vec3(0), Vec3(1)), random.chance(0.7f) ? 0 : random.unit(), any_roughness(random));
  if (random.chance(0.3f)) m["doubleSided"] = true;
  if (random.chance(0.2f)) m["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", random.unit()}};
  if (random.chance(0.1f)) m["extensions"]["KHR_materials_unlit"] = Json::object();
  if (random.chance(0.2f)) {
    m["alphaMode"] = random.chance(0.5f) ? "BLEND" : "MASK";
    m["pbrMetallicRoughness"]["baseColorFactor"][3] = random.unit();
  }
  if (random.chance(0.2f))
    m["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", glb.add_texture(sample::dark_tiles(16).png)}};
  if (random.chance(0.2f))
    m["normalTexture"] = {{"index", glb.add_texture(sample::painting_stripes(16).png)},
                          {"scale", random.between(0, 4)}};
  return glb.add_material(std::move(m));
}

}  // namespace oriel::fuzz
