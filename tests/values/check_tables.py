# SPDX-License-Identifier: GPL-3.0-or-later
"""icepost's tables of runs, sweeps and attainable speeds, against the runs' summaries and closed
forms."""
import csv
import io
import re
import urllib.parse

import numpy as np

RUNS = ("sheared", "level", "turn")
SPEEDS = (0.7, 1.0, 1.4)
PULL, OPEN_WATER = 6000.0, 3.0
STUDENT_2 = 4.302653  # 97.5 % of two degrees of freedom


def make(work):
    work.write("table.csv", work.run("icepost", "table", "--csv", *RUNS))
    for speed in SPEEDS:
        for seed in (1, 2, 3) if speed == 1.0 else (1,):
            work.run("icesolve", "sheared.cfg", "--out", f"sweep/u{speed}s{seed}", "--no-report",
                     "--set", f"hull.speed={speed}", "--set", f"simulation.seed={seed}", "--set",
                     "simulation.jitter=0.02", "--set", "environment.gravity=9.81",
                     "--set", "buoyancy.model=distributed")
    work.run("icepost", "sweep", "sweep", "-o", "sweep/page.html")
    page = (work / "sweep/page.html").read_text(encoding="utf-8")
    for name in ("points.csv", "runs.csv"):
        text = re.search(f'download="{name}" href="data:text/csv;charset=utf-8,([^"]*)"', page)
        work.write(name, urllib.parse.unquote(text.group(1)))
    work.write("thrust.toml", f"""[[thrust]]
name = "pull"
bollard_pull = {PULL}
open_water_speed = {OPEN_WATER}
""")
    work.run("icepost", "hv", "sweep", "--thrust", "thrust.toml", "--csv", "hv.csv", "-o",
             "sweep/hv.html")
    for name in ("table.csv", "points.csv", "runs.csv", "hv.csv"):
        work.files.setdefault(name, []).append(work / name)


