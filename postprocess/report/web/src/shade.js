// SPDX-License-Identifier: GPL-3.0-or-later
// GLSL shared by hull and floes: flat shading with the light at the viewer's upper left, as in the
// report's drawings, and dark outlines of one to two pixels.

export const SHADE = `
float shade(vec3 view) {
  vec3 n = normalize(cross(dFdx(view), dFdy(view)));
  return 0.62 + 0.42 * max(0.0, dot(n, normalize(vec3(-0.45, 0.5, 1.0))));
}
float outline(vec3 edge) {
  vec3 pixels = edge / max(fwidth(edge), vec3(1e-5));
  float nearest = min(pixels.x, min(pixels.y, pixels.z));
  return mix(0.45, 1.0, smoothstep(0.4, 1.3, nearest));
}`;
