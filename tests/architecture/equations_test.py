#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table "Where the equations are" of docs/method.md: every numbered equation of the page has a
row, no number stands for two equations, each file of a row is a link to it, and the files have the
functions of the row."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/method.md").read_text(encoding="utf-8")
TABLE = PAGE.split("### Where the equations are")[1].split("### Symbols")[0]
LABEL = r"(?:[A-Z]?\d+[a-z]?)"


def rows():
    """(labels, files, names) of each row, files as (name, link). A file without a folder lies in
    that of the file before."""
    for line in TABLE.splitlines():
        if not line.startswith("| ("):
            continue
        equation, files, names = (cell.strip() for cell in line.strip("|").split(" | "))
        folder, links = None, []
        for name, link in re.findall(r"\[?`([^`]+)`(?:\]\(([^)]*)\))?", files):
            folder = pathlib.PurePosixPath(name).parent if "/" in name else folder
            links.append((folder / pathlib.PurePosixPath(name).name, link))
        yield labels_of(equation), links, re.findall("`([^`]+)`", names)


def labels_of(text):
    """(14), (15) or (F1) to (F3) as a list of labels."""
    found = re.findall(rf"\(({LABEL})\)", text)
    if " to (" in text:
        kind = found[0].rstrip("0123456789")
        first, last = (int(re.sub(r"\D", "", f)) for f in found)
        return [f"{kind}{k}" for k in range(first, last + 1)]
    return found


class Equations(unittest.TestCase):
    def test_each_number_is_one_equation_and_has_a_row(self):
        # an equation is an indented line that ends in its number
        numbers = re.findall(rf"^ {{4}}.* \(({LABEL})\)$", PAGE, re.M)
        self.assertGreater(len(numbers), 30)
        self.assertEqual(sorted(numbers), sorted(set(numbers)))
        self.assertEqual(sorted(set(numbers)), sorted(k for labels, _, _ in rows() for k in labels))

    def test_each_file_is_a_link_to_it(self):
        for labels, links, _ in rows():
            self.assertTrue(links, labels)
            for name, link in links:
                self.assertEqual(link, f"../{name}", labels)  # from docs/
                self.assertTrue((ROOT / name).is_file(), f"{labels}: {name}")

    def test_the_files_have_the_functions(self):
        for labels, links, names in rows():
            text = "".join((ROOT / name).read_text(encoding="utf-8") for name, _ in links)
            for name in names:
                last = name.split("::")[-1]
                self.assertRegex(text, rf"\b{re.escape(last)}\b", f"{labels}: {name}")


if __name__ == "__main__":
    unittest.main()
