# SPDX-License-Identifier: GPL-3.0-or-later
"""One floe, met by a barge's flat bow on its corner, and one that drifts away: every number of the
run by hand.

The water is left out (no gravity, no drag), contacts are rigid and without friction. The corner is
an upright edge; its contacts are alike above and below the centre of mass, so the impact is plane:

    J = (1 + e) U / (1 / m + d^2 / I_zz),    v = J / m,    w_z = -d J / I_zz

with d the corner's y from the centre of mass."""
import numpy as np

from solids import moments, prism
from tables import read_csv

SPEED, RESTITUTION, STEP, DURATION, AVERAGE_FROM = 1.0, 0.3, 0.01, 0.75, 0.3
DENSITY, THICKNESS, YAW = 880.0, 0.3, 0.35
BARGE = [(-8.0, -2.0), (0.0, -2.0), (0.0, 3.0), (-8.0, 3.0)]  # side1 is the bow
LOW, HIGH, ORIGIN_X = -1.1, 0.7, -30.0
FLOE = [(0.0, -0.6), (0.9, -0.5), (1.0, 0.3), (0.2, 0.7)]
GAP, PLACE_Y = 0.6, 0.8
DRIFTER = {"position": [-10.0, 9.0, -0.2], "velocity": [0.7, -0.3, 0.05], "spin": [0.0, 0.0, 0.9]}
RUN = "hit"


def turned(angle):
    return np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                     [0, 0, 1]])


def floe():
    """Mass, inertia tensor in world axes, and corners about the centre of mass."""
    volume, _, centroid, inertia = moments(prism(FLOE, 0.0, THICKNESS))
    around = turned(YAW)
    corners = (np.array([(*p, THICKNESS / 2) for p in FLOE]) - centroid) @ around.T
    return DENSITY * volume, DENSITY * around @ inertia @ around.T, corners


def start_x():
    """Where the centre of mass is, so that the foremost corner is GAP ahead of the bow."""
    return ORIGIN_X + GAP - floe()[2][:, 0].min()


def case(extra=""):
    half = YAW / 2
    return f"""title = "one floe"
[simulation]
duration = {DURATION}
time_step = {STEP}
[environment]
gravity = 0.0
water_density = 1013.0
[hull]
spheres = "barge.h5"
position = [{ORIGIN_X}, 0.0, 0.0]
speed = {SPEED}
[ice]
density = {DENSITY}
[[floes]]
spheres = "corner.h5"
pattern = "single"
position = [{start_x()!r}, {PLACE_Y}, -0.3]
orientation = [{np.cos(half)!r}, 0, 0, {np.sin(half)!r}]
hold = "never"
[[floes]]
spheres = "corner.h5"
pattern = "single"
position = {DRIFTER["position"]}
velocity = {DRIFTER["velocity"]}
angular_velocity = {DRIFTER["spin"]}
hold = "never"
[contact]
restitution = {RESTITUTION}
friction_ship_ice = 0.0
friction_ice_ice = 0.27
crushing_pressure = inf
iterations = 10000
tolerance = 1e-9
[buoyancy]
model = "none"
[drag]
model = "none"
[output]
track = [1, 2]
average_from = {AVERAGE_FROM}
frames_every = 0.05
{extra}"""


def make(work):
    work.mesh("barge.obj", prism(BARGE, LOW, HIGH))
    work.run("spherize", "barge.obj", "-r", 0.15, "-s", 0.3, "-o", "barge.h5")
    work.mesh("corner.obj", prism(FLOE, 0.0, THICKNESS))
    work.run("spherize", "corner.obj", "-r", 0.05, "-s", 0.1, "-o", "corner.h5")
    work.write("hit.cfg", case())
    work.run("icesolve", "hit.cfg", "--out", RUN, "--no-report", "--threads", 2, "--verify")
    work.hit_command = work.last
    work.keep(RUN, floes=(1, 2))


class Impact:
    """The numbers of the docstring."""

    def __init__(self):
        self.mass, tensor, corners = floe()
        self.spin_inertia = tensor[2, 2]
        arm = corners[corners[:, 0].argmin()]
        one = 1 / self.mass + arm[1] ** 2 / self.spin_inertia
        self.impulse = (1 + RESTITUTION) * SPEED / one
        self.velocity = self.impulse / self.mass
        self.spin = -arm[1] * self.impulse / self.spin_inertia
        self.arm = arm
        self.energy = (self.mass * self.velocity ** 2 + self.spin_inertia * self.spin ** 2) / 2
        v, w = np.array(DRIFTER["velocity"]), DRIFTER["spin"][2]
        self.drifting = 0.5 * self.mass * (v @ v) + 0.5 * self.spin_inertia * w * w


