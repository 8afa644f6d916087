#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the world around the four programs fail; exit code 1 if one does not end as it should.

    python3 tests/faults/faults.py --bin build/release/bin [--fault NAME]... [--repetitions 100]

README.md says what is done and what must come of it.
"""
import argparse
import os
import resource
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time

from jobs import JOBS, MESHES, Result, Workshop, files_of, has_remedy, read
from kills import sigkill, sigterm

NOBODY = 65534
THIEVES = 4  # runs of each kind beside a program that fills the disk
SKIPPED = 77  # ctest's SKIP_RETURN_CODE
FAULTS = {}


class Skip(Exception):
    """The machine does not let this fault be made."""


def fault(function):
    FAULTS[function.__name__.replace("_", "-")] = function
    return function


def as_nobody():
    """Root may read and write everything: the programs run as somebody else then."""
    if os.getuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)


def limit(kind, amount):
    """For preexec_fn: a limit of the process, as a shell's or a batch system's ulimit sets it."""
    def apply():
        resource.setrlimit(kind, (amount, amount))
    return apply


def faults_of_room(shop, job, folder, done, too_little, enough):
    """What is wrong with the end of a job that had too little room for its outputs, or enough."""
    found = shop.faults(job, folder, done)
    if too_little and done.code == 0:
        found.append("exit code 0 though not all can have been written")
    if enough and done.code != 0:
        found.append(f"exit code {done.code} though there was room: {done.message}")
    return found


@fault
def file_size_limit(shop, _):
    """Every output stops growing at a limit, from nothing to the size of the largest one."""
    wrong = []
    for job in JOBS:
        largest = max(len(data) for data in shop.good[job.name].values())
        limits = sorted({0, 1, 100, 700, 2048, 4096, 10000} |
                        {largest * k // 8 for k in range(1, 8)})
        for amount in [n for n in limits if n < largest] + [8 * largest + (1 << 20)]:
            folder = shop.new_folder()
            done = shop.run(job.words, folder, preexec_fn=limit(resource.RLIMIT_FSIZE, amount))
            found = faults_of_room(shop, job, folder, done, amount < largest, amount > largest)
            wrong += [f"{job.name} with {amount} bytes a file: {text}" for text in found]
    return wrong


@fault
def disk_full(shop, _):
    """A file system of a few pages: no room, room for some of the outputs, room for all."""
    wrong = []
    for job in JOBS:
        total = sum(len(data) for data in shop.good[job.name].values())
        for share in [k / 20 for k in range(1, 20)] + [20.0]:
            folder = shop.new_folder()
            size = max(int(share * total) // 4096, 2) * 4096 + (1 << 21 if share > 1 else 0)
            mount(folder, size)
            try:
                done = shop.run(job.words, folder)
                found = faults_of_room(shop, job, folder, done, size < total, share > 1)
                if job.name == "icepost paraview" and done.code != 0 and files_of(folder):
                    found.append(f"a part of the export is left: {files_of(folder)[:3]}")
            finally:
                subprocess.run(["umount", folder], check=True)
            wrong += [f"{job.name} on {size} bytes: {text}" for text in found]
    return wrong


@fault
def disk_full_goes_on(shop, _):
    """A run on a small file system, alone and beside somebody who takes the rest of it: what was
    computed stays, and goes on to the same bits when there is room."""
    wrong, in_time = [], 0
    words = ["icesolve", "../in/case.cfg", "-q", "--no-report", "--set", "simulation.duration=40"]
    whole = shop.new_folder()
    shop.must([*words, "--out", "run"], whole)
    trials = [(False, []), (False, ["--checkpoint-every", "1"])]
    trials += THIEVES * [(True, []), (True, ["--checkpoint-every", "0.5"])]
    for thief, options in trials:
        folder = shop.new_folder()
        mount(folder, 3 << 20)
        try:
            command = [*words, *options, "--out", "run"]
            done = (run_beside_thief if thief else Workshop.run)(shop, command, folder)
            found = [] if done.code == 1 and has_remedy(done.message) else [
                f"exit code {done.code}: {done.message!r}"]
            stopped = "almost full" in done.message
            in_time += stopped
            # a thief may come between the look at the disk and the writing: HDF5's file is torn
            if stopped and not shop.can_be_read(os.path.join(folder, "run")):
                found.append("what was computed cannot be read")
            remove(os.path.join(folder, "thief"))
            subprocess.run(["mount", "-o", "remount,size=40m", folder], check=True)
            if stopped or os.path.exists(os.path.join(folder, "run", "checkpoint.h5")):
                found += goes_on(shop, [*words, *options], folder, whole, done)
            elif not thief or "what was written is kept" not in done.message:
                found.append(f"not stopped in time: {done.message!r}")
        finally:
            subprocess.run(["umount", folder], check=True)
        wrong += [f"{'beside a thief' if thief else 'alone'} {options}: {text}" for text in found]
    print(f"disk-full-goes-on: {in_time} of {len(trials)} runs stopped in time")
    if in_time < 2 + THIEVES:
        wrong.append("too few of the runs beside a thief stopped in time")
    return wrong


def goes_on(shop, words, folder, whole, done):
    """What is wrong with the way on from a run's checkpoint, now that there is room."""
    found = []
    if "--restart run/checkpoint.h5" not in done.message:
        found.append(f"no command to go on in {done.message!r}")
    rest = shop.run([*words, "--restart", "run/checkpoint.h5"], folder)
    if rest.code != 0:
        return [*found, f"the restart ends with {rest.code}: {rest.message}"]
    for name in ("run/forces.csv", "run/floe_1.csv"):
        if read(os.path.join(folder, name)) != read(os.path.join(whole, name)):
            found.append(f"after the restart {name} differs")
    return found + [f"{name} is left" for name in files_of(folder) if name.endswith(".part")]


