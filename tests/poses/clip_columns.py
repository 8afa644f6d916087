# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume that two closed triangle meshes share, exact but for rounding; neither need be convex.

A closed mesh is the sum of the vertical columns under its triangles, counted + where the triangle
looks up and - where it looks down. So the volume of A and B is the sum over all pairs of triangles
(S of A, T of B) of sign(S) sign(T) times the integral of min(z_S, z_T) over the polygon in which
their projections on the level plane overlap. The level that the columns begin at cancels.
"""
import numpy as np

CHUNK = 200_000  # pairs of triangles clipped at a time
UPRIGHT = 1e-10  # sine of an upright triangle's angle: rounding of coordinates


def overlap_volume(a, b):
    """Volume shared by the solids with triangles a [N, 3, 3] and b [M, 3, 3], outward order [m3].

    @pre both closed; vertical triangles count nothing
    """
    if not len(a) or not len(b):
        return 0.0
    origin = a.reshape(-1, 3).mean(axis=0)  # small numbers: columns cancel to rounding
    a, b = level(a - origin), level(b - origin)
    b = b[b[:, :, 2].max(axis=1) > a[:, :, 2].min()]  # under all of A: they cancel
    pairs = np.argwhere(boxes_meet(a, b))
    return sum(clip_pairs(a[rows[:, 0]], b[rows[:, 1]])
               for rows in np.array_split(pairs, len(pairs) // CHUNK + 1))


def level(triangles):
    """Without the triangles that stand upright: their columns are empty. Where they lean by
    rounding alone, heights over them are anything."""
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return triangles[np.abs(normal[:, 2]) > UPRIGHT * np.linalg.norm(normal, axis=1)]


def twice_area(triangles):
    """Twice the signed area of the projections on the level plane."""
    u = triangles[:, 1, :2] - triangles[:, 0, :2]
    v = triangles[:, 2, :2] - triangles[:, 0, :2]
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def boxes_meet(a, b):
    """[N, M]: do the projections' boxes overlap?"""
    low_a, high_a = a[:, :, :2].min(axis=1), a[:, :, :2].max(axis=1)
    low_b, high_b = b[:, :, :2].min(axis=1), b[:, :, :2].max(axis=1)
    return ((low_a[:, None] < high_b[None]) & (low_b[None] < high_a[:, None])).all(axis=2)


def clip_pairs(s, t):
    """Signed volume of the columns that are under both triangles of each pair."""
    if not len(s):
        return 0.0
    sign = np.sign(twice_area(s)) * np.sign(twice_area(t))
    polygon, count = counterclockwise(s[:, :, :2]), np.full(len(s), 3)
    corners = counterclockwise(t[:, :, :2])
    for k in range(3):
        along = corners[:, (k + 1) % 3] - corners[:, k]
        inwards = np.stack([-along[:, 1], along[:, 0]], axis=1)
        polygon, count = clip(polygon, count, inwards, -(inwards * corners[:, k]).sum(axis=1))
        keep = count >= 3
        polygon, count, s, t = polygon[keep], count[keep], s[keep], t[keep]
        corners, sign = corners[keep], sign[keep]
    height_s, height_t = plane(s), plane(t)
    lower = height_t - height_s  # where it is < 0 the column ends at T
    total = integral(polygon, count, height_s)
    below, count = clip(polygon, count, -lower[:, :2], -lower[:, 2])
    return float((sign * (total + integral(below, count, lower))).sum())


def counterclockwise(triangles):
    """The projections, those that look down turned round."""
    u, v = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    down = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] < 0.0
    return np.where(down[:, None, None], triangles[:, ::-1], triangles)


def plane(triangles):
    """(p, q, c) of each triangle's plane z = p x + q y + c."""
    u, v = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(u, v)
    slope = -normal[:, :2] / normal[:, 2:]
    return np.column_stack([slope, triangles[:, 0, 2] - (slope * triangles[:, 0, :2]).sum(axis=1)])


def clip(polygon, count, direction, offset):
    """The part of each convex polygon [N, K, 2] with direction . p + offset >= 0; `count` corners
    of each row are used. Sutherland and Hodgman (1974)."""
    n, size = polygon.shape[:2]
    used = np.arange(size)[None] < count[:, None]
    after = np.where(np.arange(1, size + 1)[None] < count[:, None], np.arange(1, size + 1)[None], 0)
    distance = np.einsum("nki,ni->nk", polygon, direction) + offset[:, None]
    next_distance = np.take_along_axis(distance, after, axis=1)
    stays = used & (distance >= 0.0)
    crosses = used & ((distance >= 0.0) != (next_distance >= 0.0))
    with np.errstate(invalid="ignore", divide="ignore"):
        part = (distance / (distance - next_distance))[:, :, None]
        ends = np.take_along_axis(polygon, after[:, :, None], axis=1)
        crossing = polygon + part * (ends - polygon)
    emitted = stays.astype(int) + crosses
    place = np.cumsum(emitted, axis=1) - emitted
    out = np.zeros((n, size + 1, 2))
    row, corner = np.nonzero(stays)
    out[row, place[row, corner]] = polygon[row, corner]
    row, corner = np.nonzero(crosses)
    out[row, place[row, corner] + stays[row, corner]] = crossing[row, corner]
    return out, emitted.sum(axis=1)


def integral(polygon, count, linear):
    """Integral of p x + q y + c over each polygon, as a fan of triangles from its first corner."""
    total = np.zeros(len(polygon))
    first = polygon[:, 0]
    for k in range(1, polygon.shape[1] - 1):
        u, v = polygon[:, k] - first, polygon[:, k + 1] - first
        area = 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
        middle = first + (u + v) / 3.0
        value = (linear[:, :2] * middle).sum(axis=1) + linear[:, 2]
        total += np.where(k + 1 < count, area * value, 0.0)
    return total