def rows_of(work, name):
    with open(work / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def affected_percent(summaries):
    """The largest share of a mean that a warning affects; None: not measured."""
    affecting = [w for s in summaries for w in s["warnings"] if w["affects_mean"] is not False]
    shares = [min(w["share"], 1.0) for w in affecting
              if w["affects_mean"] and w["share"] is not None]
    return 100.0 * max(shares) if shares else None if affecting else 0.0


def number(text):
    return float(text) if text else None


def check(work, values):
    check_table(work, values)
    check_runs(work, values)
    check_points(work, values)
    check_hv(work, values)


def lindqvist(s):
    """The total in level ice, else the submersion part."""
    totals = [f["value_N"] for f in s["formulas"]
              if f["name"] == "Lindqvist 1989" and f["part"] == "total"]
    return totals[0] if "level_ice" in s else s["lindqvist_submersion_N"]


def check_table(work, values):
    for run, row in zip(RUNS, rows_of(work, "table.csv"), strict=True):
        s = work.summary(run)
        r = s["resistance"]
        for column, want in (("run", run), ("status", "completed"),
                             ("hold", ", ".join(s["ice"]["hold"]))):
            values.equal("table.csv", column, row[column], want)
        for column, want in (
                ("mean_N", r["mean_N"]), ("ci95_N", r["ci95_N"]), ("std_N", r["std_N"]),
                ("contact_N", r["contact_mean_N"]), ("friction_N", r["friction_mean_N"]),
                ("max_N", r["max_N"]), ("lindqvist_N", lindqvist(s)),
                ("floes_moved", s["floes"]["moved"]),
                ("unconverged_%", 100 * s["contacts"]["unconverged_steps"] / s["steps"]),
                ("affected_%", affected_percent([s]))):
            values.equal("table.csv", column, number(row[column]),
                         None if want is None else float(want))


def check_runs(work, values):
    for row in rows_of(work, "runs.csv"):
        s = work.summary("sweep/" + row["run"])
        r = s["resistance"]
        speed, seed = re.fullmatch(r"u([\d.]+)s(\d)", row["run"]).groups()
        known = {"run": row["run"], "status": s["status"], "hull.speed": float(speed),
                 "simulation.seed": int(seed), "resistance_N": r["mean_N"], "ci95_N": r["ci95_N"],
                 "contact_N": r["contact_mean_N"], "friction_N": r["friction_mean_N"],
                 "largest_N": r["max_N"], "lindqvist_submersion_N": s["lindqvist_submersion_N"],
                 "unconverged_steps": s["contacts"]["unconverged_steps"], "wall_s": s["wall_s"],
                 "hold": ", ".join(s["ice"]["hold"]), "remark": ""}
        values.equal("runs.csv", "affected_%", number(row["affected_%"]), affected_percent([s]))
        for column, text in row.items():
            want = known.get(column)
            if isinstance(want, str):
                values.equal("runs.csv", column, text, want)
            elif column in known:
                values.close("runs.csv", column, number(text), want, 1e-9)


# regions of the raked hull by part, by their names; no region is called bow
PARTS = {"bow": (), "sides": tuple(f"side{k}" for k in range(5)), "bottom": ("bottom",),
         "rest": ("deck",)}


def part_columns(s):
    """Forces of one run by column of points.csv, without the endings."""
    r = s["resistance"]
    out = {"resistance": r["mean_N"], "contact": r["contact_mean_N"],
           "friction": r["friction_mean_N"]}
    for part, names in PARTS.items():
        for ending, key in (("", "mean_N"), ("_contact", "contact_mean_N"),
                            ("_friction", "friction_mean_N")):
            out[part + ending] = -sum(s["regions"][n][key][0] for n in names if n in s["regions"])
    return out


def check_points(work, values):
    """Means over seeds, with Student's interval; of a single run the resistance has its own."""
    for speed, row in zip(SPEEDS, rows_of(work, "points.csv"), strict=True):
        seeds = (1, 2, 3) if speed == 1.0 else (1,)
        runs = [work.summary(f"sweep/u{speed}s{seed}") for seed in seeds]
        values.equal("points.csv", "hull.speed", float(row["hull.speed"]), speed)
        values.equal("points.csv", "runs", int(row["runs"]), len(runs))
        values.equal("points.csv", "hold", row["hold"], "never")
        values.equal("points.csv", "affected_%", number(row["affected_%"]), affected_percent(runs))
        parts = [part_columns(s) for s in runs]
        for name in parts[0]:
            series = [p[name] for p in parts]
            values.close("points.csv", name + "_N", float(row[name + "_N"]), np.mean(series), 1e-9,
                         1e-9)
            half = None
            if len(runs) == 3:
                half = STUDENT_2 * np.std(series, ddof=1) / np.sqrt(3)
            elif name == "resistance":
                half = runs[0]["resistance"]["ci95_N"]
            got = number(row[name + "_ci95_N"])
            if half is None:
                values.equal("points.csv", name + "_ci95_N", got, None)
            else:
                values.close("points.csv", name + "_ci95_N", got, half, 1e-6, 1e-9)
        largest = [s["resistance"]["max_N"] for s in runs]
        values.close("points.csv", "largest_N", float(row["largest_N"]), np.max(largest), 1e-9)
        check_formulas(work, values, speed, row)


def check_formulas(work, values, speed, row):
    down, jeong = (formula(work, name, speed) for name in ("Lindqvist", "Jeong"))
    buoyancy = formula(work, "Jeong", 0.0)
    for column, want in (("lindqvist_submersion_N", down), ("lindqvist_1989_submersion_N", down),
                         ("jeong_2010_buoyancy_N", buoyancy),
                         ("jeong_2010_clearing_N", jeong - buoyancy),
                         ("jeong_2010_buoyancy_clearing_N", jeong)):
        values.close("points.csv", column, float(row[column]), want, 1e-6)


def check_hv(work, values):
    """Speeds at which the line or parabola through the sweep's points meets the pull."""
    pull = lambda u: PULL * (1 - u / (3 * OPEN_WATER) - 2 / 3 * (u / OPEN_WATER) ** 2)
    for row in rows_of(work, "hv.csv"):
        speed = number(row["speed"])
        values.equal("hv.csv", "thrust", row["thrust"], "pull")
        values.close("hv.csv", "thickness_m", float(row["thickness_m"]), 0.3, 1e-9)
        if speed is not None:
            values.close("hv.csv", "speed_kn", float(row["speed_kn"]), speed * 3600 / 1852, 1e-9)
        values.equal("hv.csv", "source", row["source"] in ("prescribed course", "formula"), True)
        if row["source"] == "formula" and speed:
            values.close("hv.csv", "speed", formula(work, row["curve"], speed), pull(speed), 1e-6)
            values.equal("hv.csv", "curve", row["curve"].split(",")[0] in (
                "Lindqvist 1989", "Jeong 2010"), True)
        if row["source"] == "prescribed course":
            low, high = number(row["speed_low"]), number(row["speed_high"])
            values.equal("hv.csv", "speed_low", low is None or low <= (speed or 0.0), True)
            values.equal("hv.csv", "speed_high", high is None or high >= (speed or 0.0), True)
            inside = speed is not None and SPEEDS[0] <= speed <= SPEEDS[-1]
            values.equal("hv.csv", "reach", row["reach"] == "within", inside)


def formula(work, curve, v):
    """Resistance in broken ice by F1 (submersion) or F3 (buoyancy and clearing), [N]."""
    s = work.summary("sweep/u1.0s1")
    ship, h, g = s["ship"], 0.3, 9.81
    length, breadth, draught = (ship[k + "_m"] for k in ("length", "breadth", "draught"))
    lift, inertia = (1000 - 870) * g * h * breadth, 870 * breadth * h * v * v
    if curve.startswith("Jeong"):
        clearing = 1.11 * (v / np.sqrt(g * h)) ** -1.157 * inertia if v > 0 else 0.0
        return 0.5 * lift * draught + clearing
    phi, alpha = (np.radians(ship[k + "_angle_deg"]) for k in ("stem", "entrance"))
    psi = np.arctan(np.tan(phi) / np.sin(alpha))
    slope = np.sqrt(1 / np.sin(phi) ** 2 + 1 / np.tan(alpha) ** 2)
    down = lift * (draught * (breadth + draught) / (breadth + 2 * draught) + 0.15 * (
        0.7 * length - draught / np.tan(phi) - breadth / 4 / np.tan(alpha)
        + draught * np.cos(phi) * np.cos(psi) * slope))
    return down * (1 + 9.4 * v / np.sqrt(g * length))
