#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""icebench on scenes of a few floes: its CSV, its exit codes, its help."""

import csv
import itertools
import pathlib
import subprocess
import sys
import tempfile

COLUMNS = ("engine,scene,floes,threads,simd,ms_min,ms_median,contacts,max_overlap_mm,energy_J,"
           "state_hash")
OPTIONS = ("--scene", "--floes", "--threads", "--simd", "--steps", "--peers", "--patience",
           "--model", "--iterations", "--csv", "--kernels", "--quiet", "--version")


def run(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False)


def check(condition, what):
    if not condition:
        sys.exit(f"icebench_runs.py: {what}")


def check_table(program, folder):
    path = folder / "bench.csv"
    result = run(program, "--scene", "loose,packed", "--floes", "4,6", "--threads", "1,2",
                 "--steps", "60", "--simd", "all", "--peers", "--csv", str(path))
    check(result.returncode == 0, f"exit code {result.returncode}: {result.stderr}")
    lines = path.read_text(encoding="utf-8").splitlines()
    check(lines[0] == COLUMNS, f"columns {lines[0]}")
    rows = list(csv.DictReader(lines))
    for engine, scene, floes in itertools.product(("icesolve", "icesolve-default"),
                                                  ("loose", "packed"), ("4", "6")):
        ours = [row for row in rows
                if (row["engine"], row["scene"], row["floes"]) == (engine, scene, floes)]
        check({row["threads"] for row in ours} == {"1", "2"}, f"threads of {ours}")
        hashes = {row["state_hash"] for row in ours}
        check(len(hashes) == 1 and len(hashes.pop()) == 16, f"hashes of {ours}")
    # two scenes of unlike floes, or models, never end in the same state
    check(len({row["state_hash"] for row in rows if row["state_hash"]}) == 8, "equal hashes")
    for row in rows:
        check(0.0 < float(row["ms_min"]) <= float(row["ms_median"]), f"times of {row}")
        check(float(row["contacts"]) >= 0.0 and float(row["energy_J"]) > 0.0, f"sums of {row}")
        ours = row["engine"].startswith("icesolve")
        check(row["simd"] != "" or not ours, f"instruction set of {row}")
        # both round the same time, the table to fewer digits: a tie may go either way
        shown = {f"{float(row['ms_min']) + off:.4f}" for off in (-1e-6, 0.0, 1e-6)}
        check(any(text in result.stdout for text in shown), f"{row} is not in the table")
    check(any(float(row["contacts"]) > 0.0 for row in rows), "no scene has contacts")


def check_kernels(program):
    result = run(program, "--kernels", "--scene", "packed", "--floes", "16", "--steps", "60",
                 "--simd", "all")
    check(result.returncode == 0, f"--kernels: exit code {result.returncode}: {result.stderr}")
    rows = [line.split("|")[1:-1] for line in result.stdout.splitlines()
            if line.startswith("| ") and not line.startswith("| simd")]
    check(len(rows) >= 2, f"--kernels: {result.stdout}")
    for row in rows:
        check(all(float(value) > 0.0 for value in row[1:]), f"--kernels: {row}")


def check_refusals(program, folder):
    path = folder / "none.csv"
    for arguments in (["--scene", "lose"], ["--floes", "0"], ["--threads", "0"],
                      ["--simd", "neon"], ["--steps", "-1"], ["--model", "surface"]):
        result = run(program, *arguments, "--csv", str(path))
        check(result.returncode == 2, f"{arguments}: exit code {result.returncode}")
        check(arguments[0] in result.stderr, f"{arguments}: {result.stderr}")
    check(not path.exists(), "a refused run wrote its file")
    result = run(program, "--scene", "loose", "--floes", "1", "--steps", "1", "--threads", "1",
                 "--csv", str(folder / "no" / "folder.csv"))
    check(result.returncode == 1, f"--csv into no folder: exit code {result.returncode}")


def main():
    program = sys.argv[1]
    help_text = run(program, "--help").stdout
    for option in OPTIONS:
        check(option in help_text, f"--help lacks {option}")
    with tempfile.TemporaryDirectory() as folder:
        check_table(program, pathlib.Path(folder))
        check_kernels(program)
        check_refusals(program, pathlib.Path(folder))


if __name__ == "__main__":
    main()
