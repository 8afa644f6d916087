# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged copies of a closed mesh, the same for the same mesh name, seed and index.

In: an OBJ of triangles. Out: the bytes of a file (OBJ, ASCII STL or binary STL) with one kind of
damage, or several together. Only random() of the generator is used: its sequence is fixed for all
Python versions.
"""
import math
import os
import random
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../meshes"))
import check_meshes  # noqa: E402
import hull_damage  # noqa: E402

SHARE_DELETED = 0.02      # of the faces; at least one
SHARE_DUPLICATED = 0.05
JITTER = 1e-6             # of the length of the bounding box

REPAIRABLE = ["delete", "hole", "flip", "jitter", "crack", "duplicate", "split"]
HOPELESS = ["nan", "truncate"]  # to be refused, unless what is left still determines the solid
HULLS = ["rudder", "fold", "sheet", "waterline", "skin", "posts", "domain", "patches"]
KINDS = REPAIRABLE + ["together"] + HOPELESS + HULLS  # all of HULLS are repairable
FORMATS = ["obj", "obj", "ascii.stl", "stl"]


class Mesh:
    """Vertices (x, y, z) [m], triangles (three indices from 0) and the name of each one's group."""

    def __init__(self, vertices, triangles, groups):
        self.vertices, self.triangles, self.groups = vertices, triangles, groups

    def copy(self):
        return Mesh(list(self.vertices), list(self.triangles), list(self.groups))

    def corners(self, triangle):
        return [self.vertices[k] for k in triangle]

    def volume(self):
        return check_meshes.volume(self.vertices, self.triangles)


def read_obj(path):
    """A file written as those in meshes/ are: triangles in groups, nothing but vertices."""
    with open(path, encoding="ascii") as file:
        return Mesh(*check_meshes.read_obj(file.read()))


class Dice:
    def __init__(self, *key):
        self.random = random.Random("/".join(str(part) for part in key)).random

    def below(self, count):
        return min(int(self.random() * count), count - 1)

    def between(self, least, most):
        return least + self.below(most - least + 1)

    def choose(self, count, total):
        """`count` different numbers below `total`, in random order."""
        order = list(range(total))
        for k in range(count):
            other = k + self.below(total - k)
            order[k], order[other] = order[other], order[k]
        return order[:count]


# --- kinds of damage: mesh and dice in, the mesh changed ------------------------------------------

def keep(mesh, wanted):
    mesh.triangles = [t for k, t in enumerate(mesh.triangles) if wanted(k)]
    mesh.groups = [g for k, g in enumerate(mesh.groups) if wanted(k)]


def deleted_count(mesh, dice):
    return dice.between(1, max(1, int(SHARE_DELETED * len(mesh.triangles))))


def delete(mesh, dice):
    """Faces here and there."""
    gone = set(dice.choose(deleted_count(mesh, dice), len(mesh.triangles)))
    keep(mesh, lambda k: k not in gone)


def hole(mesh, dice):
    """Faces next to each other: one hole."""
    wanted = deleted_count(mesh, dice)
    around = {}
    for k, t in enumerate(mesh.triangles):
        for vertex in t:
            around.setdefault(vertex, []).append(k)
    first = dice.below(len(mesh.triangles))
    gone, queue = {first}, [first]
    for k in queue:
        for neighbour in (n for vertex in mesh.triangles[k] for n in around[vertex]):
            if neighbour not in gone and len(gone) < wanted:
                gone.add(neighbour)
                queue.append(neighbour)
    keep(mesh, lambda k: k not in gone)


def flip(mesh, dice):
    """Half the faces turned over, at least one."""
    for k in dice.choose(max(1, len(mesh.triangles) // 2), len(mesh.triangles)):
        mesh.triangles[k] = mesh.triangles[k][::-1]


def jitter(mesh, dice):
    """Every vertex moved by up to JITTER of the length in each direction."""
    size = JITTER * max(max(axis) - min(axis) for axis in zip(*mesh.vertices))
    mesh.vertices = [tuple(value + size * (2 * dice.random() - 1) for value in point)
                     for point in mesh.vertices]


def crack(mesh, dice):
    """Every face with vertices of its own, each jittered: no two faces meet."""
    mesh.vertices = [point for t in mesh.triangles for point in mesh.corners(t)]
    mesh.triangles = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(mesh.triangles))]
    jitter(mesh, dice)


def duplicate(mesh, dice):
    """Faces written again, some the other way round, some with vertices of their own."""
    total = len(mesh.triangles)
    for k in dice.choose(dice.between(1, max(1, int(SHARE_DUPLICATED * total))), total):
        again = mesh.triangles[k][::-1] if dice.random() < 0.5 else mesh.triangles[k]
        if dice.random() < 0.5:
            points = mesh.corners(again)
            again = tuple(range(len(mesh.vertices), len(mesh.vertices) + 3))
            mesh.vertices += points
        mesh.triangles.append(again)
        mesh.groups.append(mesh.groups[k])


