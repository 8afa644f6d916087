# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases and specifications of ice fields from dictionaries, held against the programs' schemas."""
from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import jsonschema
import tomli_w

from .programs import call


class CaseError(ValueError):
    """A key that the schema does not know, or a value that it does not allow."""


def write_case(path: str | Path, case: Mapping) -> Path:
    """Writes a case (docs/case-keys.md) as TOML after the program's own schema has passed it.

    @param path  the file; one of the same name is replaced, and none is written after an error
    @param case  tables as dictionaries, [[floes]] as a list of them; numbers in SI, or texts with
        a unit; paths may be Path
    @return the path
    @raises CaseError naming all keys at fault; ProgramError, FileNotFoundError without the program
    """
    return _write(path, case, "icesolve")


def write_specification(path: str | Path, specification: Mapping) -> Path:
    """Writes a specification for icefield (docs/icefield.md) as write_case() does a case."""
    return _write(path, specification, "icefield")


def _write(path: str | Path, content: Mapping, program: str) -> Path:
    plain = _plain(content)
    schema = json.loads(call(program, ["--print-schema"]))
    errors = sorted(jsonschema.validators.validator_for(schema)(schema).iter_errors(plain),
                    key=lambda error: list(map(str, error.absolute_path)))
    if errors:
        raise CaseError("\n".join(
            f"{'.'.join(map(str, e.absolute_path)) or 'case'}: {e.message}" for e in errors))
    path = Path(path)
    path.write_text(tomli_w.dumps(plain), encoding="utf-8")
    return path


def _plain(value):
    """The same in the types of TOML: paths as text, numpy's numbers as Python's. A value of another
    type stays, and the schema refuses it."""
    if isinstance(value, Mapping):
        return {str(key): _plain(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(part) for part in value]
    if isinstance(value, Path):
        return str(value)
    return value.item() if hasattr(value, "item") else value
