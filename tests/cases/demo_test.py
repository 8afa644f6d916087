#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the demo must show: demo_test.py DEMO ICESOLVE

DEMO is a copy of cases and meshes in which cases/demo.sh has run into results/demo. Three more
seeds are computed here, of which the demo knows nothing.
"""
import json
import pathlib
import subprocess
import sys

HEADLINE = "speed-0.5"  # the speed of the paper's case
WIDEST = 0.08  # of the mean: half the interval that a first look at the tool may have


def read(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def other_seeds(demo, icesolve):
    """Three members that the demo has not computed, with its own options."""
    command = read(demo / "results/demo" / HEADLINE / "seed-1")["command_line"].split()
    settings = [word for word in command if word.startswith(("hull.", "simulation.", "output."))]
    settings = [word for word in settings if not word.startswith("simulation.seed")]
    out = demo / "results/others"
    line = [icesolve, "cases/paper-3d-defaults/case.cfg", "--out", out, "--overwrite", "--quiet"]
    line += ["--no-report", "--seeds", "3", "--set", "simulation.seed=4"]
    for setting in settings:
        line += ["--set", setting]
    subprocess.run(line, check=True, cwd=demo)
    return read(out)["ensemble"]["means_N"]


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
    others = other_seeds(demo, sys.argv[2])
    missed = [other for other in others if abs(other - mean) > half]
    assert not missed, f"{mean} +- {half} N does not contain {missed} of other seeds"

    paper = read(demo / "results/demo-paper-rules")["resistance"]
    assert paper["ci95_N"] > 5 * half, "the paper's rules are no reason for the defaults any more"
    for name in ["sweep.html", f"{HEADLINE}/seed-1/report.html"]:
        assert (results / name).is_file(), f"the demo names {name}, which is not there"
    others = ", ".join(f"{other:.1f}" for other in others)
    print(f"headline {mean:.1f} +- {half:.1f} N; other seeds {others} N")


main()
