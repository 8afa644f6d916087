# SPDX-License-Identifier: GPL-3.0-or-later
"""template_test.py WEB: the committed page is, byte by byte, what its sources give.

Builds the page in a copy of postprocess/report/web. Skipped (exit code 77), and says so, where
there is no Node or npm cannot fetch the packages that package-lock.json names.
"""
import os
import shutil
import subprocess
import sys
import tempfile

web = sys.argv[1]
built = os.path.join(web, "dist", "report_template.html")
if not shutil.which("node") or not shutil.which("npm"):
    print("skipped: no Node here (apt-get install nodejs npm): the built page was not compared")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    copy = os.path.join(folder, "web")
    shutil.copytree(web, copy, ignore=shutil.ignore_patterns("node_modules", "dist"))
    try:
        fetch = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"],
                               cwd=copy, capture_output=True, text=True, timeout=120)
        fault = "" if fetch.returncode == 0 else fetch.stderr.strip()
    except subprocess.TimeoutExpired:
        fault = "no answer for two minutes"
    if fault:
        print("skipped: npm cannot fetch the locked packages: the built page was not compared")
        print(fault[-500:])
        sys.exit(77)
    subprocess.run(["node", "build.mjs"], cwd=copy, check=True)
    anew = os.path.join(copy, "dist/report_template.html")
    with open(built, "rb") as old, open(anew, "rb") as new:
        same = old.read() == new.read()
if not same:
    print(f"{built} is not what its sources give: run 'npm ci --ignore-scripts && node build.mjs' "
          f"in {web} and commit it")
    sys.exit(1)
print("same bytes")
