# SPDX-License-Identifier: GPL-3.0-or-later
"""schema_test.py SOURCE BIN: the JSON schemas accept what the readers accept and refuse the rest.

The readers are the twin: each key is tried with good and bad values of every kind, in the schema
and in the program. The schemas in cases/ are what the programs print, where files find them.
Skipped (exit code 77) without python3-jsonschema."""
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib

try:
    import jsonschema
except ImportError:
    print("skipped: no jsonschema (apt-get install python3-jsonschema)")
    sys.exit(77)

source, programs = sys.argv[1:3]
NAMES = {"icesolve": "case.schema.json", "icefield": "specification.schema.json"}
CASE = {"simulation": {"duration": 1.0}, "hull": {"spheres": "hull.h5", "speed": 0.5},
        "floes": [{"spheres": "floe.h5"}]}
SPECIFICATION = {"pattern": "grid", "ice": {"thickness": 0.3},
                 "floes": {"size": [1.0, 1.0], "count": [2, 2]}}


def toml_text(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml_text(v)}" for key, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    return json.dumps(value) if isinstance(value, (str, bool)) else repr(value)


def as_taplo_sees(value):
    """JSON has no infinity: the language server hands it on as null."""
    if isinstance(value, dict):
        return {key: as_taplo_sees(v) for key, v in value.items()}
    if isinstance(value, list):
        return [as_taplo_sees(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def run(program, *words):
    return subprocess.run([os.path.join(programs, program), *words], capture_output=True, text=True,
                          check=False)


def complaint(program, data):
    """What the program says of a file; it ends before it opens sphere sets if a key is wrong."""
    with open("input.toml", "w", encoding="utf-8") as file:
        file.write("".join(f"{key} = {toml_text(value)}\n" for key, value in data.items()))
    words = ["--check"] if program == "icesolve" else ["-o", "field.h5"]
    return run(program, "input.toml", *words).stderr


def with_key(base, path, value):
    """The base with one key replaced; of a repeated table in its only row. None removes it."""
    data = json.loads(json.dumps(base))
    *tables, key = path
    table = data
    for name in tables:
        table = table.setdefault(name, {})
        table = table[0] if isinstance(table, list) else table
    if value is None:
        table.pop(key, None)
    else:
        table[key] = value
    return data


def keys(schema, path=()):
    """(path, subschema) of every key."""
    for name, sub in schema["properties"].items():
        sub = sub["items"] if name == "floes" and sub["type"] == "array" else sub
        if "properties" in sub:
            yield from keys(sub, (*path, name))
        else:
            yield (*path, name), sub


def scalars(sub):
    """(good values, bad values) of a number or text."""
    if "enum" in sub:
        return sub["enum"], ["none of them", 3]
    if sub["type"] == "string":
        return ["words"], [3, True, ["words"]]
    if sub["type"] == "boolean":
        return [True, False], ["true", 1, [True]]
    low, high = sub.get("minimum", -1e300), sub.get("maximum", 1e300)
    good, bad = [low, high], ["words", "1 bushel", True, [1.0], {"a": 1}]
    if sub["type"] == "integer":
        return good, [*bad, low - 1, high + 1, low + 0.5, str(low)]
    good += [f"{low}", f" +{max(low, 0.0)} {sub.get('x-unit', '')} "]
    if "null" in sub["type"]:
        return [*good, math.inf, "inf"], [*bad, low - 1]
    return good, [*bad, low - 1 - abs(low), high + 1 + abs(high), math.inf, "inf"]


def samples(sub):
    """(good values, bad values) of a key."""
    if "anyOf" in sub:  # a word or numbers
        words, numbers = sub["anyOf"]
        good, bad = samples(numbers)
        return [*words["enum"], *good], [value for value in bad if value != "words"] + ["words"]
    if sub.get("type") != "array":
        return scalars(sub)
    items, least = sub["items"], sub.get("minItems", 0)
    if items.get("type") == "array":  # rows [t, u]
        (time_low, speed_low) = (part["minimum"] for part in items["items"])
        if sub.get("x-unit") == "N":  # rows [U, force]
            return ([[[0.0, speed_low]], [["1 kn", "1 kN"], ["3 m/s", 2.0]]],
                    [[], [[0.0]], [[0.0, 1.0, 2.0]], [0.0, 1.0], 3, [["1 s", 1.0]], [[0.0, True]]])
        if "x-unit" not in sub:  # rows [U, factor]
            return ([[[0.0, speed_low]], [["1 kn", 1.0], ["3 m/s", 2.0]]],
                    [[], [[0.0]], [[0.0, 1.0, 2.0]], [0.0, 1.0], 3, [["1 s", 1.0]], [[0.0, True]]])
        return ([[[0.0, speed_low]], [[time_low, "1 kn"], ["1 s", 2.0]]],
                [[], [[0.0]], [[0.0, 1.0, 2.0]], [0.0, 1.0], 3, [["1 kn", 1.0]], [[0.0, True]]])
    good, bad = scalars(items)
    size = max(least, 1)
    fill = [good[0]] * (size - 1)
    lists = [[value, *fill] for value in bad if not isinstance(value, dict)] + [3, "words"]
    if "maxItems" in sub:
        lists += [[good[0]] * (least - 1), [good[0]] * (sub["maxItems"] + 1)]
    return [[value, *fill] for value in good], lists


def refused_keys(program, base, values):
    """Keys of whose values the program complains; the values are keyed by path."""
    data = base
    for path, value in values.items():
        data = with_key(data, path, value)
    said = complaint(program, data)
    value = r"must be|is outside|is none of|is not a number|holds whole"
    return set(re.findall(rf"error: ([a-z_.]+)[ :=].*(?:{value})", said)
               + re.findall(r"unknown key '([a-z_.]+)\.a'", said))


def try_keys(program, base, schema):
    """Each value alone in the schema; 15 keys at a time in the program, which lists 20 mistakes."""
    validator = jsonschema.Draft4Validator(schema)
    tried = 0
    found = [(path, sub, samples(sub)) for path, sub in keys(schema)]
    for path, sub, values in found:
        assert sub["description"], path
        data = with_key(base, ("hull", "speed"), None) if path[-1] == "speed_table" else base
        if "default" in sub:
            assert validator.is_valid(with_key(data, path, sub["default"])), path
        for value, good in [(v, True) for v in values[0]] + [(v, False) for v in values[1]]:
            trial = with_key(data, path, value)
            assert validator.is_valid(trial) == good, f"the schema and {path} = {value!r}"
            assert validator.is_valid(as_taplo_sees(trial)) == good, (path, value)
            tried += 1
    for begin in range(0, len(found), 15):
        some = found[begin:begin + 15]
        for good in (True, False):
            for turn in range(max(len(values[not good]) for _, _, values in some)):
                given = {path: values[not good][turn % len(values[not good])]
                         for path, _, values in some}
                refused = set() if good else {".".join(path) for path in given}
                assert refused_keys(program, base, given) == refused, (given, refused)
    return tried


def try_structure(program, base, schema):
    """Tables and required keys."""
    validator = jsonschema.Draft4Validator(schema)
    assert validator.is_valid(base)
    wrong = [with_key(base, ("hul", "speed"), 1.0), with_key(base, ("titel",), "a"),
             with_key(base, ("floes",), 3), {}]
    required = [("pattern",), ("ice", "thickness")]
    if program == "icesolve":
        wrong += [with_key(base, ("floes",), []),
                  with_key(base, ("hull", "speed_table"), [[0.0, 1.0]]),
                  with_key(base, ("contact", "restitutoin"), 0.3)]
        required = [("simulation", "duration"), ("hull", "spheres"), ("hull", "speed"), ("floes",),
                    ("hull",), ("simulation",)]
    wrong += [with_key(base, path, None) for path in required]
    for data in wrong:
        assert not validator.is_valid(data), data
        assert "error" in complaint(program, data), data
    return len(wrong)


def shipped(program):
    """Cases and specifications of the repository, and how many at least."""
    if program == "icesolve":
        return glob.glob(f"{source}/cases/*/case.cfg"), 8
    found = glob.glob(f"{source}/workflow/answers/fields/*.toml")
    return found + [path for path in glob.glob(f"{source}/cases/*/*.toml")
                    if not path.endswith("expected.toml")], 9


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for program, base in (("icesolve", CASE), ("icefield", SPECIFICATION)):
        text = run(program, "--print-schema").stdout
        with open(f"{source}/cases/{NAMES[program]}", encoding="utf-8") as file:
            assert file.read() == text, f"cases/{NAMES[program]} is stale; run: ninja schemas"
        schema = json.loads(text)
        jsonschema.Draft4Validator.check_schema(schema)
        validator = jsonschema.Draft4Validator(schema)
        files, least = shipped(program)
        assert len(files) >= least, files
        for path in files:
            with open(path, "rb") as file:
                first = file.readline().decode().split()
                place = os.path.normpath(os.path.join(os.path.dirname(path), first[1]))
                assert first[0] == "#:schema", path
                assert place == os.path.normpath(f"{source}/cases/{NAMES[program]}"), path
                data = tomllib.load(file)
            validator.validate(data)
            validator.validate(as_taplo_sees(data))
        defaults = run(program, "--print-defaults").stdout
        assert defaults.startswith(f"#:schema {NAMES[program]}\n"), defaults
        print(program, len(files), "shipped,", try_keys(program, base, schema), "values of keys,",
              try_structure(program, base, schema), "structures")
