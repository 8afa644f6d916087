#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_poses.py against overlaps that are known: poses_test.py FOLDER"""
import pathlib
import subprocess
import sys

import h5py
import numpy as np

from clip_columns import overlap_volume
from crushed_notches import Notches, crushed_notches, spacing_of, whole_share
from deepest_point import Samples, deepest, is_inside
from left_solids import left_solids

HERE = pathlib.Path(__file__).resolve().parent


def prism(outline, low, high):
    """Vertices and outward triangles of the prism over a counterclockwise star-shaped outline,
    seen from its first corner."""
    n = len(outline)
    vertices = np.array([(x, y, z) for z in (low, high) for x, y in outline], dtype=float)
    after = [(k + 1) % n for k in range(n)]
    sides = [t for k, m in enumerate(after) for t in ((k, m, n + k), (m, n + m, n + k))]
    caps = [t for k in range(1, n - 1) for t in ((0, k + 1, k), (n, n + k, n + k + 1))]
    return vertices, np.array(sides + caps)


def box(size, centre=(0.0, 0.0, 0.0)):
    x, y, z = (0.5 * s for s in size)
    vertices, triangles = prism([(-x, -y), (x, -y), (x, y), (-x, y)], -z, z)
    return vertices + centre, triangles


def turned(vertices, angle, axis):
    axis = np.array(axis) / np.linalg.norm(axis)
    cross = np.cross(np.eye(3), axis)
    turn = np.eye(3) - np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    return vertices @ turn.T


def shared(a, b):
    return overlap_volume(a[0][a[1]], b[0][b[1]])


def close(got, expected, tolerance, what):
    assert abs(got - expected) <= tolerance, f"{what}: {got}, not {expected}"


def volumes():
    """Rounding of coordinates of order 1: 1e-12 m3."""
    one = box((1, 1, 1))
    close(shared(one, box((1, 1, 1), (0.7, 0.6, 0.9))), 0.3 * 0.4 * 0.1, 1e-12, "two boxes")
    close(shared(one, box((1, 1, 1), (1, 0, 0))), 0.0, 1e-12, "two boxes face to face")
    close(shared(one, box((1, 1, 1), (0, 0, 1))), 0.0, 1e-12, "a box on a box")
    close(shared(one, one), 1.0, 1e-12, "a box and itself")
    close(shared(one, box((0.2, 0.3, 0.4), (0.1, 0, 0))), 0.024, 1e-12, "a box in a box")
    octagon = turned(one[0], np.pi / 4, (0, 0, 1)), one[1]
    close(shared(one, octagon), 2 * (np.sqrt(2) - 1), 1e-12, "a box turned by 45 degrees")
    corner = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    tetrahedron = corner, np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    # the plane x + y + z = 1 cuts a corner of 0.5 off the cube of 0.5: 1/8 - (1/2)^3/6
    close(shared(box((1, 1, 1)), tetrahedron), 0.125 - 0.125 / 6, 1e-12, "a tetrahedron in a box")
    # the same with sides that lean by rounding, as those of crushed solids do
    leaning = one[0] + 1e-16 * np.sign(one[0][:, [2]]) * (1, 0, 0), one[1]
    close(shared(leaning, octagon), 2 * (np.sqrt(2) - 1), 1e-12, "a box that leans by rounding")
    notched = prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 0, 1)
    close(shared(notched, box((1, 1, 1), (1.5, 1.5, 0.5))), 0.0, 1e-12, "a box in a notch")
    close(shared(notched, box((1, 1, 1), (1.4, 1.3, 0.5))), 0.1 * 1 + 0.9 * 0.2, 1e-12,
          "a box in both arms of an angle")