def mount(folder, size):
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder],
                          capture_output=True, check=False)
    if done.returncode != 0:
        raise Skip("mount: " + done.stderr.decode("utf-8", "replace").strip())


def remove(path):
    if os.path.exists(path):
        os.remove(path)


def run_beside_thief(shop, words, folder):
    """A run of which another program takes all room once it is on its way."""
    with subprocess.Popen(shop.command(words), cwd=folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as child:
        while child.poll() is None and not os.path.exists(f"{folder}/run/forces.csv.part"):
            time.sleep(0.002)
        time.sleep(0.05)
        try:
            with open(os.path.join(folder, "thief"), "wb", buffering=0) as file:
                while file.write(bytes(4096)):
                    pass
        except OSError:  # no room is left
            pass
        _, message = child.communicate(timeout=300)
    return Result(child.returncode, message.decode("utf-8", "replace"))


@fault
def stdout_full(shop, _):
    """Data on standard output that cannot be written are no success."""
    wrong = []
    for words in (["spherize", "../in/floe.obj", "-o", "x.h5"],
                  ["spherize", "../in/floe.obj", "--check"],
                  ["icefield", "--print-defaults"], ["icefield", "../in/field.toml", "-o", "y.h5"],
                  ["icesolve", "--print-schema"], ["icesolve", "--help"],
                  ["icesolve", "--explain", "hull.speed"],
                  ["icesolve", "../in/case.cfg", "--json", "-q", "--out", "r", "--no-report"],
                  ["icepost", "check", "../in/run", "../in/expected.toml"],
                  ["icepost", "table", "../in/run"]):
        with open("/dev/full", "wb") as full:
            done = shop.run(words, shop.new_folder(), stdout=full)
        if done.code != 1 or "standard output" not in done.message:
            wrong.append(f"{' '.join(words)}: exit code {done.code}, {done.message!r}")
    return wrong


@fault
def read_only_folder(shop, _):
    """Nothing can be created in the folder of the outputs, or what should be a folder is a file."""
    wrong = []
    for job in JOBS:
        folder = shop.new_folder()
        os.chmod(folder, 0o555)
        done = shop.run(job.words, folder, preexec_fn=as_nobody)
        found = shop.faults(job, folder, done)
        if done.code != 1:
            found.append(f"exit code {done.code}, not 1")
        wrong += [f"{job.name} in a read-only folder: {text}" for text in found]
    for words, option in ((["spherize", "../in/floe.obj"], "-o"),
                          (["icefield", "../in/field.toml"], "-o"),
                          (["icesolve", "../in/case.cfg"], "--out"),
                          (["icepost", "plot", "../in/run"], "-o"),
                          (["icepost", "paraview", "../in/run"], "-o")):
        for target in ("../in/floe.obj/x", "missing/x/y.h5", "/proc/x"):
            if option == "--out" and target.startswith("missing"):
                continue  # icesolve makes its folder
            if words[1] == "paraview" and target.startswith("missing"):
                continue  # and so does this
            if words[1] == "plot":
                target += ".svg"  # another suffix is refused before
            folder = shop.new_folder()
            done = shop.run([*words, option, target], folder)
            name = os.path.basename(target)
            if done.code != 1 or not has_remedy(done.message) or name not in done.message:
                wrong.append(f"{words} {option} {target}: exit code {done.code}, {done.message!r}")
    return wrong


@fault
def unreadable_file(shop, _):
    """An input without permission, a folder in its place, or nothing."""
    wrong = []
    for job in JOBS:
        for name in job.inputs:
            path = os.path.join(shop.inputs, name)
            kept = path + ".kept"
            for obstacle in ("no permission", "a folder", "missing"):
                os.rename(path, kept)
                try:
                    if obstacle == "no permission":
                        shutil.copy(kept, path)
                        os.chmod(path, 0)
                    elif obstacle == "a folder":
                        os.mkdir(path)
                    folder = shop.new_folder()
                    os.chmod(folder, 0o777)
                    done = shop.run(job.words, folder, preexec_fn=as_nobody)
                finally:
                    if os.path.isdir(path):
                        os.rmdir(path)
                    elif os.path.exists(path):
                        os.remove(path)
                    os.rename(kept, path)
                if name == "run/summary.json" and job.name == "icepost report" and done.code == 0:
                    continue  # of a killed run there is none: the report says so
                found = shop.faults(job, folder, done)
                if done.code not in (1, 2) or os.path.basename(name) not in done.message:
                    found.append(f"exit code {done.code} without the file's name: {done.message!r}")
                wrong += [f"{job.name}, {name}: {obstacle}: {text}" for text in found]
    return wrong


def starts(shop, words, folder, amount):
    done = shop.run([words[0], "--version"], folder, preexec_fn=limit(resource.RLIMIT_AS, amount))
    return done.code == 0


@fault
def out_of_memory(shop, _):
    """Address space from what the program needs to start at all to what its job needs."""
    wrong = []
    for job in JOBS:
        words = job.words
        folder = shop.new_folder()
        low = 8 << 20
        while not starts(shop, words, folder, low):
            low += 2 << 20
        ended, amount = False, low
        while not ended:
            amount += max(1 << 20, (amount - low) // 6)
            folder = shop.new_folder()
            done = shop.run(words, folder, preexec_fn=limit(resource.RLIMIT_AS, amount))
            ended = done.code == 0
            found = shop.faults(job, folder, done)
            if not ended and "memory" not in done.message:
                found.append(f"exit code {done.code} without a word of memory: {done.message!r}")
            wrong += [f"{job.name} with {amount >> 20} MB: {text}" for text in found]
            if amount > 64 << 30:
                return wrong + [f"{job.name} never succeeds"]
    return wrong


FAULTS["sigterm"] = sigterm
FAULTS["sigkill"] = sigkill


def private_binaries(source, folder):
    """Copies that somebody else may run, wherever the build lies."""
    target = os.path.join(folder, "bin")
    os.mkdir(target)
    for name in ("spherize", "icefield", "iceflow", "icesolve", "icepost"):
        shutil.copy(os.path.join(source, name), target)
        os.chmod(os.path.join(target, name), stat.S_IRWXU | 0o055)
    return target


def main():
    parser = argparse.ArgumentParser(description="Makes the world around the programs fail.")
    parser.add_argument("--bin", required=True, metavar="DIR", help="where the programs lie")
    parser.add_argument("--fault", action="append", choices=sorted(FAULTS), default=[],
                        help="only this one; repeatable")
    parser.add_argument("--repetitions", type=int, default=100, help="of sigkill (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the times (%(default)s)")
    parser.add_argument("--examples", type=int, default=10, help="shown per fault (%(default)s)")
    options = parser.parse_args()
    os.environ.update(OMP_NUM_THREADS="2", LC_ALL="C")
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python's own setting is no user's
    sound, skipped = True, False
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        shop = Workshop(folder, private_binaries(options.bin, folder))
        for name in options.fault or FAULTS:
            try:
                wrong = FAULTS[name](shop, options)
            except Skip as reason:
                print(f"{name}: skipped, {reason}")
                skipped = True
                continue
            print(f"{name}: {'all good' if not wrong else f'{len(wrong)} wrong'}")
            for text in wrong[:options.examples]:
                print("    " + text)
            sys.stdout.flush()
            sound = sound and not wrong
    if not sound:
        return 1
    return SKIPPED if skipped and options.fault else 0


if __name__ == "__main__":
    assert os.path.isdir(MESHES)
    sys.exit(main())
