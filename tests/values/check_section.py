# SPDX-License-Identifier: GPL-3.0-or-later
"""A section (2D): numbers per metre of breadth, their twins, and units."""
import h5py
import numpy as np

from tables import read_csv

STEP, AVERAGE_FROM, SPEED = 0.005, 0.6, 1.0


def make(work):
    for part, radius in (("hull", 0.1), ("floe", 0.05)):
        work.run("spherize", work.source / f"meshes/paper-{part}-2d.obj", "--slice", "y=0", "-r",
                 radius, "-o", f"{part}-2d.h5")
    work.files["spheres.h5"].append(work / "hull-2d.h5")
    text = (work.source / "tests/support/short_case.cfg").read_text(encoding="utf-8")
    text = text.replace("hull.h5", "hull-2d.h5").replace("floe.h5", "floe-2d.h5")
    work.write("section.cfg", text.replace("duration = 3.0", "duration = 1.5") + f"""
[output]
track = [1]
average_from = {AVERAGE_FROM}
""")
    work.run("icesolve", "section.cfg", "--out", "section", "--no-report")
    work.keep("section", floes=(1,))


def check(work, values):
    for form, name in (("forces.csv", "forces.csv"), ("floe.csv", "floe_1.csv")):
        table = read_csv(work / "section" / name)
        twins = [n for n in table if n.endswith(("_N", "_J"))]
        for twin in twins:
            values.close(form, twin + "_per_m", table[twin + "_per_m"], table[twin], 1e-15)
    check_twins(work, values, work.summary("section"))
    check_units(work, values)


def check_twins(work, values, summary):
    """Each key of newtons has a twin with the same value, and the value is that of the rows."""

    def look(node, path):
        if isinstance(node, list):
            for item in node:
                look(item, path + "[]")
        if not isinstance(node, dict):
            return
        for key, value in node.items():
            name = f"{path}.{key}" if path else key
            if path == "regions":
                name = "regions.<region>"
            if key.endswith("_per_m") and key.removesuffix("_per_m") in node:
                values.equal("summary.json", name, value, node[key.removesuffix("_per_m")])
            look(value, name)

    look(summary, "")
    forces = read_csv(work / "section" / "forces.csv")
    kept = forces["time_s"] > AVERAGE_FROM - 1e-6
    mean = -(forces["contact_fx_N"] + forces["friction_fx_N"])[kept].mean()
    values.close("summary.json", "resistance.mean_N_per_m", summary["resistance"]["mean_N_per_m"],
                 mean, 1e-6)
    values.equal("summary.json", "dimension", summary["dimension"], 2)


# of datasets in 3D and in 2D, where forces are per metre of breadth
UNITS = {"/time": ("s", "s"), "/ship/contact_force": ("N", "N/m"), "/ship/force": ("N", "N/m"),
         "/ship/friction_force": ("N", "N/m"), "/ship/moment": ("N m", "N"),
         "/ship/pose": ("m, 1", "m, 1"), "/ship/contacts": ("1", "1"),
         "/ship/moving_floes": ("1", "1"), "/ship/max_overlap": ("m", "m"),
         "/ship/kinetic_energy": ("J", "J/m"), "/regions/contact_force": ("N", "N/m"),
         "/regions/friction_force": ("N", "N/m"), "/frames/frame_time": ("s", "s"),
         "/frames/ship_position": ("m", "m"), "/frames/position": ("m", "m"),
         "/frames/orientation": ("1", "1"), "/frames/velocity": ("m/s", "m/s"),
         "/frames/angular_velocity": ("rad/s", "rad/s"), "/frames/contact_force": ("N", "N/m"),
         "/frames/state": ("1", "1"), "/frames/mass": ("kg", "kg/m"),
         "/frames/inertia": ("kg m2", "kg m"), "/contacts/contact_time": ("s", "s"),
         "/contacts/frame": ("1", "1"), "/contacts/floe": ("1", "1"),
         "/contacts/sphere": ("1", "1"),
         "/contacts/point": ("m", "m"), "/contacts/normal_force": ("N", "N/m"),
         "/contacts/friction_force": ("N", "N/m"), "/panels/region": ("1", "1"),
         "/panels/center": ("m", "m"), "/panels/normal": ("1", "1"), "/panels/area": ("m2", "m2/m"),
         "/panels/length": ("m", "m"), "/panels/force_mean": ("N", "N/m"),
         "/panels/force_p99": ("N", "N/m"), "/panels/force_max": ("N", "N/m")}
