#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What threads cost and bring, alone and beside another run.

    threads.py BIN_DIR [--case DIR] [--duration T] [--rounds N] [--waiting NAME=VALUE]...

Computes a case (cases/paper-3d with the default models) alone with one thread and with as many as
icesolve takes by itself, then two of each side by side, and prints the medians over the rounds [s]
and the ratios:

    alone        time with the default number of threads / time with one
    side by side time of two runs with the default number of threads / time of two with one each

Of a round all are measured one after the other, so that other load of the machine meets all alike.
--waiting repeats the runs with many threads with a variable of OpenMP set (OMP_WAIT_POLICY=active,
GOMP_SPINCOUNT=1000, ...), for comparison.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODELS = ["contact.normal=surface", "buoyancy.model=distributed", "drag.model=panel",
          "contact.crushing_pressure=1e6", "output.frames_every=1"]


def seconds(options, folder, runs, threads, variable):
    """Wall time until the last of so many runs at once has ended."""
    name, value = variable.split("=") if variable else ("", "")
    environment = {k: v for k, v in os.environ.items()
                   if k not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "OMP_NUM_THREADS")}
    if name:
        environment[name] = value
    words = [options.bin / "icesolve", options.case / "case.cfg", "-q", "--no-report",
             "--overwrite", *(word for text in MODELS for word in ("--set", text)),
             "--set", f"simulation.duration={options.duration}",
             "--set", f"output.average_from={options.duration / 2}"]
    if threads:
        words += ["--threads", str(threads)]
    begin = time.monotonic()
    running = [subprocess.Popen([*words, "--out", f"{folder}/{k}"], env=environment)
               for k in range(runs)]
    for run in running:
        if run.wait() != 0:
            raise SystemExit("a run failed")
    return time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("bin", type=pathlib.Path, help="where icesolve lies")
    parser.add_argument("--case", type=pathlib.Path, default=ROOT / "cases/paper-3d")
    parser.add_argument("--duration", type=float, default=25.0, help="simulated (%(default)s s)")
    parser.add_argument("--rounds", type=int, default=5, help="(%(default)s)")
    parser.add_argument("--waiting", action="append", default=[], metavar="NAME=VALUE")
    options = parser.parse_args()
    options.bin = options.bin.resolve()
    subprocess.run([ROOT / "cases/prepare.sh", options.case], check=True, capture_output=True)
    variants = [("one thread", 1, "")] + [(f"all cores {v}".strip(), 0, v)
                                          for v in ["", *options.waiting]]
    times = {}
    print(f"{os.cpu_count()} processors, load before: {os.getloadavg()[0]:.2f}")
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for runs in (1, 2):
                for name, threads, variable in variants:
                    took = seconds(options, folder, runs, threads, variable)
                    times.setdefault((runs, name), []).append(took)
    print("| threads | alone [s] | over one thread | two side by side [s] | over two of one |")
    print("|---|---|---|---|---|")
    median = {key: statistics.median(values) for key, values in times.items()}
    for name, _, _ in variants:
        alone, both = median[1, name], median[2, name]
        print(f"| {name} | {alone:.2f} | {alone / median[1, 'one thread']:.2f} | {both:.2f} | "
              f"{both / median[2, 'one thread']:.2f} |")


if __name__ == "__main__":
    main()
