# SPDX-License-Identifier: GPL-3.0-or-later
"""parallel_test.py SOURCE BIN: the way with GNU parallel of workflow/README.md."""
import os
import subprocess
import tempfile

from sweep_case import BIN, SOURCE, make_case, read, skip_without

skip_without("parallel")

with tempfile.TemporaryDirectory() as folder:
    make_case(folder)
    env = {**os.environ, "PATH": f"{BIN}:/usr/bin:/bin", "SPHERIZE": f"{BIN}/spherize",
           "HOME": folder}  # parallel keeps files in the home folder
    subprocess.run([f"{SOURCE}/cases/prepare.sh", f"{folder}/case"], check=True, env=env,
                   capture_output=True)
    os.makedirs(f"{folder}/out")
    words = ["parallel", "--joblog", "out/joblog", "--resume-failed", "-j2", "icesolve",
             "case/case.cfg", "--threads", "1", "--no-report", "--out", "out/u{1}-s{2}", "--set",
             "hull.speed={1}", "--set", "simulation.seed={2}", "--set", "simulation.jitter=0.01",
             "--set", "simulation.duration=2", "--set", "output.average_from=1",
             ":::", "0.5", "1.0", ":::", "1", "2"]
    done = subprocess.run(words, cwd=folder, env=env, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    subprocess.run(["icepost", "-q", "sweep", "out"], cwd=folder, env=env, check=True)
    page = read(f"{folder}/out/sweep.html")
    assert "4 of 4 runs completed" in page and "Resistance [N/m] against speed [m/s]" in page
    print("ok")
