# SPDX-License-Identifier: GPL-3.0-or-later
"""insert_table.py FILE NAME: puts the text on stdin between FILE's marks "<!-- NAME: begin -->" and
"<!-- NAME: end -->", in place of what is there."""
import sys

path, name = sys.argv[1:]
with open(path, encoding="utf-8") as file:
    text = file.read()
begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->\n"
if text.count(begin) != 1 or text.count(end) != 1 or text.index(end) < text.index(begin):
    sys.exit(f"{path}: no marks {begin.strip()} and {end.strip()} in this order; add them")
head, tail = text[:text.index(begin) + len(begin)], text[text.index(end):]
with open(path, "w", encoding="utf-8") as file:
    file.write(head + sys.stdin.read() + tail)
