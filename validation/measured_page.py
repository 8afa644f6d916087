# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/validation-measured.md from the tables of the data sets: compare.py page."""
import math

FORMULAS = [("lindqvist_kN", "Lindqvist"), ("riska_kN", "Riska"), ("jeong_kN", "Jeong"),
            ("keinonen_kN", "Keinonen")]

HEAD = """# Compared with measurements

<!-- written by python3 validation/compare.py page; do not edit -->

Each data set is a folder of `validation/`: the published numbers with their source (`data.csv`), \
the case, what is known and what
is assumed (`README.md`), and what the programs computed (`computed.csv`). One command computes a \
set anew, a second one writes
this page:

```
python3 validation/compare.py run uikku && python3 validation/compare.py sensitivity uikku
python3 validation/compare.py page
```

The error is computed minus measured, over measured. The interval is that of the computed mean \
(95 %); that of the measured mean
is not published. Rows are sorted by error, the
largest first.
"""


def number(row, column):
    text = row.get(column) or ""
    return float(text) if text else math.nan


def cell(value, form="{:.0f}"):
    return "" if math.isnan(value) else form.format(value)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def errors(measured, computed):
    return [c / m - 1.0 for m, c in zip(measured, computed) if not (math.isnan(m) or math.isnan(c))]


def summary_of(values):
    """Mean absolute error and bias in percent."""
    if not values:
        return "", ""
    return (f"{100 * sum(abs(v) for v in values) / len(values):.0f}",
            f"{100 * sum(values) / len(values):+.0f}")


def band(test):
    values = [number(test, column) for column, _ in FORMULAS]
    values = [v for v in values if not math.isnan(v)]
    return f"{min(values):.0f} to {max(values):.0f}" if values else ""


def points(tests, computed):
    """The tests that were computed, with the largest error first."""
    found = [(t, computed[t["test"]]) for t in tests if t["test"] in computed]
    found.sort(key=lambda p: -abs(number(p[1], "mean_kN") / number(p[0], "mean_kN") - 1.0))
    rows = []
    for test, got in found:
        mean, measured = number(got, "mean_kN"), number(test, "mean_kN")
        rows.append([test["test"], test["sheet"], test["thickness_m"],
                     test["flexural_strength_kPa"], test["speed_m_s"], f"{measured:.0f}",
                     f"{mean:.0f} +- {number(got, 'ci95_kN'):.0f}",
                     f"{100 * (mean / measured - 1):+.0f}", cell(number(got, "breaking_kN")),
                     cell(number(got, "submersion_kN")), band(test),
                     cell(number(test, "std_kN") / measured, "{:.2f}"),
                     cell(number(got, "std_kN") / mean, "{:.2f}"),
                     cell(number(test, "max_kN") / measured, "{:.1f}"),
                     cell(number(got, "max_kN") / mean, "{:.1f}")])
    return found, table(["test", "sheet", "h [m]", "sigma_f [kPa]", "V [m/s]", "measured [kN]",
                         "computed [kN]", "error [%]", "breaking [kN]", "all else [kN]",
                         "formulas as published [kN]", "std / mean, measured", "computed",
                         "max / mean, measured", "computed"], rows)


def judgement(found, group):
    """Of the tests of a group: those of its sheets, those that it names, or all."""
    sheets, names = group.get("sheets"), group.get("tests")
    found = [(t, c) for t, c in found
             if (not sheets or t["sheet"] in sheets) and (not names or t["test"] in names)]
    measured = [number(t, "mean_kN") for t, _ in found]
    computed = [number(c, "mean_kN") for _, c in found]
    rows = [["this program", *summary_of(errors(measured, computed))]]
    for column, name in FORMULAS:
        rows.append([f"{name}, as published with the tests",
                     *summary_of(errors(measured, [number(t, column) for t, _ in found]))])
    for column, name in FORMULAS[:3]:
        rows.append([f"{name}, by this program for its hull",
                     *summary_of(errors(measured, [number(c, column) for _, c in found]))])
    return table(["", "mean absolute error [%]", "bias [%]"], rows)


