# SPDX-License-Identifier: GPL-3.0-or-later
"""A sweep file becomes a plan: which inputs to make and which runs to compute.

In:  sweep.toml (keys: README.md beside this file), the case it names, and that case's spheres.txt.
Out: a Plan, from which the Snakefile makes its jobs and `icepost sweep` reads the axes (runs.toml).
"""
import difflib
import itertools
import json
import os
import re
import shlex
import subprocess
from dataclasses import dataclass, field

from sweep_inputs import (Input, SweepError, find_programs, flatten, read_recipes, read_toml, safe,
                          set_text, toml_text)

SEED = "simulation.seed"
SPECIFICATION = "field.specification"  # files; the other field.* keys change what is in them
LONGEST_NAME = 150  # of a run's folder; file systems take 255 bytes
KEYS = ("title", "case", "out", "inputs", "threads", "report", "memory_mb", "runtime_min", "set",
        "axes", "tied", "spherize")


@dataclass
class Run:
    name: str
    values: dict                                 # axis -> value as in the sweep file
    overrides: list = field(default_factory=list)  # key=value for icesolve --set
    inputs: list = field(default_factory=list)     # files that must exist before
    input: str = ""                              # of a study: what differs from the case, and
    label: str = ""                              # its value


@dataclass
class Plan:
    title: str
    case: str
    out: str
    threads: int
    report: bool
    memory_mb: int
    runtime_min: int
    programs: dict
    axes: list
    inputs: list
    runs: dict
    page: str = "sweep"  # icepost's command, and the name of the page it writes
    more: str = ""       # further tables of runs.toml

    def text(self):
        """runs.toml, the same for the same plan; a JSON string is a TOML string, too."""
        quote = lambda text: json.dumps(text, ensure_ascii=False)
        lines = ["# written by the workflow, read by icepost sweep", f"title = {quote(self.title)}",
                 f"axes = [{', '.join(map(quote, self.axes))}]"]
        for run in self.runs.values():
            values = ", ".join(f"{quote(k)} = {toml_text(v)}" for k, v in run.values.items())
            lines += ["[[run]]", f"name = {quote(run.name)}", f"values = {{{values}}}"]
            if self.page == "sensitivity":
                lines += [f"input = {quote(run.input)}", f"label = {quote(run.label)}"]
        return "\n".join(lines) + "\n" + self.more


