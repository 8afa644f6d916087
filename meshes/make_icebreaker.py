#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes an icebreaker-like hull of 100 m: closed, welded, outward-oriented triangles in OBJ.

    python3 meshes/make_icebreaker.py --triangles 8000 --out meshes/icebreaker-100m.obj
    python3 meshes/make_icebreaker.py --triangles 2000 --out myship.stl
    python3 meshes/make_icebreaker.py --report

An STL file is as a CAD program exports it: millimetres, z = 0 at the keel, no groups.

The form is that of icebreaker_form.py; this script cuts it into triangles. The port half is a row
of frames x = const; a frame runs from the keel over bilge, water line and deck edge to the centre
of the deck. Each piece of a frame gets as many points as its length needs, and neighbouring frames
are stitched piece by piece, so the bow closes in a point without slivers and the limits of the
regions are edges of the mesh. The transom is cut into upright columns and stitched in the same way.
The starboard half is the mirror image.

Coordinates are whole multiples of 10 micrometres before any comparison is made, so that the same
arguments give the same bytes on every machine.
"""
import argparse
import bisect
import math
import os
import sys

import icebreaker_form as form

TRIANGLES = 8000
UNITS_PER_METRE = 100000
COVERED = 12000.0         # m2: the edge length sqrt(COVERED / triangles) gives about that many
DECIMALS = 5

# The pieces of a frame, from the keel on, and how dense their points stand.
PIECES = ["flat", "bilge", "wet", "dry", "deck"]
SPACING = {"flat": 1.0, "bilge": 0.6, "wet": 1.0, "dry": 1.0, "deck": 1.0}
LEAST_POINTS = {"bilge": 3}
VANISHING = 0.3           # a piece shorter than this times the spacing becomes one point

COUNTER_X, SIDE_END_X = 6.0, 52.0
GROUPS = ["bow", "forefoot", "shoulder", "side", "bottom", "bilge", "stern", "propeller", "deck"]


def region(piece, x):
    """Name of the part of the hull that a piece belongs to at this x."""
    if piece in ("deck", "flat"):
        return "deck" if piece == "deck" else "bottom"
    if x < form.RUN_START_X:
        return "propeller" if piece != "dry" and x > COUNTER_X else "stern"
    if piece == "bilge":
        return "bilge" if x < form.FOREFOOT_X else "forefoot"
    if x < SIDE_END_X:
        return "side"
    return "shoulder" if x < form.FOREFOOT_X else "bow"


# --- curves -------------------------------------------------------------------------------------

def even_points(curve, count):
    """count + 1 points of equal spacing along curve(t), t in [0, 1]."""
    fine = [curve(k / (8 * count + 32)) for k in range(8 * count + 33)]
    along = [0.0]
    for a, b in zip(fine, fine[1:]):
        along.append(along[-1] + math.dist(a, b))
    points = [fine[0]]
    for k in range(1, count):
        target = along[-1] * k / count
        right = bisect.bisect_left(along, target)
        part = (target - along[right - 1]) / (along[right] - along[right - 1])
        points.append(curve((right - 1 + part) / (len(fine) - 1)))
    return points + [fine[-1]]


def curve_length(curve):
    points = [curve(k / 64) for k in range(65)]
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def frame_curves(x):
    """The pieces of the frame at x as functions of [0, 1] into the port half."""
    keel = form.keel_z(x)
    flat = form.half_breadth(x, form.KEEL) if keel == form.KEEL else 0.0
    edge = form.half_breadth(x, form.DECK)

    def line(start, end):
        return lambda t: (x, start[0] + (end[0] - start[0]) * t, start[1] + (end[1] - start[1]) * t)

    def section(low, high):
        low, high = max(low, keel), max(high, keel)

        def point(t):  # t squared, because the section may leave the bottom horizontally
            z = low + (high - low) * t * t
            return x, (form.half_breadth(x, z) if z > keel else flat), z
        return point

    return {"flat": line((0.0, keel), (flat, keel)),
            "bilge": section(form.KEEL, form.BILGE_TOP_Z),
            "wet": section(form.BILGE_TOP_Z, 0.0),
            "dry": section(0.0, form.DECK),
            "deck": line((edge, form.DECK), (0.0, form.DECK))}


def frame_positions(edge):
    """x of the frames: evenly along the centre line between the limits of the regions."""
    limits = [0.0, form.run_x(0.0), COUNTER_X, form.run_x(form.BILGE_TOP_Z), form.RUN_START_X,
              SIDE_END_X, form.FOREFOOT_X, form.stem_x(form.BILGE_TOP_Z), form.stem_x(0.0),
              form.LENGTH]
    positions = [0.0]
    for start, end in zip(limits, limits[1:]):
        def profile(t, start=start, end=end):
            x = start + (end - start) * t if t < 1 else end
            return x, form.keel_z(x)
        count = max(1, round(curve_length(profile) / edge))
        positions += [x for x, _ in even_points(profile, count)[1:]]
    return positions


# --- frames of points, on the lattice of 10 micrometres -------------------------------------------

def snap(point):
    return tuple(round(value * UNITS_PER_METRE) for value in point)


def points_of(curves, edge):
    """The pieces as lists of points; neighbouring pieces share their end."""
    frame, last = {}, None
    for piece in PIECES:
        spacing = edge * SPACING[piece]
        length = curve_length(curves[piece])
        if length < VANISHING * spacing:
            points = [snap(curves[piece](0.0))]
        else:
            count = max(LEAST_POINTS.get(piece, 1) if length > spacing else 1,
                        round(length / spacing))
            points = [snap(point) for point in even_points(curves[piece], count)]
        if last is not None:
            points[0] = last
        frame[piece], last = points, points[-1]
    return frame


def transom(frame, edge):
    """Upright columns of the flat transom, from its centre to its corner, where one is a point.

    The frame's points on the deck are moved to the tops of the columns, so that both agree.
    """
    lower = [point for piece in PIECES[:-1] for point in frame[piece][1:]]
    columns = []
    for x, y, z in frame["flat"][:1] + lower:
        top = round(form.DECK * UNITS_PER_METRE)
        count = max(1, round((top - z) / (edge * UNITS_PER_METRE)))
        columns.append([(x, y, z + round((top - z) * k / count)) for k in range(count + 1)])
    columns[-1] = columns[-1][:1]
    frame["deck"] = [column[-1] for column in columns[::-1]]
    return columns


# --- triangles ------------------------------------------------------------------------------------

def stitch(aft, fore):
    """Triangles between two rows of points, outward on the port side: shorter diagonal first."""
    i = j = 0
    triangles = []
    while i + 1 < len(aft) or j + 1 < len(fore):
        aft_next = square(aft[i + 1], fore[j]) if i + 1 < len(aft) else math.inf
        fore_next = square(aft[i], fore[j + 1]) if j + 1 < len(fore) else math.inf
        if aft_next <= fore_next:
            triangles.append((aft[i], aft[i + 1], fore[j]))
            i += 1
        else:
            triangles.append((aft[i], fore[j + 1], fore[j]))
            j += 1
    return [t for t in triangles if len(set(t)) == 3]


def square(a, b):
    return sum((p - q) ** 2 for p, q in zip(a, b))


def make(triangles=TRIANGLES):
    """The hull as a list of (group, (a, b, c)), corners in units of 10 micrometres."""
    edge = math.sqrt(COVERED / triangles)
    mesh = []
    positions = frame_positions(edge)
    frames = [points_of(frame_curves(x), edge) for x in positions]
    columns = transom(frames[0], edge)
    for inner, outer in zip(columns, columns[1:]):
        mesh += [("stern", t) for t in stitch(inner, outer)]
    for k in range(len(frames) - 1):
        for piece in PIECES:
            name = region(piece, (positions[k] + positions[k + 1]) / 2)
            mesh += [(name, t) for t in stitch(frames[k][piece], frames[k + 1][piece])]
    return mesh + [(name, (mirror(a), mirror(c), mirror(b))) for name, (a, b, c) in mesh]


def mirror(point):
    return point[0], -point[1], point[2]


def obj_text(name, mesh):
    """The mesh as OBJ: equal points are one vertex, triangles are listed group by group."""
    points = sorted({point for _, triangle in mesh for point in triangle})
    index = {point: str(k + 1) for k, point in enumerate(points)}
    lines = [f"# {name}, written by meshes/make_icebreaker.py; metres, x forward, y to port, z up"]
    lines += ["v " + " ".join(decimal(value) for value in point) for point in points]
    for group in GROUPS:
        lines.append(f"g {group}")
        lines += ["f " + " ".join(index[p] for p in t) for g, t in mesh if g == group]
    return "\n".join(lines) + "\n"


def stl_text(name, mesh):
    """The mesh as ASCII STL in millimetres, lowest point at z = 0. Readers ignore the normals."""
    keel = min(point[2] for _, triangle in mesh for point in triangle)
    per_millimetre = UNITS_PER_METRE / 1000
    lines = [f"solid {name}"]
    for _, triangle in mesh:
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += [f"  vertex {x / per_millimetre:.2f} {y / per_millimetre:.2f} "
                  f"{(z - keel) / per_millimetre:.2f}" for x, y, z in triangle]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, f"endsolid {name}"]) + "\n"


def decimal(units):
    whole, rest = divmod(abs(units), UNITS_PER_METRE)
    text = f"{whole}.{rest:0{DECIMALS}d}".rstrip("0")
    return ("-" if units < 0 else "") + text + ("0" if text.endswith(".") else "")


# --- principal dimensions -------------------------------------------------------------------------

def report():
    """Dimensions, coefficients and angles of the form itself, without a mesh."""
    waterline = form.stem_x(0.0) - form.run_x(0.0)
    volume = form.volume_below(0.0)
    area = form.waterline_area(0.0)
    breadth = 2 * form.HALF_BREADTH
    flare = math.degrees(math.atan(form.TAN_ENTRANCE / form.TAN_STEM))
    rows = [("length over all", f"{form.LENGTH:.2f} m"),
            ("length of the water line", f"{waterline:.2f} m"),
            ("breadth on the water line", f"{breadth:.2f} m"),
            ("breadth of the deck", f"{2 * form.midship(form.DECK):.2f} m"),
            ("draught, depth", f"{form.DRAUGHT:.2f}, {form.DEPTH:.2f} m"),
            ("displaced volume", f"{volume:.1f} m3"),
            ("volume up to the deck", f"{form.volume_below(form.DECK):.1f} m3"),
            ("water plane area", f"{area:.1f} m2"),
            ("block coefficient", f"{volume / (waterline * breadth * form.DRAUGHT):.3f}"),
            ("water plane coefficient", f"{area / (waterline * breadth):.3f}"),
            ("stem angle from the horizontal", f"{form.STEM_DEG:.1f} deg"),
            ("half entrance angle", f"{form.ENTRANCE_DEG:.1f} deg"),
            ("flare at the stem, from the vertical", f"{flare:.1f} deg"),
            ("side, from the vertical", f"{form.SIDE_DEG:.1f} deg"),
            ("bilge radius", f"{form.BILGE_RADIUS:.1f} m"),
            ("buttocks aft, from the horizontal", f"{form.RUN_DEG:.1f} deg")]
    return "\n".join(f"{name:38}{value}" for name, value in rows) + "\n"


def main():
    parser = argparse.ArgumentParser(description="Writes the hull of a 100 m icebreaker.")
    parser.add_argument("--triangles", type=int, default=TRIANGLES,
                        help="about so many, from 500 (default: %(default)s)")
    parser.add_argument("--out", metavar="FILE", help="OBJ or STL file to write (default: the "
                        "script's own folder, icebreaker-100m.obj)")
    parser.add_argument("--report", action="store_true", help="print the dimensions, write nothing")
    arguments = parser.parse_args()
    if arguments.report:
        sys.stdout.write(report())
        return
    if arguments.triangles < 500:
        parser.error("--triangles must be 500 or more: fewer do not show the form")
    out = arguments.out or os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                        "icebreaker-100m.obj")
    name, suffix = os.path.splitext(os.path.basename(out))
    text_of = stl_text if suffix.lower() == ".stl" else obj_text
    text = text_of(name, make(arguments.triangles))
    with open(out, "w", encoding="ascii", newline="\n") as file:
        file.write(text)


if __name__ == "__main__":
    main()
