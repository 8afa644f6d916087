# SPDX-License-Identifier: GPL-3.0-or-later
"""A free ship: one that a spring and a thrust swing along its course, by hand, and one that
a tow over its deck turns, by its histories.

Along the course, s being how far the ship is ahead of its carriage,

    u' = u + dt (T - k s) / m,    s' = s + dt (u' - U),

symplectic Euler as docs/method.md says; its period is that of sqrt(m / k) to (omega dt)^2 / 24."""
import h5py
import numpy as np

import check_hit
from tables import read_csv

STEP, DURATION, AVERAGE_FROM, SPEED = 0.02, 12.0, 2.0, 0.8
MASS, STIFFNESS, THRUST = 40000.0, 90000.0, 2500.0
CENTRE = [-4.0, 0.5, -0.2]  # over the middle of the barge, which so floats upright
HEIGHT = 0.05  # of the mesh's origin: the barge draws 1.05 m
COLUMNS = "forces.csv"


def case(free, more):
    return f"""title = "a free ship"
[simulation]
duration = {DURATION}
time_step = {STEP}
[environment]
water_density = 1000.0
[hull]
spheres = "barge.h5"
position = [-60.0, 0.0, {HEIGHT}]
speed = {SPEED}
[ship]
free = {free}
centre_of_gravity = {CENTRE}
{more}
[[floes]]
spheres = "corner.h5"
pattern = "single"
position = [0.0, 0.0]
hold = "never"
[output]
average_from = {AVERAGE_FROM}
frames_every = 0.1
"""


def make(work):
    work.write("swing.cfg", case('["surge"]', f"""mass = {MASS}
[propulsion]
thrust = {THRUST}
[tow]
point = [0.0, 0.0, -0.2]
stiffness = {STIFFNESS}
"""))
    work.write("turn.cfg", case('["surge", "sway", "heave", "roll", "pitch", "yaw"]', """
damping = [0.05, 0.05, 0.1, 0.1, 0.1, 0.05]
[propulsion]
thrust_table = [[0, 6000], [2, 3000]]
[tow]
point = [-1.0, 2.0, 2.5]
stiffness = 50000
damping = 3000
[mooring]
stiffness = [20000, 30000, 0, 0, 0, 900000]
"""))
    for name in ("swing", "turn"):
        work.run("icesolve", f"{name}.cfg", "--out", name, "--no-report")
        work.keep(name)


def swing():
    """Stretch before each step and speed behind it."""
    count = round(DURATION / STEP)
    stretch, speed = np.zeros(count + 1), np.full(count + 1, SPEED)
    for k in range(count):
        speed[k + 1] = speed[k] + STEP * (THRUST - STIFFNESS * stretch[k]) / MASS
        stretch[k + 1] = stretch[k] + STEP * (speed[k + 1] - SPEED)
    return stretch, speed


def check(work, values):
    forces = read_csv(work / "swing" / "forces.csv")
    stretch, speed = swing()
    time = STEP * np.arange(1, len(speed))
    zero = 0 * time
    for name, want in (("ship_u", speed[1:]), ("ship_x_m", -60.0 + SPEED * time + stretch[1:]),
                       ("ship_z_m", HEIGHT + zero), ("ship_roll", zero), ("ship_pitch", zero),
                       ("ship_yaw", zero), ("thrust_N", THRUST + zero),
                       ("tow_fx_N", -STIFFNESS * stretch[:-1])):
        values.close(COLUMNS, name, forces[name], want, 1e-6, margin=1e-7)
    check_swing(work, values, time, stretch, speed)
    check_turn(work, values)


