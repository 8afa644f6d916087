# SPDX-License-Identifier: GPL-3.0-or-later
"""terminal_test.py SPHERIZE ICESOLVE SOURCE: what a run shows on a terminal and elsewhere."""
import fcntl
import os
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios

spherize, icesolve, source = sys.argv[1:4]
# one iteration: steps that do not converge are worth a warning, which has a colour
ONE_ITERATION = "[contact]\niterations = 1\n"


def environment(**more):
    plain = {k: v for k, v in os.environ.items() if k not in ("CI", "NO_COLOR")}
    return {**plain, "TERM": "xterm", **more}


def on_terminal(*words, width=0, **more):
    """What the run writes to a terminal of its own, which knows its width where one is given."""
    mine, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24 if width else 0, width, 0, 0))
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
    run = subprocess.run([icesolve, "case.cfg", "--overwrite", "--no-report", *words],
                         capture_output=True, text=True, check=True, env=environment(**more))
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

    bar = re.compile(r"\ricesolve \[#*\.*\] +\d+ %(, \d+ s left)?, [\d.]+x real time")
    shown = on_terminal()
    assert bar.search(shown), shown
    assert "100 %" in shown and "warning" in shown and "\033[33m" in shown, shown
    plain = on_terminal(NO_COLOR="1")
    assert bar.search(plain) and "warning" in plain, plain
    assert not re.search(r"\033\[[0-9;]*m", plain), plain
    assert on_terminal("-q") == ""
    assert "\r" not in on_terminal(CI="true").replace("\r\n", "\n")
    dumb = on_terminal(TERM="dumb").replace("\r\n", "\n")
    assert "\r" not in dumb and "\033" not in dumb and "100 %" in dumb, dumb

    # no drawing is wider than the terminal, whether it says its width itself or COLUMNS does
    for width, how in ((40, "itself"), (40, "COLUMNS"), (20, "itself"), (200, "itself")):
        drawn = on_terminal(width=width if how == "itself" else 0,
                            COLUMNS=str(width if how == "COLUMNS" else 77))
        lines = [part.split("\033[K")[0] for part in drawn.split("\r") if "\033[K" in part]
        assert lines and max(map(len, lines)) < width, (width, how, lines)
        assert (width < 40) or "[" in lines[0], lines
    # in the first second there is nothing to tell the time left from
    first = drawn[:drawn.index("\033[K")]
    assert "left" not in first, first

    log = elsewhere()
    tenths = re.findall(r"^icesolve +(\d+) %(?:, \d+ s left)?, [\d.]+x real time$", log,
                        re.MULTILINE)
    assert tenths == [str(10 * k) for k in range(11)], tenths
    assert "\033" not in log and "\r" not in log, log
    assert elsewhere("-q") == ""
    print("ok")
