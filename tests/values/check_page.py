# SPDX-License-Identifier: GPL-3.0-or-later
"""Each cell of a sweep's page, against the runs' summaries and the points of check_tables.py."""
from html.parser import HTMLParser

import numpy as np

from check_tables import SPEEDS, affected_percent, number, rows_of

FORM = "sweep page"


class Tables(HTMLParser):
    """The page's tables as lists of rows of texts."""

    def __init__(self, page):
        super().__init__()
        self.found, self.cell = [], None
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        if tag == "table":
            self.found.append([])
        elif tag == "tr" and self.found:
            self.found[-1].append([])
        elif tag in ("td", "th") and self.found:
            self.cell = ""

    def handle_endtag(self, tag):
        if tag in ("td", "th") and self.cell is not None:
            self.found[-1][-1].append(self.cell.strip())
            self.cell = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell += data


def make(work):
    """The page is check_tables'."""


def check(work, values):
    tables = Tables((work / "sweep/page.html").read_text(encoding="utf-8")).found
    by_head = {tuple(table[0][:3]): table for table in tables}
    check_head(work, values, tables[0])
    check_points(work, values, by_head["speed [m/s]", "speed [kn]", "runs"])
    check_work(work, values, by_head["speed [m/s]", "speed [kn]", "Work per metre [N]"])
    check_runs(work, values, by_head["Run", "Status", "Resistance ± 95 % [N]"])
    heads = {head for table in tables[1:] for head in table[0]} | {r[0] for r in tables[0]}
    work.names[FORM] = heads  # a new column has no value


def with_half(mean, half):
    return f"{mean:.1f}" if half is None else f"{mean:.1f} ± {half:.1f}"


def check_head(work, values, table):
    s = work.summary("sweep/u1.0s1")
    ship, ice = s["ship"], s["ice"]
    want = {"Ship": f"L {ship['length_m']:.4g} m, B {ship['breadth_m']:.4g} m, "
                    f"T {ship['draught_m']:.4g} m, displacement "
                    f"{ship['displacement_kg'] / 1000:.4g} t, "
                    f"stem angle {ship['stem_angle_deg']:.4g}°, "
                    f"half entrance angle {ship['entrance_angle_deg']:.4g}°",
            "Ice": f"thickness 0.3 m, pieces of {ice['floe_size_mean_m']:.4g} m on the average, "
                   f"concentration {100 * ice['concentration']:.4g} %, density 870 kg/m³, "
                   "friction on the ship 0.15, ice on ice 0.3, crushing pressure 0.3 MPa",
            "Speed": f"{SPEEDS[0]:g} to {SPEEDS[-1]:g} m/s ({SPEEDS[0] * 3600 / 1852:.2f} to "
                     f"{SPEEDS[-1] * 3600 / 1852:.2f} kn)"}
    for name, text in table:
        values.equal(FORM, name, text, want.get(name))


def check_points(work, values, table):
    """A decimal of what points.csv has with all digits, which check_tables.py knows."""
    for speed, point, cells in zip(SPEEDS, rows_of(work, "points.csv"), table[1:], strict=True):
        want = {"speed [m/s]": f"{speed:g}", "speed [kn]": f"{speed * 3600 / 1852:.2f}",
                "runs": " ".join(str(k + 1) for k in range(int(point["runs"]))),
                "largest [N]": f"{number(point['largest_N']):.1f}",
                "Lindqvist [N]": f"{number(point['lindqvist_1989_submersion_N']):.1f}",
                "Jeong [N]": f"{number(point['jeong_2010_buoyancy_clearing_N']):.1f}",
                "release rule": point["hold"]}
        for head, column in (("resistance [N]", "resistance"), ("sides [N]", "sides"),
                             ("sides, friction [N]", "sides_friction"), ("contact [N]", "contact"),
                             ("friction [N]", "friction")):
            want[head] = with_half(number(point[column + "_N"]), number(point[column + "_ci95_N"]))
        for head, text in zip(table[0], cells, strict=True):
            values.equal(FORM, head, text, want.get(head))


def check_work(work, values, table):
    """Energies over the distance, means of the runs; they add up to the ship's work."""
    keys = {"Work per metre [N]": "ship_work_J", "Potential [N]": "potential_J",
            "Kinetic [N]": "kinetic_change_J", "Friction [N]": "friction_J",
            "Impacts [N]": "restitution_J", "Crushing [N]": "crushing_J", "Drag [N]": "drag_J",
            "Opened overlap [N]": "separation_J"}
    for speed, cells in zip(SPEEDS, table[1:], strict=True):
        runs = [work.summary(f"sweep/u{speed}s{seed}") for seed in ((1, 2, 3) if speed == 1.0
                                                                    else (1,))]
        for head, text in zip(table[0], cells, strict=True):
            if head.startswith("speed"):
                continue
            sign = -1 if head == "Opened overlap [N]" else 1  # the moves put it in
            share = np.mean([s["energy"][keys[head]] / s["travel"]["distance_m"] for s in runs])
            values.close(FORM, head, float(text), sign * share, margin=0.05001)


def check_runs(work, values, table):
    for cells in table[1:]:
        s = work.summary("sweep/" + cells[0])
        r, affected = s["resistance"], affected_percent([s])
        want = {"Run": cells[0], "Status": s["status"], "Warnings": str(len(s["warnings"])),
                "Resistance ± 95 % [N]": with_half(r["mean_N"], r["ci95_N"]),
                "Friction [N]": f"{r['friction_mean_N']:.1f}", "Largest [N]": f"{r['max_N']:.1f}",
                "Unconverged steps": str(s["contacts"]["unconverged_steps"]),
                "Wall time [s]": f"{s['wall_s']:.4g}",
                "Mean affected by [%]": "n/a" if affected is None else f"{affected:.4g}"}
        for head, text in zip(table[0], cells, strict=True):
            values.equal(FORM, head, text, want.get(head))
