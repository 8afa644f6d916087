#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Single runs' 95 % intervals against the mean of their ensemble.

    coverage.py ICESOLVE CASE WORK_DIR MEMBERS LEAST [OPTION]...

Runs an ensemble and demands that at least LEAST of its members' intervals contain its mean.
Prints each member's mean and interval.
"""
import json
import pathlib
import subprocess
import sys


def main():
    icesolve, case, work, members, least, *more = sys.argv[1:]
    work = pathlib.Path(work)
    subprocess.run([icesolve, case, "--seeds", members, "--out", work, "--overwrite", "-q",
                    "--no-report", *more], check=True)
    ensemble = json.loads((work / "summary.json").read_text())["ensemble"]
    mean = ensemble["mean_N"]
    print(f"ensemble: {mean:.1f} +- {ensemble['ci95_N']:.1f} N")
    covered = 0
    for seed in ensemble["seeds"]:
        run = json.loads((work / f"seed-{seed}" / "summary.json").read_text())["resistance"]
        inside = abs(run["mean_N"] - mean) <= run["ci95_N"]
        covered += inside
        print(f"seed {seed}: {run['mean_N']:.1f} +- {run['ci95_N']:.1f} N"
              f"{'' if inside else ', misses the mean'}")
    print(f"{covered} of {members} intervals contain the mean, {least} must")
    return 0 if covered >= int(least) else 1


if __name__ == "__main__":
    sys.exit(main())
