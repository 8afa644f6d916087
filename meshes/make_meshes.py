#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the meshes of the paper's cases: closed, welded, outward-oriented triangles in OBJ.

    python3 meshes/make_meshes.py --out meshes

Axes of a hull: x forward from the transom, y to port, z up from the calm water line; metres.
A floe is centred at the origin. The same arguments give the same bytes.

A solid is a loft: profiles in planes of constant y, all with the same corners in the same order.
Seen from port the corners run counterclockwise, i.e. from the deck tip down the bow, aft along the
bottom and back over the deck. Each edge of the profile is one face and carries one group name.
"""
import argparse
import math
import os

DECIMALS = 12  # 1e-12 m: far below any use, far above the rounding of tan() between machines

HULL_EDGES = ["bow", "bottom", "propeller", "stern", "stern", "deck"]
GROUP_ORDER = ["bow", "bottom", "side", "stern", "propeller", "deck", "ice"]


# --- shapes ------------------------------------------------------------------------------------

def hull_2d(length=10.0, depth=1.5, draught=1.2, stem_deg=35.0, breadth=1.0,
            bottom_end=2.4, slope_end=(1.2, -0.2), counter_end=-0.1):
    """Prism of the profile over y in [-breadth/2, breadth/2].

    stem_deg: angle of the bow from the horizontal. bottom_end: x where the flat bottom ends aft.
    slope_end: (x, z) where the propeller slope meets the counter. counter_end: z at the transom.
    """
    profile = hull_profile(length, depth, draught, stem_deg, bottom_end, slope_end, counter_end)
    half = breadth / 2
    return loft([at_y(profile, -half), at_y(profile, half)], HULL_EDGES, caps=("side", "side"))


def hull_3d(length=10.0, breadth=2.0, depth=1.8, draught=1.44, stem_deg=35.0, entrance_deg=70.0,
            bottom_end=2.4, slope_end=(1.2, -0.5), counter_end=-0.3):
    """Wedge bow, vertical parallel sides, the 2D profile in the centre plane.

    entrance_deg: half angle of every waterline at the stem. Each bow side is one plane, which meets
    the vertical side at the shoulder, breadth / (2 tan entrance) aft of the stem at every height.
    The port half is mirrored, so vertices, triangles and diagonals are symmetric about y = 0.
    """
    centre = hull_profile(length, depth, draught, stem_deg, bottom_end, slope_end, counter_end)
    half = breadth / 2
    shoulder = half / math.tan(math.radians(entrance_deg))
    side = [(x - shoulder, z) if corner < 2 else (x, z) for corner, (x, z) in enumerate(centre)]
    return mirrored(loft([at_y(centre, 0.0), at_y(side, half)], HULL_EDGES, caps=(None, "side")))


def floe(length, breadth, thickness):
    """A box centred at the origin."""
    x, z = length / 2, thickness / 2
    profile = [(x, z), (x, -z), (-x, -z), (-x, z)]
    half = breadth / 2
    return loft([at_y(profile, -half), at_y(profile, half)], ["ice"] * 4, caps=("ice", "ice"))


def hull_profile(length, depth, draught, stem_deg, bottom_end, slope_end, counter_end):
    """Corners (x, z) from the deck tip over bow, bottom, propeller slope, counter to transom."""
    deck, keel = depth - draught, -draught
    stem_foot = length - depth / math.tan(math.radians(stem_deg))
    return [(length, deck), (stem_foot, keel), (bottom_end, keel), slope_end,
            (0.0, counter_end), (0.0, deck)]


MESHES = {
    "paper-hull-2d": hull_2d,
    "paper-hull-3d": hull_3d,
    "hull-stem-25": lambda: hull_3d(stem_deg=25.0),  # the paper's hull with two other bows
    "hull-stem-50": lambda: hull_3d(stem_deg=50.0),
    "paper-floe-2d": lambda: floe(1.0, 1.0, 0.4),
    "paper-floe-3d": lambda: floe(1.0, 0.8, 0.3),
}


# --- from profiles to triangles ----------------------------------------------------------------
# A mesh is a list of (group, (a, b, c)), the corners as points (x, y, z), counterclockwise from
# outside.

def at_y(profile, y):
    return [(x, y, z) for x, z in profile]


def loft(sections, edge_groups, caps):
    """Walls between two profiles (starboard one first) and a cap on each that has a group."""
    starboard, port = sections
    mesh = []
    for k, group in enumerate(edge_groups):
        n = (k + 1) % len(port)
        mesh += face(group, [port[n], port[k], starboard[k], starboard[n]])
    if caps[0]:
        mesh += face(caps[0], starboard[::-1])
    if caps[1]:
        mesh += face(caps[1], port)
    return mesh


def face(group, corners):
    return [(group, triangle) for triangle in triangulate([rounded(c) for c in corners])]


def mirrored(half):
    """The half in y >= 0 and its image; a mirrored triangle turns round to stay outward."""
    def image(point):
        return rounded((point[0], -point[1], point[2]))
    return half + [(group, (image(a), image(c), image(b))) for group, (a, b, c) in half]


def rounded(point):
    return tuple(round(value, DECIMALS) + 0.0 for value in point)  # + 0.0 turns -0 into 0


def triangulate(corners):
    """Cuts a plane polygon, convex or not, into triangles: always the best-shaped ear first."""
    normal = area_vector(corners)
    corners, triangles = list(corners), []
    while len(corners) > 3:
        best = max(range(len(corners)), key=lambda k: (ear_quality(corners, k, normal), -k))
        triangles.append((corners[best - 1], corners[best], corners[(best + 1) % len(corners)]))
        del corners[best]
    return triangles + [tuple(corners)]


def ear_quality(corners, k, normal):
    """Sine of the smallest angle of the ear at corner k, -1 where it is not inside the polygon."""
    ear = (corners[k - 1], corners[k], corners[(k + 1) % len(corners)])
    if dot(area_vector(ear), normal) <= 0:
        return -1.0
    for point in corners:
        inside = all(dot(area_vector((ear[i - 1], ear[i], point)), normal) >= 0 for i in range(3))
        if point not in ear and inside:
            return -1.0
    sides = [math.dist(ear[i - 1], ear[i]) for i in range(3)]
    double_area = math.sqrt(dot(area_vector(ear), area_vector(ear)))
    # rounded, so that equal shapes compare equal on every machine and the first one wins
    return round(double_area / (max(sides) * sorted(sides)[1]), 9)


def area_vector(corners):
    """Twice the area of a plane polygon, along its normal."""
    total = (0.0, 0.0, 0.0)
    for i in range(1, len(corners) - 1):
        a = [p - q for p, q in zip(corners[i], corners[0])]
        b = [p - q for p, q in zip(corners[i + 1], corners[0])]
        cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        total = tuple(t + c for t, c in zip(total, cross))
    return total


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


# --- OBJ ---------------------------------------------------------------------------------------

def obj_text(name, mesh):
    """The mesh as OBJ: equal points become one vertex, triangles are listed group by group."""
    points = sorted({point for _, triangle in mesh for point in triangle})
    index = {point: k + 1 for k, point in enumerate(points)}
    lines = [f"# {name}, written by meshes/make_meshes.py; metres, x forward, y to port, z up"]
    lines += ["v " + " ".join(decimal(value) for value in point) for point in points]
    for group in GROUP_ORDER:
        triangles = [triangle for g, triangle in mesh if g == group]
        if triangles:
            lines.append(f"g {group}")
            lines += ["f " + " ".join(str(index[point]) for point in t) for t in triangles]
    return "\n".join(lines) + "\n"


def decimal(value):
    text = f"{value:.{DECIMALS}f}".rstrip("0")
    return text + "0" if text.endswith(".") else text


def main():
    parser = argparse.ArgumentParser(description="Writes the meshes of the paper's cases.")
    parser.add_argument("--out", default=os.path.dirname(os.path.abspath(__file__)),
                        help="folder to write to (default: the script's own)")
    out = parser.parse_args().out
    os.makedirs(out, exist_ok=True)
    for name, make in MESHES.items():
        with open(os.path.join(out, name + ".obj"), "w", encoding="ascii", newline="\n") as file:
            file.write(obj_text(name, make()))


if __name__ == "__main__":
    main()
