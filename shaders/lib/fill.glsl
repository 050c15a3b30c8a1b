// Filling holes of a reflected image. Light has 1 / distance in a, 0 where there is none.

// The weighted average of those that hold light and lie not nearer than the farthest by more than the factor `reach`: what
// comes into view beside a near thing is the ground behind it. A huge reach takes all.
vec4 farther_average(vec4 light[4], vec4 weight, float reach) {
  float farthest = 1e30;
  for (int i = 0; i < 4; ++i) {
    if (light[i].a > 0.0 && weight[i] > 0.0) farthest = min(farthest, light[i].a);
  }
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (light[i].a <= 0.0 || light[i].a > reach * farthest) continue;
    sum += weight[i] * light[i];
    total += weight[i];
  }
  return total > 0.0 ? sum / total : vec4(0.0);
}
