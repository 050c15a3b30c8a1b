// The reflectance of a material that is metal in places, or whose metal has a texture (Metalness of formats/assets/material.h).
uniform bool u_metal_varies;
uniform float u_metal;  // where its texture's alpha is 1
uniform vec3 u_dielectric;
uniform vec3 u_f0;  // that the table of R is of

// R is 1 - (1 - F0) A by Schlick's curve: A, by angle and roughness, follows from the table, but where its F0 is almost 1.
vec3 reflectance_in_place(vec3 reflectance, vec3 base, float metal) {
  vec3 f0 = mix(u_dielectric, base, metal), beyond = 1.0 - u_f0;
  vec3 a = mix(vec3(1.0), (1.0 - reflectance) / max(beyond, 1e-4), smoothstep(0.0, 0.05, beyond));
  return clamp(1.0 - (1.0 - f0) * a, 0.0, 1.0);
}
