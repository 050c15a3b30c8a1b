// Refraction at glass, smooth or of GGX facets (bake/trace/glass.h), and the way out of a body of it.

// The cosine to the normal beyond a surface by Snell's law, -1 beyond the critical angle. eta: index beyond over index before.
float refracted_cosine(float eta, float cos_theta) {
  float square = ((eta - 1.0) * (eta + 1.0) + cos_theta * cos_theta) / (eta * eta);
  return square < 0.0 ? -1.0 : sqrt(min(square, 1.0));
}

// The direction beyond a facet h that light towards wo comes from, both unit and on one side of it.
vec3 refracted(vec3 wo, vec3 h, float eta, float beyond) { return normalize((dot(wo, h) / eta - beyond) * h - wo / eta); }

// A direction on the side of n: what facets turn the wrong way is mirrored, so that nothing is lost.
vec3 on_side(vec3 d, vec3 n) { return d - 2.0 * min(dot(d, n), 0.0) * n; }

// A facet that v sees on a surface of width alpha, by caps of the sphere (Dupuy and Benyoub 2023). u: in [0,1)^2.
vec3 visible_facet(vec3 n, vec3 v, float alpha, vec2 u) {
  vec3 t = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n)), b = cross(n, t);
  vec3 s = normalize(vec3(alpha * dot(t, v), alpha * dot(b, v), max(dot(n, v), 1e-4)));
  float phi = 6.28318531 * u.x, z = (1.0 - u.y) * (1.0 + s.z) - s.z;
  float r = sqrt(max(1.0 - z * z, 0.0));
  vec3 h = vec3(r * cos(phi), r * sin(phi), z) + s;
  return normalize(alpha * (h.x * t + h.y * b) + max(h.z, 1e-6) * n);
}

// How far apart `count` samples of that distribution lie about a facet of slope tan theta.
float facet_step(float alpha, float cos_theta, float count) {
  float c2 = max(cos_theta * cos_theta, 1e-4), a2 = alpha * alpha, spread = a2 + (1.0 - c2) / c2;
  return sqrt(3.14159265 / count) * spread / alpha;
}

// Where a ray within a convex polyhedron leaves it: metres, and the outward normal. planes: as GlassBody::planes.
float leave_planes(vec4 planes[GLASS_PLANES], int count, vec3 p, vec3 d, out vec3 normal) {
  float nearest = 1e30;
  normal = d;
  for (int i = 0; i < count; ++i) {
    float speed = dot(planes[i].xyz, d);
    if (speed <= 1e-6) continue;
    float way = -(dot(planes[i].xyz, p) + planes[i].w) / speed;
    if (way >= nearest) continue;
    nearest = way;
    normal = planes[i].xyz;
  }
  return nearest < 1e30 ? max(nearest, 0.0) : 0.0;
}

const int kShapeHalvings = 7;

// The same of a body whose surface is seen from its centre: shape has the outward normal there by direction, a the distance. p: from
// the centre; radius: of the sphere around all of it.
float leave_shape(samplerCube shape, float radius, vec3 p, vec3 d, out vec3 normal) {
  float along = dot(p, d), far = sqrt(max(along * along - dot(p, p) + radius * radius, 0.0)) - along;
  float low = min(2e-3 * radius, far), high = max(far, 0.0);
  vec3 x = p + low * d;
  if (length(x) < textureLod(shape, x, 0.0).a) {
    float inside = 0.0, outside = 0.0;  // how far, at both ends
    for (int i = 0; i < kShapeHalvings; ++i) {
      float at = i < 4 ? 0.5 * (low + high) : mix(low, high, clamp(inside / max(inside + outside, 1e-20), 0.05, 0.95));
      x = p + at * d;
      float over = length(x) - textureLod(shape, x, 0.0).a;
      if (over < 0.0) low = at, inside = -over;
      else high = at, outside = over;
    }
    x = p + mix(low, high, inside / max(inside + outside, 1e-20)) * d;
  } else {
    high = low = 0.0;
    x = p;
  }
  vec3 n = textureLod(shape, x, 0.0).xyz;
  normal = dot(n, n) > 0.0 ? normalize(n) : normalize(x);
  return 0.5 * (low + high);
}
