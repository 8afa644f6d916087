#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes each mistake of mistakes.toml with the programs; exit code 1 if one is not answered so.

    python3 tests/mistakes/mistakes.py --bin build/release/bin [--row 15]... [--show] [--all]

README.md says what a row may hold.
"""
import argparse
import concurrent.futures
import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MESHES = os.path.join(ROOT, "meshes")
NOBODY = 65534
SECONDS = 60  # for a row; most take a tenth of a second
RUN = "icesolve case.cfg --out run --no-report"
KEYS = {"row", "what", "case", "before", "run", "code", "says", "never", "leaves", "lacks", "words",
        "terminal", "environment", "nobody", "room", "alone", "parts", "await"}


class Skip(Exception):
    """The machine does not let this mistake be made."""


def read_text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def files_of(folder):
    """Relative names of all files in a folder."""
    return {os.path.relpath(os.path.join(place, name), folder)
            for place, _, names in os.walk(folder) for name in names}


class Workshop:
    """The inputs that every row starts from: a short case with its sets, meshes and a run."""

    def __init__(self, folder, binaries, base_case, field):
        self.folder, self.inputs = folder, os.path.join(folder, "in")
        self.environment = {key: value for key, value in os.environ.items()
                            if key not in ("CI", "NO_COLOR", "LC_ALL")}
        self.environment.update(PATH=os.path.abspath(binaries) + ":" + os.environ["PATH"],
                                TERM="xterm", ROOT=ROOT, OMP_NUM_THREADS="1")
        os.chmod(folder, 0o755)
        os.mkdir(self.inputs)
        for name, text in (("case.cfg", base_case), ("field.toml", field)):
            with open(os.path.join(self.inputs, name), "w", encoding="utf-8") as file:
                file.write(text)
        shutil.copy(os.path.join(MESHES, "paper-floe-3d.obj"),
                    os.path.join(self.inputs, "floe.obj"))
        plane = "--slice y=0 -q"
        for line in (f"spherize {MESHES}/paper-hull-2d.obj {plane} -o hull.h5",
                     f"spherize {MESHES}/paper-floe-2d.obj {plane} -o floe.h5",
                     "spherize floe.obj -r 0.1 -s 0.1 -q -o floe3.h5",
                     "icesolve case.cfg --out done --no-report -q"):
            subprocess.run(line.split(), cwd=self.inputs, env=self.environment, check=True)

    def prepare(self, row):
        """A folder of its own with the inputs, changed as the row says."""
        folder = os.path.join(self.folder, f"row-{row['row']}")
        shutil.copytree(self.inputs, folder)
        case = os.path.join(folder, "case.cfg")
        text = read_text(case)
        for old, new in row.get("case", {}).items():
            if old not in text:
                raise ValueError(f"row {row['row']}: the case has no {old!r}")
            text = text.replace(old, new)
        with open(case, "w", encoding="utf-8", newline="") as file:
            file.write(text)
        if "before" in row:
            subprocess.run(["bash", "-ec", row["before"]], cwd=folder, env=self.environment,
                           check=True, capture_output=True)
        return folder


def as_nobody():
    """Root may read and write everything: the programs run as somebody else then."""
    if os.getuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)


def run_on_terminal(words, columns, **more):
    """Exit code and what a terminal of that breadth got."""
    mine, its = pty.openpty()
    subprocess.run(["stty", "cols", str(columns)], stdin=its, check=True)
    run = subprocess.Popen(words, stdout=its, stderr=its, stdin=subprocess.DEVNULL, **more)
    os.close(its)
    text = b""
    try:
        while block := os.read(mine, 65536):
            text += block
    except OSError:  # the other end was closed
        pass
    os.close(mine)
    return run.wait(timeout=SECONDS), text


def make_mistake(shop, row, folder):
    """Exit code, text on stdout and stderr, and the files that came."""
    before = files_of(folder)
    words = ["bash", "-c", row.get("run", RUN)]
    more = {"cwd": folder, "env": {**shop.environment, **row.get("environment", {})}}
    if row.get("nobody"):
        os.chmod(folder, 0o777)
        more["preexec_fn"] = as_nobody
    if "terminal" in row:
        code, text = run_on_terminal(words, row["terminal"], **more)
    else:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False, timeout=SECONDS, **more)
        code, text = done.returncode, done.stdout
    return code, text, files_of(folder) - before


def with_small_disk(shop, row, folder):
    """The same with a file system of row["room"] bytes at `small`."""
    small = os.path.join(folder, "small")
    os.mkdir(small)
    mount = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={row['room']}", "tmpfs", small],
                           capture_output=True, check=False)
    if mount.returncode != 0:
        raise Skip("no file system can be mounted")
    try:
        return make_mistake(shop, row, folder)
    finally:
        subprocess.run(["umount", small], check=True)


def faults_of(row, code, raw, came):
    """What is wrong with the answer to a mistake, as sentences."""
    wrong = []
    text = raw.decode("utf-8", "replace")
    if code != row["code"]:
        wrong.append(f"exit code {code}, expected {row['code']}")
    wrong += [f"does not say {part!r}" for part in row.get("says", []) if part not in text]
    wrong += [f"says {part!r}" for part in row.get("never", []) if part in text]
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        wrong.append("writes bytes that are no text")
    if code in (1, 2) and "terminal" not in row:
        wrong += [f"ends a line with a blank: {line!r}" for line in text.splitlines()
                  if line.endswith(" ")][:1]
    parts = sorted(name for name in came if name.endswith(".part"))
    if parts and not row.get("parts"):
        wrong.append(f"leaves {parts}")
    leaves = row.get("leaves")
    if leaves is None and code == 2:
        leaves = []
    if leaves is not None:
        wrong += [f"does not leave {name}" for name in leaves if name not in came]
        if not leaves and came:
            wrong.append(f"leaves {sorted(came)}")
    wrong += [f"leaves {name}" for name in row.get("lacks", []) if name in came]
    wrong += wide_lines(text, row["terminal"]) if "terminal" in row else []
    if code in (1, 2) and row.get("words", True):
        lines = text.strip().splitlines()
        start = next((k for k, line in enumerate(lines) if ": error: " in line), None)
        if start is None:
            wrong.append("has no line 'PROGRAM: error: ...'")
        elif len(lines) == start + 1 or not lines[-1].startswith(" "):
            wrong.append("ends without a remedy")
    return wrong


def wide_lines(text, columns):
    """Lines that are redrawn and do not fit: a terminal wraps them, and each update adds some."""
    drawn = [line for line in re.split(r"\r+\n|\n", text) if "\r" in line]
    pieces = [re.sub(r"\033\[[0-9;]*[A-Za-z]", "", piece) for line in drawn
              for piece in line.split("\r")]
    return [f"redraws a line of {len(piece)} characters on a terminal of {columns}"
            for piece in pieces if len(piece) > columns][:1]


def check_row(shop, row, show):
    """True, False or None (skipped); prints a line, and the whole answer when it is wrong."""
    name = f"{row['row']}: {row['what']}"
    begun = time.monotonic()
    folder = shop.prepare(row)
    try:
        make = with_small_disk if "room" in row else make_mistake
        code, raw, came = make(shop, row, folder)
    except Skip as reason:
        print(f"skipped  {name} ({reason})")
        return None
    except subprocess.TimeoutExpired:
        print(f"FAILED   {name}\n    no end within {SECONDS} s")
        return False
    wrong = faults_of(row, code, raw, came)
    lines = [f"{'FAILED' if wrong else 'passed':8} {name} ({time.monotonic() - begun:.1f} s)"]
    lines += [f"    {text}" for text in wrong]
    if wrong or show:
        lines += [f"    | {line}" for line in raw.decode("utf-8", "replace").splitlines()]
        lines.append(f"    exit code {code}, new files: {sorted(came)}")
    print("\n".join(lines), flush=True)
    return not wrong


def check_table(rows):
    """The table itself: keys that exist, names that are given once."""
    names = [row["row"] for row in rows]
    assert len(names) == len(set(names)), "a row is given twice"
    for row in rows:
        assert not row.keys() - KEYS, f"row {row['row']}: {row.keys() - KEYS}"
        asked = row.get("says") or row.get("lacks") or row["code"] == 0
        assert asked, f"row {row['row']} asks nothing"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", default=os.path.join(ROOT, "build", "release", "bin"))
    parser.add_argument("--row", action="append", help="only this one; repeatable")
    parser.add_argument("--show", action="store_true", help="print every answer")
    parser.add_argument("--all", action="store_true", help="rows that await a change as well")
    options = parser.parse_args()
    with open(os.path.join(HERE, "mistakes.toml"), "rb") as file:
        table = tomllib.load(file)
    rows = table["mistake"]
    check_table(rows)
    if options.row:
        rows = [row for row in rows if row["row"] in options.row]
    elif not options.all:
        rows = [row for row in rows if "await" not in row]
    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="ice-mistakes-") as folder:
        shop = Workshop(folder, options.bin, table["case"], table["field"])
        alone = [row for row in rows if row.get("alone")]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            verdicts = list(pool.map(lambda row: check_row(shop, row, options.show),
                                     [row for row in rows if not row.get("alone")]))
        verdicts += [check_row(shop, row, options.show) for row in alone]
    print(f"{verdicts.count(True)} of {len(verdicts)} mistakes answered as the table says, "
          f"{verdicts.count(None)} skipped, in {time.monotonic() - begun:.0f} s")
    return 1 if False in verdicts or not verdicts else 0


if __name__ == "__main__":
    sys.exit(main())
