#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants the faults of mutants.toml and asks for each whether a test notices; exit code 1 if one is
not noticed.

    python3 tests/mutation/mutate.py --work build/mutation

Works on a copy of the tree with a build of its own; README.md says more.
"""
import argparse
import os
import re
import subprocess
import sys
import tomllib

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# The tests that may notice a fault in a folder, the quick and likely ones first: a program, or one
# with a choice of its tests.
SOLVER = ["solver_tests", "validation_tests"]
SUITES = {
    "solver/contact": ["solver_tests [sweep],[contact],[crushing]", *SOLVER],
    "solver/integrate": ["solver_tests [integrate]", *SOLVER],
    "solver/water": ["solver_tests [water]", *SOLVER],
    "solver/broad": ["solver_tests [broad]", *SOLVER],
    "solver/narrow": ["solver_tests [patch]", "solver_tests [narrow]", *SOLVER],
    "solver/record": ["solver_tests [record]", *SOLVER],
    "preprocess/fill": ["preprocess_tests [equivalence]", "preprocess_tests [analytic]",
                        "preprocess_tests"],
    "preprocess/measure": ["preprocess_tests [analytic]", "preprocess_tests"],
    "common/geometry": ["common_tests", "preprocess_tests"],
}

# All faults are built in at once; one is chosen when a test runs ("mutant schemata").
SWITCH = """// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdlib>
namespace ice {
inline const int kMutant = [] {
    const char* const text = std::getenv("ICE_MUTANT");
    return text != nullptr ? std::atoi(text) : 0;
}();
}  // namespace ice
"""
INCLUDE = '#include "common/base/mutant.hpp"\n'


class Failure(Exception):
    """Something is wrong with the check itself, not with a mutant."""


def run(command, folder, timeout=None, env=None):
    """Exit code (None: no end within `timeout` seconds) and what was written."""
    try:
        done = subprocess.run(command, cwd=folder, timeout=timeout, env=env, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
    except subprocess.TimeoutExpired as late:
        return None, (late.stdout or b"").decode("utf-8", "replace")
    return done.returncode, done.stdout.decode("utf-8", "replace")


class Tree:
    """A copy of the sources and its build."""

    def __init__(self, work, jobs):
        self.source = os.path.join(work, "tree")
        self.build = os.path.join(self.source, "build", "release")
        self.jobs = jobs
        self.ready = set()
        # a compiler cache may then know the objects of the tree that was copied
        self.env = dict(os.environ, CCACHE_BASEDIR=self.source, CCACHE_NOHASHDIR="1")

    def copy_sources(self, mutants):
        """Makes the copy with all mutants in it, or brings it up to date; what is equal keeps its
        time."""
        code, listing = run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], ROOT)
        if code != 0:
            raise Failure(f"git ls-files fails in {ROOT}: {listing}")
        texts = {"common/base/mutant.hpp": SWITCH.encode()}
        for name in listing.split("\n"):
            path = os.path.join(ROOT, name)
            if name and os.path.isfile(path):
                with open(path, "rb") as file:
                    texts[name] = file.read()
        for mutant in mutants:
            text = mutant.plant(texts[mutant.file].decode())
            if INCLUDE not in text:
                text = INCLUDE + text
            texts[mutant.file] = text.encode()
        for name, text in texts.items():
            path = os.path.join(self.source, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            if not os.path.isfile(path) or slurp(path) != text:
                with open(path, "wb") as file:
                    file.write(text)
                os.chmod(path, 0o755 if text.startswith(b"#!") else 0o644)

    def configure(self):
        code, text = run(["cmake", "--preset", "release"], self.source, env=self.env)
        if code != 0:
            raise Failure(f"cmake --preset release fails:\n{text}")

    def prepare(self, suite, timeout):
        """Builds a test program before its first use, and sees that it passes without a fault."""
        if suite in self.ready:
            return
        code, text = run(["cmake", "--build", self.build, "-j", str(self.jobs), "--target",
                          suite.split()[0]], self.source, env=self.env)
        if code != 0:
            raise Failure("the tree with the mutants does not build:\n" + text[-3000:])
        noticed = self.test(suite, timeout)
        if noticed:
            raise Failure("with no mutant chosen a test fails: " + noticed)
        self.ready.add(suite)

    def test(self, suite, timeout, mutant=0):
        """None when all tests pass, else what noticed: a test's name."""
        program, *choice = suite.split()
        code, text = run([os.path.join(self.build, "tests", program), *choice, "--abort", "-r",
                          "xml"], self.build, timeout, dict(self.env, ICE_MUTANT=str(mutant)))
        if code == 0:
            return None
        names = re.findall(r'<TestCase name="([^"]*)"', text)
        name = names[-1] if names else "before the first test"
        for entity, sign in (("&quot;", '"'), ("&lt;", "<"), ("&gt;", ">"), ("&amp;", "&")):
            name = name.replace(entity, sign)
        end = "" if code is not None and code > 0 else " (hangs)" if code is None else " (crash)"
        return f"{program}: {name}{end}"


