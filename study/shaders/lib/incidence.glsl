// The weight of light from a direction (unit) on a surface with a shading normal and a geometric one, both on its side: what of the
// lobe falls below the surface counts above it (bake/trace/polygon_light.h).
float incidence(vec3 normal, vec3 face, vec3 direction) {
  float above = dot(face, direction);
  if (above <= 0.0) return 0.0;
  return max(dot(normal, direction), 0.0) + max(dot(normal, direction - 2.0 * above * face), 0.0);
}

// The same of light from a point, a spot or a sun, of which nothing is mirrored (bake/trace/rounded.h), on a facet.
float punctual_incidence(vec3 normal, vec3 face, vec3 direction) {
  return dot(face, direction) > 0.0 ? max(dot(normal, direction), 0.0) : 0.0;
}
