# SPDX-License-Identifier: GPL-3.0-or-later
"""run_icepost.py WRITE_SAMPLE_RUN ICEPOST: files and exit codes of the program."""
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

write_sample, icepost = sys.argv[1:3]


def run(*words):
    return subprocess.run([icepost, *words], capture_output=True, text=True)


def expect(done, code, out="", err=""):
    assert done.returncode == code, (done.args, done.returncode, done.stderr)
    assert out in done.stdout, done.stdout
    assert err in done.stderr, done.stderr


with tempfile.TemporaryDirectory() as folder:
    path = lambda name: os.path.join(folder, name)
    subprocess.run([write_sample, path("run.h5")], check=True)
    with open(path("summary.json"), "w") as file:
        file.write('{"floes": {"moved": 5}, "resistance": {"mean_N": 1107.0}}')
    with open(path("good.toml"), "w") as file:
        file.write('[[expect]]\nkey = "floes.moved"\nvalue = 5\nabs = 0\nwhy = "counted"\n')
    with open(path("miss.toml"), "w") as file:
        file.write('[[expect]]\nkey = "floes.moved"\nmin = 6\n')
    with open(path("bad.toml"), "w") as file:
        file.write('[[expect]]\nkey = "floes.move"\nmin = 6\n')

    expect(run("check", folder, path("good.toml"), "--junit", path("junit.xml")), 0, out="counted")
    assert xml.parse(path("junit.xml")).getroot().get("failures") == "0"
    expect(run("check", folder, path("miss.toml")), 1, out="MISS")
    expect(run("check", folder, path("bad.toml")), 2, err="did you mean 'floes.moved'?")
    expect(run("check", folder, path("none.toml")), 2, err="file not found")

    # a summary that is not one of icesolve's is refused by the report, by name of the key
    expect(run("report", folder), 2, err="schema: is missing")
    os.remove(path("summary.json"))
    expect(run("report", folder, "--flexural-strength", "450"), 0,
           err='--flexural-strength = 450 Pa is outside 10 kPa to 10 MPa')
    expect(run("report", folder, "--flexural-strength", "450"), 0,
           err='if 450 kPa is meant, write "450 kPa"')
    assert "outside" not in run("report", folder, "--flexural-strength", "450 kPa").stderr
    expect(run("-q", "report", folder), 0)
    page = open(path("report.html"), encoding="utf-8").read()
    xml.fromstring(page.replace("<!DOCTYPE html>", ""))  # well-formed
    expect(run("view", folder, "--time", "2", "--from", "side", "--out", path("a.svg")), 0)
    assert xml.parse(path("a.svg")).getroot().tag.endswith("svg")
    expect(run("plot", folder), 0)
    assert xml.parse(path("plot.svg")).getroot().tag.endswith("svg")
    expect(run("table", folder), 2, err="holds no summary.json")
    expect(run("sweep", folder), 2, err="holds no runs")
    expect(run("sweep", path("none")), 2, err="folder not found")
    expect(run("view", folder, "--time", "99", "--out", path("b.svg")), 0,
           err="frames from 0 to 4.4 s, none at 99 s")
    files = ["arrays.h5", "run.xdmf", "shapes.xdmf", "view.py"]
    for name, option in (("pv", []), ("dots", ["--points-only"])):
        expect(run("paraview", folder, *option, "--every", "20", "--out", path(name)), 0)
        assert sorted(os.listdir(path(name))) == files
        parts = xml.parse(path(f"{name}/run.xdmf")).getroot()[0]
        assert all(len(part) == 3 for part in parts if part.get("Name") != "contacts")
        compile(open(path(f"{name}/view.py")).read(), "view.py", "exec")

    expect(run(), 2)
    expect(run("report"), 2, err="RUN")
    expect(run("view", folder, "--time", "2", "--from", "under", "--out", path("a.svg")), 2)
    expect(run("report", path("none")), 2, err="run folder not found")
    expect(run("report", folder, "--out", path("no/report.html")), 1, err="cannot be written")
    expect(run("--version"), 0, out=".")
    print("ok")