def slurp(path):
    with open(path, "rb") as file:
        return file.read()


class Mutant:
    """One fault: a place in a file and what it becomes."""

    def __init__(self, number, entry):
        self.number, self.file, self.kind = number, entry["file"], entry["kind"]
        self.old, self.new, self.type = entry["old"], entry["new"], entry.get("type", "")
        self.suites = SUITES[os.path.dirname(self.file)]

    def plant(self, text):
        """A file's text with both expressions, of which ICE_MUTANT chooses."""
        if text.count(self.old) != 1:
            raise Failure(f"mutant {self.number}: '{self.old}' occurs {text.count(self.old)} times "
                          f"in {self.file}, should be once: mend tests/mutation/mutants.toml")
        new, old = f"{self.type}({self.new})", f"{self.type}({self.old})"
        both = f"(ice::kMutant == {self.number} ? {new} : {old})"
        return text.replace(self.old, both)

    def try_on(self, tree, timeout):
        """The test that notices, or None."""
        for suite in self.suites:
            tree.prepare(suite, timeout)
            noticed = tree.test(suite, timeout, self.number)
            if noticed:
                return noticed
        return None


def read_mutants(path, only):
    with open(path, "rb") as file:
        entries = tomllib.load(file)["mutant"]
    mutants = [Mutant(k + 1, entry) for k, entry in enumerate(entries)]
    for mutant in mutants:  # all places are looked at before the build
        with open(os.path.join(ROOT, mutant.file), encoding="utf-8") as file:
            mutant.plant(file.read())
    return mutants, [mutant for mutant in mutants if not only or mutant.number in only]


def row(cells):
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"


def check(tree, mutants, timeout):
    """Prints the table; how many are caught."""
    print(row(["", "file", "kind", "from", "to", "noticed by"]))
    print(row(["---"] * 6), flush=True)
    caught = 0
    for mutant in mutants:
        noticed = mutant.try_on(tree, timeout)
        caught += noticed is not None
        print(row([mutant.number, mutant.file, mutant.kind, f"`{mutant.old}`", f"`{mutant.new}`",
                   noticed or "**no test**"]), flush=True)
    return caught


def main():
    parser = argparse.ArgumentParser(description="Plants faults and asks whether tests notice.")
    parser.add_argument("--work", required=True, metavar="DIR", help="for the copy and its build")
    parser.add_argument("--mutants", default=os.path.join(HERE, "mutants.toml"), metavar="TOML")
    parser.add_argument("--only", type=int, nargs="+", metavar="N", help="only these mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the build")
    parser.add_argument("--timeout", type=float, default=900.0,
                        help="seconds for one test program (%(default)s)")
    parser.add_argument("--quick", action="store_true",
                        help="ask the first choice of tests only: what it misses may be caught")
    parser.add_argument("--check", action="store_true", help="only look for the places")
    options = parser.parse_args()
    try:
        every, mutants = read_mutants(options.mutants, options.only)
        if options.check:
            print(f"all {len(every)} places are there")
            return 0
        if options.quick:
            for mutant in mutants:
                mutant.suites = mutant.suites[:1]
        tree = Tree(os.path.abspath(options.work), options.jobs)
        tree.copy_sources(every)
        tree.configure()
        caught = check(tree, mutants, options.timeout)
    except Failure as failure:
        print(f"mutate.py: {failure}", file=sys.stderr)
        return 2
    print(f"\n{caught} of {len(mutants)} mutants are caught")
    return 0 if caught == len(mutants) else 1


if __name__ == "__main__":
    sys.exit(main())
