# SPDX-License-Identifier: GPL-3.0-or-later
"""What spherize wrote against the surfaces that the mesh stands for, without its geometry.

Needs numpy and h5py (Debian's python3-h5py). Winding numbers are sums of solid angles (van
Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983); distances are those to every triangle
(Ericson, Real-Time Collision Detection, section 5.1.5).
"""
import h5py
import numpy

SPHERES = 300   # at most, evenly out of all
VERTICES = 200


def spread(rows, most):
    return rows[numpy.linspace(0, len(rows) - 1, min(most, len(rows))).astype(int)]


def corners_of(surface):
    vertices = numpy.array(surface[0], dtype=float)
    return vertices[numpy.array(surface[1], dtype=int)]  # T x 3 x 3


def winding_numbers(points, corners):
    total = numpy.zeros(len(points))
    for k, p in enumerate(points):
        a, b, c = (corners[:, i] - p for i in range(3))
        la, lb, lc = (numpy.linalg.norm(x, axis=1) for x in (a, b, c))
        above = numpy.einsum("ij,ij->i", a, numpy.cross(b, c))
        under = (la * lb * lc + numpy.einsum("ij,ij->i", a, b) * lc
                 + numpy.einsum("ij,ij->i", b, c) * la + numpy.einsum("ij,ij->i", c, a) * lb)
        total[k] = numpy.arctan2(above, under).sum() / (2 * numpy.pi)
    return total


def distances(points, corners):
    """Of each point from the nearest triangle."""
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    dot = lambda x, y: numpy.einsum("ij,ij->i", x, y)  # noqa: E731
    d00, d01, d11 = dot(ab, ab), dot(ab, ac), dot(ac, ac)
    below = numpy.maximum(d00 * d11 - d01 * d01, 1e-300)
    out = numpy.empty(len(points))
    for k, p in enumerate(points):
        ap = p - a
        d20, d21 = dot(ap, ab), dot(ap, ac)
        v, w = (d11 * d20 - d01 * d21) / below, (d00 * d21 - d01 * d20) / below
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        flat = ap - v[:, None] * ab - w[:, None] * ac
        best = numpy.where(inside, dot(flat, flat), numpy.inf)
        for i in range(3):
            q, r = corners[:, i], corners[:, (i + 1) % 3]
            edge = r - q
            part = numpy.clip(dot(p - q, edge) / numpy.maximum(dot(edge, edge), 1e-300), 0, 1)
            foot = p - q - part[:, None] * edge
            best = numpy.minimum(best, dot(foot, foot))
        out[k] = numpy.sqrt(best.min())
    return out


def judge(path, truth, radius):
    """What is wrong with a sphere set of these surfaces: (answer, line), or None."""
    surfaces = [corners_of(surface) for surface in truth]
    with h5py.File(path) as file:
        centres = spread(file["center"][:], SPHERES)
        solid = file["mesh/vertices"][:][file["mesh/triangles"][:]]
    inside = numpy.zeros(len(centres), dtype=bool)
    for corners in surfaces:
        inside |= winding_numbers(centres, corners) > 0.5
    if not inside.all():
        at = centres[~inside][0]
        return "outside", f"{(~inside).sum()} of {len(centres)} spheres outside, one at {at}"
    points = spread(surfaces[0].reshape(-1, 3), VERTICES)
    off = distances(points, solid)
    outer = numpy.ones(len(points), dtype=bool)
    for corners in surfaces[1:]:  # what another part covers need not be on the solid's surface
        outer &= winding_numbers(points, corners) < 0.5
    off = numpy.where(outer, off, 0.0)
    if off.max() > radius:
        return "far", (f"the solid is {off.max():.3g} m from {points[off.argmax()]}, "
                       f"R {radius:.3g} m")
    return None
