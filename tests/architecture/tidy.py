#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""clang-tidy 14 over sources of the programs; .clang-tidy has the checks.

    tidy.py --all ROOT WORK         every source
    tidy.py --sample N ROOT WORK    N sources: those that HEAD or the tree changes, then others

All sources take 20 minutes on two cores, longer than continuous integration has. Its sample is
drawn by the hash of the commit and the source's name: the same for a commit wherever it is tested,
another one for the next commit, so that a few dozen commits reach every source.

WORK receives a build tree of its own: clang's commands, one source at a time, without precompiled
headers. Exit code 77 (skipped) without clang-tidy-14.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys

FOLDERS = ("common", "preprocess", "solver", "postprocess")


def git(root, *arguments):
    """The lines that git prints; none outside a checkout or where the history is cut off."""
    # a checkout of another owner is read as well: nothing in it runs
    done = subprocess.run(["git", "-c", f"safe.directory={os.path.abspath(root)}", "-C", root,
                           *arguments], capture_output=True, text=True)
    return done.stdout.splitlines() if done.returncode == 0 else []


def sources(work, root):
    """Names below the root of all sources that the build tree compiles."""
    commands = json.loads((work / "compile_commands.json").read_text())
    names = {os.path.relpath(entry["file"], root) for entry in commands}
    return sorted(name for name in names if name.startswith(tuple(f"{f}/" for f in FOLDERS)))


def choose(names, changed, commit, count):
    """`count` of the names: changed ones first, within each part by hash."""
    def place(name):
        return name not in changed, hashlib.sha256(f"{commit} {name}".encode()).digest()
    return sorted(names, key=place)[:count]


def configure(root, work):
    done = subprocess.run(
        ["cmake", "-S", root, "-B", work, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
         "-DCMAKE_C_COMPILER=clang-14", "-DCMAKE_CXX_COMPILER=clang++-14", "-DICE_TESTS=OFF",
         "-DICE_PRECOMPILED_HEADERS=OFF"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"cmake fails:\n{done.stdout}{done.stderr}")


def findings(root, work, name):
    """clang-tidy's report of one source; empty where it finds nothing."""
    done = subprocess.run(["clang-tidy-14", "-p", work, "--quiet", name], cwd=root,
                          capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout or done.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    options = parser.parse_args()
    for program in ("clang-tidy-14", "clang++-14"):
        if shutil.which(program) is None:
            print(f"skipped: install clang-tidy-14 and clang-14 ({program} is missing)")
            return 77
    root, work = options.root.resolve(), options.work.resolve()
    configure(root, work)
    chosen = names = sources(work, root)
    if not options.all:
        commit = "".join(git(root, "rev-parse", "HEAD"))
        changed = set(git(root, "diff", "--name-only", "HEAD~1"))
        chosen = choose(names, changed, commit, options.sample)
    faults = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for report in pool.map(lambda name: findings(root, work, name), chosen):
            faults += report != ""
            print(report, end="", flush=True)
    print(f"{len(chosen)} of {len(names)} sources, {faults} with findings")
    return 1 if faults > 0 or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
