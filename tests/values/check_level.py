# SPDX-License-Identifier: GPL-3.0-or-later
"""Level ice that a ship breaks, and members of an ensemble: numbers that follow from the rows."""
import csv
import io
import re
import shutil
import urllib.parse

import h5py
import numpy as np

from solids import moments
from tables import read_csv

AVERAGE_FROM, STEP = 1.5, 0.02


def make(work):
    work.write("level.cfg", f"""title = "level ice"
[simulation]
duration = 4.0
time_step = {STEP}
[hull]
spheres = "raked.h5"
position = [-2.1, 0.0]
draught = 1.2
speed = 0.9
[level_ice]
thickness = 0.2
extent = [0, 5, -4, 4]
spacing = 0.2
[bending]
flexural_strength = 4e5
elastic_modulus = 3e9
poisson_ratio = 0.31
model = "wedge"
factor = 1.3
[contact]
restitution = 0.1
crushing_pressure = 1.1e6
[output]
average_from = {AVERAGE_FROM}
""")
    work.run("icesolve", "level.cfg", "--out", "level", "--no-report")
    work.keep("level")
    shutil.copytree(work / "level", work / "sheets/one")
    work.run("icepost", "sweep", "sheets", "-o", "level.html")
    text = re.search('download="points.csv" href="data:text/csv;charset=utf-8,([^"]*)"',
                     (work / "level.html").read_text(encoding="utf-8"))
    (work.level_point,) = csv.DictReader(io.StringIO(urllib.parse.unquote(text.group(1))))
    work.run("icesolve", "sheared.cfg", "--seeds", 3, "--out", "members", "--no-report", "--set",
             "simulation.jitter=0.05")
    work.files["summary.json"].append(work / "members" / "summary.json")


def check(work, values):
    forces, s = read_csv(work / "level" / "forces.csv"), work.summary("level")
    kept = forces["time_s"] > AVERAGE_FROM - 1e-6
    total = -(forces["contact_fx_N"] + forces["friction_fx_N"])
    breaking = -forces["breaking_fx_N"]
    # what presses on held ice is a part of the whole; the rest is that of loose pieces
    values.within("forces.csv", "breaking_fx_N", breaking, -1e-6, total.max() + 1e-6)
    r = s["resistance"]
    values.close("summary.json", "resistance.breaking_mean_N", r["breaking_mean_N"],
                 breaking[kept].mean(), 1e-6)
    values.close("summary.json", "resistance.submersion_mean_N", r["submersion_mean_N"],
                 (total - breaking)[kept].mean(), 1e-6)
    for name, want in (("flexural_strength_Pa", 4e5), ("elastic_modulus_Pa", 3e9),
                       ("poisson_ratio", 0.31), ("crushing_pressure_Pa", 1.1e6),
                       ("thickness_m", 0.2)):
        values.close("summary.json", "ice." + name, s["ice"][name], want, 1e-9)
    values.equal("summary.json", "ice.hold", s["ice"]["hold"], ["until-bent", "always"])
    values.equal("summary.json", "ice.bending_model", s["ice"]["bending_model"], "wedge")
    values.equal("summary.json", "ice.bending_factor", s["ice"]["bending_factor"], 1.3)
    energy = s["energy"]
    # the speed is the same all the time, and what breaks is at rest until it breaks: the ship's
    # work on held ice is all lost
    values.close("summary.json", "energy.breaking_J", energy["breaking_J"],
                 0.9 * STEP * breaking.sum(), 0.02)
    spent = sum(energy[k + "_J"] for k in (
        "kinetic_change", "potential", "friction", "restitution", "crushing", "breaking", "drag",
        "buoyancy_moment", "residual"))
    given = sum(energy.get(k + "_J", 0.0) for k in ("ship_work", "separation", "water_work",
                                                    "drift_work"))
    values.close("summary.json", "energy.breaking_J", spent, given, 1e-9)
    check_formulas(values, s)
    check_pieces(work, values)
    check_cracks(work, values)
    check_members(work, values)


