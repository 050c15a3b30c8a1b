// A bright light as a few points: the twin of player/movers/light_samples.h, which tells what the numbers mean.

// Irradiance of a surface at p that faces the point, unshadowed, over the light's intensity. towards: unit, from p to it.
float facing_irradiance(vec4 at, vec3 axis, vec2 cones, bool cosine, vec3 p, out vec3 towards) {
  vec3 to = at.xyz - p * at.w;
  float distance2 = max(dot(to, to), 1e-12);
  towards = to * inversesqrt(distance2);
  if (at.w == 0.0) return 1.0;
  float forward = -dot(towards, axis);
  float t = clamp((forward - cones.y) / (cones.x - cones.y), 0.0, 1.0);
  float shape = !cosine ? t * t : cones.y < 0.0 ? abs(forward) : max(forward, 0.0);
  return shape / distance2;
}
