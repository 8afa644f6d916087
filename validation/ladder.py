#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the resistance that need no measured table: python3 validation/ladder.py

Each row of validation/ladder.csv is a law that the resistance has to follow, with what is expected,
what the programs give and why. The case is cases/paper-3d-defaults: the paper's ship and pieces.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path.insert(0, str(ROOT / "meshes"))
import compare
import make_meshes

CASE = ROOT / "cases" / "paper-3d-defaults" / "case.cfg"
MESHES = ROOT / "meshes"
TRAVEL = 24.0                         # [m], averaged over the second half, as in the demo
BREADTH, DRAUGHT, THICKNESS = 2.0, 1.44, 0.3
# whole layers of the lattice of spheres of 0.1 m: between them a face has none
THICKNESSES = 0.2, 0.4
FROUDE = 10.0                         # of lengths
COLUMNS = ["check", "expected", "got", "within", "why"]


class Ladder:
    def __init__(self, out, programs, jobs, travel):
        self.out, self.programs, self.runs = pathlib.Path(out), programs, {}
        self.travel = travel
        self.pool = concurrent.futures.ThreadPoolExecutor(jobs)

    def spheres(self, folder, thickness, scale):
        """Sphere sets of hull and floe in a folder of their own, lengths `scale` times as large."""
        folder.mkdir(parents=True, exist_ok=True)
        floe = folder / "floe.obj"
        floe.write_text(make_meshes.obj_text("floe", make_meshes.floe(1.0, 0.8, thickness)),
                        encoding="ascii")
        for mesh, name, radius, options in (
                (MESHES / "paper-hull-3d.obj", "hull", 0.1, ["--mode", "surface"]),
                (floe, "floe", 0.05, ["--arrangement", "lattice"])):
            subprocess.run([compare.program("spherize", self.programs), "-q", str(mesh), "-r",
                            str(radius * scale), "--scale", str(scale), *options, "-o",
                            str(folder / f"{name}.spheres.h5")], check=True)
        (folder / "case.cfg").write_text(CASE.read_text(encoding="utf-8").replace(
            "../case.schema.json", str(ROOT / "cases" / "case.schema.json")).replace(
                "gap = [0.1, 0.1]", f"gap = [{0.1 * scale}, {0.1 * scale}]"), encoding="utf-8")

    def start(self, name, speed, settings=(), thickness=THICKNESS, scale=1.0):
        """Runs the case at a speed of the small ship [m/s]; `scale` enlarges all (Froude's law)."""
        self.runs[name] = self.pool.submit(self.compute, name, speed, dict(settings), thickness,
                                           scale)

    def compute(self, name, speed, settings, thickness, scale):
        folder = self.out / name
        self.spheres(folder, thickness, scale)
        times = math.sqrt(scale)
        steps = round(self.travel / speed / 0.01)
        values = {"hull.speed": speed * times, "simulation.time_step": 0.01 * times,
                  "simulation.duration": steps * 0.01 * times,
                  "output.average_from": steps * 0.01 * times / 2,
                  "hull.position": f"[{-9.6 * scale}, 0, 0]",
                  "contact.crushing_pressure": 1e6 * scale, "flow.model": '"none"', **settings}
        command = [compare.program("icesolve", self.programs), str(folder / "case.cfg"), "-q",
                   "--overwrite", "--threads", "1", "--out", str(folder / "run")]
        for key, value in values.items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run(command, check=False, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            sys.exit(f"ladder.py: {name} failed: {done.stderr}")
        print(name, file=sys.stderr)
        return json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))

    def of(self, name):
        return self.runs[name].result()

    def mean(self, name):
        return self.of(name)["resistance"]["mean_N"]

    def half(self, name):
        return self.of(name)["resistance"]["ci95_N"]


def row(check, expected, got, within, why):
    return dict(zip(COLUMNS, (check, expected, got, within, why)))


def creeping_rows(ladder):
    density = 0.1 * 1000.0   # of water less that of ice, docs/case-keys.md
    bound = density * 9.81 * THICKNESS * BREADTH * (DRAUGHT + 0.1 * THICKNESS / 2)
    mean, half = ladder.mean("creeping"), ladder.half("creeping")
    energy = ladder.of("creeping")["energy"]["potential_J"] / ladder.travel
    return [row("creeping at 0.05 m/s without friction: potential energy gained per metre",
                f"0 to {bound:.0f} N", f"{energy:.0f} N", "",
                "(rho_w - rho_i) g h B (T + (1 - rho_i / rho_w) h / 2): every piece in the ship's "
                "breadth goes under the keel; pieces that leave at the sides gain less"),
            row("creeping at 0.05 m/s without friction: resistance over (rho_w - rho_i) g h B T",
                "0.5", f"{mean / (density * 9.81 * THICKNESS * BREADTH * DRAUGHT):.2f} +- "
                f"{half / (density * 9.81 * THICKNESS * BREADTH * DRAUGHT):.2f}", "shown only",
                "Jeong's C_B of measured ships; their pieces rub")]