def left_of_crushed(folder):
    """A tetrahedron, its right angle in the origin and three edges of 2 m, that lost its tip."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "checkpoint.h5"
    corners = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (1, 0, 1), (0, 1, 1), (0, 0, 1)]
    # planes: x = 0, y = 0, z = 0, the slope and z = 1; each edge along left x right
    edges = [(0, 1, 1, 2), (2, 0, 0, 2), (1, 2, 3, 2), (5, 0, 1, 0), (1, 3, 1, 3), (4, 2, 0, 3),
             (3, 4, 4, 3), (4, 5, 4, 0), (5, 3, 4, 1)]
    with h5py.File(path, "w") as file:
        for name, values in (("body", [7]), ("planes", [5]), ("corners", [6]), ("edges", [9]),
                             ("corner", np.array(corners, dtype=float))):
            file[f"crushed_solids.{name}"] = values
        for k, name in enumerate(("begin", "end", "left", "right")):
            file[f"crushed_solids.edge_{name}"] = [edge[k] for edge in edges]
    left = left_solids(path)
    assert list(left) == [7]
    close(left[7].volume, 8.0 / 6 - 1.0 / 6, 1e-12, "a tetrahedron without its tip")


def in_notches(folder):
    """A lattice of 40 points a side: 1 % of the share of a circle. No point is on a face."""
    tops = np.array([(0.0, 0, 0.5), (0.3, 0, 0.5)])
    notches = Notches(tops, np.array([(0, 0, -0.1), (0, 0, -0.2)]), 0.1)
    points = np.array([(0.05, 0, 0.45), (0.05, 0, 0.39), (0, 0, 0.51), (0.11, 0, 0.45),
                       (0.3, 0.09, 0.31)])
    assert list(notches.hold(points)) == [True, False, False, False, True]

    def left(low, high, of_one, of_other):
        one, other = box((1, 1, 1)), box((1, 1, 1), (0, 0, 0.9))
        shifted = other[0] - (0, 0, 0.9)  # its own axes
        solids = [(lambda p: p, one[0][one[1]]), (lambda p: p - (0, 0, 0.9), shifted[other[1]])]
        return whole_share((np.array(low), np.array(high)), solids, [of_one, of_other])

    # they share the height 0.4 to 0.5, of which the notch is a cylinder in a square
    circle = np.pi * 0.1 ** 2 / 0.2 ** 2
    low, high = (-0.1, -0.1, 0.3), (0.1, 0.1, 0.6)
    close(left(low, high, notches, None), 1.0 - circle, 0.01 * circle, "a notch in one")
    below = Notches(np.array([(0.0, 0, -0.5)]), np.array([(0, 0, 0.05)]), 0.1)
    # in the other one's axes; of 14 layers of points in the overlap it takes 7
    close(left(low, high, None, below), 1.0 - 0.5 * circle, 0.01 * circle, "half as deep")
    # two circles that touch, in a rectangle
    low, high = (-0.1, -0.1, 0.3), (0.3, 0.1, 0.6)
    beside = Notches(np.array([(0.2, 0, -0.5)]), np.array([(0, 0, 0.2)]), 0.1)
    one = Notches(tops[:1], np.array([(0, 0, -0.2)]), 0.1)
    close(left(low, high, one, beside), 1.0 - circle, 0.01 * circle, "a notch in each")
    close(left(low, high, one, None), 1.0 - 0.5 * circle, 0.01 * circle, "of each only one")

    # Spheres of 0.1 m on a plate of 0.44 m, 0.2 and 0.3 m from each other along it and 0.24 m
    # across. Body 1 has lost its last sphere, body 2 its second.
    folder.mkdir(parents=True, exist_ok=True)
    moves = np.zeros((12, 3))
    moves[[5, 7], 2] = 0.01, -0.03
    with h5py.File(folder / "checkpoint.h5", "w") as file:
        file["crushed.first"], file["crushed.recess"] = [-1, 0, 6], moves
    places = [(x, 0, z, 0.1) for z in (0.12, -0.12) for x in (0.0, 0.2, 0.5)]
    with h5py.File(folder / "run.h5", "w") as file:
        file["shapes/spheres"] = np.array([(9, 9, 9, 0.5), *places])
        file["shapes/sphere_offset"], file["frames/body_shape"] = [0, 1, 7], [1, 1]
    got = crushed_notches(folder / "run.h5", folder / "checkpoint.h5")
    assert list(got) == [1, 2], got
    assert np.allclose(got[1].top, [(0.5, 0, -0.22)]) and np.allclose(got[2].top, [(0.2, 0, 0.22)])
    assert np.allclose((got[1].length, got[2].length), ((0.01,), (0.03,))), got
    close(got[2].radius, 0.75 * 0.3, 1e-12, "the patch of the widest spacing along the plate")
    close(spacing_of(np.array([(0, 0, 0, 0.1)])), 0.2, 1e-12, "a sphere alone")


def turned_together():
    """The volume does not depend on the axes, nor on which solid comes first."""
    dice = np.random.default_rng(5)
    notched = prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 0, 1)
    for _ in range(20):
        b = box((1.1, 0.7, 0.9))
        b = turned(b[0], dice.uniform(0, 6), dice.normal(size=3)) + dice.uniform(0, 1.5, 3), b[1]
        expected = shared(notched, b)
        angle, axis = dice.uniform(0, 6), dice.normal(size=3)
        both = [(turned(body[0], angle, axis), body[1]) for body in (b, notched)]
        close(shared(*both), expected, 1e-11, "turned together")
        # two boxes make the angle: their shares add up
        arms = box((2, 1, 1), (1, 0.5, 0.5)), box((1, 1, 1), (0.5, 1.5, 0.5))
        close(sum(shared(arm, b) for arm in arms), expected, 1e-11, "in parts")


def depths():
    """Sampled at h / 5, near the deepest sample at h / 50: 2 % of h; corners and faces exact."""
    def depth(a, b, most=1.0):
        return deepest(Samples(a[0], a[1], 0.2), lambda points: points, b[0][b[1]], most)

    one = box((1, 1, 1))
    close(depth(one, box((1, 1, 1), (0.87, 0.1, 0.2))), 0.13, 1e-9, "a box's face")
    close(depth(one, box((1, 1, 1), (0, 0, 1.01))), 0.0, 0.0, "apart")
    pointed = turned(turned(one[0], np.pi / 4, (0, 0, 1)), np.arctan(np.sqrt(0.5)), (1, 1, 0))
    pointed = pointed - (0, 0, pointed[:, 2].min() + 0.07), one[1]
    close(depth(pointed, box((9, 9, 1), (0, 0, -0.5))), 0.07, 1e-9, "a corner in a face")
    close(depth(box((0.2, 0.2, 0.2)), box((3, 3, 3)), 0.5), 0.5, 1e-12, "deeper than asked for")
    # two edges that cross, each a right angle: at the crossing either is 0.05 below the other,
    # where the nearest faces are 0.05 sqrt(1/2) away
    roof = turned(one[0], np.pi / 4, (1, 0, 0)), one[1]
    top = roof[0][:, 2].max()
    keel = turned(roof[0], np.pi / 2, (0, 0, 1)) + (0.03, 0.02, 2 * top - 0.05), one[1]
    close(depth(roof, keel), 0.05 * np.sqrt(0.5), 0.02, "an edge across an edge")
    points = np.array([(0.1, 0.2, 0.3), (0.6, 0.0, 0.0)])
    assert list(is_inside(points, one[0][one[1]])) == [True, False]


def write_run(path, centres):
    """A run of one frame: a hull far away and floes of 2 x 1 x 0.5 m at these places, each with
    four spheres that reach its end at x = 1 m; in its checkpoint nothing is crushed."""
    floe, hull = box((2, 1, 0.5)), box((1, 1, 1))
    with h5py.File(path, "w") as file:
        file.attrs["dimension"] = 3
        file["shapes/vertices"] = np.concatenate([hull[0], floe[0]])
        file["shapes/triangles"] = np.concatenate([hull[1], floe[1]])
        file["shapes/vertex_offset"], file["shapes/triangle_offset"] = [0, 8, 16], [0, 12, 24]
        n = len(centres)
        file["frames/frame_time"], file["frames/body_shape"] = [1.5], [1] * n
        file["frames/body"] = list(range(n))
        file["frames/ship_position"] = np.array([[100.0, 0, 0]])
        file["frames/position"] = np.array([centres], dtype=float)
        file["frames/orientation"] = np.tile([1.0, 0, 0, 0], (1, n, 1))
        ends = [(0.95, y, z, 0.05) for y in (-0.2, 0.2) for z in (-0.1, 0.1)]
        file["shapes/spheres"] = np.array([(0, 0, 0, 0.5), *ends])
        file["shapes/sphere_offset"] = [0, 1, 5]


def write_checkpoint(path, body, moves):
    """A checkpoint in which these spheres of one body have moved."""
    first = np.full(body + 1, -1)
    first[body] = 0
    with h5py.File(path, "w") as file:
        for name in ("body", "planes", "corners", "edges", *(f"edge_{end}" for end in
                     ("begin", "end", "left", "right"))):
            file[f"crushed_solids.{name}"] = np.zeros(0, dtype=int)
        file["crushed_solids.corner"] = np.zeros((0, 3))
        file["crushed.first"], file["crushed.recess"] = first, np.array(moves, dtype=float)


def program(folder):
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "run.h5"

    def run(*options):
        return subprocess.run([sys.executable, "-B", HERE / "check_poses.py", path, *options],
                              capture_output=True, text=True)

    write_run(path, [(0, 0, 0), (1.9, 0.2, 0)])
    got = run()
    # 0.1 x 0.8 x 0.5 of 1 m3, which is 0.1 m deep
    assert got.returncode == 1 and got.stderr == "", got
    expected = "floe 1 and floe 2, t = 1.50 s: 0.04 m3, 4.000 % of a floe, 100.0 mm deep"
    assert expected in got.stdout, got
    assert run("--max-share", "0.05").returncode == 0
    assert run("--max-share", "0.05", "--max-depth", "0.09").returncode == 1
    # Floe 1 was crushed by 0.1 m at two of its end's spheres, with notches of 0.3 m radius about
    # y = 0.2, z = +-0.1. The overlap is -0.3 < y < 0.5 and |z| < 0.25 there; strips of z have the
    # lens of both, from -0.1 to 0.5 at the height of either sphere.
    moves = np.zeros((4, 3))
    moves[2:, 0] = -0.1
    write_checkpoint(path.with_name("checkpoint.h5"), 1, moves)
    z = (np.arange(1000) + 0.5) / 4000
    half = np.sqrt(0.3 ** 2 - (z - 0.1) ** 2)
    left = 1.0 - 2.0 * half.mean() / 0.8
    got = run("--at-end", "--max-share", "0.1")
    assert got.returncode == 0, got
    close(share_of(got.stdout), 4.0 * left, 0.04, "the share beside the notches")
    # on the other floe, whose end is far away, they change nothing
    write_checkpoint(path.with_name("checkpoint.h5"), 2, moves)
    close(share_of(run("--at-end").stdout), 4.0, 1e-3, "notches elsewhere")
    write_run(path, [(0, 0, 0), (2.0, 0.2, 0)])
    got = run()
    assert got.returncode == 0 and "0 pairs overlap" in got.stdout, got


def share_of(text):
    """The first pair's, in per cent."""
    return float(text.split(" m3, ")[1].split(" %")[0])


volumes()
left_of_crushed(pathlib.Path(sys.argv[1]))
in_notches(pathlib.Path(sys.argv[1]) / "notches")
turned_together()
depths()
program(pathlib.Path(sys.argv[1]))
