# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the resistance of the pre-sawn channel moves with finer panels and a finer table:

    python3 tests/bench/flow_resolution.py [build/release/bin] [--seeds 5]

Whole runs of cases/presawn-channel at 1 m/s, whose sphere sets are made; 4 s of a processor each.
"""
import argparse
import concurrent.futures
import json
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "cases/presawn-channel"
SETTINGS = ("hull.speed=1", "simulation.duration=13.6", "output.average_from=4",
            "simulation.jitter=0.004", "flow.model=file")
SPACING = 0.15  # m, half a floe's thickness: the case's own
# the longest edge is a 15th of the hull's length, unless --panel says another [m]
FLOWS = {"the case's": ("--spacing", SPACING),
         "panels x 4": ("--spacing", SPACING, "--panel", None),
         "spacing / 2": ("--spacing", SPACING / 2), "spacing / 4": ("--spacing", SPACING / 4)}


def resistance(programs, flow, seed, folder):
    command = [programs / "icesolve", CASE / "case.cfg", "--threads", "1", "-q", "--out", folder]
    for setting in (*SETTINGS, f"flow.file={flow}", f"simulation.seed={seed}"):
        command += ["--set", setting]
    subprocess.run(command, check=True)
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))["resistance"]["mean_N"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs="?", default=ROOT / "build/release/bin", type=Path)
    parser.add_argument("--seeds", type=int, default=5, help="runs of each flow")
    options = parser.parse_args()
    programs = options.programs.resolve()
    with tempfile.TemporaryDirectory() as folder, \
            concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        folder, reports, runs, edge = Path(folder), {}, {}, None
        for name, arguments in FLOWS.items():
            place = folder / name.replace(" ", "").replace("/", "by")
            flow, report = place.with_suffix(".flow.h5"), place.with_suffix(".json")
            # half of the first flow's longest edge: four times as many panels
            arguments = [str(edge / 2 if a is None else a) for a in arguments]
            command = [programs / "iceflow", CASE / "hull.spheres.h5", "-q", "-o", flow]
            subprocess.run([*command, "--json", report, *arguments], check=True)
            reports[name] = json.loads(report.read_text(encoding="utf-8"))
            edge = edge or reports[name]["panel_m"]
            runs[name] = [pool.submit(resistance, programs, flow, seed,
                                      folder / f"{place.name}-{seed}")
                          for seed in range(1, options.seeds + 1)]
        print("| table | panels | spacing [m] | resistance [N] | change [%] |")
        print("|---|---|---|---|---|")
        base = None
        for name, jobs in runs.items():
            means = [job.result() for job in jobs]
            mean = statistics.mean(means)
            base = base or mean
            error = statistics.stdev(means) / len(means) ** 0.5 if len(means) > 1 else 0.0
            flow = reports[name]
            print(f"| {name} | {flow['panels']} | {flow['spacing_m']:.4g} | "
                  f"{mean:.0f}, standard error {error:.0f} | {100 * (mean / base - 1):+.1f} |")


if __name__ == "__main__":
    main()
