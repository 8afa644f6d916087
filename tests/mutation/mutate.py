#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants faults and asks for each whether a test notices; exit code 1 if more than 5 % are not.

    python3 tests/mutation/mutate.py --work build/mutation

Faults are those of mutants.toml, which people chose, and those of drawn.jsonl, which draw.py took
from the sources. Works on a copy of the tree with a build of its own; README.md says more.
"""
import argparse
import concurrent.futures
import dataclasses
import itertools
import json
import os
import re
import sys
import tomllib

import draw
from suites import Suites
from tree import Failure, Tree

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
GOAL = 0.95  # of the mutants


@dataclasses.dataclass(frozen=True)
class Mutant:
    """One fault: its places, which for a kernel with a twin are two."""
    number: int
    kind: str
    places: tuple
    drawn: bool

    @property
    def file(self):
        return self.places[0].file

    @property
    def id(self):
        """The same as long as its text is."""
        return [self.file, self.kind, self.places[0].old, self.places[0].new]


def chosen_places(number, entry):
    """The places of an entry of mutants.toml: text that occurs once."""
    for part in (entry, entry["twin"]) if "twin" in entry else (entry,):
        with open(os.path.join(ROOT, part["file"]), encoding="utf-8") as file:
            text = file.read()
        if text.count(part["old"]) != 1:
            raise Failure(f"mutant {number}: '{part['old']}' occurs {text.count(part['old'])} times"
                          f" in {part['file']}, should be once: mend tests/mutation/mutants.toml")
        begin = text.index(part["old"])
        yield draw.Fault(part["file"], begin, begin + len(part["old"]), entry["kind"], part["old"],
                         part["new"], part.get("type", "auto"))


def read_chosen(path):
    with open(path, "rb") as file:
        entries = tomllib.load(file)["mutant"]
    return [Mutant(k + 1, entry["kind"], tuple(chosen_places(k + 1, entry)), False)
            for k, entry in enumerate(entries)]


def read_survivors(path):
    """Faults that are known to change nothing that a test could see: their texts and the reason."""
    with open(path, "rb") as file:
        entries = tomllib.load(file).get("survivor", [])
    return {one_line(e["file"], e["old"], e["new"]): e["why"] for e in entries}


def one_line(*texts):
    """Without line breaks, as mutate.py prints a fault."""
    return tuple(" ".join(text.split()) for text in texts)


def text_of(fault):
    """What a fault is, wherever its file has it."""
    return one_line(fault.file, fault.kind, fault.old, fault.new)


def read_drawn(path):
    """Faults of an earlier draw, those whose text is still there."""
    with open(path, encoding="utf-8") as file:
        kept = [tuple(json.loads(line)) for line in file]
    there = {}
    for fault in draw.every_fault(ROOT):
        there.setdefault(text_of(fault), fault)
    return [there[text] for text in kept if text in there]


def write_drawn(path, mutants):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(json.dumps(text_of(m.places[0])) + "\n" for m in mutants if m.drawn)


def draw_mutants(chosen, drawn, count, seed, files):
    """`drawn`, then others up to `count`, and a third more in reserve for those that do not
    compile; none in the place of another. They are in few files, so that the build is not one of
    all sources."""
    taken = [place for mutant in chosen for place in mutant.places]
    out = []
    for fault in itertools.chain(drawn, draw.draw(ROOT, seed, files)):
        if len(out) < count + count // 3 and all(
                fault.file != t.file or fault.end <= t.begin or t.end <= fault.begin
                for t in taken):
            out.append(fault)
            taken.append(fault)
    return [Mutant(len(chosen) + 1 + k, fault.kind, (fault,), True) for k, fault in enumerate(out)]


class Results:
    """What each mutant met, kept in a file so that a run can go on where another ended."""

    def __init__(self, path):
        self.path = path
        self.noticed = {}
        if os.path.isfile(path):
            with open(path, encoding="utf-8") as file:
                for line in file:
                    key, value = json.loads(line)
                    self.noticed[json.dumps(key)] = value

    def get(self, mutant):
        return self.noticed.get(json.dumps(mutant.id), "not tried")

    def put(self, mutant, value):
        self.noticed[json.dumps(mutant.id)] = value
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps([mutant.id, value]) + "\n")


def row(cells):
    return "| " + " | ".join(" ".join(str(c).split()).replace("|", "\\|") for c in cells) + " |"


def is_known(mutant, survivors):
    place = mutant.places[0]
    return one_line(mutant.file, place.old, place.new) in survivors


def try_all(mutants, suites, results, jobs, survivors):
    """Asks the tests of each mutant's folder first; prints a row for each.

    Known survivors are not asked: each would cost the time of all tests. What a quick run does not
    notice is not kept: the slow tests may."""
    print(row(["", "file", "kind", "from", "to", "noticed by"]))
    print(row(["---"] * 6), flush=True)
    open_ones = [m for m in mutants
                 if results.get(m) == "not tried" and not is_known(m, survivors)]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for mutant, noticed in zip(open_ones, pool.map(suites.try_on, open_ones)):
            if noticed or not suites.quick_only:
                results.put(mutant, noticed)
            place = mutant.places[0]
            print(row([mutant.number, mutant.file, mutant.kind, f"`{place.old[:100]}`",
                       f"`{place.new[:100]}`", noticed or "**no test**"]), flush=True)


def judge(mutants, results, survivors):
    """Prints how many are caught; the exit code."""
    known = [m for m in mutants if is_known(m, survivors)]
    counted = [m for m in mutants if results.get(m) != "not tried" and m not in known]
    caught = sum(results.get(m) is not None for m in counted)
    print(f"\nof {len(mutants)} mutants {len(known)} are known to change nothing (survivors.toml); "
          f"of {len(counted)} others that were tried {caught} are caught"
          + (f", {100 * caught / len(counted):.1f} %" if counted else ""))
    for mutant in counted:
        if results.get(mutant) is None:
            print(f"not noticed: {mutant.number}, {mutant.file}, {mutant.kind}: "
                  f"{' '.join(mutant.places[0].old.split())} -> "
                  f"{' '.join(mutant.places[0].new.split())}")
    return 0 if caught >= GOAL * len(counted) else 1


def parse():
    parser = argparse.ArgumentParser(description="Plants faults and asks whether tests notice.")
    parser.add_argument("--work", required=True, metavar="DIR", help="for the copy and its build")
    parser.add_argument("--mutants", default=os.path.join(HERE, "mutants.toml"), metavar="TOML")
    parser.add_argument("--drawn", type=int, default=120, metavar="N",
                        help="how many to draw from the sources (%(default)s)")
    parser.add_argument("--seed", type=int, metavar="N",
                        help="draw all of them by this seed, not those of drawn.jsonl")
    parser.add_argument("--files", type=int, default=45, metavar="N",
                        help="from how many sources to draw them, which are drawn, too "
                        "(%(default)s)")
    parser.add_argument("--only", type=int, nargs=2, metavar=("FIRST", "LAST"),
                        help="only these numbers")
    parser.add_argument("--preset", default="release", help="of the build (%(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of build and tests")
    parser.add_argument("--anew", action="store_true", help="forget the results of an earlier run")
    parser.add_argument("--quick", action="store_true",
                        help="ask the first choice of tests only: what it misses may be caught")
    parser.add_argument("--list", action="store_true", help="print the mutants, plant nothing")
    parser.add_argument("--check", action="store_true", help="only look for the places")
    return parser.parse_args()


def check(chosen):
    """The places are there, and a draw has faults of all kinds and folders, the same each time."""
    first, again = (list(itertools.islice(draw.draw(ROOT, 1), 200)) for _ in range(2))
    folders = {fault.file.split("/")[0] for fault in first}
    if first != again or {f.kind for f in first} != set(draw.KINDS) or len(folders) < 4:
        raise Failure("draw.py draws from few folders or kinds, or differently each time")
    print(f"all {len(chosen)} places are there, and faults can be drawn")


def main():
    options = parse()
    try:
        chosen = read_chosen(options.mutants)
        survivors = read_survivors(os.path.join(HERE, "survivors.toml"))
        if options.check:
            check(chosen)
            return 0
        listed = os.path.join(HERE, "drawn.jsonl")
        drawn = read_drawn(listed) if options.seed is None else []
        mutants = chosen + draw_mutants(chosen, drawn, options.drawn, options.seed or 1,
                                        options.files)
        if options.list:
            for m in mutants[:len(chosen) + options.drawn]:
                print(m.number, *(" ".join(part.split()) for part in m.id), sep="\t")
            return 0
        tree = Tree(ROOT, os.path.abspath(options.work), options.jobs, options.preset)
        mutants = tree.build(mutants)[:len(chosen) + options.drawn]
        if options.seed is None and options.drawn >= len(drawn):
            write_drawn(listed, mutants)  # with those that came in the place of what is gone
        path = os.path.join(tree.work, "results.jsonl")
        if options.anew and os.path.isfile(path):
            os.remove(path)
        if options.only:
            mutants = [m for m in mutants if options.only[0] <= m.number <= options.only[1]]
        results = Results(path)
        try_all(mutants, Suites(tree, options.quick), results, options.jobs, survivors)
    except Failure as failure:
        print(f"mutate.py: {failure}", file=sys.stderr)
        return 2
    return judge(mutants, results, survivors)


if __name__ == "__main__":
    sys.exit(main())