def split(mesh, dice):
    """Two to five parts by random planes, each with its own vertices, faces in random order."""
    middle = [(max(axis) + min(axis)) / 2 for axis in zip(*mesh.vertices)]
    size = [max(axis) - min(axis) for axis in zip(*mesh.vertices)]
    part = [0] * len(mesh.triangles)
    for number in range(1, dice.between(2, 5)):
        normal = [2 * dice.random() - 1 for _ in range(3)]
        point = [m + s * (dice.random() - 0.5) for m, s in zip(middle, size)]
        for k, t in enumerate(mesh.triangles):
            centre = [sum(axis) / 3 for axis in zip(*mesh.corners(t))]
            if sum(n * (c - p) for n, c, p in zip(normal, centre, point)) > 0:
                part[k] = number
    order = sorted(dice.choose(len(mesh.triangles), len(mesh.triangles)), key=lambda k: part[k])
    vertices, triangles, new = [], [], {}
    for k in order:
        for vertex in mesh.triangles[k]:
            if (part[k], vertex) not in new:
                new[part[k], vertex] = len(vertices)
                vertices.append(mesh.vertices[vertex])
        triangles.append(tuple(new[part[k], vertex] for vertex in mesh.triangles[k]))
    mesh.groups = [mesh.groups[k] for k in order]
    mesh.vertices, mesh.triangles = vertices, triangles


def together(mesh, dice):
    """Two or three repairable kinds, one after the other; faces are deleted at most once.

    Two faces less of a box may be its edge: what is left would not tell where that was.
    """
    first = dice.below(2)  # delete or hole
    kinds = REPAIRABLE[first:first + 1] + REPAIRABLE[2:]
    chosen = [kinds[k] for k in sorted(dice.choose(dice.between(2, 3), len(kinds)))]
    for kind in chosen:
        DAMAGE[kind](mesh, dice)
    return chosen


def nan(mesh, dice):
    """One to three vertices of faces that are no numbers, or infinite."""
    for _ in range(dice.between(1, 3)):
        vertex = mesh.triangles[dice.below(len(mesh.triangles))][dice.below(3)]
        point = list(mesh.vertices[vertex])
        point[dice.below(3)] = (math.nan, math.inf, -math.inf)[dice.below(3)]
        mesh.vertices[vertex] = tuple(point)


DAMAGE = {"delete": delete, "hole": hole, "flip": flip, "jitter": jitter, "crack": crack,
          "duplicate": duplicate, "split": split, "together": together, "nan": nan,
          "truncate": lambda mesh, dice: None,  # the file is cut, not the mesh
          "patches": lambda mesh, dice: hull_damage.patches(mesh, dice, split)}
DAMAGE.update((kind, getattr(hull_damage, kind)) for kind in HULLS if kind not in DAMAGE)


# --- files ----------------------------------------------------------------------------------------

def obj_bytes(mesh):
    lines = ["v %.12g %.12g %.12g" % point for point in mesh.vertices]
    group = None
    for t, name in zip(mesh.triangles, mesh.groups):
        if name != group:
            lines.append("g " + name)
            group = name
        lines.append("f %d %d %d" % (t[0] + 1, t[1] + 1, t[2] + 1))
    return ("\n".join(lines) + "\n").encode("ascii")


def ascii_stl_bytes(mesh):
    lines = ["solid damaged"]
    for t in mesh.triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex %.9g %.9g %.9g" % point for point in mesh.corners(t)]
        lines += ["endloop", "endfacet"]
    return ("\n".join(lines + ["endsolid damaged"]) + "\n").encode("ascii")


def stl_bytes(mesh):
    head = b"binary".ljust(80, b" ") + struct.pack("<I", len(mesh.triangles))
    return head + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(value for point in mesh.corners(t) for value in point), 0)
        for t in mesh.triangles)


WRITERS = {"obj": obj_bytes, "ascii.stl": ascii_stl_bytes, "stl": stl_bytes}


def volume_of(surfaces):
    return sum(check_meshes.volume(*surface) for surface in surfaces)


def damaged_copy(mesh, name, seed, index):
    """Kind, all that was done, file ending and bytes of a copy, and what solid it stands for.

    Kinds follow each other with the index; the format changes with every round of kinds. The solid
    is the union of closed surfaces: vertices and triangles each.
    """
    dice = Dice(name, seed, index)
    kind = KINDS[index % len(KINDS)]
    ending = FORMATS[index // len(KINDS) % len(FORMATS)]
    copy = mesh.copy()
    truth = [(mesh.vertices, mesh.triangles)]
    answer = DAMAGE[kind](copy, dice)
    done = answer if kind == "together" else [kind]
    if kind in HULLS and answer:
        truth = answer
    data = WRITERS[ending](copy)
    if kind == "truncate":
        data = data[:dice.between(0, len(data) - 2)]
    return kind, done, ending, data, truth
