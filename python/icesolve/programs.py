# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs as functions."""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path

from .runs import Run, open_run

_BUILT = Path(__file__).resolve().parents[2] / "build" / "release" / "bin"
_PROGRESS = re.compile(r"^icesolve +(\d+) %")


class ProgramError(RuntimeError):
    """A program refused its input or failed: its own words, and its exit code in `code`: 1 failed,
    2 bad input, as in docs/contract.md."""

    def __init__(self, words: str, code: int):
        super().__init__(words)
        self.code = code


def find_program(name: str) -> str:
    """The path of one of the five programs. @raises FileNotFoundError where there is none"""
    folder = os.environ.get("ICESOLVE_BIN")
    if folder:
        candidates = [Path(folder) / name]
    else:
        installed = shutil.which(name)
        candidates = ([Path(installed)] if installed else []) + [_BUILT / name]
    for candidate in candidates:
        if os.access(candidate, os.X_OK):
            return str(candidate)
    raise FileNotFoundError(f"no program {name}: set ICESOLVE_BIN to its folder, or build it with "
                            "./bootstrap.sh build")


def call(name: str, words: list[str], progress: Callable[[float], None] | None = None) -> str:
    """Runs a program to its end.

    Ctrl-C reaches it as it does in a terminal: icesolve writes a checkpoint and its summary.
    @param progress  is called with the share that is done [-], 0 to 1, from icesolve alone
    @return its standard output
    @raises ProgramError with the program's error text
    """
    # its answer goes to a file: a pipe that nobody empties would stop it
    with tempfile.TemporaryFile("w+") as answer:
        with subprocess.Popen([find_program(name), *words], stdout=answer, stderr=subprocess.PIPE,
                              text=True) as child:
            said = []
            for line in child.stderr:
                share = _PROGRESS.match(line)
                if share and progress:
                    progress(int(share[1]) / 100.0)
                said.append(line)
        answer.seek(0)
        text = answer.read()
    if child.returncode != 0:
        faults = [line for line in said if not _PROGRESS.match(line)]
        raise ProgramError("".join(faults).strip() or f"{name} ended with {child.returncode}",
                           child.returncode)
    return text


def spherize(mesh: str | Path, radius: float, out: str | Path | None = None, **options) -> Path:
    """Fills a closed surface mesh with contact spheres.

    @param radius  of the spheres [m]
    @param out  the sphere set, <mesh stem>.spheres.h5 in the working folder unless given
    @param options  of the program, `spacing=0.1` for --spacing 0.1, `check=True` for --check;
        numbers in SI
    @return the sphere set's path
    @raises ProgramError with the program's words, e.g. for a surface that cannot be made closed
    """
    out = Path(out) if out else Path(Path(mesh).stem + ".spheres.h5")
    call("spherize", [str(mesh), "-r", repr(radius), "-o", str(out), "-q", *_words(options)])
    return out


def make_field(specification: str | Path, out: str | Path, **options) -> Path:
    """Makes an ice field of a specification (docs/icefield.md).

    @param out  the field's file, HDF5
    @param options  of the program, as in spherize()
    @return the field's path
    @raises ProgramError with the program's words
    """
    call("icefield", [str(specification), "-o", str(out), "-q", *_words(options)])
    return Path(out)


def run(case: str | Path, out: str | Path | None = None, *, seeds: int | None = None,
        threads: int | None = None, overwrite: bool = False, report: bool = True,
        settings: Mapping[str, object] | None = None,
        progress: Callable[[float], None] | None = None) -> Run:
    """Runs a case, or with `seeds` an ensemble of so many members.

    @param threads  a count; the case's own unless given

    @param out  the run folder, results/<case> unless given; refused where it exists, unless
        `overwrite`
    @param settings  keys of the case to override, {"hull.speed": 0.8}
    @param progress  is called with the share that is done [-], 0 to 1
    @return the run; of an ensemble its first member, whose `ensemble` has mean and interval of all
    @raises ProgramError where icesolve refuses the case or fails
    Warnings of the run become Python's.
    """
    folder = Path(out) if out else Path("results") / Path(case).stem
    words = [str(case), "--out", str(folder)]
    words += ["--seeds", str(seeds)] if seeds else []
    words += ["--threads", str(threads)] if threads else []
    words += ["--overwrite"] if overwrite else []
    words += [] if report else ["--no-report"]
    for word in setting_words(settings or {}):
        words += ["--set", word]
    call("icesolve", words, progress)
    result = open_run(folder)
    for text in result.warnings:
        warnings.warn(text, stacklevel=2)
    return result


def setting_words(settings: Mapping[str, object]) -> list[str]:
    """Keys of a case as the program's --set takes them: {"hull.speed": 1} is "hull.speed=1"."""
    return [f"{key}={_value(value)}" for key, value in settings.items()]


def _words(options: Mapping[str, object]) -> list[str]:
    words = []
    for name, value in options.items():
        if value is False or value is None:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(str(value))
    return words


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    return str(value)
