// How wide the blur of a reflected image is at a pixel: the share d / (d + e) of the lobe's angle, e from the eye to the plane, d from
// there to what is seen.
uniform vec4 u_ndc_from_image; // scale, offset
uniform vec2 u_tangents;       // view-space x, y over -z at ndc 1; orthographic: half sizes in metres
uniform float u_ortho;
uniform vec3 u_plane_normal;   // view space, towards the eye's side
uniform float u_plane_offset;  // dot(normal, point of the plane)
uniform float u_farthest;      // metres: distances are cut off here
uniform float u_median;        // tangent of the radius that holds half of the lobe
uniform float u_pixels_per_tangent;  // of the image, at its centre
uniform int u_coarse;          // pixels of the image along a side of a coarse one

// The view ray of a pixel, and where it meets the plane. valid: it does.
struct PlaneHit {
  vec3 view;
  vec3 at;
  float cos_theta;
  float distance;
  bool valid;
};

PlaneHit plane_hit(vec2 pixel) {
  vec2 ndc = pixel * u_ndc_from_image.xy + u_ndc_from_image.zw;
  vec3 origin = vec3(ndc * u_tangents, 0.0) * u_ortho;
  vec3 view = normalize(vec3(ndc * u_tangents * (1.0 - u_ortho), -1.0));
  float cos_theta = -dot(u_plane_normal, view);
  float distance = (u_plane_offset - dot(u_plane_normal, origin)) / -max(cos_theta, 1e-6);
  return PlaneHit(view, origin + distance * view, cos_theta, distance, cos_theta >= 1e-4 && distance > 0.0);
}

// How far behind the plane lies what is seen at 1 / distance from the eye.
float behind_plane(float inverse, float to_plane) {
  return max(1.0 / max(inverse, 1.0 / u_farthest) - to_plane, 0.0);
}

// Pixels that a tangent spans at such a distance.
float pixels_at(float behind, float to_plane) {
  return u_pixels_per_tangent * (u_ortho > 0.5 ? behind : behind / (behind + to_plane));
}
