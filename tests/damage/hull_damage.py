# SPDX-License-Identifier: GPL-3.0-or-later
"""What real hull files come with, done to a closed mesh: mesh and dice in, the mesh changed.

Each returns the surfaces whose union is the solid that the damaged mesh stands for, or None where
that is the mesh as it was.
"""
import math


def box_of(vertices):
    return [min(axis) for axis in zip(*vertices)], [max(axis) for axis in zip(*vertices)]


def append(mesh, other, group="part"):
    first = len(mesh.vertices)
    mesh.vertices += other[0]
    mesh.triangles += [tuple(k + first for k in t) for t in other[1]]
    mesh.groups += [group] * len(other[1])


HEXAHEDRON = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
              (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]


def make_box(centre, size, turn=0.0):
    """Outward; turned about z [rad]."""
    c, s = math.cos(turn), math.sin(turn)
    vertices = []
    for k in range(8):
        x, y, z = [h * (0.5 if k >> d & 1 else -0.5) for d, h in enumerate(size)]
        vertices.append((centre[0] + c * x - s * y, centre[1] + s * x + c * y, centre[2] + z))
    return vertices, list(HEXAHEDRON)


def turned(triangles):
    return [t[::-1] for t in triangles]


def rudder(mesh, dice):
    """A thin closed box through the skin near the aft end, facing either way."""
    low, high = box_of(mesh.vertices)
    length, depth = high[0] - low[0], high[2] - low[2]
    aft = [t for t in mesh.triangles
           if sum(p[0] for p in mesh.corners(t)) / 3 < low[0] + 0.15 * length] or mesh.triangles
    points = mesh.corners(aft[dice.below(len(aft))])
    centre = [sum(axis) / 3 for axis in zip(*points)]
    box = make_box(centre, (0.02 * length, 0.004 * length, 0.3 * depth), 0.1 + dice.random())
    truth = [(list(mesh.vertices), list(mesh.triangles)), box]
    append(mesh, (box[0], turned(box[1]) if dice.random() < 0.5 else box[1]), "rudder")
    return truth


def fold(mesh, dice):
    """One to three faces with two inner points that have changed places, one off the plane."""
    low, high = box_of(mesh.vertices)
    for chosen in dice.choose(min(dice.between(1, 3), len(mesh.triangles)), len(mesh.triangles)):
        a, b, c = mesh.triangles[chosen]
        pa, pb, pc = mesh.corners((a, b, c))
        centre = [sum(axis) / 3 for axis in zip(pa, pb, pc)]
        along = [0.08 * (y - x) for x, y in zip(pa, pb)]
        lift = 2e-3 * max(h - m for h, m in zip(high, low)) * (dice.random() - 0.5)
        u, v = [y - x for x, y in zip(pa, pb)], [y - x for x, y in zip(pa, pc)]
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        size = math.sqrt(sum(x * x for x in n)) or 1.0
        p, q = len(mesh.vertices), len(mesh.vertices) + 1
        mesh.vertices.append(tuple(x + d for x, d in zip(centre, along)))
        mesh.vertices.append(tuple(x - d + lift * y / size for x, d, y in zip(centre, along, n)))
        mesh.triangles[chosen] = (c, a, p)
        more = [(c, p, q), (c, q, b), (a, b, q), (a, q, p)]
        mesh.triangles += more
        mesh.groups += [mesh.groups[chosen]] * len(more)


def sheet(mesh, dice):
    """An open bulkhead without thickness across the solid, which may reach through the skin."""
    low, high = box_of(mesh.vertices)
    x = low[0] + (0.2 + 0.6 * dice.random()) * (high[0] - low[0])
    reach = 0.3 + 0.25 * dice.random()
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    half = [reach * (b - a) for a, b in zip(low, high)]
    corners = [(x, middle[1] + j * half[1], middle[2] + k * half[2])
               for j, k in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    append(mesh, (corners, [(0, 1, 2), (0, 2, 3)]), "bulkhead")


def below(vertices, triangles, groups, z):
    """The faces below a level, those that it cuts with corners on it; the cut is open."""
    vertices, out, names, cuts = list(vertices), [], [], {}

    def cut(a, b):
        key = (min(a, b), max(a, b))
        if key not in cuts:
            p, q = vertices[key[0]], vertices[key[1]]
            part = (z - p[2]) / (q[2] - p[2])
            cuts[key] = len(vertices)
            vertices.append((p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1]), z))
        return cuts[key]

    for t, name in zip(triangles, groups):
        kept = []
        for a, b in zip(t, t[1:] + t[:1]):
            if vertices[a][2] <= z:
                kept.append(a)
            if (vertices[a][2] - z) * (vertices[b][2] - z) < 0:
                kept.append(cut(a, b))
        for k in range(1, len(kept) - 1):
            out.append((kept[0], kept[k], kept[k + 1]))
            names.append(name)
    return vertices, out, names


