# SPDX-License-Identifier: GPL-3.0-or-later
"""A sensitivity study becomes a plan: the case, and its inputs varied one at a time.

In:  a study (keys: README.md beside this file) or just a case file, and the ranges over which its
     inputs vary (sensitivity/ranges.toml).
Out: a Plan as of a sweep. Its runs.toml also has [[input]] (name, base value, source), for each run
     the input that differs from the case with its value, and [[left_out]]: ranges that have nothing
     to vary in this case, and why.
"""
import json
import math
import os
import re
import subprocess
import tomllib

from plan_sweep import KEYS, LONGEST_NAME, SEED, Planner
from sweep_inputs import flatten, read_toml, set_text, toml_text

HERE = os.path.dirname(os.path.abspath(__file__))
FIELD_SEED = "field.seed"
RANDOM_FIELDS = ("cusps", "voronoi", "power-law")  # patterns of icefield that a seed changes
JITTER = 0.01  # of the smallest ice sphere's radius, as icesolve --seeds (solver/ensemble)
SEEDS = 3
RADIUS, SPHERES = ("-r", "--radius"), ("-r", "--radius", "-s", "--spacing")  # spherize's options
METRES = {"": 1.0, "m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254}
RANGE_KEYS = ("name", "keys", "dimension", "values", "factors", "add", "source")


class NothingToVary(Exception):
    """Why a range has no value in this case that differs from the case's own."""


def change(value, by, operation):
    """A number, or the numbers of a list, by one factor or by one for each; 0.2 MPa stays MPa."""
    if isinstance(value, list):
        each = by if isinstance(by, list) else [by] * len(value)
        return [change(v, b, operation) for v, b in zip(value, each)]
    if isinstance(value, str):
        found = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(\S*)\s*", value)
        if not found:
            raise NothingToVary(f"'{value}' is no number")
        return f"{change(float(found[1]), by, operation):.10g} {found[2]}".strip()
    if isinstance(value, bool) or not isinstance(value, (int, float)) or math.isinf(value):
        raise NothingToVary(f"{toml_text(value)} is no finite number")
    result = operation(value, by)
    whole = isinstance(value, int) and result == int(result)
    return int(result) if whole else float(f"{result:.10g}")


def change_options(options, factor):
    """spherize's options with -r and -s, where they stand, changed by a factor."""
    words = list(options)
    for at, word in enumerate(words[:-1]):
        if word in SPHERES:
            words[at + 1] = f"{float(words[at + 1]) * factor:.10g}"
    if words == list(options):
        raise NothingToVary("its list of inputs gives no radius (-r)")
    return " ".join(words)


def metres(length):
    """0.05, "50 mm" or "0.05 m" in m; None where it is no such length."""
    found = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(\w*)\s*", str(length))
    return float(found[1]) * METRES[found[2]] if found and found[2] in METRES else None


class StudyPlanner(Planner):
    KEYS = tuple(k for k in KEYS if k not in ("axes", "tied")) + ("seeds", "ranges", "vary")
    def read_file(self):
        """A study; a case file is one, too, with the default ranges."""
        file = read_toml(self.path, "study")
        folder, name = os.path.split(self.path)
        stem = os.path.splitext(name)[0]
        if stem == "case":
            stem = os.path.basename(folder)
        out = os.path.abspath(os.path.join("results", f"{stem}-sensitivity"))
        if "simulation" not in file:
            return {"out": out, **file}
        return {"case": name, "title": file.get("title", stem), "report": False, "out": out}

    def defaults(self, program):
        if program not in self.printed:
            text = subprocess.run([self.programs[program], "--print-defaults"], check=True,
                                  capture_output=True, text=True).stdout
            self.printed[program] = tomllib.loads(text)
        return self.printed[program]

    def field_recipe(self):
        return next((r for r in self.recipes.values() if r.program == "icefield"), None)

    def specification(self):
        recipe = self.field_recipe()
        return flatten(read_toml(recipe.source, "specification")) if recipe else {}

    def base_value(self, key):
        """What the case has for a key, in effect or by default; None where it has no such key."""
        if key in self.constant:
            return self.constant[key]
        if key.startswith("field."):
            return self.field_value(key[len("field."):])
        if key.endswith(".spherize"):
            recipe = self.recipe_of(key[:-len("spherize")] + "spheres")
            return " ".join(recipe.options) if recipe else None
        value = self.case_value(key) if key.count(".") else None
        return self.default_value(key) if value is None else value

    def field_value(self, key):
        """What the specification has; a channel's far end is closed as broadly as its sides."""
        specification = self.specification()
        if key == "edges.ahead" and key not in specification:
            return specification.get("edges.breadth")
        return specification.get(key)

    def default_value(self, key):
        """What icesolve takes for a key that the case does not give (solver/case/read_case.cpp)."""
        if key.endswith(".hold") and self.case_value(key[:-len("hold")] + "pattern") == "file":
            return "never"
        if key == "contact.crushing_pressure" and self.case_value("simulation.dimension") == 2:
            return math.inf
        floes, defaults = self.case_keys.get("floes", []), self.defaults("icesolve")
        if key.endswith(".hold"):
            return defaults["floes"][0].get("hold") if floes else None
        sheet = "level_ice" in self.case_keys
        if key == "level_ice.spacing" and sheet:
            return change(self.base_value("level_ice.thickness"), 0.7, lambda a, b: a * b)
        bends = sheet or any(group.get("hold") == "until-bent" for group in floes)
        sections = ["floes.", *([] if sheet else ["level_ice."]), *([] if bends else ["bending."])]
        return None if key.startswith(tuple(sections)) else flatten(defaults).get(key)

    def keys_in_case(self, entry):
        """The range's keys, those of floes for each group that has them and may leave its place."""
        dimension = self.base_value("simulation.dimension")
        if entry.get("dimension", dimension) != dimension:
            raise NothingToVary(f"it has none in {dimension}D")
        groups = self.case_keys.get("floes", [])
        found = []
        for key in entry["keys"]:
            name = key[len("floes."):] if key.startswith("floes.") else None
            if name is None or len(groups) < 2:
                each = [key]
            else:
                each = [f"floes.{k}.{name}" for k in range(1, len(groups) + 1)]
            for one in each:
                base = self.base_value(one)
                if base is not None and base != "always":
                    found.append((one, base))
        if not found:
            raise NothingToVary("the case has no " + " or ".join(entry["keys"]))
        return found

    def varied(self, entry):
        """Settings of each variation, without those that change nothing."""
        base = dict(self.keys_in_case(entry))
        changes = []
        try:
            for factor in entry.get("factors", []):
                changes.append({key: change_options(value.split(), factor)
                                if key.endswith(".spherize") else
                                change(value, factor, lambda a, b: a * b)
                                for key, value in base.items()})
            for step in entry.get("add", []):
                changes.append({key: change(value, step, lambda a, b: a + b)
                                for key, value in base.items()})
        except NothingToVary:
            if "values" not in entry:
                raise
        changes = [c for c in changes if c != base]
        if not changes:
            changes = [{key: value for key in base} for value in entry.get("values", [])]
            changes = [c for c in changes if c != base]
        if not changes:
            raise NothingToVary(f"every value is the case's own, {label(base)}")
        return base, changes

    def read_ranges(self):
        """The default ranges, with the study's [vary]: new values, further keys, [] for none."""
        path = self.beside(self.get("ranges", str, None)) if "ranges" in self.file else (
            f"{HERE}/sensitivity/ranges.toml")
        ranges = read_toml(path, "ranges").get("range", [])
        for entry in ranges:
            for key in entry:
                if key not in RANGE_KEYS:
                    self.fail(f"{path}: unknown key '{key}' of a range",
                              "known keys: " + ", ".join(RANGE_KEYS))
            if not entry.get("keys") or not {"values", "factors", "add"} & set(entry):
                self.fail(f"{path}: a range without keys, or without values, factors or add",
                          'write keys = ["contact.restitution"] and values = [0.1, 0.5]')
            for key in entry["keys"] if "ranges" in self.file else ():  # ours are tested
                self.explain(key)
        for key, values in flatten(self.get("vary", dict, {})).items():
            self.explain(key)
            if not isinstance(values, list):
                self.fail(f"vary: '{key}' is no list of values", f"write \"{key}\" = [a, b]")
            mine = {"name": key, "keys": [key], "values": values, "source": "stated by the study"}
            at = next((k for k, entry in enumerate(ranges) if key in entry["keys"]), len(ranges))
            if at < len(ranges):
                mine["name"] = ranges[at].get("name", key)
            ranges[at:at + 1] = [mine] if values else []
        return ranges

    def members(self):
        """Settings of each seed, those of icesolve --seeds: offsets, or a random field, anew.

        In level ice the seed itself changes the pieces' sizes."""
        members = [{SEED: k} for k in range(1, self.get("seeds", int, SEEDS) + 1)]
        if self.specification().get("pattern") in RANDOM_FIELDS:
            return [{**member, FIELD_SEED: member[SEED]} for member in members]
        if "level_ice" not in self.case_keys and not self.base_value("simulation.jitter"):
            self.constant["simulation.jitter"] = float(f"{JITTER * self.ice_radius():.6g}")
        return members

    def ice_radius(self):
        """Radius of the smallest ice spheres [m], which need not be made yet."""
        radii = []
        for k in range(1, len(self.case_keys.get("floes", [])) + 1):
            recipe = self.recipe_of(f"floes.{k}.spheres") or self.recipe_of(f"floes.{k}.file")
            if recipe is None:
                return self.measured_ice_radius()
            if recipe.program == "icefield":
                specification = self.specification()  # a quarter of the thickness by default
                thickness = metres(specification.get("ice.thickness"))
                radii.append(metres(specification.get("spheres.radius", 0.25 * thickness)))
            else:
                pairs = zip(recipe.options, recipe.options[1:] + [""])
                radii.append(next((metres(value) for name, value in pairs if name in RADIUS), 0.1))
        return self.measured_ice_radius() if None in radii else min(radii)

    def measured_ice_radius(self):
        """The same from the case's files, as icesolve reads them."""
        done = subprocess.run([self.programs["icesolve"], self.case, "--check"],
                              capture_output=True, text=True)
        found = re.search(r"; ice ([0-9.e+-]+)", done.stderr)
        if not found:
            self.fail(f"the case's ice cannot be read: {done.stderr.strip()}",
                      'or give the offset of the seeds, "simulation.jitter" = 0.001, in [set]')
        return float(found[1])

    def plan(self):
        self.printed = {}
        self.constant = flatten(self.get("set", dict, {}))
        for key in self.constant:
            self.explain(key)
        inputs, left_out = [], {}
        for entry in self.read_ranges():
            name = entry.get("name", entry["keys"][0])
            try:
                base, changes = self.varied(entry)
                inputs.append((name, base, changes, entry.get("source", "not stated")))
                left_out.pop(name, None)
            except NothingToVary as reason:
                if name not in [i[0] for i in inputs]:
                    left_out[name] = str(reason)
        if not inputs:
            self.fail("there is nothing to vary", "write e.g. \"contact.restitution\" = [0.1, 0.5] "
                      "below [vary]")
        runs = {}
        for member in self.members():  # sets the jitter, too
            self.add_run(runs, None, {}, member)
            for name, _, changes, _ in inputs:
                for settings in changes:
                    self.add_run(runs, name, settings, member)
        plan = self.make_plan([], runs)
        plan.page = "sensitivity"
        plan.more = "".join(
            f"[[input]]\nname = {quote(name)}\nbase = {quote(label(base))}\n"
            f"source = {quote(source)}\n"
            for name, base, _, source in inputs)
        plan.more += "".join(f"[[left_out]]\nname = {quote(name)}\nwhy = {quote(why)}\n"
                             for name, why in left_out.items())
        return plan

    def add_run(self, runs, input_name, settings, member):
        seed = f"seed={member[SEED]}"
        words = f"{input_name}={label(settings)}" if input_name else "case"
        name = f"{re.sub('[^A-Za-z0-9.=+-]+', '-', words)}__{seed}"
        if len(name) > LONGEST_NAME or name in runs:
            name = f"run-{len(runs) + 1:04d}"
        run = self.plan_run(name, {**settings, **member}, self.constant)
        run.input, run.label = input_name or "", label(settings)
        runs[name] = run


def quote(text):
    return json.dumps(text, ensure_ascii=False)


def label(settings):
    """Values of a variation for people; of several keys, or numbers of a list, in their order."""
    texts = []
    for key, value in settings.items():
        if key.endswith(".spherize"):
            words = str(value).split()
            value = " ".join(" ".join(words[at:at + 2]) for at, word in enumerate(words)
                             if word in SPHERES)
        parts = [set_text(v) for v in value] if isinstance(value, list) else [set_text(value)]
        texts.append(parts[0] if len(set(parts)) == 1 else " x ".join(parts))
    return texts[0] if len(set(texts)) == 1 else ", ".join(texts)


def plan_study(path, out=None, folder=None):
    """The plan of a study. Raises SweepError, writes nothing. Arguments as plan_sweep()'s."""
    return StudyPlanner(path, out, folder).plan()
