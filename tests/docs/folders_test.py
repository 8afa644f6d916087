#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""folders_test.py REPOSITORY: CONTRIBUTING.md's list of folders is that of rules.cmake, in its order."""
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
    for indent, name in re.findall(r"^( *)([a-z]+)/ ", block, re.M):
        if indent:
            names.append(f"{top}/{name}")
        else:
            top = name
    return names


expected, got = ruled(), listed()
if len(expected) < 30:
    sys.exit(f"hardly any folders in rules.cmake: {expected}")
if expected != got:
    sys.exit("CONTRIBUTING.md, 'Where things are', and tests/architecture/rules.cmake differ:\n"
             f"  missing: {[n for n in expected if n not in got]}\n"
             f"  unknown: {[n for n in got if n not in expected]}\n"
             f"  the order of rules.cmake: {' '.join(expected)}")