def check_swing(work, values, time, stretch, speed):
    s = work.summary("swing")
    kept = time > AVERAGE_FROM - 1e-9
    u, tow = speed[1:][kept], -STIFFNESS * stretch[:-1][kept]
    period = 2 * np.pi * np.sqrt(MASS / STIFFNESS)
    ship = s["ship"]
    for name, want, rel in (
            ("mass_kg", MASS, 1e-12), ("speed_mean", u.mean(), 1e-6),
            ("speed_std", u.std(ddof=1), 1e-6), ("thrust_mean_N", THRUST, 1e-9),
            ("tow_fx_mean_N", tow.mean(), 1e-6), ("tow_fx_std_N", tow.std(ddof=1), 1e-6),
            # whole periods within the 10 s: 2.4 of them give 2 or 3
            ("surge_period_s", period, 0.3), ("surge_amplitude_m", np.ptp(stretch) / 2, 0.35)):
        values.close("summary.json", "ship." + name, ship[name], want, rel)
    values.close("summary.json", "ship.surge_amplitude_m", ship["surge_amplitude_m"],
                 np.sqrt(2) * u.std(ddof=1) * ship["surge_period_s"] / (2 * np.pi), 1e-6)
    values.equal("summary.json", "ship.stuck", ship["stuck"], False)
    values.close("summary.json", "travel.distance_m", s["travel"]["distance_m"],
                 SPEED * DURATION + stretch[-1], 1e-6)
    middle = (speed[1:] + speed[:-1]) / 2
    work_of = lambda force: STEP * np.sum(force * middle)
    kinetic = 0.5 * MASS * (speed[-1] ** 2 - SPEED ** 2)
    energy = s["energy"]
    for name, want in (("thrust_work_J", work_of(THRUST)),
                       ("tow_work_J", work_of(-STIFFNESS * stretch[:-1])),
                       ("ship_kinetic_J", kinetic), ("mooring_work_J", 0.0),
                       ("ship_ice_work_J", 0.0), ("ship_losses_J", 0.0),
                       ("ship_potential_J", 0.0), ("ship_residual_J", 0.0),
                       ("ship_separation_J", 0.0)):
        values.close("summary.json", "energy." + name, energy[name], want, 1e-5, margin=1e-3)


def check_turn(work, values):
    forces, s = read_csv(work / "turn" / "forces.csv"), work.summary("turn")
    kept = forces["time_s"] > AVERAGE_FROM - 1e-6
    check_poses(work, values, forces)
    ship = s["ship"]
    for name in ("roll", "pitch", "yaw"):
        angle = np.degrees(forces["ship_" + name][kept])
        values.close("summary.json", f"ship.{name}_mean_deg", ship[name + "_mean_deg"],
                     angle.mean(), 1e-6)
        values.close("summary.json", f"ship.{name}_std_deg", ship[name + "_std_deg"], angle.std(),
                     1e-5)
    with h5py.File(work / "turn" / "run.h5") as file:
        pose, time = file["ship/pose"][()], file["time"][()]
    centre = pose[:, :3] + rotate(pose[:, 3:], CENTRE)
    anchor = np.column_stack([-60.0 + CENTRE[0] + 0 * time, CENTRE[1] + 0 * time])
    for k, name in enumerate(("surge", "sway")):  # from the mooring's place
        off = (centre[:, k] - anchor[:, k])[kept]
        values.close("summary.json", f"ship.{name}_mean_m", ship[name + "_mean_m"], off.mean(),
                     1e-6)
        values.close("summary.json", f"ship.{name}_std_m", ship[name + "_std_m"], off.std(), 1e-5)
    # the mooring pulls by the place before each step
    off = centre[:, 0] - anchor[:, 0]
    pull = -20000.0 * np.concatenate([[0.0], off[:-1]])[kept]
    values.close("summary.json", "ship.mooring_fx_mean_N", ship["mooring_fx_mean_N"], pull.mean(),
                 1e-5)
    values.close("summary.json", "ship.mooring_fx_std_N", ship["mooring_fx_std_N"],
                 pull.std(ddof=1), 1e-5)
    # a box afloat: its weight is that of 8 x 5 x 1.05 m of water at the start
    heave = (centre[:, 2] - HEIGHT - CENTRE[2])[kept]
    values.close("summary.json", "ship.heave_mean_m", ship["heave_mean_m"], heave.mean(),
                 margin=1e-6)
    values.close("summary.json", "ship.heave_std_m", ship["heave_std_m"], heave.std(), 1e-4)
    draught = -HEIGHT - check_hit.LOW
    # KB + BM - KG, BM = B^2 / (12 T), about the middle of the breadth
    gm = draught / 2 + 25.0 / (12 * draught) - (CENTRE[2] - check_hit.LOW)
    values.close("summary.json", "ship.gm_m", ship["gm_m"], gm, 1e-6)
    values.close("summary.json", "ship.mass_kg", ship["mass_kg"], 1000.0 * 40 * draught, 1e-6)
    energy = s["energy"]
    balance = sum(energy[k] for k in ("thrust_work_J", "tow_work_J", "mooring_work_J",
                                      "ship_separation_J")) - sum(
        energy[k] for k in ("ship_ice_work_J", "ship_losses_J", "ship_kinetic_J",
                            "ship_potential_J", "ship_residual_J"))
    for key in ("mooring_work_J", "ship_losses_J", "ship_potential_J"):
        values.close("summary.json", "energy." + key, balance, 0.0, margin=1e-6)
        values.within("summary.json", "energy." + key, abs(energy[key]), 1.0, np.inf)


