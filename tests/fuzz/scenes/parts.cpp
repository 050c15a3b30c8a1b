#include "tests/fuzz/scenes/parts.h"

#include "tests/fuzz/scenes/materials.h"
#include "tests/fuzz/scenes/shapes.h"

namespace oriel::fuzz {
namespace {

const Vec3 kLow(-3, 0, -2), kHigh(3, 2.7f, 2);  // of the room

int place(Glb& glb, Primitive p, int material) {
  p.material = material;
  return glb.add_node({{"mesh", glb.add_mesh(p)}});
}

int place_damaged(Glb& glb, Random& random, Primitive p, int material) {
  damage(p, random);
  return place(glb, std::move(p), material);
}

float any_radiance(Random& random) {
  return static_cast<float>(random.decades(1, 1e5));
}

void room(Glb& glb, Random& random) {
  Primitive p;
  add_box(p, kLow, kHigh, true);
  place(glb, p, random.chance(0.5f) ? white(glb, random) : any_material(glb, random));
}

void furniture(Glb& glb, Random& random) {
  const int material = random.chance(0.5f) ? white(glb, random) : any_material(glb, random);
  Primitive p;
  for (int n = random.whole(1, 20); n > 0; --n) {
    const Vec3 low = random.in_box(kLow, kHigh - 0.5f);
    add_box(p, low, low + random.in_box(Vec3(0.01f), Vec3(0.8f)));
  }
  place_damaged(glb, random, p, material);
}

// Panels so close to the walls that light falls behind them.
void panels(Glb& glb, Random& random) {
  Primitive p;
  const auto proud = static_cast<float>(random.decades(1e-4, 0.05));
  for (int i = 0; i < 4; ++i) {
    const Vec3 low(kLow.x + 0.2f + 1.4f * static_cast<float>(i), 0.3f, kLow.z + proud);
    add_box(p, low, low + Vec3(1.2f, 2, 0.018f));
  }
  place(glb, p, any_material(glb, random));
}

void ball(Glb& glb, Random& random) {
  Primitive p;
  for (int n = random.whole(1, 3); n > 0; --n)
    add_sphere(p, random.in_box(kLow, kHigh), random.between(0.05f, 0.8f), random.whole(3, 24));
  place_damaged(glb, random, p, random.chance(0.5f) ? metal(glb, random) : any_material(glb, random));
}

void curved_metal(Glb& glb, Random& random) {
  Primitive p;
  add_wave(p, random.in_box(kLow, kHigh), random.between(0.1f, 2), random.whole(4, 20));
  add_tube(p, random.in_box(kLow, kHigh), random.between(0.1f, 2), random.between(0.005f, 0.2f), random.whole(3, 16));
  place_damaged(glb, random, p, metal(glb, random));
}

void ground(Glb& glb, Random& random) {
  const auto side = static_cast<float>(random.decades(100, 1e5));
  Primitive p;
  add_quad(p, Vec3(-side / 2, random.chance(0.5f) ? 0 : -0.01f, side / 2), Vec3(side, 0, 0), Vec3(0, 0, -side));
  place(glb, p, random.chance(0.5f) ? plain(glb, random.unit()) : any_material(glb, random));
}

void dome(Glb& glb, Random& random) {
  Primitive p;
  add_sphere(p, Vec3(0), static_cast<float>(random.decades(100, 1e5)), 24, true);
  place(glb, p, random.chance(0.7f) ? lamp(glb, random, any_radiance(random)) : plain(glb, random.unit()));
}

void panel_lamp(Glb& glb, Random& random) {
  constexpr float kGaps[] = {0, 1e-6f, 1e-3f, 0.1f};
  Primitive p;
  add_quad(p, Vec3(-0.5f, kHigh.y - kGaps[random.below(4)], -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1));
  place(glb, p, lamp(glb, random, any_radiance(random), random.chance(0.2f)));
}

void boxed_lamp(Glb& glb, Random& random) {
  const Vec3 low = random.in_box(kLow, kHigh - 0.6f);
  Primitive box, bulb;
  add_box(box, low, low + 0.5f);
  if (random.chance(0.5f)) add_box(box, low + 0.01f, low + 0.49f, true);
  place(glb, box, any_material(glb, random));
  add_sphere(bulb, low + 0.25f, 0.1f, 6);
  place(glb, bulb, lamp(glb, random, any_radiance(random)));
}

Json lamp_node(Glb& glb, Random& random, const char* type, double intensity, const Vec3& at) {
  Json light = {{"type", type}, {"intensity", intensity}};
  if (std::string_view(type) == "spot") {
    const float outer = random.between(0.01f, 1.57f);
    light["spot"] = {{"innerConeAngle", outer * 0.99f * random.unit()}, {"outerConeAngle", outer}};
  }
  return {{"translation", {at.x, at.y, at.z}},
          {"extensions", {{"KHR_lights_punctual", {{"light", glb.add_light(std::move(light))}}}}}};
}

void bulbs(Glb& glb, Random& random) {
  for (int n = random.whole(1, 4); n > 0; --n) {
    Vec3 at = random.in_box(kLow, kHigh);
    if (random.chance(0.5f)) at[random.below(3)] = random.chance(0.5f) ? kLow.x : 0;  // on a wall or on the floor
    glb.add_node(lamp_node(glb, random, random.chance(0.5f) ? "point" : "spot", random.decades(0.1, 1e5), at));
  }
}

void many_bulbs(Glb& glb, Random& random) {
  for (int n = static_cast<int>(random.decades(100, 4000)); n > 0; --n)
    glb.add_node(lamp_node(glb, random, "point", random.decades(0.1, 100), random.in_box(kLow, kHigh)));
}

void many_lamps(Glb& glb, Random& random) {
  const int material = lamp(glb, random, any_radiance(random));
  Primitive p;
  for (int n = static_cast<int>(random.decades(100, 3000)); n > 0; --n)
    add_quad(p, random.in_box(kLow, kHigh), random.in_box(Vec3(-0.02f), Vec3(0.02f)),
             random.in_box(Vec3(-0.02f), Vec3(0.02f)));
  place(glb, p, material);
}

void sun(Glb& glb, Random& random) {
  Json node = lamp_node(glb, random, "directional", random.decades(1, 1e5), Vec3(0));
  const float half = random.between(0, kPi);
  node["rotation"] = {std::sin(half), 0, 0, std::cos(half)};
  glb.add_node(std::move(node));
}

void picture_that_shines(Glb& glb, Random& random) {
  Primitive p;
  add_quad(p, Vec3(-1, 1, kLow.z + 0.02f), Vec3(2, 0, 0), Vec3(0, 1, 0), random.whole(1, 8));
  place_damaged(glb, random, p, lamp(glb, random, any_radiance(random), true));
}

// A tube that shines within a tube of glass.
void neon(Glb& glb, Random& random) {
  const Vec3 at(-1, 2, kLow.z + 0.1f);
  Primitive inner, outer;
  add_tube(inner, at, 2, 0.01f, 8);
  add_tube(outer, at, 2, 0.015f, 8);
  place(glb, inner, lamp(glb, random, any_radiance(random)));
  place(glb, outer, glass(glb, random));
}

void pane(Glb& glb, Random& random) {
  Primitive p;
  if (random.chance(0.5f))
    add_box(p, Vec3(-1, 0.2f, 0), Vec3(1, 2, 0.01f));
  else
    add_quad(p, Vec3(-1, 0.2f, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  place_damaged(glb, random, p, glass(glb, random));
}

void mirror(Glb& glb, Random& random) {
  Primitive p;
  add_quad(p, Vec3(-1, 0.2f, kLow.z + 0.01f), Vec3(2, 0, 0), Vec3(0, 2, 0));
  if (random.chance(0.3f)) add_quad(p, Vec3(1, 0.2f, kHigh.z - 0.01f), Vec3(-2, 0, 0), Vec3(0, 2, 0));
  place(glb, p, metal(glb, random));
}

void animated(Glb& glb, Random& random) {
  Primitive p;
  const Vec3 low = random.in_box(kLow, kHigh - 0.5f);
  add_box(p, low, low + 0.3f);
  glb.animate(place(glb, p, any_material(glb, random)), random.in_box(Vec3(-1), Vec3(1)));
}

void skinned(Glb& glb, Random& random) {
  Primitive p;
  add_tube(p, Vec3(0, 1, 0), 0.5f, 0.2f, 8);
  p.skinned = true;
  p.material = any_material(glb, random);
  const int mesh = glb.add_mesh(p);
  const int tip = glb.add_child({{"translation", {0, 0.2, 0}}});
  const int foot = glb.add_node({{"children", {tip}}});
  glb.add_node({{"mesh", mesh}, {"skin", glb.add_skin({foot, tip})}});
}

void instances(Glb& glb, Random& random) {
  Primitive p;
  add_box(p, Vec3(-0.05f), Vec3(0.05f));
  p.material = any_material(glb, random);
  const int mesh = glb.add_mesh(p);
  for (int n = random.whole(2, 60); n > 0; --n) {
    const Vec3 at = random.in_box(kLow, kHigh);
    const float s = random.between(-2, 2);
    glb.add_node({{"mesh", mesh}, {"translation", {at.x, at.y, at.z}}, {"scale", {s, 1, random.between(0.01f, 2)}}});
  }
}

void triangle(Glb& glb, Random& random) {
  Primitive p;
  p.positions = {random.in_box(kLow, kHigh), random.in_box(kLow, kHigh), random.in_box(kLow, kHigh)};
  p.indices = {0, 1, 2};
  if (random.chance(0.5f)) p.material = any_material(glb, random);
  glb.add_node({{"mesh", glb.add_mesh(p)}});
}

void camera(Glb& glb, Random& random) {
  const Vec3 at = random.in_box(kLow - 1.0f, kHigh + 1.0f);  // some stand in walls
  glb.add_node({{"camera", glb.add_camera(random.between(0.2f, 2))}, {"translation", {at.x, at.y, at.z}}});
}

void many_triangles(Glb& glb, Random& random) {
  Primitive p;
  add_wave(p, Vec3(0, 1, 0), 2, static_cast<int>(std::sqrt(random.decades(1e4, 1e6) / 2)));
  place(glb, p, any_material(glb, random));
}

constexpr Part kParts[] = {
    {"room", 0.5f, room},
    {"furniture", 0.4f, furniture},
    {"panels", 0.15f, panels},
    {"ball", 0.2f, ball},
    {"curved metal", 0.2f, curved_metal},
    {"ground", 0.1f, ground},
    {"dome", 0.1f, dome},
    {"panel lamp", 0.4f, panel_lamp},
    {"boxed lamp", 0.1f, boxed_lamp},
    {"bulbs", 0.25f, bulbs},
    {"many bulbs", 0.03f, many_bulbs},
    {"many lamps", 0.03f, many_lamps},
    {"sun", 0.1f, sun},
    {"picture that shines", 0.1f, picture_that_shines},
    {"neon", 0.1f, neon},
    {"pane", 0.15f, pane},
    {"mirror", 0.15f, mirror},
    {"animated", 0.07f, animated},
    {"skinned", 0.05f, skinned},
    {"instances", 0.1f, instances},
    {"triangle", 0.15f, triangle},
    {"camera", 0.4f, camera},
    {"many triangles", 0.02f, many_triangles},
};

}  // namespace

std::span<const Part> all_parts() {
  return kParts;
}

}  // namespace oriel::fuzz