def friction_rows(ladder):
    base, one, two = (ladder.mean(f"friction {mu}") for mu in (0.0, 0.1, 0.2))
    half = 2 * (ladder.half("friction 0.1") + ladder.half("friction 0.0")) / (one - base)
    lindqvist = {mu: ladder.of(f"friction {mu}")["lindqvist_submersion_N"] for mu in (0.0, 0.1)}
    return [row("friction 0.2 over 0.1: growth over that without friction", "2",
                f"{(two - base) / (one - base):.2f}", f"{half:.2f}",
                "friction is proportional to the coefficient while the pieces' ways do not change"),
            row("friction 0.1 over none: resistance", f"{lindqvist[0.1] / lindqvist[0.0]:.2f}",
                f"{one / base:.2f}", "shown only", "Lindqvist's submersion term")]


def speed_rows(ladder):
    rows = []
    formula = {v: ladder.of(f"speed {v}")["lindqvist_submersion_N"] for v in (0.25, 1.0)}
    for flow in ("", " with flow"):
        got = ladder.mean(f"speed 1.0{flow}") / ladder.mean(f"speed 0.25{flow}")
        rows.append(row(f"speed 1 over 0.25 m/s{flow}: resistance",
                        f"{formula[1.0] / formula[0.25]:.2f}", f"{got:.2f}", "shown only",
                        "Lindqvist's submersion term"))
    return rows


def thickness_rows(ladder):
    thin, thick = THICKNESSES
    ratio = ladder.mean(f"thickness {thick}") / ladder.mean(f"thickness {thin}")
    exponent = math.log(ratio) / math.log(thick / thin)
    return [row(f"thickness {thin} to {thick} m: exponent of the resistance", "1 to 2",
                f"{exponent:.2f}", "", "buoyancy grows with h, breaking up of jams faster")]


def froude_rows(ladder):
    rows = []
    for speed in (0.25, 0.5, 1.0):
        small, large = f"speed {speed}", f"speed {speed} x 10"
        ratio = ladder.mean(large) / ladder.mean(small) / FROUDE ** 3
        spread = math.hypot(ladder.half(small) / ladder.mean(small),
                            ladder.half(large) / ladder.mean(large))
        rows.append(row(f"lengths x 10, speed x sqrt 10, pressure x 10, from {speed} m/s: "
                        "force over 1000 times that", "1", f"{ratio:.3f}", f"{spread:.3f}",
                        "Froude's law: every force is a weight"))
    return rows


def energy_rows(ladder):
    rows = []
    for name in ("speed 0.25", "speed 0.5", "speed 1.0"):
        energy = ladder.of(name)["energy"]
        gained = (energy["potential_J"] + energy["kinetic_change_J"]) / energy["ship_work_J"]
        rows.append(row(f"{name} m/s: energy that the ice has gained over the ship's work",
                        "0 to 1", f"{gained:.2f}", "",
                        "the rest is lost to water, friction, impacts and crushing"))
    return rows


def start_all(ladder):
    still = {"contact.friction_ship_ice": 0.0}
    ladder.start("creeping", 0.05, {**still, "contact.friction_ice_ice": 0.0,
                                    "simulation.time_step": 0.02})
    for mu in (0.0, 0.1, 0.2):
        ladder.start(f"friction {mu}", 0.5, {"contact.friction_ship_ice": mu})
    for speed in (0.25, 0.5, 1.0):
        ladder.start(f"speed {speed}", speed)
        ladder.start(f"speed {speed} x 10", speed, scale=FROUDE)
    for speed in (0.25, 1.0):
        ladder.start(f"speed {speed} with flow", speed, {"flow.model": '"double-body"'})
    for thickness in THICKNESSES:
        ladder.start(f"thickness {thickness}", 0.5, thickness=thickness)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side")
    parser.add_argument("--travel", type=float, default=TRAVEL,
                        help="way of the ship [m], shorter for a trial")
    parser.add_argument("--out", default=str(ROOT / "results" / "ladder"), help="run folders")
    parser.add_argument("--programs", default=str(ROOT / "build" / "release" / "bin"))
    parser.add_argument("--table", default=str(HERE / "ladder.csv"))
    arguments = parser.parse_args()
    ladder = Ladder(arguments.out, arguments.programs, arguments.jobs, arguments.travel)
    start_all(ladder)
    parts = (froude_rows, energy_rows, creeping_rows, friction_rows, speed_rows, thickness_rows)
    rows = [row for part in parts for row in part(ladder)]
    commit = ladder.of("creeping")["git_commit"]
    travel = "" if arguments.travel == TRAVEL else f" --travel {arguments.travel:g}"
    compare.write_table(pathlib.Path(arguments.table), COLUMNS, rows,
                        f"python3 validation/ladder.py{travel}, commit {commit}")
    print(arguments.table)


if __name__ == "__main__":
    main()
