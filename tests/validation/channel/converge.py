#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean resistance in the confined channel against time step, iterations and the ice's spheres.

    converge.py BIN_DIR MESHES_DIR WORK_DIR [--seeds N] [--only NAME]... [--duration T] [--jobs N]

Runs tests/validation/channel/case.cfg with each variation for each seed, two at a time, and prints
a markdown table: mean over the seeds with its 95 % interval (Student's t), and the difference from
the base in percent. Runs that are already in WORK_DIR are not repeated.
"""
import argparse
import concurrent.futures
import json
import pathlib
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PRESSURES = ["0.2 MPa", "1 MPa"]
BASE_RADIUS = 0.05
VARIATIONS = {"base": {}}
VARIATIONS |= {f"time step {dt} s": {"simulation.time_step": dt} for dt in (0.02, 0.005, 0.0025)}
VARIATIONS |= {f"{n} iterations": {"contact.iterations": n} for n in (10, 100)}
VARIATIONS |= {f"ice spheres of {r} m": {"radius": r} for r in (0.1, 0.025)}
# two-sided 95 % quantile of Student's t by degrees of freedom
T95 = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447, 7: 2.365, 8: 2.306, 9: 2.262}


def make_sets(options, radius):
    """The sphere sets for one radius of the ice; returns their folder with the case in it."""
    folder = options.work / f"sets-{radius}"
    folder.mkdir(parents=True, exist_ok=True)
    meshes = {
        "hull": (options.meshes / "paper-hull-3d.obj", 0.1),
        "floe": (options.meshes / "paper-floe-3d.obj", radius),
        "side": (HERE / "side.obj", radius),
        "end": (HERE / "end.obj", radius),
    }
    for name, (mesh, r) in meshes.items():
        out = folder / f"{name}.spheres.h5"
        if not out.exists():
            subprocess.run([options.bin / "spherize", mesh, "-r", str(r), "--mode", "surface",
                            "-o", out, "-q"], check=True)
    (folder / "case.cfg").write_text((HERE / "case.cfg").read_text())
    return folder


def is_done(out):
    """Did a run come to its end? One that was stopped leaves a summary, too."""
    summary = out / "summary.json"
    return summary.exists() and json.loads(summary.read_text())["status"] == "completed"


def run(options, pressure, name, seed):
    """One run's summary."""
    keys = dict(VARIATIONS[name])
    folder = options.work / f"sets-{keys.pop('radius', BASE_RADIUS)}"
    out = options.work / f"{pressure} {name} {seed}".replace(" ", "_")
    keys |= {"simulation.seed": seed, "contact.crushing_pressure": f'"{pressure}"'}
    if options.duration:
        keys |= {"simulation.duration": options.duration, "output.average_from": 0.0}
    if not is_done(out):
        command = [options.bin / "icesolve", folder / "case.cfg", "--out", out, "--overwrite",
                   "--threads", "1", "-q",
                   *(part for k, v in keys.items() for part in ("--set", f"{k}={v}"))]
        subprocess.run(command, check=True)
    return json.loads((out / "summary.json").read_text())


def interval(values):
    """Mean and half width of its 95 % interval."""
    mean = statistics.mean(values)
    n = len(values)
    if n < 2:
        return mean, float("nan")
    return mean, T95.get(n - 1, 1.96) * statistics.stdev(values) / n**0.5


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("bin", "meshes", "work"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--only", action="append", choices=VARIATIONS)
    parser.add_argument("--pressure", action="append", choices=PRESSURES)
    parser.add_argument("--duration", type=float, help="simulated seconds, for a trial")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    names = [n for n in VARIATIONS if not options.only or n in options.only]
    for name in names:
        make_sets(options, VARIATIONS[name].get("radius", BASE_RADIUS))
    seeds = range(1, options.seeds + 1)
    print("| crushing pressure | variation | resistance [N] | 95 % interval | from base [%] "
          "| steps not converged [%] | deepest overlap [mm] |\n|---|---|---|---|---|---|---|")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for pressure in options.pressure or PRESSURES:
            tasks = {name: [pool.submit(run, options, pressure, name, s) for s in seeds]
                     for name in names}
            base = None
            for name in names:
                runs = [task.result() for task in tasks[name]]
                mean, half = interval([r["resistance"]["mean_N"] for r in runs])
                base = base or mean
                late = statistics.mean(r["contacts"]["unconverged_steps"] / r["steps"]
                                       for r in runs)
                deep = max(r["contacts"]["max_overlap_m"] for r in runs)
                print(f"| {pressure} | {name} | {mean:.0f} | {half:.0f} | "
                      f"{100 * (mean / base - 1):+.1f} | {100 * late:.0f} | {1e3 * deep:.0f} |",
                      flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
