#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""commands_test.py SOURCE BIN PAGE...: runs the commands of these pages, in their order.

Commands are the blocks marked "sh"; a block marked "toml NAME" is the file NAME. They run in a copy
of what they need, with the programs in BIN; runs of icesolve are cut to SECONDS of simulated time.
ELSEWHERE names the test of each command that is not run here. A block without a mark is an error,
because nobody knows whether it is run."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

SOURCE, BIN = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
PAGES = sys.argv[3:]
SECONDS = 3.0
README_BYTES = 8192  # a front page is read in ten minutes
ELSEWHERE = {  # beginning of a command -> test that runs it, and that test's file
    "./bootstrap.sh demo": ('"cases: run the demo"', "tests/cases/CMakeLists.txt"),
    "./bootstrap.sh test": ("./bootstrap.sh test", ".ci/run"),
    # where ParaView is installed
    "paraview --script": ("ParaView reads and draws the exported run",
                          "tests/postprocess/CMakeLists.txt"),
    "pvpython run/paraview": ("ParaView reads and draws the exported run",
                              "tests/postprocess/CMakeLists.txt"),
    "build/release/tests/bench_flow": ("bench_flow: finer panels leave the channel's loads",
                                       "tests/bench/CMakeLists.txt"),
    # numbers of a whole run
    "icepost check results/": ('"cases: check ${name}"', "tests/cases/CMakeLists.txt"),
}
SHORTENED = f"""#!/usr/bin/env bash
for word in "$@"; do
    case $word in
        --new | --check | --explain | --print-* | --help) exec '{BIN}/icesolve' "$@" ;;
    esac
done
words=()
while (($#)); do
    if [[ $1 == --set && $2 =~ ^(simulation.duration|output.average_from)= ]]; then
        shift
    else
        words+=("$1")
    fi
    shift
done
exec '{BIN}/icesolve' "${{words[@]}}" --set simulation.duration={SECONDS} \\
    --set output.average_from={SECONDS / 2}
"""


def fail(text):
    sys.exit(f"commands_test.py: {text}")


def make_workshop(folder):
    """The folders that commands read, programs where a build has them, a mesh of one's own."""
    shutil.copytree(SOURCE / "cases", folder / "cases", ignore=shutil.ignore_patterns("*.h5"))
    for name in ("meshes", "workflow", "examples"):
        (folder / name).symlink_to(SOURCE / name)
    programs = folder / "build/release/bin"
    programs.mkdir(parents=True)
    for name in ("spherize", "icefield", "iceflow", "icepost"):
        (programs / name).symlink_to(BIN / name)
    (programs / "icesolve").write_text(SHORTENED, encoding="utf-8")
    (programs / "icesolve").chmod(0o755)
    if "docs/your-own-ship.md" not in PAGES:  # which makes it
        subprocess.run([sys.executable, "-B", SOURCE / "meshes/make_icebreaker.py", "--triangles",
                        "2000", "--out", folder / "myship.stl"], check=True)
    return {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}",
            "PYTHONDONTWRITEBYTECODE": "1"}


def blocks(page):
    """(mark, text) of the fenced blocks of a page."""
    text = (SOURCE / page).read_text(encoding="utf-8")
    found = re.findall(r"^```([^\n]*)\n(.*?)^```$", text, re.M | re.S)
    if 2 * len(found) != len(re.findall(r"^```", text, re.M)):
        fail(f"{page}: a block that is not closed")
    for mark, block in found:
        if not mark:
            fail(f"{page}: mark this block as sh, text or toml:\n{block}")
    return found


def without_others(page, text):
    """The block without the commands that other tests run."""
    kept = []
    for line in text.replace("\\\n", " ").splitlines():
        for beginning, (test, file) in ELSEWHERE.items():
            if line.startswith(beginning):
                if test not in (SOURCE / file).read_text(encoding="utf-8"):
                    fail(f"{page}: '{line}' should be run by {test}, which is not in {file}")
                break
        else:
            kept.append(line)
    return "\n".join(kept)


def run_page(page, folder, environment):
    """Number of blocks run."""
    count = 0
    for mark, text in blocks(page):
        kind, _, name = mark.partition(" ")
        if kind == "toml" and name:
            (folder / name).write_text(text, encoding="utf-8")
        commands = without_others(page, text) if kind == "sh" else ""
        if not commands.strip():
            continue
        began = time.monotonic()
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, text=True,
                              env=environment, capture_output=True, check=False)
        if done.returncode:
            said = "\n".join((done.stdout + done.stderr).splitlines()[-20:])
            fail(f"{page}: exit code {done.returncode} of\n{commands}\n{said}")
        print(f"{page}: {time.monotonic() - began:.1f} s for {commands.splitlines()[0]} ...")
        count += 1
    return count


with tempfile.TemporaryDirectory() as name:
    work = pathlib.Path(name)
    workshop = make_workshop(work)
    for this in PAGES:
        if this == "README.md" and (SOURCE / this).stat().st_size > README_BYTES:
            fail(f"{this} has more than {README_BYTES} bytes: move something into docs/")
        if not run_page(this, work, workshop):
            fail(f"{this} has no commands to run")
