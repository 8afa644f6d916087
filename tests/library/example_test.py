# SPDX-License-Identifier: GPL-3.0-or-later
"""example_test.py two_floes docs/library.md: what the example prints is physics, and what the page
shows."""
import re
import subprocess
import sys

program, page = sys.argv[1:]
output = subprocess.run([program], check=True, capture_output=True, text=True).stdout
number = r"\s*(-?\d+\.\d+)"
rows = [tuple(map(float, row)) for row in re.findall(
    rf"t ={number} s: f_x ={number} N, f_z ={number} N; first floe at x ={number}, z ={number} m",
    output)]
assert len(rows) == 8, output
assert rows[-1][0] == 4.0 and any(row[1] != 0.0 for row in rows), output
for time, f_x, f_z, x, z in rows:
    assert f_x <= 0.0, f"ice pulls the ship at t = {time}"
    # deeper than the hull's bottom by more than its size the floe would be lost
    assert -1.75 < z < 0.1, f"the floe is at z = {z} at t = {time}"
    # the stem, a slope of 45 degrees, is ahead of the keel's end at 1.8 m by at most 1.2 m
    assert 1.8 + 0.5 * time - 1.0 < x, f"the ship has gone through the floe at t = {time}"

with open(page, encoding="utf-8") as file:
    blocks = re.findall(r"```\n(t = .*?)```", file.read(), re.S)
assert blocks, f"{page} shows no output"
shown = [tuple(map(float, re.findall(number[3:], line))) for line in blocks[0].splitlines()]
# another compiler may round otherwise: the page's digits to 2 % of the largest force
largest = max(abs(v) for row in rows for v in row[1:3])
for got, want in zip(rows, shown, strict=True):
    assert all(abs(a - b) <= 0.02 * largest for a, b in zip(got, want, strict=True)), (got, want)
