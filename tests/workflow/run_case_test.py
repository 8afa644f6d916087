# SPDX-License-Identifier: GPL-3.0-or-later
"""run_case_test.py SOURCE BIN: an interrupted run of a sweep goes on from its checkpoint."""
import json
import os
import subprocess
import tempfile

from sweep_case import BIN, SOURCE, make_case, read

with tempfile.TemporaryDirectory() as folder:
    make_case(folder)
    env = {**os.environ, "SPHERIZE": f"{BIN}/spherize"}
    subprocess.run([f"{SOURCE}/cases/prepare.sh", f"{folder}/case"], check=True, env=env,
                   capture_output=True)

    def run(name, *words):
        done = subprocess.run([f"{SOURCE}/workflow/run_case.sh", f"{BIN}/icesolve",
                               f"{folder}/case/case.cfg", f"{folder}/{name}", "--threads", "1",
                               "--no-report", "--set", "output.average_from=1", *words],
                              capture_output=True, text=True)
        summary = f"{folder}/{name}/summary.json"
        return done, json.loads(read(summary)) if os.path.exists(summary) else None

    done, whole = run("whole", "--set", "simulation.duration=4")
    assert done.returncode == 0, done.stderr
    assert not os.path.exists(f"{folder}/whole/checkpoint.h5")

    # stopped after 2 of 4 s, as Ctrl-C would leave it, then called again: the same bits
    run("cut", "--set", "simulation.duration=2", "--checkpoint-every", "2")
    assert os.path.exists(f"{folder}/cut/checkpoint.h5")
    os.remove(f"{folder}/cut/summary.json")  # as Snakemake does with what was interrupted
    done, cut = run("cut", "--set", "simulation.duration=4")
    assert done.returncode == 0 and "begins again" not in done.stderr, done.stderr
    assert cut["state_hash"] == whole["state_hash"] and cut["steps"] == whole["steps"]
    assert "--restart" in cut["command_line"]

    # a checkpoint of another case is no reason to fail
    run("other", "--set", "simulation.duration=2", "--set", "hull.speed=0.7",
        "--checkpoint-every", "2")
    done, other = run("other", "--set", "simulation.duration=4")
    assert done.returncode == 0 and "begins again" in done.stderr, done.stderr
    assert other["state_hash"] == whole["state_hash"]

    # what fails fails
    done, _ = run("bad", "--set", "hull.speed=-999")
    assert done.returncode == 2 and "outside" in done.stderr, done.stderr
    print("ok")