def check_pieces(work, values):
    """Pieces that broke off and the rest of the sheet: prisms of its thickness, each about its own
    centre, with the ice's density, that are together the sheet less the cracks."""
    form = "pieces.h5"
    work.files.setdefault(form, []).append(work / "level/pieces.h5")
    length = (3e9 * 0.2 ** 3 / (12 * (1 - 0.31 ** 2) * 1000 * 9.81)) ** 0.25
    with h5py.File(work / "level/pieces.h5") as file:
        head = file.attrs
        values.equal(form, "/@format", head["format"], "icesolve-pieces")
        values.equal(form, "/@format_version", head["format_version"], 1)
        whole = 0.0
        for group in ("pieces", "rest", "sheet"):
            rows = file[group]
            first, side = rows["vertex_offset"][()], rows["triangle_offset"][()]
            for k, mass in enumerate(rows["mass"][()]):
                solid = (rows["vertices"][first[k]:first[k + 1]],
                         {"": rows["triangles"][side[k]:side[k + 1]]})
                volume, _, centroid, _ = moments(solid)
                whole += volume if group != "pieces" else 0.0
                values.close(form, f"/{group}/vertices", centroid, [0, 0, 0], margin=1e-6)
                for name in ("mass", "vertex_offset", "triangle_offset", "triangles"):
                    values.close(form, f"/{group}/{name}", mass, 900 * volume, 1e-9)
            at = rows["at"][()]
            values.within(form, f"/{group}/at", at[:, :2], [0, -4], [5, 4])
        # the sheet at the start; the ship is beside it
        values.within(form, "/rest/mass", whole / (5 * 8 * 0.2), 0.98, 1.001)
        values.within(form, "/sheet/gone", file["sheet/gone"][()], 0.0, 4.0)
        values.equal(form, "/drift", file["drift"][()].tolist(), [[0.0, 0.0, 0.0]])
        pieces = file["pieces"]
        values.equal(form, "/pieces/number", len(set(pieces["number"][()])), len(pieces["mass"]))
        for name, low, high in (("body", head["first_body"], np.inf), ("born", 0.0, 4.0),
                                ("load", 1.0, 1e7), ("gone", pieces["born"][()], np.inf),
                                # 0.32 of the characteristic length, 0.9 m/s at most, +- 20 %
                                ("radius", 0.32 * length * (1 - 0.144 * 0.9) * 0.8,
                                 0.32 * length * 1.2)):
            values.within(form, "/pieces/" + name, pieces[name][()], low, high)
        for name in ("first_body", "piece_group", "rest_group"):
            values.within(form, "/@" + name, head[name], 0, 1000)


def check_cracks(work, values):
    """Means over the pieces of pieces.h5, in the summary and in the points of a sweep."""
    s = work.summary("level")
    cracks, resistance = s["level_ice"], s["resistance"]
    length = (3e9 * 0.2 ** 3 / (12 * (1 - 0.31 ** 2) * 1000 * 9.81)) ** 0.25
    with h5py.File(work / "level/pieces.h5") as file:
        pieces, sheet = file["pieces"], file["sheet"]
        radius = pieces["radius"][()].mean()
        lost = sheet["mass"][()][sheet["gone"][()] > 0].sum() / (900 * 0.2)
        # a piece is its part of the sheet less half a gap all around
        area = pieces["mass"][()] / (900 * 0.2)
        opening = np.degrees(np.minimum(2 * area / pieces["radius"][()] ** 2, np.pi)).mean()
        known = {"pieces": len(pieces["mass"]), "crack_radius_m": radius,
                 "characteristic_length_m": length, "thickness_m": 0.2,
                 "crack_radius_per_length": radius / length,
                 "crack_radius_per_thickness": radius / 0.2,
                 "breaking_load_N": pieces["load"][()].mean()}
    for name, want in known.items():
        values.close("summary.json", "level_ice." + name, cracks[name], want, 1e-6)
    values.within("summary.json", "level_ice.opening_deg", cracks["opening_deg"], 0.95 * opening,
                  1.2 * opening)
    # broken along the bow's way through the ice, 0.9 m/s for 4 s at most, and a crack before it
    values.within("summary.json", "level_ice.channel_breadth_m", cracks["channel_breadth_m"],
                  lost / (0.9 * 4.0 + 2 * radius), 8.0)
    row = work.level_point
    for name in ("crack_radius_m", "crack_radius_per_length", "crack_radius_per_thickness",
                 "opening_deg", "channel_breadth_m"):
        values.close("points.csv", name, float(row[name]), cracks[name], 1e-9)
    for name in ("breaking", "submersion"):
        values.close("points.csv", name + "_N", float(row[name + "_N"]),
                     resistance[name + "_mean_N"], 1e-9)
        # one run has no interval of its parts
        values.equal("points.csv", name + "_ci95_N", row[name + "_ci95_N"], "")


