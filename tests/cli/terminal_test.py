# SPDX-License-Identifier: GPL-3.0-or-later
"""terminal_test.py SPHERIZE ICESOLVE MESHES: what a run shows on a terminal and elsewhere."""
import os
import pty
import re
import subprocess
import sys
import tempfile

spherize, icesolve, meshes = sys.argv[1:4]
CASE = """title = "terminal"
[simulation]
dimension = 2
duration = 3.0
time_step = 0.005
[hull]
spheres = "hull.h5"
position = [-9.6, 0, 0]
speed = 1.0
[[floes]]
spheres = "floe.h5"
count = [5, 1]
origin = [0.05, 0]
[contact]
iterations = 1
"""  # one iteration: steps that do not converge are worth a warning, which has a colour


def environment(**more):
    plain = {k: v for k, v in os.environ.items() if k not in ("CI", "NO_COLOR")}
    return {**plain, "TERM": "xterm", **more}


def on_terminal(*words, **more):
    """What the run writes to a terminal of its own."""
    mine, its = pty.openpty()
    run = subprocess.Popen([icesolve, "case.cfg", "--no-report", *words], stderr=its,
                           stdout=subprocess.DEVNULL, env=environment(**more))
    os.close(its)
    text = b""
    try:
        while block := os.read(mine, 65536):
            text += block
    except OSError:  # the other end was closed
        pass
    os.close(mine)
    assert run.wait() == 0, text
    return text.decode()


def elsewhere(*words, **more):
    run = subprocess.run([icesolve, "case.cfg", "--no-report", *words], capture_output=True,
                         text=True, check=True, env=environment(**more))
    assert run.stdout == "", run.stdout
    return run.stderr


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name in ("hull", "floe"):
        subprocess.run([spherize, os.path.join(meshes, f"paper-{name}-2d.obj"), "--slice", "y=0",
                        "-o", f"{name}.h5", "-q"], check=True)
    with open("case.cfg", "w", encoding="utf-8") as file:
        file.write(CASE)

    bar = re.compile(r"\ricesolve \[#*\.*\] +\d+ %, \d+ s left, [\d.]+x real time")
    shown = on_terminal()
    assert bar.search(shown), shown
    assert "100 %" in shown and "warning" in shown and "\033[33m" in shown, shown
    plain = on_terminal(NO_COLOR="1")
    assert bar.search(plain) and "warning" in plain and not re.search(r"\033\[[0-9;]*m", plain), plain
    assert on_terminal("-q") == ""
    assert "\r" not in on_terminal(CI="true").replace("\r\n", "\n")

    log = elsewhere()
    tenths = re.findall(r"^icesolve +(\d+) %, \d+ s left, [\d.]+x real time$", log, re.MULTILINE)
    assert tenths == [str(10 * k) for k in range(11)], tenths
    assert "\033" not in log and "\r" not in log, log
    assert elsewhere("-q") == ""
    print("ok")
