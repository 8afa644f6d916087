# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of the sources with all mutants in it, and its build.

All faults are built in at once; one is chosen when a test runs ("mutant schemata")."""
import os
import re
import subprocess

SWITCH = """// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdlib>
// a planted fault may leave a variable unused or be odd in other ways that a warning names
#pragma GCC diagnostic warning "-Wall"
#pragma GCC diagnostic warning "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-value"
#pragma GCC diagnostic ignored "-Wfloat-equal"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wuseless-cast"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wduplicated-branches"
#pragma GCC diagnostic ignored "-Wint-in-bool-context"
#pragma GCC diagnostic ignored "-Wtype-limits"
namespace ice {
inline const int kMutant = [] {
    const char* const text = std::getenv("ICE_MUTANT");
    return text != nullptr ? std::atoi(text) : 0;
}();
}  // namespace ice
"""
INCLUDE = '#include "common/base/mutant.hpp"\n'
TARGETS = ["spherize", "icefield", "iceflow", "icesolve", "icepost", "common_tests",
           "preprocess_tests", "field_tests", "flow_tests", "solver_tests", "postprocess_tests",
           "cli_tests", "validation_tests"]


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
    def __init__(self, root, work, jobs, preset):
        self.root, self.work, self.jobs, self.preset = root, work, jobs, preset
        self.source = os.path.join(work, "tree")
        self.folder = os.path.join(self.source, "build", "release")
        # a compiler cache may then know the objects of the tree that was copied
        self.env = {"CCACHE_BASEDIR": self.source, "CCACHE_NOHASHDIR": "1", **os.environ}

    def build(self, mutants):
        """Plants and builds; those that do not compile are left out. @return the others"""
        self.copy(mutants)
        code, text = run(["cmake", "--preset", self.preset, "-DICE_TESTS=ON",
                          "-DICE_UNITED_SOURCES=ON", "-DICE_PRECOMPILED_HEADERS=ON"],
                         self.source, env=self.env)
        if code != 0:
            raise Failure(f"cmake --preset {self.preset} fails:\n{text}")
        while True:
            code, text = run(["cmake", "--build", self.folder, "-j", str(self.jobs), "--target",
                              *TARGETS, "--", "-k", "0"], self.source, env=self.env)
            if code == 0:
                return mutants
            wrong = self.wrong_ones(mutants, text)
            if not wrong:
                raise Failure("the tree with the mutants does not build:\n" + text[-3000:])
            print(f"{len(wrong)} mutants do not compile and are left out", flush=True)
            mutants = [m for m in mutants if m.number not in wrong]
            self.copy(mutants)

    def wrong_ones(self, mutants, text):
        """Numbers of the mutants that the compiler complains about."""
        wrong = set()
        places = [(m.number, place) for m in mutants for place in m.places if m.drawn]
        # an error in a library's template names the place that asked for it
        for file, line, why in set(re.findall(r"([\w/.-]+\.(?:cpp|hpp)):(\d+):\d+: +"
                                              r"((?:fatal )?error|required from here)", text)):
            own = [(n, p) for n, p in places if file.endswith(p.file)]
            with open(os.path.join(self.root, own[0][1].file) if own else os.devnull,
                      encoding="utf-8") as source:
                before = source.read()
            # one line was put in front; planted faults keep the number of lines
            there = [n for n, p in own
                     if before.count("\n", 0, p.begin) + 2 <= int(line) <=
                     before.count("\n", 0, p.end) + 2]
            wrong |= set(there or [n for n, _ in own if why != "required from here"])
        return wrong

    def copy(self, mutants):
        """Makes the copy, or brings it up to date; what is equal keeps its time."""
        code, listing = run(["git", "ls-files", "--cached", "--others", "--exclude-standard"],
                            self.root)
        if code != 0:
            raise Failure(f"git ls-files fails in {self.root}: {listing}")
        texts = {"common/base/mutant.hpp": SWITCH.encode()}
        for name in listing.split("\n"):
            path = os.path.join(self.root, name)
            if name and os.path.isfile(path):
                with open(path, "rb") as file:
                    texts[name] = file.read()
        for file, text in self.planted(mutants, texts):
            texts[file] = text
        for name, text in texts.items():
            path = os.path.join(self.source, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            if not os.path.isfile(path) or slurp(path) != text:
                with open(path, "wb") as file:
                    file.write(text)
                os.chmod(path, 0o755 if text.startswith(b"#!") else 0o644)

    @staticmethod
    def planted(mutants, texts):
        by_file = {}
        for mutant in mutants:
            for place in mutant.places:
                by_file.setdefault(place.file, []).append((place, mutant.number))
        for file, places in by_file.items():
            text = texts[file].decode()
            for place, number in sorted(places, key=lambda p: -p[0].begin):
                text = text[:place.begin] + place.planted(number) + text[place.end:]
            yield file, (INCLUDE + text).encode()


def slurp(path):
    with open(path, "rb") as file:
        return file.read()
