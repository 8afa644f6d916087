# SPDX-License-Identifier: GPL-3.0-or-later
"""The flow around a hull without symmetry and its report: the table against its own derivatives,
the added mass against bounds, a run against its file."""
import hashlib
import json

import h5py
import numpy as np

import check_sheared
from solids import moments, polygon_area, prism
from tables import read_csv

FLOW, REPORT = "flow.h5", "iceflow.json"
DRAUGHT, PANEL, SPACING, DENSITY, ABOUT = 1.2, 0.5, 0.25, 1021.0, (-2.0, 0.1, 0.0)


def make(work):
    work.run("iceflow", "raked.h5", "-o", "raked.flow.h5", "--draught", DRAUGHT, "--panel", PANEL,
             "--spacing", SPACING, "--json", "flow.json", "--added-mass", "--about", *ABOUT,
             "--density", DENSITY)
    work.flow_command = work.last
    work.files.setdefault(FLOW, []).append(work / "raked.flow.h5")
    work.files.setdefault(REPORT, []).append(work / "flow.json")
    work.write("flow.cfg", f"""title = "drift in the flow"
[simulation]
duration = 1.0
time_step = 0.01
[hull]
spheres = "raked.h5"
position = [0.0, 0.0]
draught = {DRAUGHT}
speed = 0.9
[[floes]]
spheres = "corner.h5"
pattern = "single"
position = [4.0, 1.5]
hold = "never"
[flow]
model = "file"
file = "raked.flow.h5"
current = [0.3, -0.1]
pressure = true
[output]
average_from = 0.2
track = [1]
""")
    work.run("icesolve", "flow.cfg", "--out", "flow", "--no-report")
    work.keep("flow", floes=(1,))


def check(work, values):
    report = json.loads((work / "flow.json").read_text(encoding="utf-8"))
    with h5py.File(work / "raked.flow.h5") as file:
        check_head(work, values, file, report)
        check_table(values, file)
        check_report(work, values, file, report)
        check_run(work, values, file)


def check_head(work, values, file, report):
    sha = hashlib.sha256((work / "raked.obj").read_bytes()).hexdigest()
    for name, want in (("format", "icesolve-flow"), ("format_version", 1), ("units", "SI"),
                       ("symmetric", 0), ("source_sha256", sha), ("spacing", SPACING),
                       ("reference_speed", 1.0), ("panels", report["panels"]), ("sealed", 1),
                       ("command_line", work.flow_command), ("residual", report["residual"])):
        values.equal(FLOW, "/@" + name, file.attrs[name], want)
    values.equal(FLOW, "/@created_by", file.attrs["created_by"].split()[0], "iceflow")
    values.close(FLOW, "/@draught", file.attrs["draught"], DRAUGHT, 1e-12)


def check_table(values, file):
    """The topmost nodes lie in the water's surface, where no water rises beside the hull; the
    velocity is the potential's gradient, by differences, where the table neither fades, in the
    outer third of the breadth that it reaches, nor is near the panels."""
    w, phi = file["velocity"][()].astype(float), file["potential"][()].astype(float)
    nz, ny, nx, _ = w.shape
    origin, h = file.attrs["origin"], file.attrs["spacing"]
    values.close(FLOW, "/@origin", origin[2] + (nz - 1) * h, 0.0, margin=1e-9)
    x, y = origin[0] + h * np.arange(nx), origin[1] + h * np.arange(ny)
    z = origin[2] + h * np.arange(nz)
    z, y, x = np.meshgrid(z, y, x, indexing="ij")
    far = np.sqrt(sum(np.maximum(0, np.maximum(low - at, at - high)) ** 2 for at, low, high in (
        (x, -6.0, 2.0), (y, -1.2, 1.5), (z, -DRAUGHT, 0.0))))
    away = (far > 3 * h) & (far < 2.7 * 2 / 3 - 2 * h)
    values.close(FLOW, "/velocity", w[-1, ..., 2][away[-1]], np.zeros(away[-1].sum()), margin=1e-6)
    inner = np.zeros_like(away)
    inner[1:-1, 1:-1, 1:-1] = True
    for k, axis in enumerate((2, 1, 0)):
        slope = np.gradient(phi, h, axis=axis)
        good = away & inner
        margin = 0.02 * np.abs(w).max()
        values.close(FLOW, "/potential", slope[good], w[..., k][good], margin=margin)
        values.close(FLOW, "/velocity", w[..., k][good], slope[good], margin=margin)
    # ahead of the stem on its height the water is pushed ahead, behind the stern it follows
    ahead = np.argmin(np.abs(x[0, 0] - 3.0)), np.argmin(np.abs(y[0, :, 0] - 0.2))
    values.within(FLOW, "/velocity", w[-1, ahead[1], ahead[0], 0], 0.02, 1.0)


