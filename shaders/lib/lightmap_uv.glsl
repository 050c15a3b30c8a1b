// A place on a page of the lightmap, interpolated at the centroid of what a triangle covers of a pixel: at its middle,
// beside the triangle, lies another chart's light. A driver may take the point's 1/w from the middle all the same (Mesa
// 22's llvmpipe does), which scales all that it interpolates there: the third component, 1 everywhere, tells by how
// much.
vec2 lightmap_uv(vec3 v) {
  return v.xy / v.z;
}
