# SPDX-License-Identifier: GPL-3.0-or-later
"""terminal_test.py SPHERIZE ICESOLVE SOURCE: what a run shows on a terminal and elsewhere."""
import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile

spherize, icesolve, source = sys.argv[1:4]
# one iteration: steps that do not converge are worth a warning, which has a colour
ONE_ITERATION = "[contact]\niterations = 1\n"


def environment(**more):
    plain = {k: v for k, v in os.environ.items() if k not in ("CI", "NO_COLOR")}
    return {**plain, "TERM": "xterm", **more}


def on_terminal(*words, **more):
    """What the run writes to a terminal of its own."""
    mine, its = pty.openpty()
    run = subprocess.Popen([icesolve, "case.cfg", "--overwrite", "--no-report", *words], stderr=its,
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
    run = subprocess.run([icesolve, "case.cfg", "--overwrite", "--no-report", *words], capture_output=True,
                         text=True, check=True, env=environment(**more))
    assert run.stdout == "", run.stdout
    return run.stderr


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name in ("hull", "floe"):
        mesh = os.path.join(source, f"meshes/paper-{name}-2d.obj")
        subprocess.run([spherize, mesh, "--slice", "y=0", "-o", f"{name}.h5", "-q"], check=True)
    shutil.copy(os.path.join(source, "tests/support/short_case.cfg"), "case.cfg")
    with open("case.cfg", "a", encoding="utf-8") as file:
        file.write(ONE_ITERATION)

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
