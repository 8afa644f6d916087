# SPDX-License-Identifier: GPL-3.0-or-later
"""A folder with the inputs and results of the value tests, and the programs that make them."""
import json
import os
import pathlib
import re
import subprocess

from solids import write_obj


class Workshop:
    """`files` lists, for each format, the files that must have values for all their names, `names`
    the names of what is no such file."""

    def __init__(self, folder, programs, source):
        self.folder, self.programs, self.source = (
            pathlib.Path(word) for word in (folder, programs, source))
        self.files = {}
        self.names = {}
        self.last = ""

    def __truediv__(self, name):
        return self.folder / name

    def mesh(self, name, solid):
        write_obj(self / name, solid)

    def write(self, name, text):
        (self / name).write_text(text, encoding="utf-8")

    def run(self, program, *words):
        """Runs a program; its standard output. The command as the program stores it is `last`."""
        words = [str(word) for word in words]
        command = [str(self.programs / program), *words, "-q"]
        self.last = " ".join([program, *words, "-q"])
        done = subprocess.run(command, cwd=self.folder, check=False, text=True,
                              capture_output=True, env=dict(os.environ, OMP_NUM_THREADS="2"))
        if done.returncode != 0:
            raise RuntimeError(f"{self.last} ended with {done.returncode}:\n{done.stderr}")
        return done.stdout

    def keep(self, folder, *, floes=()):
        """Takes up the files of a run's folder."""
        self.files.setdefault("summary.json", []).append(self / folder / "summary.json")
        self.files.setdefault("forces.csv", []).append(self / folder / "forces.csv")
        self.files.setdefault("run.h5", []).append(self / folder / "run.h5")
        for floe in floes:
            self.files.setdefault("floe.csv", []).append(self / folder / f"floe_{floe}.csv")

    def summary(self, folder):
        return json.loads((self / folder / "summary.json").read_text(encoding="utf-8"))

    def check_origin(self, values, form, report):
        """Version, commit and compiler."""
        cmake = (self.source / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(icesolve VERSION ([\d.]+)", cmake).group(1)
        values.equal(form, "version", report["version"], version)
        commit = re.fullmatch(r"unknown|[0-9a-f]{12,40}(-dirty)?", report["git_commit"])
        values.equal(form, "git_commit", commit is not None, True)
        compiler = re.fullmatch(r"(GNU|Clang) [\d.]+", report["compiler"])
        values.equal(form, "compiler", compiler is not None, True)
