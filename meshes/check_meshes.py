#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the committed meshes and prints their figures; exit code 1 when a check fails.

    python3 meshes/check_meshes.py

Each OBJ file must equal what its script writes, be closed and outward (each edge is used twice,
in opposite directions, around a positive volume), have no flat triangle and no vertex twice, and
have the volume of its closed form. The volume is per metre in 2D: those meshes are 1 m broad. The
icebreaker's faces are chords of a curved form: its volumes are a little less than the form's, and
its angles are measured from its edges.
"""
import argparse
import math
import os
import sys
from collections import Counter

import icebreaker_form as form
import make_icebreaker
import make_meshes

VOLUME_TOLERANCE = 1e-9   # relative; the files carry 1e-12 m
CHORD_TOLERANCE = 3e-3    # relative; what 8000 chord triangles may lack of a curved form
ANGLE_TOLERANCE_DEG = 0.1
LONGEST_ASPECT = 12.0     # longest edge / height over it
ICEBREAKER = "icebreaker-100m"
SYMMETRIC = {"paper-hull-3d", "hull-stem-25", "hull-stem-50", ICEBREAKER}


def hull_profile_area(length, depth, stem_deg, bottom_end, heights):
    """Area under the deck: trapezoids of the stations x = 0, 1.2, bottom_end, stem foot and tip."""
    stem_foot = length - depth / math.tan(math.radians(stem_deg))
    stations = [0.0, 1.2, bottom_end, stem_foot, length]
    return sum((stations[k + 1] - stations[k]) * (heights[k] + heights[k + 1]) / 2
               for k in range(len(stations) - 1))


def closed_forms():
    """Volumes from the dimensions alone, without the meshes."""
    profile_2d = hull_profile_area(10.0, 1.5, 35.0, 2.4, [0.4, 0.5, 1.5, 1.5, 0.0])
    profile_3d = {stem: hull_profile_area(10.0, 1.8, stem, 2.4, [0.66, 0.86, 1.8, 1.8, 0.0])
                  for stem in (25.0, 35.0, 50.0)}
    # the wedge takes from the full breadth two triangles of 1 by 1 / tan 70 deg at every height
    wedge = 1.8 * 1.0 / math.tan(math.radians(70.0))
    return {
        ICEBREAKER: form.volume_below(form.DECK),
        "paper-hull-2d": profile_2d,
        "paper-hull-3d": 2.0 * profile_3d[35.0] - wedge,
        "hull-stem-25": 2.0 * profile_3d[25.0] - wedge,
        "hull-stem-50": 2.0 * profile_3d[50.0] - wedge,
        "paper-floe-2d": 1.0 * 1.0 * 0.4,
        "paper-floe-3d": 1.0 * 0.8 * 0.3,
    }


def read_obj(text):
    """Vertices, triangles as vertex indices from 0, and the group of each triangle."""
    vertices, triangles, groups, group = [], [], [], ""
    for line in text.splitlines():
        word, _, rest = line.partition(" ")
        if word == "v":
            vertices.append(tuple(float(value) for value in rest.split()))
        elif word == "g":
            group = rest
        elif word == "f":
            triangles.append(tuple(int(value) - 1 for value in rest.split()))
            groups.append(group)
    return vertices, triangles, groups


def volume(vertices, triangles):
    """Signed volume [m3], positive when the triangles face outward."""
    total = 0.0
    for triangle in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[k] for k in triangle)
        total += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) +
                  az * (bx * cy - by * cx)) / 6
    return total


def area(vertices, triangle):
    return math.hypot(*make_meshes.area_vector([vertices[k] for k in triangle])) / 2


def faults(name, text, expected_volume):
    """What is wrong with a mesh file, one sentence each."""
    found = []
    made = make_meshes.MESHES.get(name)
    if made and text != make_meshes.obj_text(name, made()):
        found.append("differs from what make_meshes.py writes; run it and commit the result")
    if name == ICEBREAKER and text != make_icebreaker.obj_text(name, make_icebreaker.make()):
        found.append("differs from what make_icebreaker.py writes; run it and commit the result")
    vertices, triangles, groups = read_obj(text)

    # closed and consistently oriented: each directed edge once, and its reverse once
    edges = Counter((t[k - 1], t[k]) for t in triangles for k in range(3))
    if any(count != 1 or edges[(b, a)] != 1 for (a, b), count in list(edges.items())):
        found.append("is not closed: an edge is not used twice in opposite directions")
    if len(set(vertices)) != len(vertices):
        found.append("is not welded: a vertex stands twice")
    if set(range(len(vertices))) != {k for t in triangles for k in t}:
        found.append("has a vertex that no triangle uses")
    if any(area(vertices, t) <= 1e-9 for t in triangles):
        found.append("has a triangle without area")
    if "" in groups:
        found.append("has a triangle outside the named groups")

    got = volume(vertices, triangles)
    tolerance = CHORD_TOLERANCE if name == ICEBREAKER else VOLUME_TOLERANCE
    if not abs(got - expected_volume) <= tolerance * expected_volume:
        found.append(f"has volume {got!r} m3, closed form {expected_volume!r} m3")
    if name in SYMMETRIC and not symmetric(vertices, triangles, groups):
        found.append("is not mirror symmetric about y = 0")
    if name == ICEBREAKER:
        found += icebreaker_faults(vertices, triangles, groups)
    return found


def icebreaker_faults(vertices, triangles, groups):
    """What does not agree with the form's dimensions, angles and hydrostatics."""
    found = []
    if sorted(set(groups)) != sorted(make_icebreaker.GROUPS):
        found.append("lacks a region or has one too many: " + " ".join(sorted(set(groups))))
    worst = max(aspect(vertices, t) for t in triangles)
    if worst > LONGEST_ASPECT:
        found.append(f"has a triangle of aspect {worst:.1f}")

    expected = {"length": form.LENGTH, "breadth": 2 * form.midship(form.DECK), "depth": form.DEPTH,
                "stem_deg": form.STEM_DEG, "entrance_deg": form.ENTRANCE_DEG,
                "displaced_volume": form.volume_below(0.0),
                "water_plane": form.waterline_area(0.0)}
    measured = icebreaker_figures(vertices, triangles)
    for key, value in expected.items():
        chord = key in ("displaced_volume", "water_plane")
        tolerance = ANGLE_TOLERANCE_DEG if key.endswith("_deg") else value * CHORD_TOLERANCE \
            if chord else 2e-5  # two units of the file
        if not abs(measured[key] - value) <= tolerance:
            found.append(f"has {key} {measured[key]:.5f}, the form {value:.5f}")
    return found


