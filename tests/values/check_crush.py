# SPDX-License-Identifier: GPL-3.0-or-later
"""A floe that does not move, into whose corner a barge drives: the ice crushes at its strength,
which is no jam; of rigid ice the run says that it is jammed.

At a depth d the corner's section is the thickness times d (tan a + tan b), with a and b the angles
of the corner's sides to the course, so the force is the pressure times that."""
import numpy as np

from check_hit import FLOE, GAP, SPEED, STEP, THICKNESS, YAW, case, turned
from tables import read_csv

PRESSURE, DURATION = 4e4, 0.85


def make(work):
    held = case().replace('hold = "never"', 'hold = "always"').replace(
        "duration = 0.75", f"duration = {DURATION}").replace("track = [1, 2]\n", "")
    assert f"duration = {DURATION}" in held
    start = held.index("velocity = "), held.index("hold", held.index("velocity = "))
    held = held[:start[0]] + held[start[1]:]  # of the drifter
    work.write("crush.cfg", held)
    for name, pressure in (("crush", PRESSURE), ("jam", "inf")):
        work.run("icesolve", "crush.cfg", "--out", name, "--no-report", "--set",
                 f"contact.crushing_pressure={pressure}")
    work.keep("crush")


def check(work, values):
    forces, s = read_csv(work / "crush" / "forces.csv"), work.summary("crush")
    corners = np.array(FLOE) @ turned(YAW)[:2, :2].T
    k = corners[:, 0].argmin()
    sides = [corners[(k + step) % len(FLOE)] - corners[k] for step in (1, -1)]
    tangents = sum(abs(side[1]) / side[0] for side in sides)
    depth = np.maximum(0.0, SPEED * forces["time_s"] - GAP)
    want = PRESSURE * THICKNESS * depth * tangents
    push = -forces["contact_fx_N"]
    # spheres stand for patches of the corner: the sum over the run to a tenth
    values.close("forces.csv", "contact_fx_N", push.sum(), want.sum(), 0.1)
    lost = SPEED * STEP * push.sum()
    for name, value in (("ship_work_J", lost), ("crushing_J", lost), ("kinetic_change_J", 0.0),
                        ("friction_J", 0.0), ("restitution_J", 0.0)):
        values.close("summary.json", "energy." + name, s["energy"][name], value, 1e-6, 1e-6 * lost)
    values.equal("summary.json", "warnings[].text", jams(s), 0)
    values.equal("summary.json", "warnings[].text", jams(work.summary("jam")) > 0, True)
    for name, want in (("moved", 0), ("total", 2)):
        values.equal("summary.json", "floes." + name, s["floes"][name], want)



def jams(s):
    return sum("jam" in w["text"] for w in s["warnings"])
