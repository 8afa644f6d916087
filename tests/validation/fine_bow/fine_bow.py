#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hull with a sharp stem in broken ice, against the radius of the hull's spheres.

    fine_bow.py BIN_DIR WORK_DIR [--seeds N] [--radius R]... [--jobs N]

No sphere fits into a sharp stem: it is cut back by R (1 / sin a - 1), a being half the angle of the
stem. A Wigley hull (B / L = 0.1) goes through ice of 70 % and L / 200 with spheres of L / 250 to
L / 1000. Runs that are already in WORK_DIR are not repeated. Prints a markdown table; exit code 1
where a floe lies deeper in another body than a tenth of its thickness, or where the mean of a
radius is outside the interval of another one.
"""
import argparse
import concurrent.futures
import itertools
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
LENGTH, BREADTH, DRAUGHT, FREEBOARD = 100.0, 10.0, 6.25, 1.875  # [m]
THICKNESS = 0.5                                                 # of the ice, as in floes.toml [m]
COLUMNS, ROWS = 80, 16  # of the mesh; the formula's error is below 1 cm


def half_breadth(x, z):
    """Wigley's parabolas below the water, the waterline's above it."""
    return 0.5 * BREADTH * (1 - (2 * x / LENGTH) ** 2) * (1 - (min(z, 0.0) / DRAUGHT) ** 2)


def write_hull(path):
    """Both sides and the deck, as an OBJ file; the sides meet at stem, stern and keel."""
    xs = [LENGTH * (i / COLUMNS - 0.5) for i in range(COLUMNS + 1)]
    zs = [-DRAUGHT + (DRAUGHT + FREEBOARD) * k / ROWS for k in range(ROWS + 1)]
    numbers, faces = {}, []

    def vertex(i, k, side):
        y = side * half_breadth(xs[i], zs[k])
        return numbers.setdefault((xs[i], 0.0 if abs(y) < 1e-12 else y, zs[k]), len(numbers) + 1)

    def quad(corners):
        for face in ((corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])):
            if len(set(face)) == 3:
                faces.append(face)

    for i, k in itertools.product(range(COLUMNS), range(ROWS)):
        for side in (1, -1):
            ring = [vertex(i, k, side), vertex(i, k + 1, side), vertex(i + 1, k + 1, side),
                    vertex(i + 1, k, side)]
            quad(ring if side > 0 else ring[::-1])
    for i in range(COLUMNS):
        quad([vertex(i, ROWS, 1), vertex(i, ROWS, -1),
              vertex(i + 1, ROWS, -1), vertex(i + 1, ROWS, 1)])
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in numbers)
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in faces)


def prepare(options, radius):
    """The folder with case, field and the hull's spheres of one radius."""
    folder = options.work / f"radius-{radius}"
    folder.mkdir(parents=True, exist_ok=True)
    write_hull(folder / "hull.obj")
    shutil.copy(HERE / "case.cfg", folder)
    if not (options.work / "field.h5").exists():
        subprocess.run([options.bin / "icefield", HERE / "floes.toml", "-q", "-o",
                        options.work / "field.h5"], check=True)
    shutil.copy(options.work / "field.h5", folder)
    subprocess.run([options.bin / "spherize", folder / "hull.obj", "-q", "-r", str(radius), "-s",
                    "0.4", "--mode", "surface", "-o", folder / "hull.spheres.h5"], check=True)
    return folder


def is_complete(summary):
    """Is it there, of a run that went to its end?"""
    return (summary.exists() and
            json.loads(summary.read_text(encoding="utf-8"))["status"] == "completed")


def run(options, radius, seed):
    folder = options.work / f"radius-{radius}"
    out = folder / f"seed-{seed}"
    if not is_complete(out / "summary.json"):
        subprocess.run([options.bin / "icesolve", folder / "case.cfg", "--out", out, "--set",
                        f"simulation.seed={seed}", "--threads", "1", "-q", "--no-report",
                        "--overwrite"], check=True)
    return json.loads((out / "summary.json").read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--radius", type=float, action="append",
                        help="[m]; default 0.4, 0.2 and 0.1")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.bin, options.work = options.bin.resolve(), options.work.resolve()
    radii = options.radius or [LENGTH / 250, LENGTH / 500, LENGTH / 1000]
    for radius in radii:
        prepare(options, radius)
    jobs = [(radius, seed + 1) for radius in radii for seed in range(options.seeds)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = list(pool.map(lambda job: run(options, *job), jobs))

    print("| radius [m] | seed | resistance [kN] | 95 % interval | deepest overlap [mm] "
          "| unseen [mm] | time of the contact search [s] |\n|---|---|---|---|---|---|---|")
    for (radius, seed), s in zip(jobs, runs):
        r, c = s["resistance"], s["contacts"]
        print(f"| {radius:g} | {seed} | {r['mean_N'] / 1e3:.0f} | {r['ci95_N'] / 1e3:.0f} "
              f"| {1e3 * c['max_overlap_m']:.0f} | {1e3 * c['unseen_overlap_m']:.0f} "
              f"| {s['stage_seconds']['narrow']:.1f} |")
    deep = any(s["contacts"][key] > 0.1 * THICKNESS
               for s in runs for key in ("max_overlap_m", "unseen_overlap_m"))
    parted = any(abs(a["mean_N"] - b["mean_N"]) > a["ci95_N"] + b["ci95_N"]
                 for a, b in itertools.combinations([s["resistance"] for s in runs], 2))
    return 1 if deep or parted else 0


if __name__ == "__main__":
    sys.exit(main())
