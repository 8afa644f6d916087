#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Damages closed meshes and asks whether spherize repairs or refuses them; exit code 1 if not.

    python3 tests/damage/damage.py --spherize build/release/bin/spherize --count 1000 --seed 1

Every copy is given to `spherize COPY --check --json FILE -q`; README.md says what the kinds of
damage are, which of them are repairable and what the answers are called.
"""
import argparse
import glob
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import damage_mesh

try:
    import check_spheres
except ImportError as missing:  # numpy, h5py: volumes are compared, places are not
    check_spheres = None
    print(f"spheres and distances are not checked: {missing}", file=sys.stderr)

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
VOLUME_TOLERANCE = 0.01
FAULTS = ["wrong", "outside", "far", "silent", "mute", "crash", "hang"]  # never allowed
ANSWERS = ["good", "refused"] + FAULTS
MUST_BE_TOLD = {"delete", "hole", "flip", "duplicate", "nan"}  # a repair that has to be listed


def ask(program, copy, timeout, options=("--check",)):
    """Runs spherize on a file; its exit code (None: hang), what it wrote to stderr, its JSON."""
    report = copy + ".json"
    try:
        done = subprocess.run([program, copy, *options, "--json", report, "-q"], timeout=timeout,
                              stdin=subprocess.DEVNULL, capture_output=True, check=False)
    except subprocess.TimeoutExpired:
        return None, "no answer within the time limit", None
    try:
        with open(report, encoding="utf-8") as file:
            found = json.load(file)
    except (OSError, ValueError):
        found = None
    return done.returncode, done.stderr.decode("utf-8", "replace"), found


def classify(done, volume, code, message, report):
    """Name of the answer to these kinds of damage, and one line on it."""
    first = message.strip().splitlines()[0] if message.strip() else "no message"
    if code is None:
        return "hang", first
    if code == 2:  # "where: what is wrong", then the remedy on a line of its own
        return ("refused" if len(message.strip().splitlines()) > 1 else "mute"), first
    if code != 0:
        return "crash", f"exit code {code}: {first}"
    got = report.get("volume_m3") if isinstance(report, dict) else None
    if not isinstance(got, (int, float)):
        return "wrong", "exit code 0 without a volume"
    error = abs(got - volume) / volume
    if not error <= VOLUME_TOLERANCE:
        return "wrong", f"volume {got:.6g} m3, true {volume:.6g} m3 ({error:.1%} off)"
    if MUST_BE_TOLD.intersection(done) and not report.get("repairs"):
        return "silent", "repaired, but no repair is listed"
    return "good", f"volume off by {error:.1e}"


class Trial:
    """One mesh; its damaged copies are made, tried and judged by index."""

    def __init__(self, path, options):
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.path, self.options = path, options
        self.mesh = damage_mesh.read_obj(path)
        low, high = (list(map(f, zip(*self.mesh.vertices))) for f in (min, max))
        self.radius = max(h - m for m, h in zip(low, high)) / 50

    def run(self, index):
        kind, done, ending, data, truth = damage_mesh.damaged_copy(self.mesh, self.name,
                                                                   self.options.seed, index)
        stem = f"{self.name}-{index}-" + "+".join(done)
        # every kind in turn
        rounds = self.options.places_every
        places = rounds > 0 and index // len(damage_mesh.KINDS) % rounds == 0
        answer, line = self.judge(done, f"{stem}.{ending}", data, truth, places)
        if self.options.keep and (failed(kind, answer) or self.options.index is not None):
            self.save(stem, ending, data, answer, line)
        return kind, index, answer, line

    def judge(self, done, name, data, truth, places):
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, name)
            with open(copy, "wb") as file:
                file.write(data)
            answer, line = classify(done, damage_mesh.volume_of(truth),
                                    *ask(self.options.spherize, copy, self.options.timeout))
            if answer == "good" and places and check_spheres:
                answer, line = self.judge_places(copy, truth) or (answer, line)
        return answer, line.replace(folder + os.sep, "")

    def judge_places(self, copy, truth):
        """Whether spheres stand outside, or the solid is farther from its source than R, unsaid."""
        spheres = copy + ".h5"
        code, message, report = ask(
            self.options.spherize, copy, self.options.timeout,
            ["-r", repr(self.radius), "-o", spheres,
             "--up", "z", "--forward", "+x", "--units", "m"])
        if code == 2:
            return "refused", message.strip().splitlines()[0]
        if code != 0:
            return "crash" if code is not None else "hang", message
        if not os.path.exists(spheres):
            return "wrong", "exit code 0 without a sphere set"
        fault = check_spheres.judge(spheres, truth, self.radius)
        return None if fault and fault[0] == "far" and report["warnings"] else fault

    def undamaged(self):
        """The mesh itself must be good, or the rest means nothing."""
        return self.judge([], self.name + ".obj", damage_mesh.obj_bytes(self.mesh),
                          [(self.mesh.vertices, self.mesh.triangles)],
                          self.options.places_every > 0)

    def save(self, stem, ending, data, answer, line):
        os.makedirs(self.options.keep, exist_ok=True)
        with open(os.path.join(self.options.keep, f"{stem}.{ending}"), "wb") as file:
            file.write(data)
        with open(os.path.join(self.options.keep, f"{stem}.txt"), "w", encoding="utf-8") as file:
            file.write(f"{answer}: {line}\n")


def failed(kind, answer):
    return answer in FAULTS or (answer == "refused" and kind not in damage_mesh.HOPELESS)


def print_table(name, results):
    print(f"\n{name}\n{'':12}{'copies':>8}" + "".join(f"{answer:>9}" for answer in ANSWERS))
    for kind in damage_mesh.KINDS:
        counts = Counter(answer for k, _, answer, _ in results if k == kind)
        if counts:
            print(f"{kind:12}{sum(counts.values()):8}"
                  + "".join(f"{counts[answer] or '-':>9}" for answer in ANSWERS))


def print_examples(trial, results, most):
    """How to see again what failed: a few copies of each kind and answer."""
    shown = Counter()
    for kind, index, answer, line in results:
        if not failed(kind, answer):
            continue
        shown[kind, answer] += 1
        if shown[kind, answer] <= most:
            print(f"  {kind} {answer}: --meshes {os.path.relpath(trial.path)} "
                  f"--seed {trial.options.seed} --index {index}\n    {line}")


def parse_options():
    parser = argparse.ArgumentParser(description="Tries spherize on damaged copies of meshes.")
    parser.add_argument("--spherize", required=True, metavar="PROGRAM")
    parser.add_argument("--meshes", nargs="+", metavar="OBJ",
                        default=sorted(glob.glob(os.path.join(ROOT, "meshes", "*.obj"))),
                        help="closed meshes (default: meshes/*.obj)")
    parser.add_argument("--count", type=int, default=1000, help="copies of each mesh (%(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--index", type=int, help="only this copy")
    parser.add_argument("--kinds", nargs="+", choices=damage_mesh.KINDS, metavar="KIND",
                        default=damage_mesh.KINDS, help="only these of the copies")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time")
    parser.add_argument("--timeout", type=float, default=60.0,
                        help="seconds per copy (%(default)s)")
    parser.add_argument("--at-least", type=float, default=99.0, metavar="PERCENT",
                        help="of the repairable copies to be good (%(default)s)")
    parser.add_argument("--places-every", type=int, default=10, metavar="N",
                        help="fill the copies of every Nth round of kinds and check where "
                        "their spheres are (%(default)s); 0: none")
    parser.add_argument("--keep", metavar="DIR", help="save the copies that fail there; with "
                        "--index, that copy in any case")
    parser.add_argument("--examples", type=int, default=2, help="failures shown per kind")
    options = parser.parse_args()
    options.spherize = os.path.abspath(options.spherize)
    if not os.access(options.spherize, os.X_OK):
        parser.error(f"--spherize {options.spherize} is no program: build it first")
    if options.count < 1 or options.jobs < 1 or not options.meshes:
        parser.error("nothing to do: give --count and --jobs of 1 or more, and a mesh")
    return options


def main():
    options = parse_options()
    indices = range(options.count) if options.index is None else [options.index]
    kinds = damage_mesh.KINDS
    indices = [index for index in indices if kinds[index % len(kinds)] in options.kinds]
    everything, sound = [], True
    with ThreadPoolExecutor(options.jobs) as pool:
        for path in options.meshes:
            trial = Trial(path, options)
            answer, line = trial.undamaged()
            if answer != "good":
                print(f"{path}: the undamaged mesh is {answer}: {line}", file=sys.stderr)
                sound = False
                continue
            results = list(pool.map(trial.run, indices))
            print_table(trial.name, results)
            print_examples(trial, results, options.examples)
            sys.stdout.flush()
            everything += results

    hoped = [answer for kind, _, answer, _ in everything if kind not in damage_mesh.HOPELESS]
    faults = sum(answer in FAULTS for _, _, answer, _ in everything)
    share = 100.0 * hoped.count("good") / len(hoped) if hoped else 100.0
    print(f"\n{hoped.count('good')} of {len(hoped)} repairable copies are good: {share:.2f} % "
          f"(at least {options.at_least:g}); {faults} of {len(everything)} copies wrong, outside, "
          "far, silent, mute, crashed or hanging")
    return 0 if sound and faults == 0 and share >= options.at_least else 1


if __name__ == "__main__":
    sys.exit(main())
