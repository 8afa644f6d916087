#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""make_key_tables.py [--check]: writes docs/case-keys.md from the JSON schemas in cases/.

With --check nothing is written: the exit code is 1 if the page is stale. `ninja schemas` renews the
schemas from the programs and then this page."""
import json
import math
import pathlib
import re
import sys

DOCS = pathlib.Path(__file__).resolve().parent
PAGE = DOCS / "case-keys.md"
HEAD = """\
<!-- Written by docs/make_key_tables.py from cases/*.schema.json; `ninja schemas` renews it. -->
# Keys of case files and field specifications

Both files are TOML. Numbers are SI; a text may carry a unit: `"2 kn"`, `"80 mm"`, `"1.5 MPa"`, \
`"20 %"`. Paths are relative to
the file. Unknown keys, wrong types or units and values out of range are errors with line and \
column, all at once.

`icesolve --explain KEY` prints one key, `icesolve --print-defaults` all of them, \
`icesolve --print-schema` the JSON schema;
`icefield` has the same options for specifications. A first line `#:schema ../case.schema.json` \
gives editors completion and
checks. The manual pages icesolve-case(5) and icefield-specification(5) have the same tables.
"""
FILES = {"case": ("Case file", "A case is one run of [icesolve](icesolve.md)."),
         "specification": ("Field specification", "A specification is one field of "
                           "[icefield](icefield.md). Only the keys of its pattern may be given.")}


def meaning(sub):
    """The description without the parts that have a column of their own, safe within a table."""
    text = sub["description"].removesuffix(" Required.")
    text = re.sub(r" (In \S+, or a text with a unit: .*|A number, or a text in %\.)$", "", text)
    return text.replace("|", "\\|")


def span(sub):
    """Bounds of a number, as in "0 to 1"; bounds of a million and more only keep overflow out."""
    low, high = sub.get("minimum", -math.inf), sub.get("maximum", math.inf)
    low, high = (bound if abs(bound) < 1e6 else math.copysign(math.inf, bound)
                 for bound in (low, high))
    if math.isinf(low) and math.isinf(high):
        return "any"
    return f"at least {low:g}" if math.isinf(high) else f"{low:g} to {high:g}"


def value(sub):
    """The values that a key takes, in a few words."""
    if "enum" in sub:
        return ", ".join(f'`"{word}"`' for word in sub["enum"])
    if "anyOf" in sub:
        return ", or ".join(value(one) for one in sub["anyOf"])
    if sub["type"] == "array":
        items = sub["items"]
        if "enum" in items:
            return "list of " + value(items)
        if items.get("type") == "array":
            return "list of pairs"
        least, most = sub.get("minItems"), sub.get("maxItems")
        if most is None:
            return f"list of integers, {span(items)}"
        count = str(most) if least == most else f"{least} or {most}"
        noun = "integers" if items["type"] == "integer" else "numbers"
        return f"{count} {noun}" + ("" if span(items) == "any" else f", each {span(items)}")
    if sub["type"] == "string":
        return "text"
    if sub["type"] == "boolean":
        return "true or false"
    if sub["type"] == "integer":
        return f"integer, {span(sub)}"
    return span(sub) if span(sub) != "any" else "number"


def default(name, sub, required):
    if name in required:
        return "required"
    text = json.dumps(sub["default"]) if "default" in sub else ""
    return f"`{re.sub(r'[.]0(?![0-9])', '', text)}`" if text else ""


def rows(prefix, table):
    required = table.get("required", [])
    lines = ["| key | unit | values | default | meaning |", "|---|---|---|---|---|"]
    for name, sub in table["properties"].items():
        lines.append(f"| `{prefix}{name}` | {sub.get('x-unit', '')} | {value(sub)} "
                     f"| {default(name, sub, required)} | {meaning(sub)} |")
    return lines


def tables(schema):
    """(heading, prefix of the keys, subschema) of the top level and of each table."""
    nested = {}
    for name, sub in schema["properties"].items():
        repeated = "properties" in sub.get("items", {})
        table = sub["items"] if repeated else sub
        if "properties" in table:
            nested[name] = (f"`[[{name}]]`, one for each group" if repeated else f"`[{name}]`",
                            table)
    top = {n: s for n, s in schema["properties"].items() if n not in nested}
    yield "Top level", "", {"properties": top, "required": schema.get("required", [])}
    for name, (heading, table) in nested.items():
        yield heading, f"{name}.", table


def page():
    lines = [HEAD]
    for name, (title, sentence) in FILES.items():
        path = DOCS.parent / "cases" / f"{name}.schema.json"
        schema = json.loads(path.read_text(encoding="utf-8"))
        lines += [f"## {title}", "", sentence, ""]
        for heading, prefix, table in tables(schema):
            lines += [f"### {heading}", "", *rows(prefix, table), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def main():
    text = page()
    if sys.argv[1:] == ["--check"]:
        if not PAGE.is_file() or PAGE.read_text(encoding="utf-8") != text:
            sys.exit("docs/case-keys.md is stale; run: ninja -C build/release schemas")
    elif sys.argv[1:]:
        sys.exit("usage: make_key_tables.py [--check]")
    else:
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