def waterline(mesh, dice):
    """Cut off above a level and left open."""
    low, high = box_of(mesh.vertices)
    z = low[2] + (0.45 + 0.4 * dice.random()) * (high[2] - low[2])
    mesh.vertices, mesh.triangles, mesh.groups = below(mesh.vertices, mesh.triangles, mesh.groups,
                                                       z)
    used = sorted({k for t in mesh.triangles for k in t})
    new = {old: k for k, old in enumerate(used)}
    mesh.vertices = [mesh.vertices[k] for k in used]
    mesh.triangles = [tuple(new[k] for k in t) for t in mesh.triangles]
    # a fan from any point in the plane closes it: what it covers twice cancels
    edges = {(a, b) for t in mesh.triangles for a, b in zip(t, t[1:] + t[:1])}
    middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, z)
    fan = [(b, a, len(mesh.vertices)) for a, b in sorted(edges) if (b, a) not in edges]
    return [(mesh.vertices + [middle], mesh.triangles + fan)]


def skin(mesh, dice):
    """An inner skin: a smaller copy about the middle of the volume, facing in or out."""
    total, centre = 0.0, [0.0, 0.0, 0.0]
    for t in mesh.triangles:
        a, b, c = mesh.corners(t)
        volume = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                  + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        total += volume
        centre = [s + volume * sum(axis) / 4 for s, axis in zip(centre, zip(a, b, c))]
    centre = [s / total for s in centre]
    scale = 0.5 + 0.4 * dice.random()
    inner = [tuple(m + scale * (x - m) for x, m in zip(p, centre)) for p in mesh.vertices]
    append(mesh, (inner, turned(mesh.triangles) if dice.random() < 0.5
                  else list(mesh.triangles)), "tank")


def posts(mesh, dice):
    """Square tubes above the deck that lack an end: small planar openings, up to 1.5 % of doubt."""
    low, high = box_of(mesh.vertices)
    count = dice.between(8, 30)
    # half of the steepest slope that counts, 85 degrees, times area^2 / perimeter
    side = min((0.015 * dice.random() * mesh.volume() / (2.86 * count)) ** (1 / 3),
               0.01 * (high[0] - low[0]))
    truth = [(list(mesh.vertices), list(mesh.triangles))]
    for k in range(count):
        x = low[0] + (high[0] - low[0]) * (0.1 + 0.8 * k / count)
        post = make_box((x, (low[1] + high[1]) / 2, high[2] + 3 * side), (side, side, 4 * side))
        truth.append(post)
        append(mesh, (post[0], post[1][2:] if dice.random() < 0.7 else post[1][:2] + post[1][4:]),
               "post")
    return truth


def domain(mesh, dice):
    """A flow solver's box, facing inwards, or a sea plane, or both."""
    low, high = box_of(mesh.vertices)
    length = max(b - a for a, b in zip(low, high))
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    which = dice.below(3)
    if which != 1:
        box = make_box(middle, (5 * length, 3.5 * length, 3.5 * length))
        append(mesh, (box[0], turned(box[1])), "domain")
    if which != 0:
        z = low[2] + (0.3 + 0.4 * dice.random()) * (high[2] - low[2])
        far = 1.5 * length
        sea = [(middle[0] + far * i, middle[1] + far * j, z)
               for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        append(mesh, (sea, [(0, 1, 2), (0, 2, 3)]), "sea")


def patches(mesh, dice, split):
    """Parts by random planes, open edges split here and there, each part moved 1e-4 L at most."""
    split(mesh, dice)
    low, high = box_of(mesh.vertices)
    length = max(b - a for a, b in zip(low, high))
    edges = {}
    for k, t in enumerate(mesh.triangles):
        for a, b in zip(t, t[1:] + t[:1]):
            edges.setdefault((min(a, b), max(a, b)), []).append(k)
    parent = list(range(len(mesh.vertices)))

    def root(v):
        while parent[v] != v:
            v = parent[v]
        return v

    for t in mesh.triangles:
        for v in t[1:]:
            parent[root(v)] = root(t[0])
    by = {}
    for v in range(len(mesh.vertices)):
        by.setdefault(root(v), [0.5e-4 * length * (2 * dice.random() - 1) for _ in range(3)])
    shift = [by[root(v)] for v in range(len(mesh.vertices))]
    touched = set()
    for (a, b), owners in sorted(edges.items()):
        if len(owners) > 1 or owners[0] in touched or dice.random() < 0.5:
            continue
        touched.add(owners[0])
        t = mesh.triangles[owners[0]]
        part = 0.3 + 0.4 * dice.random()
        v = len(mesh.vertices)
        mesh.vertices.append(tuple(x + part * (y - x)
                                   for x, y in zip(mesh.vertices[a], mesh.vertices[b])))
        shift.append(shift[a])
        turn = next(k for k in range(3) if {t[k], t[(k + 1) % 3]} == {a, b})
        p, q, r = t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]
        mesh.triangles[owners[0]] = (p, v, r)
        mesh.triangles.append((v, q, r))
        mesh.groups.append(mesh.groups[owners[0]])
    mesh.vertices = [tuple(x + d for x, d in zip(p, s)) for p, s in zip(mesh.vertices, shift)]
