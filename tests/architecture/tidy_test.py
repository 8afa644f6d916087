# SPDX-License-Identifier: GPL-3.0-or-later
"""tidy.py's sample, and that clang-tidy refuses a source with a fault: tidy_test.py WORK"""
import pathlib
import shutil
import sys

import tidy

names = [f"solver/file_{k}.cpp" for k in range(100)]
changed = {"solver/file_7.cpp", "solver/file_50.cpp", "README.md"}

first = tidy.choose(names, changed, "a commit", 20)
assert first == tidy.choose(reversed(names), changed, "a commit", 20), "depends on the order"
assert set(first[:2]) == {"solver/file_7.cpp", "solver/file_50.cpp"}, "changed sources come first"
assert len(set(first)) == 20
assert set(first) != set(tidy.choose(names, changed, "the next commit", 20))
# 98 sources in samples of 18: a source is missed 40 times in a row with a chance of 0.0003
reached = {name for k in range(40) for name in tidy.choose(names, changed, f"commit {k}", 20)}
assert len(reached) > 97, len(reached)

if shutil.which("clang-tidy-14") is None:
    sys.exit(77)
work = pathlib.Path(sys.argv[1])
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
root = pathlib.Path(__file__).resolve().parents[2]
shutil.copy(root / ".clang-tidy", work)
(work / "sound.cpp").write_text("int half(int count) { return count / 2; }\n")
(work / "faulty.cpp").write_text(
    "double half(int count) { double all = count / 2; return all; }\n")
(work / "compile_flags.txt").write_text("-std=c++20\n")
assert tidy.findings(work, work, "sound.cpp") == "", tidy.findings(work, work, "sound.cpp")
report = tidy.findings(work, work, "faulty.cpp")
assert "bugprone-integer-division" in report, report
