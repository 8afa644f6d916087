#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""flow_table.py SWEEP: a sweep's resistance, one column for each of the axis "title", as Markdown.

SWEEP is the folder of a sweep over "title", one other axis and seeds. Cells are the mean over the
seeds with Student's 95 % interval, then its ratio to Lindqvist's submersion part for the same hull,
ice and speed. Points without a run are left out; runs that failed are no points.
"""
import json
import math
import os
import sys
import tomllib
from collections import defaultdict

# 97.5 % quantiles of Student's distribution for 1 to 9 degrees of freedom
STUDENT = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]
NAMES = {"hull.speed": "speed", "drag.coefficient": "C_d"}


def read_points(sweep):
    """axis, {(its value, title): [(mean, Lindqvist) of each run]}."""
    with open(os.path.join(sweep, "runs.toml"), "rb") as file:
        plan = tomllib.load(file)
    axis = next(a for a in plan["axes"] if a not in ("title", "simulation.seed", "field.seed"))
    points = defaultdict(list)
    for run in plan["run"]:
        path = os.path.join(sweep, "runs", run["name"], "summary.json")
        if not os.path.exists(path):
            continue
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
        if summary["status"] == "completed":
            points[run["values"][axis], run["values"]["title"]].append(
                (summary["resistance"]["mean_N"], summary.get("lindqvist_submersion_N")))
    return axis, points


def cell(runs):
    if not runs:
        return ""
    means = [mean for mean, _ in runs]
    mean, lindqvist = math.fsum(means) / len(means), runs[0][1]
    text = f"{mean:.0f}"
    if len(means) > 1:
        spread = math.fsum((m - mean) ** 2 for m in means) / (len(means) - 1)
        student = STUDENT[min(len(means) - 1, len(STUDENT)) - 1]
        text += f" ± {student * math.sqrt(spread / len(means)):.0f}"
    return text + (f" ({mean / lindqvist:.2f})" if lindqvist else "")


def main():
    axis, points = read_points(sys.argv[1])
    titles = sorted({title for _, title in points})
    values = list(dict.fromkeys(value for value, _ in points))
    unit = " [m/s]" if axis == "hull.speed" and not isinstance(values[0], str) else ""
    print(f"| {NAMES.get(axis, axis)}{unit} | runs | " + " | ".join(titles) + " | Lindqvist [N] |")
    print("|---" * (len(titles) + 3) + "|")
    for value in values:
        rows = [points[value, title] for title in titles]
        lindqvist = next((l for row in rows for _, l in row if l), None)
        count = "/".join(map(str, sorted({len(row) for row in rows})))
        formula = f"{lindqvist:.0f}" if lindqvist else ""
        print(f"| {value} | {count} | " + " | ".join(map(cell, rows)) + f" | {formula} |")


if __name__ == "__main__":
    main()
