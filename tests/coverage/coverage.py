#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""coverage.py SOURCE BUILD [ctest option]...: runs the suite in BUILD, made with the preset
"coverage", and prints the lines that it reached, per folder. Ends with 1 where a part of the
project has less than 90 %.

coverage.py --table SUMMARY.json prints the table of what gcovr wrote before."""
import collections
import json
import subprocess
import sys

PARTS = ("common", "preprocess", "solver", "postprocess")
BOUND = 0.90


def measure(source, build, options):
    """gcovr's summary of a run of the suite. A test that fails does not stop the count."""
    subprocess.run(["find", build, "-name", "*.gcda", "-delete"], check=True)
    tests = subprocess.run(["ctest", "--test-dir", build, "--timeout", "3600", *options],
                           check=False)
    if tests.returncode:
        print("coverage.py: some tests failed, see above", file=sys.stderr)
    summary = f"{build}/coverage.json"
    filters = [word for part in PARTS for word in ("--filter", f"{source}/{part}/")]
    subprocess.run(["gcovr", "--root", source, *filters, "--exclude-unreachable-branches",
                    "--gcov-ignore-parse-errors", "--json-summary", summary, build], check=True)
    return summary


def add_up(files):
    """{folder: [lines reached, lines]}, of the parts and of their folders."""
    sums = collections.defaultdict(lambda: [0, 0])
    for entry in files:
        folders = entry["filename"].split("/")[:-1]
        for depth in range(1, min(len(folders), 2) + 1):
            row = sums["/".join(folders[:depth])]
            row[0] += entry["line_covered"]
            row[1] += entry["line_total"]
    return sums


def main():
    if sys.argv[1] == "--table":
        summary = sys.argv[2]
    else:
        summary = measure(sys.argv[1], sys.argv[2], sys.argv[3:])
    with open(summary, encoding="utf-8") as file:
        sums = add_up(json.load(file)["files"])
    missing = [part for part in PARTS if part not in sums]
    if missing:
        sys.exit(f"coverage.py: no lines of {', '.join(missing)}; was {summary} made by all tests?")
    print("| folder | lines | reached | % |\n|---|---|---|---|")
    for folder in sorted(sums):
        reached, lines = sums[folder]
        print(f"| {folder} | {lines} | {reached} | {100 * reached / max(lines, 1):.1f} |")
    low = [part for part in PARTS if sums[part][0] < BOUND * sums[part][1]]
    if low:
        sys.exit(f"coverage.py: less than {100 * BOUND:.0f} % in {', '.join(low)}")


if __name__ == "__main__":
    main()
