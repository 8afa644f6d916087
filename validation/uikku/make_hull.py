#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a stand-in for MT Uikku's hull.

    python3 validation/uikku/make_hull.py [--stem DEG] [--entrance DEG] --out FILE.obj

The ship's lines are not public. This hull has her length, breadth and draught on the water line and
a bow of two planes with the two angles that the resistance formulas know: the stem from the
horizontal and the half entrance angle, the same at every height.
"""
import argparse
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "meshes"))
import make_meshes

LENGTH, BREADTH, DRAUGHT = 150.0, 21.3, 9.55  # of the water line [m]
FREEBOARD = 3.0                               # the ice does not reach it
STEM_DEG, ENTRANCE_DEG = 30.0, 21.0


def hull(stem_deg=STEM_DEG, entrance_deg=ENTRANCE_DEG):
    over_all = LENGTH + FREEBOARD / math.tan(math.radians(stem_deg))
    return make_meshes.hull_3d(over_all, BREADTH, DRAUGHT + FREEBOARD, DRAUGHT, stem_deg,
                               entrance_deg, bottom_end=36.0, slope_end=(12.0, -4.0),
                               counter_end=-1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--stem", type=float, default=STEM_DEG, help="from the horizontal [deg]")
    parser.add_argument("--entrance", type=float, default=ENTRANCE_DEG, help="half angle [deg]")
    parser.add_argument("--out", required=True, help="the OBJ file")
    arguments = parser.parse_args()
    with open(arguments.out, "w", encoding="ascii", newline="\n") as file:
        file.write(make_meshes.obj_text("uikku-stand-in", hull(arguments.stem, arguments.entrance)))


if __name__ == "__main__":
    main()
