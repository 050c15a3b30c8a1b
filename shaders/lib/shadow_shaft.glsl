// Shadow maps of a mover: from a point of a light, just as wide as the sphere around the mover. The same maths as
// player/movers/shadow_shaft.h.

struct Shaft {
  mat3 frame;     // across, up, along: pack space
  vec3 from;      // the point; of a direction, the sphere's centre
  float tangent;  // of half its width; of a direction: half its width, metres
  bool parallel;
  float away;  // from `from` to the sphere's centre
};

mat3 frame_from_normal(vec3 n) {
  float side = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (side + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x), vec3(b, side + n.y * n.y * a, -n.y), n);
}

// at: LightSamples::at. sphere: centre and radius.
Shaft make_shaft(vec4 at, vec4 sphere) {
  Shaft s;
  s.parallel = at.w == 0.0;
  vec3 to = s.parallel ? -at.xyz : sphere.xyz - at.xyz;
  float distance2 = max(dot(to, to), 1e-12);
  s.frame = frame_from_normal(to * inversesqrt(distance2));
  s.from = s.parallel ? sphere.xyz : at.xyz;
  s.tangent = s.parallel ? sphere.w : min(sphere.w * inversesqrt(max(distance2 - sphere.w * sphere.w, 1e-12)), 4.0);
  s.away = s.parallel ? 0.0 : sqrt(distance2);
  return s;
}

// Half the width of the shaft at that distance along it.
float shaft_width(Shaft s, float along) { return s.parallel ? s.tangent : s.tangent * along; }

// Place in the map, [-1,1] inside, and the distance along the shaft.
vec3 in_shaft(Shaft s, vec3 p) {
  vec3 local = (p - s.from) * s.frame;
  return vec3(local.xy / max(shaft_width(s, local.z), 1e-12), local.z);
}

// In the depth buffer, of the distance along the shaft.
float shaft_depth(Shaft s, vec2 range, float along) {
  float reach = range.y - range.x;
  float depth = s.parallel ? (along - range.x) / reach : range.y / reach * (1.0 - range.x / max(along, 1e-12));
  return clamp(depth, 0.0, 1.0);
}

// Nearest and farthest that a map of the mover alone holds, and one of the scene.
vec2 mover_range(Shaft s, float radius) {
  float reach = max(1.01 * radius, 1e-6);
  return s.parallel ? vec2(-reach, reach) : vec2(max(s.away - reach, 0.01 * s.away), s.away + reach);
}
vec2 scene_range(Shaft s, float reach) {
  return s.parallel ? vec2(-reach, reach) : vec2(0.01 * s.away, s.away + reach);
}
