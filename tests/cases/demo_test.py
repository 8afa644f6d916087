#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the demo must show: demo_test.py DEMO ICESOLVE

DEMO is a copy of cases and meshes in which cases/demo.sh has run into results/demo. Three more
seeds are computed here, of which the demo knows nothing.
"""
import json
import math
import pathlib
import subprocess
import sys

HEADLINE = "speed-0.5"  # the speed of the paper's case
WIDEST = 0.08  # of the mean: half the interval that a first look at the tool may have


def read(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def other_seeds(demo, icesolve):
    """Mean and interval of three members that the demo has not computed, with its options."""
    command = read(demo / "results/demo" / HEADLINE / "seed-1")["command_line"].split()
    settings = [word for word in command if word.startswith(("hull.", "simulation.", "output."))]
    settings = [word for word in settings if not word.startswith("simulation.seed")]
    out = demo / "results/others"
    line = [icesolve, "cases/paper-3d-defaults/case.cfg", "--out", out, "--overwrite", "--quiet"]
    line += ["--no-report", "--seeds", "3", "--set", "simulation.seed=4"]
    for setting in settings:
        line += ["--set", setting]
    subprocess.run(line, check=True, cwd=demo)
    ensemble = read(out)["ensemble"]
    return ensemble["mean_N"], ensemble["ci95_N"]


def main():
    demo = pathlib.Path(sys.argv[1])
    results = demo / "results/demo"
    summaries = [*results.glob("speed-*/summary.json"), *results.glob("speed-*/*/summary.json")]
    assert len(summaries) == 12, f"three ensembles of three members, but {len(summaries)} summaries"
    for path in summaries:
        warnings = json.loads(path.read_text(encoding="utf-8"))["warnings"]
        assert not warnings, f"{path} warns: {warnings}"

    headline = read(results / HEADLINE)["ensemble"]
    mean, half = headline["mean_N"], headline["ci95_N"]
    assert half < WIDEST * mean, f"the headline {mean} +- {half} N is wider than {WIDEST:.0%}"
    other, other_half = other_seeds(demo, sys.argv[2])
    # The means of two independent ensembles differ by no more than both intervals together. Three
    # seeds may lie close together by chance, so that their interval alone need not hold the others.
    both = math.hypot(half, other_half)
    assert abs(other - mean) < both, f"{mean} N, but {other} N with other seeds: +- {both} N"

    paper = read(demo / "results/demo-paper-rules")["resistance"]
    assert paper["ci95_N"] > 5 * half, "the paper's rules are no reason for the defaults any more"
    for name in ["sweep.html", f"{HEADLINE}/seed-1/report.html"]:
        assert (results / name).is_file(), f"the demo names {name}, which is not there"
    print(f"headline {mean:.1f} +- {half:.1f} N; other seeds {other:.1f} +- {other_half:.1f} N")


main()
