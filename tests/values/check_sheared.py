# SPDX-License-Identifier: GPL-3.0-or-later
"""A raked ship among three floes, with friction and crushing: numbers that follow from others by
mechanics, with the floes' masses from their polygons.

Without gravity and water a floe's momentum changes by its contacts alone,

    m (v' - v) / dt = F_ice - F_ship,

so what the ship feels is known from the floes' motion; and all rows of one step are known twice,
in forces.csv and run.h5, from the touches of /contacts and from the floes' own histories."""
import h5py
import numpy as np

from check_field import DRIFT, OUTLINES, THICKNESS
from solids import moments, prism
from tables import read_csv

SPEED, STEP, DURATION, AVERAGE_FROM = 1.3, 0.01, 2.4, 0.7
DENSITY = 870.0
# plan of the hull, counterclockwise from above, stem last; both sides differ
PLAN = [(-6.0, -1.2), (-0.5, -1.2), (2.0, 0.2), (0.0, 1.5), (-6.0, 1.5)]
LOW, HIGH, RAKE = -1.3, 0.6, [0.0, -0.9, -0.9, -0.9, 0.0]
RUN, ROWS = "sheared", "rows"


def make(work):
    work.mesh("raked.obj", prism(PLAN, LOW, HIGH, RAKE))
    work.run("spherize", "raked.obj", "-r", 0.1, "-s", 0.2, "-o", "raked.h5", "--mode", "surface")
    work.write("sheared.cfg", f"""title = "three floes"
[simulation]
duration = {DURATION}
time_step = {STEP}
[environment]
gravity = 0.0
[hull]
spheres = "raked.h5"
position = [{DRIFT[0] - 2.2}, 0.3, 0.0]
speed = {SPEED}
[ice]
density = {DENSITY}
[[floes]]
pattern = "file"
file = "free.h5"
hold = "never"
[contact]
restitution = 0.2
friction_ship_ice = 0.15
friction_ice_ice = 0.3
crushing_pressure = 3e5
[buoyancy]
model = "none"
[drag]
model = "none"
[output]
track = [1, 2, 3]
average_from = {AVERAGE_FROM}
frames_every = 0.01
""")
    work.run("icesolve", "sheared.cfg", "--out", RUN, "--no-report", "--verify")
    work.keep(RUN, floes=(1, 2, 3))
    work.run("icesolve", "sheared.cfg", "--out", ROWS, "--no-report", "--set",
             "output.history_every=0.05", "--set", "output.frames_every=0.2")
    work.keep(ROWS)


def masses():
    return [DENSITY * moments(prism(outline, 0, THICKNESS))[0] for outline in OUTLINES]


def check(work, values):
    forces = read_csv(work / RUN / "forces.csv")
    tracks = [read_csv(work / RUN / f"floe_{k}.csv") for k in (1, 2, 3)]
    check_momenta(values, forces, tracks)
    check_rows(work, values, forces)
    check_summary(work, values, forces)


def columns(table, *names):
    return np.column_stack([table[name] for name in names])


def force_of(table, kind):
    return columns(table, *(f"{kind}_f{axis}_N" for axis in "xyz"))


def check_momenta(values, forces, tracks):
    change = 0.0
    for mass, track in zip(masses(), tracks):
        v = columns(track, "vx", "vy", "vz")
        before = np.vstack([np.zeros(3), v[:-1]])
        got = force_of(track, "ice") - force_of(track, "contact") - force_of(track, "friction")
        # nine digits of velocities of 1 m/s, divided by the step
        for axis in range(3):
            values.close("floe.csv", f"ice_f{'xyz'[axis]}_N", got[:, axis],
                         (mass * (v - before) / STEP)[:, axis], margin=1e-8 * mass / STEP)
        change = change + mass * (v - before) / STEP
    assert np.abs(force_of(tracks[1], "ice")).max() > 1.0  # else the floes never met
    total = force_of(forces, "contact") + force_of(forces, "friction")
    for name in (f"{kind}_f{axis}_N" for kind in ("contact", "friction") for axis in "xyz"):
        values.close("forces.csv", name, forces[name], sum(t[name] for t in tracks), 1e-7, 1e-4)
        values.close("floe.csv", name, sum(t[name] for t in tracks), forces[name], 1e-7, 1e-4)
        assert np.abs(forces[name]).max() > 1.0, name
    # the floes push one another with equal and opposite forces
    for axis in range(3):
        values.close("forces.csv", f"contact_f{'xyz'[axis]}_N", total[:, axis], -change[:, axis],
                     margin=1e-8 * sum(masses()) / STEP)


def check_rows(work, values, forces):
    """Rows of five steps: means of forces and counts, the largest overlap, the last energy."""
    rows = read_csv(work / ROWS / "forces.csv")
    for name, column in forces.items():
        five = column.reshape(-1, 5)
        want = {"time_s": five[:, -1], "max_overlap_m": five.max(axis=1),
                "kinetic_energy_J": five[:, -1], "moving_floes": five[:, -1]}.get(
                    name, five.mean(axis=1))
        values.close("forces.csv", name, rows[name], want, 1e-8)


