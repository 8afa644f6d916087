#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An hour of level ice that a small ship breaks: does memory follow the pieces alive, not the time?

    python3 tests/soak/level_ice.py build/release/bin build/release/tests/soak/level-ice

Prints a row for each 300 s of simulated time; exit code 1 if the memory of the process grows by
more than 5 % in the second half (docs/soak.md). --duration N runs N seconds.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEED = 0.5  # [m/s]
ROW = 300.0  # [s]
BOUND = 0.05  # growth of memory in the second half, as for the basin
# the paper's hull, 10 x 2 m; ice of a tenth of its breadth, so that pieces break off all the time
CASE = """title = "A small ship in level ice, for long"
[simulation]
duration = {duration}
time_step = 0.04
[hull]
spheres = "hull.spheres.h5"
position = [-10.2, 0, 0]
speed = {speed}
[level_ice]
thickness = 0.2
extent = [0, {length}, -6, 6]
spacing = 0.15
[bending]
flexural_strength = "200 kPa"
[contact]
crushing_pressure = "500 kPa"
[output]
history_every = 1.0
frames_every = 60.0
average_from = 20.0
"""


def memory_of(pid):
    """Resident memory [MB]; none of a process that has ended."""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as file:
            return next((int(line.split()[1]) / 1024 for line in file
                         if line.startswith("VmRSS:")), None)
    except FileNotFoundError:
        return None


def last_row(path):
    """The last whole row of a table by column; none before the first."""
    try:
        lines = path.read_text(encoding="utf-8").split("\n")[:-1]
    except FileNotFoundError:
        return None
    rows = [line for line in lines if not line.startswith("#")]
    return dict(zip(rows[0].split(","), rows[-1].split(","))) if len(rows) > 1 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("bin", type=pathlib.Path, help="folder of the programs")
    parser.add_argument("out", type=pathlib.Path, help="folder for the case and its run")
    parser.add_argument("--duration", type=float, default=3600.0, help="[s]")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    case = options.out / "case.cfg"
    case.write_text(CASE.format(duration=options.duration, speed=SPEED,
                                length=SPEED * options.duration + 20.0), encoding="utf-8")
    subprocess.run([options.bin / "spherize", ROOT / "meshes/paper-hull-3d.obj", "-r", "0.2",
                    "--mode", "surface", "-o", options.out / "hull.spheres.h5", "-q"], check=True)
    run = options.out / "run"
    print("| t [s] | pieces moving | contacts | memory [MB] |\n|---|---|---|---|", flush=True)
    rows = []
    with subprocess.Popen([options.bin / "icesolve", case, "--out", run, "--overwrite",
                           "--no-report", "-q"]) as process:
        while process.poll() is None:
            time.sleep(0.2)
            row, memory = last_row(run / "forces.csv.part"), memory_of(process.pid)
            if row and memory and float(row["time_s"]) >= ROW * (len(rows) + 1):
                rows.append((float(row["time_s"]), memory))
                print(f"| {rows[-1][0]:.0f} | {row['moving_floes']} | {row['contacts']} | "
                      f"{memory:.1f} |", flush=True)
    if process.returncode != 0:
        return 2
    half = [memory for t, memory in rows if t <= 0.5 * options.duration]
    if not half or len(rows) == len(half):
        print("too short for two halves of memory")
        return 0
    growth = rows[-1][1] / half[-1] - 1
    print(f"memory grew by {100 * growth:.1f} % in the second half (bound {100 * BOUND:.0f} %)")
    return 0 if growth <= BOUND else 1


if __name__ == "__main__":
    sys.exit(main())
