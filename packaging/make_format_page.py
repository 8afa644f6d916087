#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""make_format_page.py OUT PROGRAM NAME VERSION EXAMPLE: the manual page of a file format.

Written from PROGRAM --print-schema, so that it knows what the program knows: tables, keys, what
each takes, its bounds, unit and default. EXAMPLE is a file of that kind, shown at the end."""
import json
import pathlib
import subprocess
import sys


def roff(text):
    """Text in which nothing means anything to roff."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line[:1] in ".'" else line for line in escaped.split("\n"))


def range_text(sub):
    low, high = sub.get("minimum"), sub.get("maximum")
    parts = [f"from {low:g}"] if low is not None else []
    if high is not None or "null" in sub["type"]:
        parts.append(f"to {high:g}" if high is not None else "to inf")
    unit = f" {sub['x-unit']}" if "x-unit" in sub else ""
    return " ".join(parts) + unit if parts else ""


def kind(sub):
    """What a value is, in a few words."""
    if "enum" in sub:
        return "one of " + ", ".join(f'"{word}"' for word in sub["enum"])
    if "anyOf" in sub:
        return " or ".join(kind(part) for part in sub["anyOf"])
    if sub["type"] == "string":
        return "text"
    if sub["type"] == "integer":
        return f"whole number {range_text(sub)}"
    if sub["type"] != "array":
        return f"number {range_text(sub)}"
    items = sub["items"]
    if "enum" in items:
        return "list of " + ", ".join(f'"{word}"' for word in items["enum"])
    if items["type"] == "array":
        return "list of pairs [" + ", ".join(kind(part) for part in items["items"]) + "]"
    least, most = sub.get("minItems"), sub.get("maxItems")
    count = "list of" if most is None else (f"{most} times" if least == most else
                                            f"{least} or {most} times")
    return f"{count} a {kind(items)}"


def keys_of(table, required):
    out = []
    for name, sub in table["properties"].items():
        default = ", required" if name in required else (
            f", default {json.dumps(sub['default'])}" if "default" in sub else "")
        out += [".TP", f".B {roff(name)}", roff(f"{kind(sub)}{default}") + ".", ".br",
                roff(sub["description"].removesuffix(" Required."))]
    return out


def page(program, name, version, example):
    text = subprocess.run([program, "--print-schema"], check=True, capture_output=True,
                          text=True).stdout
    schema = json.loads(text)
    maker = pathlib.Path(program).name
    out = [f'.TH {name.upper()} "5" "" "icesolve {version}" "File Formats"', ".SH NAME",
           f"{name} \\- {schema['title'].split()[-1]} of", f".BR {maker} (1)", ".SH DESCRIPTION",
           "A TOML file. Numbers are SI; a text may carry a unit, as in",
           '.BR "\\(dq2 kn\\(dq" .',
           "Paths are relative to the file. Unknown keys, wrong types or units and values out of",
           "range are errors with line and column.", ".PP", f".B {maker} \\-\\-explain KEY",
           "says the same of one key,", f".B {maker} \\-\\-print\\-defaults",
           "prints a file with all of them, and", f".B {maker} \\-\\-print\\-schema",
           "a JSON schema: an editor with a TOML language server (taplo) completes and checks keys",
           "in a file whose first line names it,", '.BR "#:schema FILE" .', ".SH KEYS"]
    tables = {n: s for n, s in schema["properties"].items() if "properties" in s or "properties"
              in s.get("items", {})}
    top = {"properties": {n: s for n, s in schema["properties"].items() if n not in tables}}
    out += keys_of(top, schema.get("required", []))
    for table, sub in tables.items():
        repeated = sub["type"] == "array"
        sub = sub["items"] if repeated else sub
        out += [f'.SS "{roff(f"[[{table}]]" if repeated else f"[{table}]")}"']
        out += keys_of(sub, sub.get("required", []))
    lines = [line for line in example.splitlines() if not line.startswith("#:schema")]
    out += [".SH EXAMPLES", ".nf", roff("\n".join(lines)), ".fi", ".SH SEE ALSO",
            f".BR {maker} (1)"]
    return "\n".join(out) + "\n"


def main():
    out, program, name, version, example = sys.argv[1:6]
    text = page(program, name, version, pathlib.Path(example).read_text(encoding="utf-8"))
    pathlib.Path(out).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
