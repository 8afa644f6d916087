# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the workflow share: a small case, a sweep file, Snakemake's command."""
import os
import shutil
import subprocess
import sys

SOURCE, BIN = (os.path.abspath(path) for path in sys.argv[1:3])
SNAKEMAKE = "/usr/bin/snakemake"

# two steps of ice against the 2D ship: short, but through all programs
SWEEP = """title = "Test <sweep>"
case = "case/case.cfg"
out = "out"
report = false
[set]
simulation.duration = 2.0
simulation.jitter = 0.01
output.average_from = 1.0
[axes]
hull.speed = {speeds}
seeds = {seeds}
"""


def skip_without(*programs):
    missing = [p for p in programs if not shutil.which(p, path="/usr/bin:/usr/sbin:/bin:/sbin")]
    if missing:
        print(f"skipped: no {', '.join(missing)} here; apt-get install --no-install-recommends "
              "snakemake parallel slurmctld slurmd slurm-client munge")
        sys.exit(77)


def make_case(folder):
    """The paper's 2D case in folder/case, its meshes in folder/meshes; nothing prepared yet."""
    os.makedirs(f"{folder}/meshes")
    os.makedirs(f"{folder}/case")
    for name in ("paper-hull-2d.obj", "paper-floe-2d.obj"):
        shutil.copy(f"{SOURCE}/meshes/{name}", f"{folder}/meshes")
    shutil.copy(f"{SOURCE}/cases/paper-2d-u0.5/case.cfg", f"{folder}/case")
    with open(f"{SOURCE}/cases/paper-2d-u0.5/spheres.txt", encoding="utf-8") as file:
        text = file.read().replace("../../meshes", "../meshes")
    write(f"{folder}/case/spheres.txt", text)


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def snakemake_words(folder, profile, *words, file="sweep=sweep.toml"):
    kind, name = file.split("=")
    return [SNAKEMAKE, "-s", f"{SOURCE}/workflow/Snakefile", "--profile",
            f"{SOURCE}/workflow/{profile}", "--config", f"{kind}={folder}/{name}", f"bin={BIN}",
            *words]


def run_snakemake(folder, profile, *words, file="sweep=sweep.toml"):
    done = subprocess.run(snakemake_words(folder, profile, *words, file=file), cwd=folder,
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def summaries(folder):
    """Run -> time its summary was written, in ns."""
    found, runs = {}, f"{folder}/out/runs"
    for name in sorted(os.listdir(runs)) if os.path.isdir(runs) else []:
        path = f"{runs}/{name}/summary.json"
        if os.path.exists(path):
            found[name] = os.stat(path).st_mtime_ns
    return found
