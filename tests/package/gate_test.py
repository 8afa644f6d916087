# SPDX-License-Identifier: GPL-3.0-or-later
"""gate_test.py SOURCE BIN: the run steps of examples/ci/hull-gate.yml let a hull pass, and stop
another whose stem is too steep. Only the step that installs the package is left out."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

source, programs = pathlib.Path(sys.argv[1]), sys.argv[2]
workflow = (source / "examples/ci/hull-gate.yml").read_text(encoding="utf-8")
steps = [step for step in re.findall(r"^ +run: (.+)$", workflow, re.M) if "apt-get" not in step]
assert len(steps) == 3, steps
page = (source / "examples/ci/README.md").read_text(encoding="utf-8")
for step in steps:  # the page and GitLab's job say the same
    assert page.count(step) == 2, step


def run_gate(hull):
    """(exit code of the first step that failed or 0, that step, the verdicts)"""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file in ("case.cfg", "expected.toml"):
            shutil.copy(source / "examples/ci" / file, folder)
        shutil.copy(source / "meshes/paper-floe-2d.obj", folder / "floe.obj")
        (folder / "hull.obj").write_text(hull, encoding="utf-8")
        for step in steps:
            done = subprocess.run(["bash", "-e", "-c", step], cwd=folder, capture_output=True,
                                  text=True, check=False,
                                  env={**os.environ, "PATH": programs + ":" + os.environ["PATH"]})
            if done.returncode:
                print(step, done.stdout, done.stderr, sep="\n")
                break
        verdicts = xml.etree.ElementTree.parse(folder / "verdicts.xml").getroot()
        return done.returncode, step, [case.find("failure") is None
                                       for case in verdicts.iter("testcase")]


good = (source / "meshes/paper-hull-2d.obj").read_text(encoding="utf-8")
steep = good.replace("v 7.857777989887 ", "v 9.454044648632 ")  # 1.5 m / tan 70 deg aft of x = 10
assert steep.count("v 9.454044648632 ") == 2

code, step, verdicts = run_gate(good)
assert (code, verdicts) == (0, [True, True, True]), (code, step, verdicts)
code, step, verdicts = run_gate(steep)
assert code == 1 and step.startswith("icepost check") and not verdicts[0], (code, step, verdicts)
