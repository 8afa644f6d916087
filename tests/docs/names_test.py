#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""names_test.py REPOSITORY: names in the documents are those of the project.

CONTRIBUTING.md's list of folders is that of rules.cmake, in its order; targets of ninja and presets
of CMake that any page names exist."""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])


def ruled():
    """Folders of the order_* lists below a tool's top folder."""
    text = (ROOT / "tests/architecture/rules.cmake").read_text(encoding="utf-8")
    lists = re.findall(r"^set\(order_\w+([^)]*)\)", text, re.M)
    return [name for words in lists for name in words.split() if "/" in name]


def listed():
    """Folders of the block under "Where things are": indented ones are in the one above."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    block = text.split("## Where things are", 1)[1].split("```")[1]
    names, top = [], ""
    for indent, name in re.findall(r"^( *)([a-z_]+(?:/[a-z_]+)*)/ ", block, re.M):
        if indent:
            names.append(f"{top}/{name}")
        else:
            top = name
    return names


def pages():
    top = ("*.md", "docs/*.md", "cases/**/*.md", "tests/*/*.md", "workflow/*.md", "packaging/*.md",
           "examples/**/*.md", "meshes/*.md")
    return sorted(path for pattern in top for path in ROOT.glob(pattern))


def unknown_names():
    """Complaints about targets and presets."""
    targets = {name for folder in ("tests", "packaging", "preprocess", "solver", "postprocess")
               for path in (ROOT / folder).rglob("CMakeLists.txt")
               for name in re.findall(r"add_(?:custom_target|executable)\(\s*([\w-]+)",
                                      path.read_text(encoding="utf-8"))}
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    known = {p["name"] for kind in ("configurePresets", "buildPresets", "testPresets")
             for p in presets[kind]} | {"P"}  # which stands for any of them
    found = 0
    for page in pages():
        text = page.read_text(encoding="utf-8")
        named = [("target", name, name in targets)
                 for name in re.findall(r"ninja\s+-C\s+build/release\s+([a-z][\w-]+)", text)]
        named += [("preset", name, name in known)
                  for name in re.findall(r"--preset\s+([A-Za-z-]+)", text)]
        found += len(named)
        yield from (f"{page.relative_to(ROOT)}: no {kind} {name}"
                    for kind, name, exists in named if not exists)
    if found < 10:
        yield f"hardly any targets and presets in the documents: {found}"


faults = list(unknown_names())
expected, got = ruled(), listed()
if len(expected) < 30:
    faults.append(f"hardly any folders in rules.cmake: {expected}")
if expected != got:
    faults.append("CONTRIBUTING.md, 'Where things are', and tests/architecture/rules.cmake "
                  "differ:\n"
                  f"  missing: {[n for n in expected if n not in got]}\n"
                  f"  unknown: {[n for n in got if n not in expected]}\n"
                  f"  the order of rules.cmake: {' '.join(expected)}")
if faults:
    sys.exit("\n".join(faults))