def check_report(work, values, file, report):
    hull = prism(check_sheared.PLAN, check_sheared.LOW, check_sheared.HIGH, check_sheared.RAKE)
    for name, want in (("schema", "iceflow/1"), ("dimension", 3), ("symmetric", False),
                       ("draught_m", DRAUGHT), ("spacing_m", SPACING),
                       ("nodes", list(file["velocity"].shape[2::-1]))):
        values.equal(REPORT, name, report[name], want)
    # a panel of at most 0.5 m, quarters of rectangles of it: their number from the wetted area
    values.within(REPORT, "panel_m", report["panel_m"], PANEL / 2, 1.5 * PANEL)
    area = moments(hull)[1]
    values.within(REPORT, "panels", report["panels"], area / 4 / PANEL ** 2, 8 * area / PANEL ** 2)
    # the wetted hull's length is that at the water, 1.2 m over the lowest point
    back = 0.9 * (1.9 - DRAUGHT) / 1.9
    values.close(REPORT, "length_m", report["length_m"], 8.0 - back, 1e-6)
    values.within(REPORT, "residual", report["residual"], 0.0, 0.1)
    values.within(REPORT, "worst", report["worst"], report["residual"], 2.0)
    at = np.array(report["worst_at_m"])
    values.within(REPORT, "worst_at_m", at, [-6.0 - 1e-6, -1.2 - 1e-6, -DRAUGHT - 1e-6],
                  [2.0 + 1e-6, 1.5 + 1e-6, 1e-6])
    values.within(REPORT, "net_flux", abs(report["net_flux"]), 0.0, 0.02)
    mass = report["added_mass"]
    volume = submerged()
    values.close(REPORT, "added_mass.displacement_kg", mass["displacement_kg"], DENSITY * volume,
                 0.02)
    values.equal(REPORT, "added_mass.water_density_kg_per_m3", mass["water_density_kg_per_m3"],
                 DENSITY)
    values.equal(REPORT, "added_mass.about_m", mass["about_m"], list(ABOUT))
    check_matrix(work, values, report)
    for stage, seconds in report["seconds"].items():
        values.within(REPORT, "seconds.<stage>", seconds, 0.0, 600.0)
    work.check_origin(values, REPORT, report)


def submerged():
    """Volume below the water: the plan's area less what the rake takes from each height, [m3]."""
    height = np.linspace(0, DRAUGHT, 2001)
    middle = (height[1:] + height[:-1]) / 2
    lost = 0.9 * (1.9 - middle) / 1.9 * 2.7
    return float(np.sum((polygon_area(check_sheared.PLAN) - lost) * np.diff(height)))


def check_matrix(work, values, report):
    """Symmetric and positive, and it moves with its point as a rigid body's does: M' = S^T M S, for
    points of one height: motions along the water and up and down are worked out apart."""
    name = "added_mass.matrix"
    matrix = np.array(report["added_mass"]["matrix"])
    values.close(REPORT, name, matrix, matrix.T, 1e-9)
    values.within(REPORT, name, np.linalg.eigvalsh(matrix), 0.0, np.inf)
    work.run("iceflow", "raked.h5", "--check", "--draught", DRAUGHT, "--panel", PANEL, "--json",
             "origin.json", "--added-mass", "--about", 0, 0, 0, "--density", DENSITY)
    other = json.loads((work / "origin.json").read_text(encoding="utf-8"))
    a = np.array(ABOUT)
    # a velocity v, w about the origin is v + w x a, w about a
    cross = np.array([[0, a[2], -a[1]], [-a[2], 0, a[0]], [a[1], -a[0], 0]])
    shift = np.block([[np.eye(3), cross], [np.zeros((3, 3)), np.eye(3)]])
    values.close(REPORT, name, other["added_mass"]["matrix"], shift.T @ matrix @ shift, 1e-6)
    # a slender hull moves less water along than across
    share = np.diag(matrix)[:2] / report["added_mass"]["displacement_kg"]
    values.within(REPORT, name, share, [0.01, 2 * share[0]], [0.5, 2.0])


def check_run(work, values, file):
    s = work.summary("flow")
    for name, want in (("model", "file"), ("panels", int(file.attrs["panels"])),
                       ("residual", float(file.attrs["residual"]))):
        values.equal("summary.json", "flow." + name, s["flow"][name], want)
    check_arrows(work, values, file)
    # no contacts: the floe's motion is the work of the water alone
    energy = s["energy"]
    track = read_csv(work / "flow" / "floe_1.csv")
    assert np.abs(track["contact_fx_N"]).max() == 0.0
    spent = energy["kinetic_change_J"] + energy["potential_J"] + energy["drag_J"] + energy[
        "residual_J"]
    values.close("summary.json", "energy.water_work_J", energy["water_work_J"], spent, 1e-6)
    values.within("summary.json", "energy.drag_J", energy["drag_J"], 1e-3, np.inf)
    values.within("summary.json", "energy.water_work_J", energy["water_work_J"], 1e-3, np.inf)


def check_arrows(work, values, table):
    """Arrows of the flow in run.h5 are the table, linear between its nodes, at their points."""
    name = "run.h5"
    with h5py.File(work / "flow" / "run.h5") as file:
        if "flow" not in file:
            return
        point, arrow = (file["flow/" + key][()].astype(float) for key in ("point", "velocity"))
        values.equal(name, "/flow/arrow", list(file["flow/arrow"][()]), list(range(len(point))))
        for key, unit, word in (("point", "m", "water's surface"), ("velocity", "1", "1 m/s")):
            values.equal(name, f"/flow/{key}@units", file["flow/" + key].attrs["units"], unit)
            values.equal(name, f"/flow/{key}@meaning", word in file["flow/" + key].attrs["meaning"],
                         True)
    w = table["velocity"][()].astype(float)
    at = (point - table.attrs["origin"]) / table.attrs["spacing"]
    first = np.clip(np.floor(at + 1e-6).astype(int), 0, np.array(w.shape[2::-1]) - 2)
    part = at - first
    want = 0.0
    for corner in np.ndindex(2, 2, 2):
        i, j, k = (first + corner).T
        share = np.prod(np.where(corner, part, 1 - part), axis=1)
        want = want + share[:, None] * w[k, j, i]
    values.close(name, "/flow/point", want, arrow, margin=1e-4)
    values.close(name, "/flow/velocity", arrow, want, margin=1e-4)
