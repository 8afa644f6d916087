# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs ended from outside: SIGTERM and SIGKILL at random times of a fixed seed."""
import json
import os
import random
import shutil
import signal
import subprocess
import time

from jobs import JOBS, Result, files_of, has_remedy, read

CHECKPOINTS = ["--checkpoint-every", "0.05"]  # every tenth step: the kill often falls into one


def end_after(shop, words, folder, seconds, how, once=None):
    """Starts a program and sends it a signal after some time, counted from when the file `once` is
    there if one is named."""
    started = time.monotonic()
    with subprocess.Popen(shop.command(words), cwd=folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as child:
        while once and child.poll() is None and not os.path.exists(os.path.join(folder, once)):
            time.sleep(0.002)
        try:
            _, message = child.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            child.send_signal(how)
            _, message = child.communicate(timeout=300)
    took = time.monotonic() - started
    return Result(child.returncode, message.decode("utf-8", "replace")), took


def left_alone(shop, words):
    """How long a program takes [s], and what it leaves: file name -> bytes."""
    folder = shop.new_folder()
    started = time.monotonic()
    shop.must(words, folder)
    took = time.monotonic() - started
    left = {name: read(os.path.join(folder, name)) for name in files_of(folder)}
    shutil.rmtree(folder)
    return took, left


def sigterm(shop, options):
    """SIGTERM: 130 and no file half-written; icesolve leaves a checkpoint and goes on from it."""
    draw, wrong = random.Random(options.seed), []
    for job in JOBS:
        whole, _ = left_alone(shop, job.words)
        for _ in range(10):
            folder = shop.new_folder()
            done, _ = end_after(shop, job.words, folder, draw.uniform(0.0, whole), signal.SIGTERM)
            if done.code == -signal.SIGTERM and not files_of(folder):
                continue  # before main() had begun
            if done.code == 130 and "interrupted" in done.message:
                done.code, done.message = 1, "error: interrupted\n  remedy"  # as faults() wants it
            wrong += [f"{job.name}: {text}" for text in shop.faults(job, folder, done)]
    return wrong


def go_on(shop, folder, good):
    """Goes on from the checkpoint, if there is one: the files must be those of the whole run."""
    checkpoint = os.path.join(folder, "run", "checkpoint.h5")
    if not os.path.exists(checkpoint):
        return []
    done = shop.run(["icesolve", "../in/case.cfg", "--restart", "run/checkpoint.h5", "--no-report",
                     *CHECKPOINTS], folder)
    if done.code != 0:
        return [f"the restart ends with {done.code}: {done.message}"]
    wrong = []
    with open(os.path.join(folder, "run", "summary.json"), encoding="utf-8") as file:
        if json.load(file)["state_hash"] != json.loads(good["run/summary.json"])["state_hash"]:
            wrong.append("the restart ends in another state")
    for name in ("run/forces.csv", "run/floe_1.csv"):
        if read(os.path.join(folder, name)) != good[name]:
            wrong.append(f"after the restart {name} differs")
    return wrong + [f"{name} is left" for name in files_of(folder) if name.endswith(".part")]


def is_torn(shop, folder):
    """Can run.h5.part not be read, because the kill came while HDF5 wrote to it? Then icepost must
    say so; the rows of the last checkpoint are in files of their own."""
    part = os.path.join(folder, "run", "run.h5.part")
    if not os.path.exists(part) or shop.can_be_read(os.path.join(folder, "run")):
        return False, []
    done = shop.run(["icepost", "plot", "run", "-o", "try.svg"], folder)
    if done.code == 2 and "run.h5.part" in done.message and has_remedy(done.message):
        return True, []
    return True, [f"icepost ends with {done.code} on run.h5.part: {done.message!r}"]


def sigkill(shop, options):
    """SIGKILL at any time: no final file that is not whole, and the same bits after a restart."""
    job = next(job for job in JOBS if job.name == "icesolve")
    words = [*job.words[:4], "--no-report", *CHECKPOINTS]
    draw, wrong, killed, went_on, torn, runs = random.Random(options.seed), [], 0, 0, 0, 0
    whole, good = left_alone(shop, words)
    while killed < options.repetitions and runs < 4 * options.repetitions:
        runs += 1
        folder = shop.new_folder()
        # every other one while it steps: to start takes most of the time where a program is slow
        once = "run/checkpoint.h5" if runs % 2 else None
        after = draw.uniform(0.0, whole / 4 if once else whole)
        done, took = end_after(shop, words, folder, after, signal.SIGKILL, once)
        if done.code != -signal.SIGKILL:
            whole = took  # it ended first: the machine has less to do now
            shutil.rmtree(folder)
            continue
        killed += 1
        found = [f"{name} is not whole" for name in files_of(folder)
                 if not name.endswith(".part") and
                 not shop.is_whole(os.path.join(folder, name), good.get(name, b""), 1)]
        is_so, more = is_torn(shop, folder)
        torn += is_so
        found += more
        went_on += os.path.exists(os.path.join(folder, "run", "checkpoint.h5"))
        found += go_on(shop, folder, good)
        wrong += [f"kill {killed}, after {after:.3f} s: {text}" for text in found]
        shutil.rmtree(folder)
    print(f"sigkill: {killed} of {runs} runs were killed before they ended; of the killed ones "
          f"{went_on} had a checkpoint, {torn} a torn run.h5.part")
    if killed < options.repetitions or went_on < options.repetitions // 4:
        wrong.append("too few of the runs were killed in time to mean anything")
    return wrong
