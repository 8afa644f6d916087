# SPDX-License-Identifier: GPL-3.0-or-later
"""coverage_test.py coverage.py: the table of a made-up summary, with a part just above and just
below the bound."""
import json
import subprocess
import sys
import tempfile


def table(solver_reached, parts=("common/base", "preprocess/fill", "postprocess/views")):
    files = [{"filename": f"{folder}/a.cpp", "line_covered": 10, "line_total": 10}
             for folder in parts]
    files += [{"filename": "solver/step/step.cpp",
               "line_covered": solver_reached, "line_total": 60},
              {"filename": "solver/water/drag.cpp", "line_covered": 36, "line_total": 40}]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"files": files}, file)
        file.flush()
        return subprocess.run([sys.executable, "-B", sys.argv[1], "--table", file.name],
                              check=False, capture_output=True, text=True)


good = table(54)
assert good.returncode == 0, good
assert "| solver | 100 | 90 | 90.0 |" in good.stdout, good
assert "| solver/step | 60 | 54 |" in good.stdout, good
low = table(53)
assert low.returncode == 1 and "less than 90 % in solver" in low.stderr, low
gap = table(54, parts=("common/base", "preprocess/fill"))
assert gap.returncode == 1 and "no lines of postprocess" in gap.stderr, gap