class Planner:
    KEYS = KEYS

    def __init__(self, path, out, folder):
        self.path = os.path.abspath(path)
        self.file = self.read_file()
        for key in self.file:
            if key not in self.KEYS:
                near = difflib.get_close_matches(key, self.KEYS, 1)
                self.fail(f"unknown key '{key}'", f"did you mean '{near[0]}'?" if near else
                          "known keys: " + ", ".join(self.KEYS))
        self.case = self.beside(self.get("case", str, None))
        self.programs = find_programs(folder)
        self.case_keys = read_toml(self.case, "case")
        if out:
            self.out = os.path.abspath(out)
        elif "out" in self.file:
            self.out = self.beside(self.get("out", str, None))
        else:
            stem = os.path.splitext(os.path.basename(self.path))[0]
            self.out = os.path.abspath(os.path.join("results", stem))
        self.recipes = self.read_recipes()
        self.made = {}  # (program, source, options) -> Input
        self.passed = set()  # overrides that were checked: key=value

    def read_file(self):
        return read_toml(self.path, "sweep file")

    def fail(self, what, remedy):
        raise SweepError(f"{self.path}: {what}\n  {remedy}")

    def get(self, key, kind, default):
        if key not in self.file and default is not None:
            return default
        value = self.file.get(key)
        if not isinstance(value, kind) or (kind is int and (isinstance(value, bool) or value < 1)):
            name = {str: "a text", int: "a whole number from 1", bool: "true or false",
                    dict: "a table"}[kind]
            self.fail(f"'{key}' is {'missing' if value is None else 'wrong'}", f"it takes {name}")
        return value

    def beside(self, path):
        return os.path.normpath(os.path.join(os.path.dirname(self.path), path))

    def read_recipes(self):
        default = os.path.join(os.path.dirname(self.case), "spheres.txt")
        path = self.beside(self.get("inputs", str, None)) if "inputs" in self.file else default
        if os.path.exists(path):
            return read_recipes(path)
        if "inputs" in self.file:
            self.fail(f"no file {path}", "'inputs' names a list like a case's spheres.txt")
        return {}

    def explain(self, key):
        """Refuses a key that the program would not take, before anything runs."""
        if re.fullmatch(r"(hull|floes(\.\d+)?)\.(mesh|spherize)", key) or key == SPECIFICATION:
            return
        program, name = ("icefield", key[6:]) if key.startswith("field.") else ("icesolve", key)
        name = re.sub(r"^floes\.\d+\.", "floes.", name)
        done = subprocess.run([self.programs[program], "--explain", name], capture_output=True,
                              text=True)
        if done.returncode != 0:
            hint = re.search(r"did you mean '(.*)'", done.stderr)
            self.fail(f"no key of a case is called '{key}'", f"did you mean '{hint[1]}'?" if hint
                      else "keys: icesolve --print-defaults, hull.mesh, floes.mesh; field.KEY: "
                           "icefield --print-defaults")

    def read_axes(self):
        axes = {}
        for key, values in flatten(self.get("axes", dict, None)).items():
            if key == "seeds":
                if not isinstance(values, int) or isinstance(values, bool) or values < 1:
                    self.fail("axes: 'seeds' is wrong", "it takes the number of seeds: seeds = 5")
                key, values = SEED, list(range(1, values + 1))
            self.explain(key)
            if not isinstance(values, list) or not values:
                self.fail(f"axes: '{key}' is no list of values", f"write \"{key}\" = [a, b, c]")
            if len({toml_text(v) for v in values}) < len(values):
                self.fail(f"axes: '{key}' has a value twice", "remove one")
            axes[key] = values
        if not axes:
            self.fail("'axes' is empty", 'write e.g. "hull.speed" = [0.5, 1.0] below [axes]')
        return axes

    def case_value(self, key):
        """What the case has for hull.spheres, floes.spheres or floes.2.spheres."""
        table, *rest = key.split(".")
        part = self.case_keys.get(table, {})
        if isinstance(part, list):
            group = int(rest[0]) - 1 if len(rest) > 1 else 0
            part = part[group] if 0 <= group < len(part) else {}
        return part.get(rest[-1])

    def recipe_of(self, key):
        value = self.case_value(key)
        path = os.path.join(os.path.dirname(self.case), value) if isinstance(value, str) else ""
        return self.recipes.get(os.path.normpath(path))

    def make(self, program, source, options, label):
        """A file made for this sweep, once for all runs with the same options."""
        if not os.path.exists(source):
            self.fail(f"no file {source}", "paths are relative to the sweep file")
        key = (program, source, tuple(options))
        if key not in self.made:
            ending = ".spheres.h5" if program == "spherize" else ".h5"
            output = os.path.join(self.out, "inputs", f"{len(self.made) + 1}-{label}{ending}")
            self.made[key] = Input(program, source, list(options), output)
        return self.made[key].output

    def mesh_override(self, key, mesh):
        spheres = key[:-len("mesh")] + "spheres"
        recipe = self.recipe_of(spheres)
        options = recipe.options if recipe else []
        table = self.get("spherize", dict, {})
        if key[:-5] in table:
            options = str(table[key[:-5]]).split()
        source = self.beside(str(mesh))
        stem = safe(os.path.basename(source).split(".")[0])
        return f"{spheres}={self.make('spherize', source, options, stem)}"

    def spherize_override(self, key, options):
        """The set again, from the same mesh with other options."""
        spheres = key[:-len("spherize")] + "spheres"
        recipe = self.recipe_of(spheres)
        if recipe is None:
            self.fail(f"'{key}' has no sphere set to make anew",
                      "the case's spheres.txt must list the call that makes it")
        stem = safe(os.path.basename(recipe.source).split(".")[0])
        return f"{spheres}={self.make('spherize', recipe.source, options.split(), stem)}"

    def field_override(self, values):
        recipe = next((r for r in self.recipes.values() if r.program == "icefield"), None)
        if recipe is None:
            self.fail("field.* keys need an ice field, and the case's spheres.txt makes none",
                      "add a line 'SPECIFICATION.toml -o FILE' there")
        source, label, options = recipe.source, "field", list(recipe.options)
        for key, value in values.items():
            if key == SPECIFICATION:
                source = self.beside(str(value))
                label = safe(os.path.basename(source).split(".")[0])
            else:
                options += ["--set", f"{key[6:]}={set_text(value)}"]
        return f"floes.file={self.make('icefield', source, options, label)}"

    def plan_run(self, name, values, constant):
        """Overrides and inputs of one combination."""
        run = Run(name, values)
        keys = {**constant, **values}
        fields = {k: v for k, v in keys.items() if k.startswith("field.")}
        replaced = set()
        for key, value in keys.items():
            if key.endswith((".mesh", ".spherize")):
                remake = self.mesh_override if key.endswith(".mesh") else self.spherize_override
                run.overrides.append(remake(key, str(value)))
                recipe = self.recipe_of(key.rsplit(".", 1)[0] + ".spheres")
                replaced.add(recipe.output if recipe else None)
            elif key not in fields:
                run.overrides.append(f"{key}={set_text(value)}")
        if fields:
            run.overrides.append(self.field_override(fields))
            replaced |= {r.output for r in self.recipes.values() if r.program == "icefield"}
        made = [text.split("=", 1)[1] for text in run.overrides
                if text.split("=", 1)[1].startswith(os.path.join(self.out, "inputs"))]
        run.inputs = [path for path in self.recipes if path not in replaced] + made
        return run

    def read_tied(self, axes):
        """Keys with one value per value of an axis: axis -> key -> values."""
        tied = {}
        for name, values in flatten(self.get("tied", dict, {})).items():
            axis = next((a for a in axes if name.startswith(f"{a}.")), None)
            if axis is None:
                self.fail(f"'tied.{name}' belongs to no axis", 'write [tied."hull.speed"] with the '
                          'keys below it')
            key = name[len(axis) + 1:]
            self.explain(key)
            if key in axes or key in flatten(self.get("set", dict, {})):
                self.fail(f"'{key}' is tied to {axis} and also in [axes] or [set]", "remove one")
            if not isinstance(values, list) or len(values) != len(axes[axis]):
                self.fail(f"'{key}' is tied to {axis} but is no list of {len(axes[axis])} values",
                          "give one value for each of the axis")
            tied.setdefault(axis, {})[key] = values
        return tied

    def check_seeds(self, axes, constant):
        """Seeds that change nothing would be the same run several times."""
        # of level ice they change the pieces' sizes; all other ice is moved by the jitter
        key, default = (("level_ice.scatter", 0.2) if "level_ice" in self.case_keys else
                        ("simulation.jitter", 0))
        keys = {**flatten(self.case_keys), **constant, **axes}
        if len(axes.get(SEED, [])) > 1 and keys.get(key, default) == 0:
            self.fail(f"all seeds give the same run, because {key} is 0",
                      f'write e.g. "{key}" = {default or 0.01} below [set]')

    def plan(self):
        axes = self.read_axes()
        constant = flatten(self.get("set", dict, {}))
        for key in constant:
            self.explain(key)
            if key in axes:
                self.fail(f"'{key}' is in [set] and in [axes]", "remove it from one of them")
        self.check_seeds(axes, constant)
        tied = self.read_tied(axes)
        runs = {}
        for values in itertools.product(*axes.values()):
            values = dict(zip(axes, values))
            name = run_name(values)
            if len(name) > LONGEST_NAME or name in runs:
                name = f"run-{len(runs) + 1:04d}"
            along = {key: each[axes[axis].index(values[axis])]
                     for axis, keys in tied.items() for key, each in keys.items()}
            runs[name] = self.plan_run(name, values, {**constant, **along})
        return self.make_plan(list(axes), runs)

    def check_values(self, runs):
        """Refuses values that icesolve would not take, before anything runs.

        Each value once, one of each key per call: a key's range knows no other key."""
        values = {}  # key -> its values in order
        for run in runs.values():
            for text in run.overrides:
                key = text.split("=", 1)[0]
                if text not in self.passed and not key.endswith((".spheres", ".file")):
                    self.passed.add(text)
                    values.setdefault(key, []).append(text)
        # a hull that does not exist ends the call before it builds anything
        probe = f"hull.spheres={os.path.join(self.out, 'no hull yet')}"
        faults = []
        for k in range(max(map(len, values.values()), default=0)):
            sets = [texts[k] for texts in values.values() if k < len(texts)]
            words = [word for text in [*sets, probe] for word in ("--set", text)]
            done = subprocess.run([self.programs["icesolve"], self.case, "--check", *words],
                                  capture_output=True, text=True)
            faults += [line[len("--set "):].partition(": error: ")[2]
                       for line in done.stderr.splitlines()
                       if any(line.startswith(f"--set {text}: error: ") for text in sets)]
        if faults:
            count = f"{len(faults)} value{'s' if len(faults) > 1 else ''} that no run can have:"
            self.fail("\n  ".join([count, *faults]), "nothing was computed; correct the file")

    def make_plan(self, axes, runs):
        self.check_values(runs)
        needed = {path for run in runs.values() for path in run.inputs}
        inputs = [i for i in [*self.recipes.values(), *self.made.values()] if i.output in needed]
        return Plan(self.get("title", str, ""), self.case, self.out, self.get("threads", int, 1),
                    self.get("report", bool, True), self.get("memory_mb", int, 1000),
                    self.get("runtime_min", int, 60), self.programs, axes, inputs, runs)


def run_name(values):
    """hull.speed=0.5__simulation.seed=1; of a mesh or specification the file's name."""
    # no commas: Snakemake splits the wildcards of a cluster's job there
    is_file = lambda key: key.endswith(".mesh") or key == SPECIFICATION
    text = lambda key, value: os.path.basename(value) if is_file(key) else set_text(value)
    return "__".join(f"{key}={safe(text(key, value))}" for key, value in values.items())


def plan_sweep(path, out=None, folder=None):
    """The plan of a sweep file. Raises SweepError, writes nothing.

    out: folder of the results, instead of the file's; folder: where the programs are."""
    return Planner(path, out, folder).plan()


def write_plan(plan):
    """Folders and runs.toml, which is left alone when it says the same: jobs read it meanwhile."""
    for name in ("inputs", "logs", "runs"):
        os.makedirs(os.path.join(plan.out, name), exist_ok=True)
    path, text = os.path.join(plan.out, "runs.toml"), plan.text()
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    with open(f"{path}.part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(f"{path}.part", path)


def input_command(plan, made):
    """spherize or icefield, one input."""
    return shlex.join([plan.programs[made.program], made.source, *made.options, "-o", made.output])
