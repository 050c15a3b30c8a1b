// A scene whose materials cannot share what they reflect with.
#pragma once

#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

// Fifty materials, each reflecting as no other does: metals and dielectrics, roughness 0.01 to 0.5, the widest that
// gets a kernel.
inline Scene fifty_materials() {
  SceneParts parts;
  for (int i = 0; i < 50; ++i) {
    SceneMaterial m;
    m.name = "material " + std::to_string(i);
    m.roughness = 0.01f * static_cast<float>(i + 1);
    m.metallic = i % 2 == 0 ? 1.0f : 0.0f;
    m.base_color = Vec3(0.5f + 0.01f * static_cast<float>(i), 0.95f - 0.01f * static_cast<float>(i), 0.6f);
    m.ior = 1.2f + 0.03f * static_cast<float>(i);
    parts.add(m);
  }
  return parts.finish();
}

}  // namespace oriel::test
