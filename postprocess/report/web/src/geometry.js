// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes for drawing: triangles with corners of their own, which know the edges to be outlined.

function normals(vertices, triangles) {
  const out = new Float32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[t + k]);
    const u = [0, 1, 2].map((d) => vertices[b + d] - vertices[a + d]);
    const v = [0, 1, 2].map((d) => vertices[c + d] - vertices[a + d]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    out.set(n.map((x) => x / length), t);
  }
  return out;
}

/** For each side of each triangle (side k is opposite to corner k): is it a crease or border? */
function creases(vertices, triangles, angle) {
  const normal = normals(vertices, triangles);
  const flat = Math.cos((angle * Math.PI) / 180);
  const count = vertices.length / 3;
  const side = new Map(); // directed edge -> triangle
  const ends = (t, k) => [triangles[t + ((k + 1) % 3)], triangles[t + ((k + 2) % 3)]];
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) {
      const [a, b] = ends(t, k);
      side.set(a * count + b, t);
    }
  const out = new Uint8Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) {
      const [a, b] = ends(t, k);
      const other = side.get(b * count + a);
      const cosine = other === undefined ? -1
        : normal[t] * normal[other] + normal[t + 1] * normal[other + 1]
          + normal[t + 2] * normal[other + 2];
      out[t + k] = cosine < flat ? 1 : 0;
    }
  return out;
}

/** Ends of the edges where faces meet at `angle` degrees or more and of borders: 6 numbers each. */
export function creaseLines(vertices, triangles, angle) {
  const crease = creases(vertices, triangles, angle);
  const points = [];
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k)
      if (crease[t + k])
        for (const corner of [triangles[t + ((k + 1) % 3)], triangles[t + ((k + 2) % 3)]])
          points.push(...vertices.subarray(3 * corner, 3 * corner + 3));
  return new Float32Array(points);
}

/**
 * Triangles without shared corners. `edge` of corner k is the k-th unit vector: interpolated, it
 * tells how far a pixel is from each side. Sides that are not to be drawn get a 1 at all corners,
 * which keeps pixels away from them.
 * @param angle between faces in degrees from which their common side is drawn
 */
export function triangleSoup(vertices, triangles, angle) {
  const crease = creases(vertices, triangles, angle);
  const position = new Float32Array(3 * triangles.length);
  const edge = new Uint8Array(3 * triangles.length);
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) {
      const from = 3 * triangles[t + k];
      for (let d = 0; d < 3; ++d) {
        position[3 * (t + k) + d] = vertices[from + d];
        edge[3 * (t + k) + d] = d === k || !crease[t + d] ? 1 : 0;
      }
    }
  return { position, edge };
}
