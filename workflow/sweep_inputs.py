# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sweep's plan is made of: TOML as read and written, programs, inputs of a case.

Only Python's standard library is used: Snakemake runs it on every machine of a cluster.
"""
import json
import os
import re
import shutil
import tomllib
from dataclasses import dataclass


class SweepError(Exception):
    """What is wrong, where, and what to do about it."""


@dataclass
class Input:
    """A sphere set or ice field, made once for all runs that need it."""
    program: str  # spherize or icefield
    source: str   # mesh or specification
    options: list
    output: str


def toml_text(value):
    """A value as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    return repr(value)


def read_toml(path, what):
    try:
        with open(path, "rb") as file:
            return tomllib.load(file)
    except OSError as error:
        raise SweepError(f"{path}: {what} not readable: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SweepError(f"{path}: {what} is no TOML: {error}") from None


def flatten(table, prefix=""):
    """Nested tables as one of dotted keys: hull.speed = 1 and "hull.speed" = 1 are the same."""
    flat = {}
    for key, value in table.items():
        if isinstance(value, dict):
            flat.update(flatten(value, f"{prefix}{key}."))
        else:
            flat[prefix + key] = value
    return flat


def find_programs(folder):
    """Programs by name: in the folder given, else in the build, else on the PATH."""
    build = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../build/release/bin")
    found = {}
    for name in ("spherize", "icefield", "icesolve", "icepost"):
        places = [folder] if folder else [build, None]
        for place in places:
            program = shutil.which(name, path=place)
            if program:
                found[name] = os.path.realpath(program)
                break
        else:
            raise SweepError(f"no program {name} in {folder or 'build/release/bin or the PATH'}; "
                             "run ./bootstrap.sh build or give --config bin=DIR")
    return found


def read_recipes(path):
    """The calls listed in a case's spheres.txt (cases/prepare.sh) by output."""
    folder, recipes = os.path.dirname(path), {}
    absolute = lambda name: os.path.normpath(os.path.join(folder, name))
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if not words or words[0].startswith("#"):
                continue
            if "-o" not in words[:-1]:
                raise SweepError(f"{path}: '{line.strip()}' names no output; add -o FILE")
            at = words.index("-o")
            program = "icefield" if words[0].endswith(".toml") else "spherize"
            output = absolute(words[at + 1])
            recipes[output] = Input(program, absolute(words[0]), words[1:at] + words[at + 2:],
                                    output)
    return recipes


def set_text(value):
    """A value as icesolve's --set takes it: texts without quotes."""
    return value if isinstance(value, str) else toml_text(value)


def safe(text):
    return re.sub(r"[^A-Za-z0-9.+-]", "_", text)