def check_summary(work, values, forces):
    s = work.summary(RUN)
    kept = forces["time_s"] > AVERAGE_FROM - 1e-6
    signs = {"resistance": (-1.0, "x"), "lateral": (1.0, "y"), "vertical": (1.0, "z")}
    for key, (sign, axis) in signs.items():
        push = sign * forces[f"contact_f{axis}_N"][kept]
        rub = sign * forces[f"friction_f{axis}_N"][kept]
        both = push + rub
        for name, want in (("mean_N", both.mean()), ("contact_mean_N", push.mean()),
                           ("friction_mean_N", rub.mean()), ("std_N", both.std(ddof=1)),
                           ("max_N", both[np.abs(both).argmax()]),
                           ("trend_N", np.polyfit(np.arange(len(both)), both, 1)[0] * len(both))):
            values.close("summary.json", f"{key}.{name}", s[key][name], want, 1e-6)
        check_interval(values, key, s[key], both)
    # a rigid course: the ship's work is its resistance times its way
    # --verify: the floes' momenta and the ship's force balance to rounding
    for key, share in s["imbalance"].items():
        values.within("summary.json", "imbalance." + key, share, 0.0, 1e-12)
    energy = s["energy"]
    work_done = -STEP * SPEED * (forces["contact_fx_N"] + forces["friction_fx_N"]).sum()
    values.close("summary.json", "energy.ship_work_J", energy["ship_work_J"], work_done, 1e-7)
    spent = sum(energy[k + "_J"] for k in ("kinetic_change", "friction", "restitution", "crushing",
                                           "potential", "drag", "buoyancy_moment", "residual"))
    values.close("summary.json", "energy.friction_J", spent,
                 energy["ship_work_J"] + energy["separation_J"] + energy.get("water_work_J", 0.0),
                 1e-9)
    kinetic = forces["kinetic_energy_J"]
    values.close("summary.json", "energy.kinetic_J", energy["kinetic_J"], kinetic[-1], 1e-8)
    values.close("summary.json", "energy.kinetic_max_J", energy["kinetic_max_J"], kinetic.max(),
                 1e-8)
    sizes = [2 * np.sqrt(m / DENSITY / THICKNESS / np.pi) for m in masses()]
    for name, want in (("floe_size_min_m", min(sizes)), ("floe_size_mean_m", np.mean(sizes)),
                       ("floe_size_max_m", max(sizes)), ("crushing_pressure_Pa", 3e5),
                       ("friction_ship_ice", 0.15), ("friction_ice_ice", 0.3), ("floes", 3)):
        values.close("summary.json", "ice." + name, s["ice"][name], want, 1e-9)
    with h5py.File(work / "free.h5") as file:
        values.close("summary.json", "ice.concentration", s["ice"]["concentration"],
                     file.attrs["concentration"], 1e-9)
    regions = s["regions"]
    for name in ("mean_N", "contact_mean_N", "friction_mean_N"):
        got = sum(np.array(r[name]) for r in regions.values())
        part = {"mean_N": ("contact", "friction"), "contact_mean_N": ("contact",),
                "friction_mean_N": ("friction",)}[name]
        want = sum(force_of(forces, p)[kept].mean(axis=0) for p in part)
        values.close("summary.json", f"regions.<region>.{name}", got, want, 1e-6)
    check_ship(values, s["ship"])


# Student's quantiles for 95 %, from tables, for 4, 6, 8, ... degrees of freedom
STUDENT = [2.776445, 2.446912, 2.306004, 2.228139, 2.178813, 2.144787, 2.119905, 2.100922, 2.085963]


def check_interval(values, key, found, series):
    """With J ordinates of the periodogram, S their mean: the half width is t(2 J) sqrt(S / n), and
    n / (effective samples) = S over the variance. J is what t says."""
    n, spread = len(series), series.std(ddof=1)
    effective = found["effective_samples"]
    t = found["ci95_N"] / (spread / np.sqrt(effective))
    j = 2 + int(np.argmin(np.abs(np.array(STUDENT) - t)))
    values.close("summary.json", key + ".ci95_N", t, STUDENT[j - 2], 1e-6)
    ordinates = np.abs(np.fft.rfft(series - series.mean())[1:j + 1]) ** 2 / n
    values.close("summary.json", key + ".effective_samples", effective,
                 n * spread ** 2 / ordinates.mean(), 1e-6)
    values.close("summary.json", key + ".correlation_time_s", found["correlation_time_s"],
                 n * STEP / effective, 1e-9)
    # these series have their hits at any time
    values.equal("summary.json", key + ".trend_significant", found["trend_significant"], False)


def check_ship(values, ship):
    """At the waterline z = 0 the bow's corners lie RAKE LOW... between their ends."""
    back = 0.9 * HIGH / (HIGH - LOW)
    stem = 2.0 - back
    rake = np.degrees(np.arctan2(HIGH - LOW, 0.9))
    volume = moments(prism(PLAN, LOW, 0.0, None))[0]
    values.close("summary.json", "ship.length_m", ship["length_m"], 6.0 + stem, 1e-6)
    values.close("summary.json", "ship.breadth_m", ship["breadth_m"], 2.7, 1e-9)
    values.close("summary.json", "ship.draught_m", ship["draught_m"], -LOW, 1e-9)
    values.close("summary.json", "ship.stem_angle_deg", ship["stem_angle_deg"], rake, 1e-6)
    # between the stem and the foremost point at a quarter of the breadth from the mesh's x axis,
    # which is on the port side; and at 0.99 of its half
    quarter, full = 2.0 * (0.675 - 0.2) / 1.3, 2.0 * (0.99 * 1.35 - 0.2) / 1.3
    values.close("summary.json", "ship.entrance_angle_deg", ship["entrance_angle_deg"],
                 np.degrees(np.arctan2(0.675, quarter)), 1e-9)
    values.close("summary.json", "ship.parallel_length_m", ship["parallel_length_m"],
                 6.0 + stem - full, 1e-9)
    values.close("summary.json", "ship.bow_length_m", ship["bow_length_m"], full, 1e-9)
    # the lower end's bow lies 0.9 m behind, linearly: half of it over the submerged height
    lost = 0.9 * 2.7 * (0 - LOW) * ((HIGH - LOW / 2) / (HIGH - LOW))
    values.close("summary.json", "ship.displacement_kg", ship["displacement_kg"],
                 1000.0 * (volume - lost), 1e-6)
