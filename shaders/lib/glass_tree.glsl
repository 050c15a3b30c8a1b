// Rays through the triangles of a body of glass (player/scene/glass_tree.h).
uniform sampler2D u_tree;

vec4 tree_texel(int i) { return texelFetch(u_tree, ivec2(i & 1023, i >> 10), 0); }

vec3 tree_corner(int base, int i) { return tree_texel(base + i).xyz; }

// How far along a ray a triangle is met, -1 where it is not or, leaving, its front faces the ray; entering, its back. where: of the
// second and third corner.
float meet_triangle(int base, vec3 p, vec3 d, bool leaving, out vec2 where) {
  vec3 a = tree_corner(base, 0), ab = tree_corner(base, 1) - a, ac = tree_corner(base, 2) - a, from = p - a;
  vec3 across = cross(d, ac), beside = cross(from, ab);
  float slant = dot(ab, across);  // minus the front's normal along the ray
  where = vec2(dot(from, across), dot(d, beside));
  if (leaving ? slant >= 0.0 : slant <= 0.0) return -1.0;
  where /= slant;
  if (any(lessThan(where, vec2(-1e-5))) || where.x + where.y > 1.00001) return -1.0;
  return dot(ac, beside) / slant;
}

// The first triangle along a ray, at least so far, that it leaves the glass by or enters it by: metres, -1 where none is. Outward
// normals: of the triangle, and as its surface is shaded.
float meet_tree(vec3 p, vec3 d, float least, bool leaving, out vec3 flat_normal, out vec3 normal) {
  vec3 inverse = 1.0 / mix(d, vec3(1e-12), lessThan(abs(d), vec3(1e-12)));
  int count = int(tree_texel(0).w), met = -1;
  float nearest = 1e30;
  vec2 at = vec2(0.0), where;
  for (int node = 0; node < count;) {
    vec4 lower = tree_texel(2 * node), upper = tree_texel(2 * node + 1);
    vec3 a = (lower.xyz - p) * inverse, b = (upper.xyz - p) * inverse, first = min(a, b), last = max(a, b);
    bool within = max(max(first.x, first.y), max(first.z, least)) <= min(min(last.x, last.y), min(last.z, nearest)) * 1.000001;
    if (within && upper.w < 0.0) {
      ++node;
      continue;
    }
    for (int i = 0, leaf = int(upper.w); within && i < (leaf & 7); ++i) {
      int base = 2 * count + 6 * ((leaf >> 3) + i);
      float way = meet_triangle(base, p, d, leaving, where);
      if (way > least && way < nearest) nearest = way, met = base, at = where;
    }
    node = int(lower.w);
  }
  flat_normal = normal = leaving ? d : -d;
  if (met < 0) return -1.0;
  vec3 corner = tree_corner(met, 0);
  flat_normal = normalize(cross(tree_corner(met, 1) - corner, tree_corner(met, 2) - corner));
  normal = mix(tree_corner(met, 3), tree_corner(met, 4), at.x) + at.y * (tree_corner(met, 5) - tree_corner(met, 3));
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : flat_normal;
  if (dot(normal, d) * (leaving ? 1.0 : -1.0) <= 1e-4) normal = flat_normal;
  return nearest;
}
