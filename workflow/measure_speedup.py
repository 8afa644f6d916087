#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""measure_speedup.py [SWEEP.toml] [CORES]: how much of its runs' summed time a sweep takes.

Computes the sweep on one core and again on CORES (2), into a temporary folder, and prints

    time on CORES / sum over the runs of their wall time on one core

of which 1 / CORES is the least. Snakemake's own time and the page are part of the numerator, sphere
sets are made before. Only a machine without other load gives the figure: the script prints it.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))


def run(sweep, out, cores, *words):
    begin = time.monotonic()
    subprocess.run(["snakemake", "-s", f"{HERE}/Snakefile", "--profile", f"{HERE}/local", "--cores",
                    str(cores), "--quiet", "all", "--config", f"sweep={sweep}", f"out={out}",
                    *words], check=True)
    return time.monotonic() - begin


def main():
    sweep = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else f"{HERE}/paper-3d.toml")
    cores = int(sys.argv[2]) if len(sys.argv) > 2 else 2
    print(f"load before: {os.getloadavg()[0]:.2f}")
    with tempfile.TemporaryDirectory() as folder:
        alone = run(sweep, f"{folder}/alone", 1)
        walls = []
        for name in os.listdir(f"{folder}/alone/runs"):
            with open(f"{folder}/alone/runs/{name}/summary.json", encoding="utf-8") as file:
                walls.append(json.load(file)["wall_s"])
        together = run(sweep, f"{folder}/together", cores)
    print(f"{len(walls)} runs: {sum(walls):.1f} s summed, {alone:.1f} s on one core with "
          f"Snakemake, {together:.1f} s on {cores} cores: {together / sum(walls):.3f} of the sum")


main()