def trends(found, checks):
    """Signs of the trends that set.toml names: pairs of tests."""
    value = {t["test"]: (number(t, "mean_kN"), number(c, "mean_kN")) for t, c in found}
    rows = []
    for check in checks:
        low, high = check["tests"]
        if low in value and high in value:
            rows.append([check["what"], f"{low} to {high}", f"{value[high][0] / value[low][0]:.2f}",
                         f"{value[high][1] / value[low][1]:.2f}"])
    return table(["what grows", "tests", "measured ratio", "computed ratio"], rows) if rows else ""


def sensitivity(data_set, rows, base):
    if not rows or base is None:
        return "Not computed yet.\n"
    mean = number(base, "mean_kN")
    why = {entry["key"]: entry["why"] for entry in data_set["uncertain"]}
    lines = [[f"`{r['input']}`", (f"x {r['value']}" if r["relative"] == "1" else r["value"]),
              f"{number(r, 'mean_kN'):.0f} +- {number(r, 'ci95_kN'):.0f}",
              f"{100 * (number(r, 'mean_kN') / mean - 1):+.0f}", why[r["input"]]] for r in rows]
    return table(["input", "value", "computed [kN]", "change [%]", "why it is uncertain"], lines)


def section(folder, read_set, read_table):
    data_set, tests = read_set(folder), read_table(folder / "data.csv")
    computed = {row["test"]: row for row in read_table(folder / "computed.csv")}
    found, rows = points(tests, computed)
    if not found:
        return f"## {data_set['title']}\n\nNot computed yet.\n"
    commits = ", ".join(sorted({c["commit"] for _, c in found}))
    base = computed.get(data_set["base_test"])
    return "\n".join([
        f"## {data_set['title']}\n", data_set["text"].strip() + "\n", rows,
        *(f"Mean absolute error and bias, {group['what']}:\n\n{judgement(found, group)}"
          for group in data_set["groups"]),
        "Trends:\n", trends(found, data_set["trends"]),
        f"One input at a time, test {data_set['base_test']}"
        + (f" ({number(base, 'mean_kN'):.0f} +- {number(base, 'ci95_kN'):.0f} kN)" if base else "")
        + ":\n",
        sensitivity(data_set, read_table(folder / "sensitivity.csv"), base),
        f"Computed by commit {commits}; inputs and assumptions: "
        f"[`validation/{folder.name}`](../validation/{folder.name}/README.md).\n"])


def misses(check):
    """Does a number miss what is expected by more than it may? Ranges are `low to high`."""
    got = float(check["got"].split()[0])
    if " to " in check["expected"]:
        low, high = (float(bound.split()[0]) for bound in check["expected"].split(" to "))
        return not low <= got <= high
    if check["within"] in ("", "shown only"):
        return False
    return abs(got - float(check["expected"])) > float(check["within"])


def met(check):
    if check["within"] == "shown only":
        return ""
    return "no" if misses(check) else "yes"


def ladder(rows):
    """The checks without a table, those that miss their bound first."""
    head = """## A ladder of checks that need no table

The paper's ship and pieces with the project's defaults (`cases/paper-3d-defaults`). \
`python3 validation/ladder.py` computes
them.
"""
    rows = sorted(rows, key=lambda check: not misses(check))
    lines = [[r["check"], r["expected"], r["got"], r["within"], met(r), r["why"]] for r in rows]
    return head + "\n" + table(["check", "expected", "got", "within", "met", "why"], lines)


def make(root, read_set, read_table):
    folders = sorted(path.parent for path in root.glob("*/set.toml"))
    missing = (root / "not-readable.md").read_text(encoding="utf-8")
    return "\n".join([HEAD, *(section(f, read_set, read_table) for f in folders),
                      ladder(read_table(root / "ladder.csv")), missing])
