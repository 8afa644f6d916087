# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests that may notice a fault, the quick and likely ones first.

Without a fault all tests pass and their times are taken; a test that lasts a multiple of its time
with a fault hangs and has noticed, too. A fault meets the tests of its folder, then the other quick
ones of the programs that its code is in, then the slow ones."""
import json
import os
import re

from tree import Failure, run

QUICK = 1.0  # [s] a test that is asked of every mutant
# Scripts that are tests, with their arguments: of the files' values, and of what a terminal shows.
SCRIPTS = {"values": ["tests/values/values_test.py", "{bin}", "{source}", "--stop"],
           "terminal": ["tests/cli/terminal_test.py", "{bin}/spherize", "{bin}/icesolve",
                        "{source}"]}
FIRST = {
    "common/cli": ["terminal"],
    "solver/contact": ["solver_tests [sweep],[contact],[crushing]"],
    "solver/loads": ["solver_tests [integrate]"],
    "solver/integrate": ["solver_tests [integrate]"],
    "solver/water": ["solver_tests [water]"],
    "solver/broad": ["solver_tests [broad]"],
    "solver/narrow": ["solver_tests [patch]", "solver_tests [narrow]"],
    "solver/record": ["solver_tests [record],[energy]"],
    "solver/draft": ["solver_tests [draft]"],
    "solver/run": ["flow_tests [file]"],
    "solver/iceflow.cpp": ["cli_tests [flow]"],
    "solver/ship": ["solver_tests [ship]"],
    "solver/case": ["solver_tests [case]"],
    "solver/scene": ["solver_tests [scene]"],
    "solver/bending": ["solver_tests [bending]"],
    "solver/level_ice": ["solver_tests [level_ice]"],
    "solver/flow": ["flow_tests"],
    "solver/live_edge": ["solver_tests [edge],[strip]"],
    "preprocess/fill": ["preprocess_tests [equivalence]", "preprocess_tests [analytic]",
                        "preprocess_tests [edges]"],
    "preprocess/measure": ["preprocess_tests [analytic]"],
    "common/formats": ["common_tests [formats]"],
    "common/toml": ["common_tests [toml]"],
    "postprocess/views": ["postprocess_tests [views]"],
    "postprocess/statistics": ["postprocess_tests [statistics]"],
    "postprocess/report": ["postprocess_tests [report]"],
    "postprocess/paraview": ["postprocess_tests [paraview]"],
    "postprocess/attain": ["postprocess_tests [hv]"],
    "postprocess/sweep": ["postprocess_tests [sweep]"],
}
PROGRAMS = {
    "solver": ["solver_tests", "flow_tests", "cli_tests", "values", "validation_tests"],
    "common": ["common_tests", "solver_tests", "preprocess_tests", "field_tests",
               "postprocess_tests", "flow_tests", "cli_tests", "values", "validation_tests"],
    "postprocess": ["postprocess_tests", "cli_tests", "values"],
    "preprocess": ["preprocess_tests", "field_tests", "cli_tests", "values"],
}


class Suites:
    def __init__(self, tree, quick_only=False):
        self.tree, self.quick_only = tree, quick_only
        self.times = {}  # of each program's tests, in seconds
        self.known = set()  # lists of tests of which the program knows all

    def try_on(self, mutant):
        """The test that notices, or None."""
        folder = "/".join(mutant.file.split("/")[:2])
        for choice in FIRST.get(folder, []):
            if choice in SCRIPTS:
                if noticed := self.script(choice, mutant.number):
                    return noticed
                continue
            program, tags = (choice + " ").split(" ", 1)
            self.measure(program)
            noticed = self.ask(program, mutant.number, [tags.strip()] if tags.strip() else [])
            if noticed:
                return noticed
        programs = PROGRAMS[folder.split("/")[0]]
        for slow in (False,) if self.quick_only else (False, True):
            for program in programs:
                noticed = self.ask_of(program, mutant.number, slow)
                if noticed:
                    return noticed
        return None

    def ask_of(self, program, number, slow):
        if program in SCRIPTS:
            return self.script(program, number) if not slow else None
        self.measure(program)
        names = [n for n, seconds in self.times[program].items() if (seconds > QUICK) == slow]
        if not names:
            return None
        listing = os.path.join(self.tree.work, f"{program}-{number}.txt")
        with open(listing, "w", encoding="utf-8") as file:
            # a comma would end a name of the list
            file.writelines(name.replace(",", "\\,") + "\n" for name in names)
        try:
            self.require_known(program, slow, listing, len(names))
            return self.ask(program, number, ["-f", listing])
        finally:
            os.remove(listing)

    def require_known(self, program, slow, listing, count):
        """A name that the program does not find would be a test that never runs."""
        if (program, slow) in self.known:
            return
        _, text = run([os.path.join(self.tree.folder, "tests", program), "-f", listing,
                       "--list-test-names-only"], self.tree.folder, 60, self.tree.env)
        found = len(text.splitlines())
        if found != count:
            raise Failure(f"{program}: of {count} tests {found} are found by their names")
        self.known.add((program, slow))

    def measure(self, program):
        """Runs all tests without a fault, once for each build of a program."""
        if program in self.times:
            return
        path = os.path.join(self.tree.folder, "tests", program)
        stamp = os.path.getmtime(path)
        saved = os.path.join(self.tree.work, program + ".times.json")
        if os.path.isfile(saved):
            with open(saved, encoding="utf-8") as file:
                kept = json.load(file)
            if kept["stamp"] == stamp:
                self.times[program] = kept["times"]
                return
        code, text = self.run_tests(program, 0, [], 3600)
        times = {clear(name): float(seconds) for name, seconds in re.findall(
            r'<TestCase name="([^"]*)".*?<OverallResult success="true" durationInSeconds="([^"]*)"',
            text, re.S)}
        if code != 0 or not times:
            raise Failure(f"with no mutant chosen {program} fails:\n" + text[-2000:])
        with open(saved, "w", encoding="utf-8") as file:
            json.dump({"stamp": stamp, "times": times}, file)
        self.times[program] = times

    def run_tests(self, program, number, choice, timeout):
        environment = dict(self.tree.env, ICE_MUTANT=str(number), OMP_NUM_THREADS="1")
        return run([os.path.join(self.tree.folder, "tests", program), *choice, "--abort", "-r",
                    "xml", "-d", "yes"], self.tree.folder, timeout, environment)

    def ask(self, program, number, choice):
        """None when all tests of a choice pass, else what noticed: a test's name."""
        code, text = self.run_tests(program, number, choice,
                                    60 + 5 * sum(self.times[program].values()))
        if code == 0:
            return None
        names = re.findall(r'<TestCase name="([^"]*)"', text)
        end = "" if code is not None and code > 0 else " (hangs)" if code is None else " (crash)"
        return f"{program}: {clear(names[-1]) if names else 'before the first test'}{end}"

    def script(self, name, number):
        """A test that is a script: what it says where it notices."""
        script, *words = SCRIPTS[name]
        places = {"bin": os.path.join(self.tree.folder, "bin"), "source": self.tree.source}
        environment = dict(self.tree.env, ICE_MUTANT=str(number), OMP_NUM_THREADS="1")
        code, text = run(["/usr/bin/python3", "-B", os.path.join(self.tree.source, script),
                          *(word.format(**places) for word in words)],
                         self.tree.folder, 600, environment)
        if code in (0, 77):
            return None
        lines = text.strip().splitlines() or ["hangs"]
        return f"{name}: " + lines[-1 if lines[0].startswith("Traceback") else 0][:150]


def clear(name):
    for entity, sign in (("&quot;", '"'), ("&lt;", "<"), ("&gt;", ">"), ("&apos;", "'"),
                         ("&amp;", "&")):
        name = name.replace(entity, sign)
    return name