def check_formulas(values, s):
    """Lindqvist (1989), Riska and others (1997), Jeong (2010) as their papers' readers print them,
    for the ship and the ice that the summary names."""
    ship = s["ship"]
    length, breadth, draught = (ship[k + "_m"] for k in ("length", "breadth", "draught"))
    phi, alpha = (np.radians(ship[k + "_angle_deg"]) for k in ("stem", "entrance"))
    h, mu, v, g, water, ice = 0.2, 0.1, 0.9, 9.81, 1000.0, 900.0
    strength, modulus, poisson = 4e5, 3e9, 0.31
    psi = np.arctan(np.tan(phi) / np.sin(alpha))
    lift = (water - ice) * g * h * breadth
    slope = np.sqrt(1 / np.sin(phi) ** 2 + 1 / np.tan(alpha) ** 2)
    down = lift * (draught * (breadth + draught) / (breadth + 2 * draught) + mu * (
        0.7 * length - draught / np.tan(phi) - breadth / 4 / np.tan(alpha)
        + draught * np.cos(phi) * np.cos(psi) * slope))
    down *= 1 + 9.4 * v / np.sqrt(g * length)
    crush = 0.5 * strength * h * h * (np.tan(phi) + mu * np.cos(phi) / np.cos(psi)) / (
        1 - mu * np.sin(phi) / np.cos(psi))
    bend = 27 / 64 * strength * breadth * h ** 1.5 / np.sqrt(
        modulus / (12 * (1 - poisson ** 2) * water * g)) * (
        np.tan(psi) + mu * np.cos(phi) / (np.sin(alpha) * np.cos(psi))) * (1 + 1 / np.cos(psi))
    faster = 1 + 1.4 * v / np.sqrt(g * h)
    inertia = ice * breadth * h * v * v
    clearing = 1.11 * (v / np.sqrt(g * h)) ** -1.157 * inertia
    breaking = 2.73 * (v * np.sqrt(ice * breadth / strength / h)) ** -1.54 * inertia
    buoyancy = 0.5 * lift * draught
    want = {("Lindqvist 1989", "submersion"): down, ("Lindqvist 1989", "crushing"): crush * faster,
            ("Lindqvist 1989", "bending"): bend * faster,
            ("Lindqvist 1989", "total"): down + (crush + bend) * faster,
            ("Jeong 2010", "buoyancy"): buoyancy, ("Jeong 2010", "clearing"): clearing,
            ("Jeong 2010", "buoyancy + clearing"): buoyancy + clearing,
            ("Jeong 2010", "breaking"): breaking,
            ("Jeong 2010", "total"): buoyancy + clearing + breaking,
            ("Riska 1997", "total"): riska(ship, h, v)}
    found = {(f["name"], f["part"]): f for f in s["formulas"]}
    key = "formulas[]."
    values.equal("summary.json", key + "name", {k[0] for k in found}, {k[0] for k in want})
    values.equal("summary.json", key + "part", set(found), set(want))
    for pair, value in want.items():
        values.close("summary.json", key + "value_N", found[pair]["value_N"], value, 1e-6)
        values.equal("summary.json", key + "verified", found[pair]["verified"],
                     pair in (("Jeong 2010", "breaking"), ("Jeong 2010", "total")))
    values.close("summary.json", "lindqvist_submersion_N", s["lindqvist_submersion_N"], down, 1e-6)


def riska(ship, h, v):
    """In kN, m, m/s and degrees."""
    length, breadth, draught = (ship[k + "_m"] for k in ("length", "breadth", "draught"))
    bow, parallel, phi = ship["bow_length_m"], ship["parallel_length_m"], ship["stem_angle_deg"]
    at_rest = 0.23 / (2 * draught / breadth + 1) * breadth * parallel * h + (1 + 0.021 * phi) * (
        4.58 * breadth * h * h + 1.47 * bow * h * h + 0.29 * breadth * bow * h)
    per_speed = (1 + 0.063 * phi) * (18.9 * h ** 1.5 + 0.67 * breadth * h) + 1.55 * h * (
        1 + 1.2 * draught / breadth) * breadth ** 2 / np.sqrt(length)
    return 1e3 * (at_rest + per_speed * v)


def check_members(work, values):
    """Student's interval over three means: t(2, 97.5 %) = 4.302653."""
    s = work.summary("members")
    means = [work.summary(f"members/seed-{k}")["resistance"]["mean_N"] for k in (1, 2, 3)]
    e = s["ensemble"]
    values.equal("summary.json", "ensemble.seeds", e["seeds"], [1, 2, 3])
    values.equal("summary.json", "ensemble.members", e["members"], 3)
    values.close("summary.json", "ensemble.means_N", e["means_N"], means, 1e-12)
    values.close("summary.json", "ensemble.mean_N", e["mean_N"], np.mean(means), 1e-9)
    half = 4.302653 * np.std(means, ddof=1) / np.sqrt(3)
    values.close("summary.json", "ensemble.ci95_N", e["ci95_N"], half, 1e-6)
    values.close("summary.json", "resistance.ci95_N", s["resistance"]["ci95_N"], half, 1e-6)
    check_averages(values, s, [work.summary(f"members/seed-{k}") for k in (1, 2, 3)])


def check_averages(values, s, members):
    """Numbers of an ensemble are its members' means, largest values or sums."""
    forces = [f"{force}.{name}" for force in ("resistance", "lateral", "vertical")
              for name in ("mean_N", "contact_mean_N", "friction_mean_N", "std_N")]
    regions = [f"regions.{region}.{name}" for region in s["regions"]
               for name in ("mean_N", "contact_mean_N", "friction_mean_N")]
    energy = [f"energy.{name}_J" for name in ("ship_work", "kinetic_change", "friction", "crushing",
                                              "restitution", "separation")]
    for keys, rule in ((forces + regions + energy + ["contacts.mean", "contacts.residual_share",
                                                     "travel.distance_m"], np.mean),
                       (["contacts.max", "contacts.max_overlap_m"],
                        np.max),
                       (["steps", "simulated_s", "wall_s", "contacts.unconverged_steps"], np.sum)):
        for key in keys:
            want = rule([at_key(member, key) for member in members], axis=0)
            name = "regions.<region>." + key.rsplit(".", 1)[1] if "regions" in key else key
            values.close("summary.json", name, at_key(s, key), want, 1e-9, 1e-12)


def at_key(summary, key):
    for part in key.split("."):
        summary = summary[part]
    return summary
