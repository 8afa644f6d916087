# SPDX-License-Identifier: GPL-3.0-or-later
"""slurm_test.py SOURCE BIN: a sweep as jobs of a private one-node Slurm."""
import os
import subprocess
import tempfile

from slurm_node import slurm_node
from sweep_case import SWEEP, make_case, read, run_snakemake, skip_without, summaries, write

skip_without("snakemake", "munged", "slurmctld", "slurmd", "sbatch", "scontrol")

with tempfile.TemporaryDirectory() as folder:
    make_case(folder)
    write(f"{folder}/sweep.toml", SWEEP.format(speeds="[0.5, -999.0, 1.0]", seeds=1))
    os.makedirs(f"{folder}/slurm")
    with slurm_node(f"{folder}/slurm") as env:
        os.environ.update(env)
        code, text = run_snakemake(folder, "slurm")
        assert code == 1, text
        assert "1 of 3 runs have no result: hull.speed=-999.0" in text, text
        first = summaries(folder)
        assert len(first) == 2, (first, text)
        assert "2 of 3 runs completed" in read(f"{folder}/out/sweep.html")
        # the jobs ran in Slurm: two inputs and three runs, one of which failed
        logs = [name for name in os.listdir(f"{folder}/out/logs") if name.startswith("slurm-")]
        assert len(logs) == 5, logs
        states = subprocess.run(["scontrol", "-o", "show", "job"], capture_output=True, text=True)
        assert states.stdout.count("JobState=COMPLETED") == 4, states.stdout
        assert states.stdout.count("JobState=FAILED") == 1, states.stdout

        write(f"{folder}/sweep.toml", SWEEP.format(speeds="[0.5, 0.8, 1.0]", seeds=1))
        code, text = run_snakemake(folder, "slurm")
        assert code == 0, text
        second = summaries(folder)
        assert len(second) == 3 and all(second[run] == first[run] for run in first), text
        assert "3 of 3 runs completed" in read(f"{folder}/out/sweep.html")
    print("ok")