OF_SHIP = {"/ship/velocity": "m/s", "/ship/angles": "rad", "/ship/thrust": "N",
           "/ship/tow_force": "N", "/frames/ship_orientation": "1"}
TRACK = "m,m,m,1,1,1,1,m/s,m/s,m/s,rad/s,rad/s,rad/s" + 9 * ",{}"


def check_units(work, values):
    form = "run.h5"
    for column, folder in enumerate(("sheared", "section")):
        force = ("N", "N/m")[column]
        with h5py.File(work / folder / "run.h5") as file:
            for name, units in UNITS.items():
                if name in file:
                    values.equal(form, name + "@units", file[name].attrs["units"], units[column])
            values.equal(form, "/tracked/<floe>@units", file["tracked/1"].attrs["units"], "SI")
            values.equal(form, "/tracked/<floe>@column_units",
                         file["tracked/1"].attrs["column_units"], TRACK.format(*9 * [force]))
            head = file.attrs
            title = ("three floes", "short")[column]
            for name, want in (("format", "icesolve-result"), ("format_version", 1),
                               ("units", "SI"), ("dimension", 3 - column), ("title", title)):
                values.equal(form, "/@" + name, head[name], want)
            values.close(form, "/@average_from", head["average_from"], [0.7, AVERAGE_FROM][column])
            for name in ("git_commit", "command_line"):
                values.equal(form, "/@" + name, head[name], work.summary(folder)[name])
            values.equal(form, "/@created_by", head["created_by"].split()[0], "icesolve")
            resolved = (work / folder / "case.resolved.cfg").read_text(encoding="utf-8")
            # the file has two lines of comment above it
            values.equal(form, "/@case_toml", head["case_toml"], resolved.split("\n", 2)[2])
            check_words(values, file)
    with h5py.File(work / "turn" / "run.h5") as file:
        for name, unit in OF_SHIP.items():
            values.equal(form, name + "@units", file[name].attrs["units"], unit)
        check_words(values, file)


def check_words(values, file):
    """Texts that say what a dataset is name the thing."""
    words = {"/ship/contact_force": "normal", "/ship/friction_force": "tangential",
             "/ship/force": "resistance is -x", "/ship/moment": "moment", "/ship/pose": "origin",
             "/ship/contacts": "impulse", "/ship/moving_floes": "not held",
             "/ship/max_overlap": "deepest", "/ship/kinetic_energy": "floes", "/time": "end",
             "/regions/contact_force": "normal", "/regions/friction_force": "tangential",
             "/ship/velocity": "centre of gravity", "/ship/angles": "roll, pitch and yaw",
             "/panels/area": "area", "/panels/length": "waterline", "/panels/center": "middle",
             "/panels/normal": "outward", "/panels/region": "hull_regions",
             "/panels/force_mean": "mean", "/panels/force_p99": "99 %",
             "/panels/force_max": "largest", "/shapes/hull_panel": "/panels"}
    for name, word in words.items():
        if name in file:
            values.equal("run.h5", name + "@long_name", word in file[name].attrs["long_name"], True)
    for name, key, word in (
            ("/ship/moment", "reference_point", "origin of the hull's mesh"),
            ("/frames/orientation", "order", "w,x,y,z body to world"),
            ("/frames/ship_orientation", "order", "w,x,y,z ship to world"),
            ("/frames/contact_force", "meaning", "of the ship on the floe"),
            ("/frames/state", "meaning", "0 held, 1 moving, 2 behind the hull"),
            ("/contacts/frame", "meaning", "row of /frames"),
            ("/contacts/point", "meaning", "ship frame")):
        if name in file:
            values.equal("run.h5", f"{name}@{key}", word in file[name].attrs[key], True)