def check(work, values):
    hit = Impact()
    forces = read_csv(work / RUN / "forces.csv")
    row = check_forces(values, forces, hit)
    check_floe(work, values, hit, row)
    check_drifter(work, values)


def check_forces(values, forces, hit):
    """Every step has a row; all are zero but that of the impact. @return its number"""
    steps = round(DURATION / STEP)
    time = STEP * np.arange(1, steps + 1)
    values.close("forces.csv", "time_s", forces["time_s"], time, 1e-8)
    row = int(np.abs(forces["contact_fx_N"]).argmax())
    alone = np.zeros(steps)
    alone[row] = 1.0
    values.close("forces.csv", "contact_fx_N", forces["contact_fx_N"], -hit.impulse / STEP * alone,
                 1e-6)
    for name in ("contact_fy_N", "contact_fz_N", "friction_fx_N", "friction_fy_N", "friction_fz_N"):
        values.close("forces.csv", name, forces[name], 0 * alone, margin=1e-6)
    values.within("forces.csv", "contacts", forces["contacts"][row], 1, 8)
    values.close("forces.csv", "contacts", np.delete(forces["contacts"], row), alone[1:] * 0.0)
    values.close("forces.csv", "moving_floes", forces["moving_floes"], 2 + 0 * alone)
    values.within("forces.csv", "max_overlap_m", forces["max_overlap_m"], 0.0, SPEED * STEP)
    energy = hit.drifting + hit.energy * (np.arange(steps) >= row)
    values.close("forces.csv", "kinetic_energy_J", forces["kinetic_energy_J"], energy, 1e-6)
    # the corner is reached after GAP / SPEED, at most a step early or late
    assert abs(time[row] - GAP / SPEED) < 1.5 * STEP, time[row]
    return row


def check_floe(work, values, hit, row):
    track = read_csv(work / RUN / "floe_1.csv")
    after = np.arange(len(track["time_s"])) >= row
    since = np.where(after, STEP * (np.arange(len(after)) - row + 1), 0.0)
    angle = YAW + hit.spin * since
    expected = {"time_s": STEP * (np.arange(len(after)) + 1),
                "x_m": start_x() + hit.velocity * since, "y_m": PLACE_Y + 0 * since,
                "z_m": -0.3 + 0 * since, "qw": np.cos(angle / 2), "qx": 0 * since, "qy": 0 * since,
                "qz": np.sin(angle / 2), "vx": hit.velocity * after, "vy": 0 * since,
                "vz": 0 * since, "wx": 0 * since, "wy": 0 * since, "wz": hit.spin * after}
    alone = np.arange(len(after)) == row
    expected["contact_fx_N"] = -hit.impulse / STEP * alone
    for name in ("contact_fy_N", "contact_fz_N", "friction_fx_N", "friction_fy_N",
                 "friction_fz_N", "ice_fx_N", "ice_fy_N", "ice_fz_N"):
        expected[name] = 0 * since
    for name, want in expected.items():
        # spheres stand for the corner, whose arm they know to some 1e-6 m
        values.close("floe.csv", name, track[name], want, 1e-6, margin=1e-6)


def check_drifter(work, values):
    """Uniform motion and a turn about the vertical."""
    track = read_csv(work / RUN / "floe_2.csv")
    time = track["time_s"]
    for k, axis in enumerate("xyz"):
        values.close("floe.csv", f"{axis}_m", track[f"{axis}_m"],
                     DRIFTER["position"][k] + DRIFTER["velocity"][k] * time, 1e-7)
        values.close("floe.csv", "v" + axis, track["v" + axis],
                     DRIFTER["velocity"][k] + 0 * time, 1e-8)
        values.close("floe.csv", "w" + axis, track["w" + axis], DRIFTER["spin"][k] + 0 * time,
                     margin=1e-8)
    values.close("floe.csv", "qw", track["qw"], np.cos(0.45 * time), 1e-7)
    values.close("floe.csv", "qz", track["qz"], np.sin(0.45 * time), 1e-7)
