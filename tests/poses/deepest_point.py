# SPDX-License-Identifier: GPL-3.0-or-later
"""How deep one solid's surface lies inside another solid: samples, exact distances."""
import numpy as np

CHUNK = 500_000  # pairs of a point and a triangle looked at at a time
FINER = 10  # the deepest sample's surroundings are sampled so many times finer

# Rays go along z of axes turned by these angles [rad], so that they meet no edge of a mesh that is
# laid along the axes.
TILT = (0.5390, 0.3127)


class Samples:
    """Points of a mesh at most `spacing` apart along its edges and on its triangles.

    Each triangle gives a lattice of its own that contains its corners."""

    def __init__(self, vertices, triangles, spacing):
        self.corners = vertices[triangles]
        sides = np.linalg.norm(self.corners - np.roll(self.corners, 1, axis=1), axis=2)
        self.steps = np.maximum(np.ceil(sides.max(axis=1) / spacing), 1.0).astype(int)
        lattices = {n: lattice(n) for n in np.unique(self.steps)}
        self.weights = np.concatenate([lattices[n] for n in self.steps])
        self.triangle = np.repeat(np.arange(len(triangles)), [len(lattices[n]) for n in self.steps])
        self.points = self.at(self.triangle, self.weights)

    def at(self, triangle, weights):
        return np.einsum("pk,pkx->px", weights, self.corners[triangle])

    def around(self, sample):
        """Finer points of the sample's triangle, as far as its neighbours."""
        triangle = self.triangle[sample]
        fine = np.linspace(-1.0, 1.0, 2 * FINER + 1) / self.steps[triangle]
        i, j = np.meshgrid(fine, fine, indexing="ij")
        weights = self.weights[sample] + np.stack([i, j, -i - j], axis=2).reshape(-1, 3)
        weights = weights[(weights >= -1e-12).all(axis=1)]
        return self.at(np.full(len(weights), triangle), weights)


def lattice(n):
    """Weights of the corners at the lattice points of a triangle divided n times [P, 3]."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    i, j = i[i + j <= n] / n, j[i + j <= n] / n
    return np.stack([i, j, 1.0 - i - j], axis=1)


def deepest(samples, carry, triangles, most):
    """How deep the samples' surface lies inside the closed mesh `triangles`: 0 if it is outside.

    @param carry  brings points into the mesh's axes
    @param most   [m]; depths beyond it count as `most`
    """
    points = carry(samples.points)
    depth = depths(points, triangles, most)
    best = int(depth.argmax())
    if depth[best] <= 0.0:
        return 0.0
    finer = depths(carry(samples.around(best)), triangles, most)
    return float(max(depth[best], finer.max(initial=0.0)))


def depths(points, triangles, most):
    """Distance of the points inside the mesh from its surface, at most `most`; 0 outside [P]."""
    out = np.zeros(len(points))
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    rows = np.nonzero(((points > low.min(axis=0)) & (points < high.max(axis=0))).all(axis=1))[0]
    for group in neighbours(points, rows, 4.0 * most):
        inside = group[is_inside(points[group], triangles)]
        if not len(inside):
            continue
        p = points[inside]
        near = ((low < p.max(axis=0) + most) & (high > p.min(axis=0) - most)).all(axis=1)
        out[inside] = np.minimum(distance(p, triangles[near]), most) if near.any() else most
    return out


def neighbours(points, rows, size):
    """The rows in groups, one for each cell of a level grid."""
    cell = np.floor(points[rows, :2] / size).astype(int)
    order = np.lexsort(cell.T)
    ends = np.nonzero((np.diff(cell[order], axis=0) != 0).any(axis=1))[0] + 1
    return np.split(rows[order], ends) if len(rows) else []


def in_chunks(points, triangles, work):
    parts = np.array_split(points, len(points) * len(triangles) // CHUNK + 1)
    return np.concatenate([work(part, triangles) for part in parts])


def is_inside(points, triangles):
    """Does a ray from each point leave the closed mesh an odd number of times? [P]"""
    (ca, cb), (sa, sb) = np.cos(TILT), np.sin(TILT)
    turn = np.array([[ca, -sa * cb, sa * sb], [sa, ca * cb, -ca * sb], [0.0, sb, cb]])
    points, triangles = points @ turn, triangles @ turn
    if not len(points):
        return np.zeros(0, dtype=bool)
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    hit = ((low[:, :2] < points[:, :2].max(axis=0)) & (high[:, :2] > points[:, :2].min(axis=0))
           & (high[:, 2:] > points[:, 2].min())).all(axis=1)
    return in_chunks(points, triangles[hit], crossings) % 2 == 1


def crossings(points, triangles):
    """How many triangles lie above each point, along z [P]."""
    sides = []
    for k in range(3):
        along = triangles[:, (k + 1) % 3] - triangles[:, k]
        away = points[:, None, :2] - triangles[None, :, k, :2]
        sides.append(along[None, :, 0] * away[:, :, 1] - along[None, :, 1] * away[:, :, 0])
    within = ((sides[0] > 0) & (sides[1] > 0) & (sides[2] > 0)
              | (sides[0] < 0) & (sides[1] < 0) & (sides[2] < 0))
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    height = ((triangles[None, :, 0] - points[:, None]) * normal[None]).sum(axis=2)
    return (within & (height * np.sign(normal[None, :, 2]) > 0.0)).sum(axis=1)


def distance(points, triangles):
    """Distance of each point from the nearest of the triangles [P]."""
    return in_chunks(points, triangles, distance_from_all)


def distance_from_all(points, triangles):
    a, b, c = (triangles[None, :, k] for k in range(3))
    p = points[:, None]
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=2)
    best = np.full((len(points), len(triangles)), np.inf)
    over = np.broadcast_to(size > 0.0, best.shape)
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        away = p - start
        length = np.maximum((along * along).sum(axis=2), 1e-300)
        t = np.clip((away * along).sum(axis=2) / length, 0.0, 1.0)
        rest = away - t[:, :, None] * along
        best = np.minimum(best, (rest * rest).sum(axis=2))
        over = over & ((away * np.cross(normal, along)).sum(axis=2) >= 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        height = np.abs(((p - a) * normal).sum(axis=2)) / size
    return np.where(over, np.minimum(height, np.sqrt(best)), np.sqrt(best)).min(axis=1)