def check_poses(work, values, forces):
    """Angles are those of R_z(yaw) R_y(pitch) R_x(roll), positions and speeds those of the rows."""
    name = "run.h5"
    with h5py.File(work / "turn" / "run.h5") as file:
        pose, velocity = file["ship/pose"][()], file["ship/velocity"][()]
        angles = np.column_stack([forces["ship_" + k] for k in ("roll", "pitch", "yaw")])
        values.close(name, "/ship/angles", file["ship/angles"][()], angles, 1e-8)
        ahead = rotate(pose[:, 3:], [1.0, 0.0, 0.0])
        values.close(COLUMNS, "ship_yaw", forces["ship_yaw"], np.arctan2(ahead[:, 1], ahead[:, 0]),
                     margin=1e-8)
        values.close(COLUMNS, "ship_pitch", forces["ship_pitch"], np.arcsin(-ahead[:, 2]),
                     margin=1e-8)
        port, up = rotate(pose[:, 3:], [0.0, 1.0, 0.0]), rotate(pose[:, 3:], [0.0, 0.0, 1.0])
        values.close(COLUMNS, "ship_roll", forces["ship_roll"], np.arctan2(port[:, 2], up[:, 2]),
                     margin=1e-8)
        values.close(COLUMNS, "ship_x_m", forces["ship_x_m"], pose[:, 0], 1e-8)
        values.close(COLUMNS, "ship_z_m", forces["ship_z_m"], pose[:, 2], margin=1e-8)
        values.close(name, "/ship/thrust", file["ship/thrust"][()], forces["thrust_N"], 1e-8)
        values.close(name, "/ship/tow_force", file["ship/tow_force"][:, 0], forces["tow_fx_N"],
                     1e-8)
        # rows are steps: the centre of gravity moves by its velocity
        centre = pose[:, :3] + rotate(pose[:, 3:], CENTRE)
        values.close(name, "/ship/velocity", velocity[1:], np.diff(centre, axis=0) / STEP,
                     margin=1e-3)
        values.close(COLUMNS, "ship_u", forces["ship_u"], velocity[:, 0], 1e-7)
        turned = file["frames/ship_orientation"][()]
        every = round(0.1 / STEP)
        values.close(name, "/frames/ship_orientation",
                     np.abs(np.einsum("ij,ij->i", turned[1:], pose[every - 1::every, 3:])),
                     np.ones(len(turned) - 1), 1e-6)
        # the spring is level and its point's stretch gives its force
        values.close(name, "/ship/tow_force", file["ship/tow_force"][:, 2], 0 * pose[:, 0])


def rotate(turn, vector):
    """Vectors turned by quaternions w, x, y, z."""
    w, q = turn[:, :1], turn[:, 1:]
    v = np.broadcast_to(np.asarray(vector, float), q.shape)
    return v + 2 * np.cross(q, np.cross(q, v) + w * v)
