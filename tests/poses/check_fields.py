#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a ship through fields of every icefield pattern and checks the poses of all frames.

    check_fields.py PROGRAMS MESHES WORK [--seeds N] [--patterns P,...] [--seconds T]

PROGRAMS is the folder of spherize, icefield and icesolve, MESHES that of paper-hull-3d.obj, WORK
where the runs go. The paper's ship goes at 1 m/s into some 20 floes of 0.3 m thick ice that crushes
at 1 MPa. The run stops at each second, and the poses are checked. Exit code 1 when two bodies share
more than --max-share of a floe's volume, without crushed ice (left_solids.py, crushed_notches.py),
or contacts did not know of an overlap (contacts.unseen_overlap_m, more than half a sphere radius).
Depths take notches as whole ice, so that they are upper bounds.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys

import check_poses
from crushed_notches import take_crushed
from run_poses import Run

RADIUS = 0.05  # of the ice's spheres [m]
ICE = f'[ice]\nthickness = 0.3\n[spheres]\nradius = {RADIUS}\nspacing = 0.12\n'
EDGES = "[edges]\nbreadth = 1\npiece = 2\noverhang = [4, 4]\nahead = 1\n"
AREA = "[area]\nsize = [5, 4]\n"
CASE = """[simulation]
dimension = 3
duration = 1
time_step = 0.01
[hull]
spheres = "../hull.spheres.h5"
position = [-9.7, 0, 0]
speed = 1.0
[[floes]]
pattern = "file"
file = "field.h5"
hold = "{hold}"
[contact]
crushing_pressure = "1 MPa"
[output]
frames_every = 0.25
average_from = 0
"""


def rows(dice):
    """Size, count and gaps of a grid's floes."""
    x, y = dice.uniform(0.7, 1.3), dice.uniform(0.7, 1.3)
    return (f"[floes]\nsize = [{x:.3f}, {y:.3f}]\ncount = [{int(5 / x)}, {int(4 / y)}]\n"
            f"gap = [{dice.uniform(0.01, 0.1):.3f}, {dice.uniform(0.01, 0.1):.3f}]\n")


def polygons(dice, folder):
    """Floes of three to eight corners, convex or not, each within its square of a metre."""
    lines = ["floe,x,y"]
    for floe in range(20):
        count = dice.randint(3, 8)
        for k in range(count):
            angle = 2 * math.pi * (k + dice.uniform(0.0, 0.6)) / count
            far = dice.uniform(0.33, 0.47)
            lines.append(f"{floe},{floe // 4 + 0.5 + far * math.cos(angle):.4f},"
                         f"{floe % 4 - 1.5 + far * math.sin(angle):.4f}")
    (folder / "polygons.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return f'[floes]\nfile = "{folder / "polygons.csv"}"\n'


PATTERNS = {
    "grid": lambda dice, folder: ICE + rows(dice) + EDGES,
    "brick": lambda dice, folder: ICE + rows(dice) + EDGES,
    "cusps": lambda dice, folder: ICE + AREA + "[floes]\nbreaking_length = 0.9\n"
                                  "breaking_width = 1.4\ngap = [0.02, 0.02]\n" + EDGES,
    "voronoi": lambda dice, folder: ICE.replace("0.3", "0.3\nchamfer = 0.03") + AREA
                                    + "[floes]\nconcentration = 0.8\nmean_size = 1\n" + EDGES,
    "power-law": lambda dice, folder: ICE + AREA + "[floes]\nconcentration = 0.75\nsmallest = 0.6\n"
                                      "largest = 2\nexponent = 1.8\n" + EDGES,
    "polygons": lambda dice, folder: ICE + polygons(dice, folder),
}


def call(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(word) for word in command)}: exit code {done.returncode}\n"
                 f"{done.stderr}")


def make_field(options, pattern, seed):
    """Prepares a run and returns its folder."""
    folder = options.work / f"{pattern}-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    text = (f'pattern = "{pattern}"\nseed = {seed}\n'
            + PATTERNS[pattern](random.Random(seed), folder))
    (folder / "field.toml").write_text(text, encoding="utf-8")
    case = CASE.format(hold="until-hull-contact" if pattern == "cusps" else "never")
    (folder / "case.cfg").write_text(case, encoding="utf-8")
    call(options.programs / "icefield", folder / "field.toml", "-o", folder / "field.h5", "-q")
    return folder


def run_second(options, folder, second):
    """Runs one more second. Returns rows as check_poses.check()."""
    run = folder / "run"
    until = ["--set", f"simulation.duration={second}", "-q"]
    if second == 1:
        call(options.programs / "icesolve", folder / "case.cfg", "--out", run, "--overwrite",
             "--checkpoint-every", "1", *until)
    else:
        call(options.programs / "icesolve", folder / "case.cfg", "--restart",
             run / "checkpoint.h5", "--checkpoint-every", "1", *until)
    poses = Run(run)
    take_crushed(poses, run)
    return check_poses.check(poses, 1, first=len(poses.time) - 1)


def judge(options, folder):
    """What the poses and the run itself say of its overlaps."""
    found = [row for second in range(1, options.seconds + 1)
             for row in run_second(options, folder, second)]
    summary = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
    contacts = summary["contacts"]

    def most(key, of_hull):
        return max((row[key] for row in found if (row["a"] == 0) == of_hull), default=0.0)

    return {"worst": max(found, key=lambda row: row["share"], default=None),
            "share": most("share", False), "hull_share": most("share", True),
            "floes": most("depth_m", False), "hull": most("depth_m", True),
            "unseen": contacts["unseen_overlap_m"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=10, help="fields of each pattern (default 10)")
    parser.add_argument("--patterns", default=",".join(PATTERNS), help="default: all of them")
    parser.add_argument("--seconds", type=int, default=4, help="of each run (default 4)")
    parser.add_argument("--max-share", type=float, default=0.005,
                        help="of the smaller floe's volume (default 0.005)")
    options = parser.parse_args()
    options.work = options.work.resolve()
    options.work.mkdir(parents=True, exist_ok=True)
    call(options.programs / "spherize", options.meshes / "paper-hull-3d.obj", "-r", "0.1", "--mode",
         "surface", "-o", options.work / "hull.spheres.h5", "-q")
    print("| pattern | fields | worst share of a floe | with the hull | deepest: floes | hull "
          "| unseen |\n|---|---|---|---|---|---|---|")
    faults = []
    for pattern in options.patterns.split(","):
        of_pattern = []
        for seed in range(1, options.seeds + 1):
            got = judge(options, make_field(options, pattern, seed))
            of_pattern.append(got)
            name = f"{pattern}, seed {seed}"
            row = got["worst"]
            if row and row["share"] > options.max_share:
                faults.append(f"{name}: bodies {row['a']} and {row['b']} share "
                              f"{100 * row['share']:.2f} % of a floe at t = {row['time_s']:.2f} s")
            if got["unseen"] > 0.5 * RADIUS:
                faults.append(f"{name}: {1e3 * got['unseen']:.1f} mm of an overlap unseen")
        worst = {key: max(got[key] for got in of_pattern)
                 for key in ("share", "hull_share", "floes", "hull", "unseen")}
        print(f"| {pattern} | {options.seeds} | {100 * worst['share']:.2f} % | "
              f"{100 * worst['hull_share']:.2f} % | "
              f"{1e3 * worst['floes']:.1f} mm | {1e3 * worst['hull']:.1f} | "
              f"{1e3 * worst['unseen']:.1f} |", flush=True)
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
