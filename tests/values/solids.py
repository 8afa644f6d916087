# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of the value tests, none with a symmetry that could hide a swapped axis, and their exact
integrals.

Integrals are sums over tetrahedra from the origin to each triangle, as in any textbook; the
programs' own come from another formula (common/geometry)."""
import numpy as np

# A right-angled corner with unequal legs along x, y, z, moved away from the origin.
LEGS = np.array([1.2, 1.0, 0.8])
CORNER = np.array([3.0, -2.0, 1.0])


def tetrahedron():
    """Vertices, and triangles by the name of their group."""
    vertices = CORNER + np.vstack([np.zeros(3), np.diag(LEGS)])
    return vertices, {"back": [(0, 3, 2)], "side": [(0, 1, 3)], "bottom": [(0, 2, 1)],
                      "slope": [(1, 2, 3)]}


def prism(outline, low, high, shift_low=None):
    """An outline [n, 2], counterclockwise from above, from z = low to high. `shift_low` [n] moves
    corners of the lower end along x. The sides' names are side0, side1, ..."""
    outline = np.asarray(outline, float)
    n = len(outline)
    lower = outline.copy()
    if shift_low is not None:
        lower[:, 0] += shift_low
    vertices = np.vstack([np.column_stack([lower, np.full(n, low)]),
                          np.column_stack([outline, np.full(n, high)])])
    groups = {"bottom": [(0, k + 1, k) for k in range(1, n - 1)],
              "deck": [(n, n + k, n + k + 1) for k in range(1, n - 1)]}
    for k in range(n):
        m = (k + 1) % n
        groups[f"side{k}"] = [(k, m, n + m), (k, n + m, n + k)]
    return vertices, groups


def write_obj(path, solid):
    vertices, groups = solid
    with open(path, "w", encoding="utf-8") as file:
        file.writelines("v {:.17g} {:.17g} {:.17g}\n".format(*v) for v in vertices)
        for name, triangles in groups.items():
            file.write(f"g {name}\n")
            file.writelines("f {} {} {}\n".format(*(k + 1 for k in t)) for t in triangles)


def moments(solid):
    """Volume, area, centroid and inertia tensor about it for density 1."""
    vertices, groups = solid
    triangles = np.array([t for part in groups.values() for t in part])
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    six = np.einsum("ij,ij->i", a, np.cross(b, c))
    volume = six.sum() / 6
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    centroid = np.einsum("i,ij->j", six, a + b + c) / (24 * volume)
    # int x x^T over a tetrahedron from 0: |det| / 120 (sum of v v^T + (sum of v)(sum of v)^T)
    total = a + b + c
    second = sum(np.einsum("i,ij,ik->jk", six, v, v) for v in (a, b, c, total)) / 120
    second -= volume * np.outer(centroid, centroid)
    return volume, area, centroid, np.trace(second) * np.eye(3) - second


def polygon_area(outline):
    x, y = np.asarray(outline, float).T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
