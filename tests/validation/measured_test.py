#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""validation/ against itself and the programs: measured_test.py ROOT PROGRAMS

The page of measurements is what its tables give, every number of it; changed inputs change it; two
tests of a set, shortened to a few metres, run and answer to their thickness.
"""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT, PROGRAMS = (pathlib.Path(p).resolve() for p in sys.argv[1:3])


def compare(root, *arguments):
    done = subprocess.run([sys.executable, "-B", str(root / "validation" / "compare.py"),
                           *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done


def copy_tree(folder):
    """What compare.py reads, without run folders."""
    for part in ("validation", "meshes", "cases"):
        shutil.copytree(ROOT / part, folder / part,
                        ignore=shutil.ignore_patterns("*.h5", "__pycache__"))
    (folder / "docs").mkdir()
    return folder


def page_of(root):
    page = root / "docs" / "page.txt"
    compare(root, "page", "--page", str(page))
    return page.read_text(encoding="utf-8")


def check_page(copy):
    written = (ROOT / "docs/validation-measured.md").read_text(encoding="utf-8")
    assert page_of(copy) == written, "docs/validation-measured.md is stale: compare.py page"


def check_numbers_count(copy):
    """Each measured and computed mean is in the page, and changes it."""
    before = page_of(copy)
    for name, old, new in (("data.csv", ",830,", ",831,"),
                           ("data.csv", "III,1.04,669,", "III,1.05,669,")):
        path = copy / "validation" / "uikku" / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, (name, old)
        path.write_text(text.replace(old, new), encoding="utf-8")
        assert page_of(copy) != before, f"{old} of {name} is not in the page"
        path.write_text(text, encoding="utf-8")
    path = copy / "validation" / "uikku" / "computed.csv"
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    for k in range(2, len(lines)):
        test, mean, rest = lines[k].split(",", 2)
        changed = lines[:k] + [f"{test},{2 * float(mean)},{rest}"] + lines[k + 1:]
        path.write_text("".join(changed), encoding="utf-8")
        assert page_of(copy) != before, f"test {test} is not in the page"
    path.write_text("".join(lines), encoding="utf-8")


def check_runs(copy):
    """Three metres of two tests, at their thickness and at twice that."""
    def means():
        table = copy / "short.csv"
        compare(copy, "run", "uikku", "--tests", "301,303", "--distance", "3", "--jobs", "2",
                "--out", str(copy / "runs"), "--table", str(table), "--programs", str(PROGRAMS))
        rows = [line.split(",") for line in table.read_text(encoding="utf-8").splitlines()[2:]]
        assert [row[0] for row in rows] == ["301", "303"]
        return [float(row[1]) for row in rows]

    first = means()
    assert all(mean > 0.0 for mean in first), first
    assert means() == first, "equal runs differ"
    data = copy / "validation" / "uikku" / "data.csv"
    text = data.read_text(encoding="utf-8")
    for test in ("301", "303"):
        text = text.replace(f"{test},III,1.04", f"{test},III,2.08")
    data.write_text(text, encoding="utf-8")
    thick = means()
    # crushing and bending grow with the section at least
    assert all(t > 1.5 * f for t, f in zip(thick, first)), (first, thick)


def check_ladder(copy):
    """Three metres of each run of the ladder: the law that holds from the first contact on does."""
    table = copy / "ladder.csv"
    done = subprocess.run([sys.executable, "-B", str(copy / "validation" / "ladder.py"),
                           "--travel", "3", "--jobs", "2", "--out", str(copy / "ladder"),
                           "--table", str(table), "--programs", str(PROGRAMS)],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    with open(table, encoding="utf-8", newline="") as file:
        rows = {row["check"]: row
                for row in csv.DictReader(line for line in file if line[0] != "#")}
    committed = (copy / "validation" / "ladder.csv").read_text(encoding="utf-8")
    for check, row in rows.items():
        assert check in committed, f"{check} is not in validation/ladder.csv"
        if check.startswith("speed") and row["expected"] == "0 to 1":
            assert 0.0 < float(row["got"]) < 1.0, row
        if check.startswith("lengths x 10"):
            # chance decides the ways of single pieces; a wrong power of the scale is 3 or 10
            assert 0.5 < float(row["got"]) < 2.0, row


with tempfile.TemporaryDirectory() as place:
    tree = copy_tree(pathlib.Path(place))
    check_page(tree)
    check_numbers_count(tree)
    check_runs(tree)
    check_ladder(tree)