def icebreaker_figures(vertices, triangles):
    """Dimensions, angles and hydrostatics, from the mesh alone."""
    spans = [max(axis) - min(axis) for axis in zip(*vertices)]
    wet = [[vertices[k] for k in t] for t in triangles
           if max(vertices[k][2] for k in t) <= 0.0]  # the water line runs along edges
    down = [make_meshes.area_vector(corners)[2] / 2 for corners in wet]
    volume_wet = sum(a * sum(p[2] for p in corners) / 3 for a, corners in zip(down, wet))

    # the straight part of the stem, from the forefoot to the bend above the water
    stem = sorted(p for p in vertices if p[1] == 0.0 and p[0] > form.FOREFOOT_X
                  and form.BILGE_TOP_Z <= p[2] <= form.STEM_BEND_Z)
    low, high = stem[0], stem[-1]
    stem_deg = math.degrees(math.atan2(high[2] - low[2], high[0] - low[0]))

    # slopes of the water line's first two chords, extrapolated from their middles to the stem
    tip, second, third = sorted((p for p in vertices if p[2] == 0.0 and p[1] >= 0.0),
                                reverse=True)[:3]
    first_slope = (second[1] - tip[1]) / (tip[0] - second[0])
    next_slope = (third[1] - second[1]) / (second[0] - third[0])
    change = (next_slope - first_slope) / ((tip[0] - third[0]) / 2)
    entrance = math.atan(first_slope - change * (tip[0] - second[0]) / 2)
    return {"length": spans[0], "breadth": spans[1], "depth": spans[2], "stem_deg": stem_deg,
            "entrance_deg": math.degrees(entrance), "displaced_volume": volume_wet,
            "water_plane": -sum(down)}


def aspect(vertices, triangle):
    """Longest edge / height over it; 1.15 for an equilateral triangle."""
    corners = [vertices[k] for k in triangle]
    longest = max(math.dist(corners[k - 1], corners[k]) for k in range(3))
    return longest * longest / (2 * max(area(vertices, triangle), 1e-30))


def symmetric(vertices, triangles, groups):
    def key(points, group):
        first = points.index(min(points))
        return group, points[first:] + points[:first]  # keeps the orientation
    solid, image = set(), set()
    for triangle, group in zip(triangles, groups):
        points = [vertices[k] for k in triangle]
        solid.add(key(tuple(points), group))
        image.add(key(tuple((x, 0.0 - y, z) for x, y, z in points[::-1]), group))
    return solid == image


def main():
    parser = argparse.ArgumentParser(description="Checks the meshes and prints their figures.")
    parser.add_argument("--in", dest="folder", default=os.path.dirname(os.path.abspath(__file__)),
                        help="folder of the OBJ files (default: the script's own)")
    folder = parser.parse_args().folder
    failed = False
    print("mesh             vertices  triangles  volume_m3   area_m2     groups")
    for name, expected_volume in closed_forms().items():
        try:
            with open(os.path.join(folder, name + ".obj"), encoding="ascii", newline="") as file:
                text = file.read()
            found = faults(name, text, expected_volume)
        except (OSError, ValueError, IndexError) as error:
            found = [f"cannot be read: {error}"]
        for fault in found:
            print(f"{name}.obj {fault}", file=sys.stderr)
        failed = failed or bool(found)
        if not found:
            vertices, triangles, groups = read_obj(text)
            total = sum(area(vertices, t) for t in triangles)
            print(f"{name:16} {len(vertices):8}  {len(triangles):9}  "
                  f"{volume(vertices, triangles):<10.6f}  {total:<10.6f}  "
                  + " ".join(dict.fromkeys(groups)))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
