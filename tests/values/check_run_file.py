# SPDX-License-Identifier: GPL-3.0-or-later
"""run.h5 of the raked ship among three floes: its datasets against the CSV files, the touches' sums
and moments, and the loads on panels anew from the touches."""
import h5py
import numpy as np

from check_field import DRIFT, OUTLINES, THICKNESS
from check_sheared import (AVERAGE_FROM, DENSITY, DURATION, HIGH, LOW, PLAN, RAKE, RUN, SPEED, STEP,
                           columns, force_of, masses)
from solids import moments, prism
from tables import read_csv


def make(work):
    """The run is check_sheared's."""


def check(work, values):
    forces = read_csv(work / RUN / "forces.csv")
    tracks = [read_csv(work / RUN / f"floe_{k}.csv") for k in (1, 2, 3)]
    with h5py.File(work / RUN / "run.h5") as file:
        check_history(values, file, forces, tracks)
        check_frames(values, file, tracks)
        check_touches(values, file, forces)
        check_panels(work, values, file)


def check_history(values, file, forces, tracks):
    name = "run.h5"
    values.close(name, "/time", file["time"][()], forces["time_s"], 1e-8)
    for key, kind in (("contact_force", "contact"), ("friction_force", "friction")):
        values.close(name, "/ship/" + key, file["ship/" + key][()], force_of(forces, kind), 1e-8)
        values.close(name, "/regions/" + key, file["regions/" + key][()].sum(axis=1),
                     force_of(forces, kind), 1e-5)
    values.close(name, "/ship/force", file["ship/force"][()],
                 force_of(forces, "contact") + force_of(forces, "friction"), 1e-8)
    for key, column in (("contacts", "contacts"), ("moving_floes", "moving_floes"),
                        ("max_overlap", "max_overlap_m"), ("kinetic_energy", "kinetic_energy_J")):
        values.close(name, "/ship/" + key, file["ship/" + key][()], forces[column], 1e-8)
    time = file["time"][()]
    course = np.zeros((len(time), 7))
    course[:, 0], course[:, 1], course[:, 3] = DRIFT[0] - 2.2 + SPEED * time, 0.3, 1.0
    values.close(name, "/ship/pose", file["ship/pose"][()], course, 1e-9)
    values.equal(name, "/tracked/floe", list(file["tracked/floe"][()]), [1, 2, 3])
    for k, track in enumerate(tracks):
        labels = [c.decode() for c in file["track_columns"][()]]
        for column, label in enumerate(labels):
            own = next(n for n in track if n.removesuffix("_N").removesuffix("_m") ==
                       label.removesuffix("_N").removesuffix("_m"))
            values.close(name, "/tracked/<floe>", file[f"tracked/{k + 1}"][:, column], track[own],
                         1e-8, margin=1e-12)
        values.equal(name, "/track_columns", len(labels), 22)
        values.equal(name, "/tracked/<floe>@columns",
                     file[f"tracked/{k + 1}"].attrs["columns"], ",".join(labels))
    for key, want in (("xyz", "xyz"), ("wxyz", "wxyz")):
        values.equal(name, "/" + key, b"".join(file[key][()]).decode(), want)
    values.equal(name, "/pose_parts", [p.decode() for p in file["pose_parts"][()]],
                 ["x", "y", "z", "qw", "qx", "qy", "qz"])


def check_frames(values, file, tracks):
    """A frame of each step, and one of the start."""
    name, frames = "run.h5", file["frames"]
    time = frames["frame_time"][()]
    values.close(name, "/frames/frame_time", time, STEP * np.arange(len(time)), margin=1e-9)
    values.close(name, "/frames/ship_position", frames["ship_position"][:, 0],
                 DRIFT[0] - 2.2 + SPEED * time, 1e-9)
    count = len(time) - 1
    for k, track in enumerate(tracks):
        for key, parts in (("position", ("x_m", "y_m", "z_m")), ("velocity", ("vx", "vy", "vz")),
                           ("angular_velocity", ("wx", "wy", "wz"))):
            values.close(name, "/frames/" + key, frames[key][1:, k], columns(track, *parts)[:count],
                         1e-6, margin=1e-6)
        turn = columns(track, "qw", "qx", "qy", "qz")[:count]
        same = np.abs(np.einsum("ij,ij->i", frames["orientation"][1:, k], turn))
        values.close(name, "/frames/orientation", same, np.ones(count), 1e-6)
        push = -force_of(track, "contact") - force_of(track, "friction")
        values.close(name, "/frames/contact_force", frames["contact_force"][1:, k], push[:count],
                     1e-5)
    values.close(name, "/frames/mass", frames["mass"][()], masses(), 1e-9)
    inertias = [DENSITY * np.diag(moments(prism(o, 0, THICKNESS))[3]) for o in OUTLINES]
    values.close(name, "/frames/inertia", frames["inertia"][()], inertias, 1e-9)
    values.equal(name, "/frames/body", list(frames["body"][()]), [1, 2, 3])
    values.equal(name, "/frames/body_group", set(frames["body_group"][()]), {0})
    check_shapes(values, file)
    behind = frames["state"][()]
    values.equal(name, "/frames/state", set(behind.ravel()) <= {1, 2}, True)


def check_shapes(values, file):
    """Shape 0 is the hull, the others the floes: volumes of their meshes."""
    name, shapes = "run.h5", file["shapes"]
    starts = {n: shapes[n + "_offset"][()] for n in ("vertex", "triangle", "sphere")}
    want = [moments(prism(PLAN, LOW, HIGH, RAKE))[0]]
    found = []
    for k in range(len(starts["vertex"]) - 1):
        rows = slice(starts["vertex"][k], starts["vertex"][k + 1])
        triangles = shapes["triangles"][starts["triangle"][k]:starts["triangle"][k + 1]]
        found.append(moments((shapes["vertices"][rows].astype(float), {"": triangles}))[0])
    values.close(name, "/shapes/vertices", found[0], want[0], 1e-5)
    by_body = [found[k] for k in file["frames/body_shape"][()]]
    floes = [mass / DENSITY for mass in masses()]
    for part in ("/frames/body_shape", "/shapes/triangles", "/shapes/vertex_offset",
                 "/shapes/triangle_offset"):
        values.close(name, part, by_body, floes, 1e-5)
    spheres = shapes["spheres"][()]
    hull = spheres[:starts["sphere"][1]]
    values.close(name, "/shapes/spheres", np.unique(np.round(hull[:, 3], 6)), [0.1], 1e-5)
    values.equal(name, "/shapes/sphere_offset", int(starts["sphere"][-1]), len(spheres))
    regions = [n.decode() for n in file["hull_regions"][()]]
    # the bottom is where the mesh's bottom is
    vertices, triangles = shapes["vertices"][()], shapes["triangles"][:starts["triangle"][1]]
    region = shapes["region"][:len(triangles)]
    low = (vertices[triangles][:, :, 2] < LOW + 1e-6).all(axis=1)
    values.equal(name, "/shapes/region", {regions[r] for r in region[low]}, {"bottom"})
    values.equal(name, "/hull_regions", set(regions) - {"hull"},
                 {"bottom", "deck", *(f"side{k}" for k in range(5))})
    values.equal(name, "/region_names", [n.decode() for n in file["region_names"][()]][
        :len(regions)], regions)


def check_touches(values, file, forces):
    """Frames are steps here: a step's touches add up to its force, and with their places to its
    moment about the mesh's origin."""
    name, touches = "run.h5", file["contacts"]
    frame = touches["frame"][()]
    both = touches["normal_force"][()].astype(float) + touches["friction_force"][()]
    arm = touches["point"][()].astype(float)
    rows = len(forces["time_s"])
    for key, kind in (("normal_force", "contact"), ("friction_force", "friction")):
        total = np.zeros((rows + 1, 3))
        np.add.at(total, frame, touches[key][()])
        values.close(name, "/contacts/" + key, total[1:], force_of(forces, kind), 1e-5)
    values.close(name, "/contacts/frame", touches["contact_time"][()], STEP * frame, 1e-6)
    values.close(name, "/contacts/contact_time", touches["contact_time"][()], STEP * frame, 1e-6)
    push, rub = (np.linalg.norm(touches[n][()], axis=1) for n in ("normal_force",
                                                                  "friction_force"))
    values.within(name, "/contacts/friction_force", rub - 0.15 * push, -np.inf, 1e-4 * push.max())
    moment = np.zeros((rows + 1, 3))
    np.add.at(moment, frame, np.cross(arm, both))
    values.close(name, "/ship/moment", file["ship/moment"][()], moment[1:], 1e-4)
    values.close(name, "/contacts/point", moment[1:], file["ship/moment"][()], 1e-4)
    by_floe = np.zeros((4, 3))
    np.add.at(by_floe, touches["floe"][()], both)
    values.close(name, "/contacts/floe", by_floe[1:],
                 -file["frames/contact_force"][1:].astype(float).sum(axis=0), 1e-4)
    # the touch is near the sphere that it names: half a spacing aside and the ice's own sphere
    spheres = file["shapes/spheres"][()][touches["sphere"][()]]
    values.within(name, "/contacts/sphere", np.linalg.norm(spheres[:, :3] - arm, axis=1), 0.0, 0.4)


def check_panels(work, values, file):
    name, panels, s = "run.h5", file["panels"], work.summary(RUN)
    touched = {tuple(np.round(p["center_m"], 6)): p for p in s["panels"]}
    window = s["panel_rule"]["window_s"]
    values.close(name, "/panels@window", panels.attrs["window"], window, 1e-12)
    values.close(name, "/panels@size", panels.attrs["size"], s["panel_rule"]["size_m"], 1e-12)
    values.equal(name, "/panels/panel", list(panels["panel"][()]), list(range(len(panels["area"]))))
    values.equal("summary.json", "panel_rule.panels", s["panel_rule"]["panels"],
                 len(panels["area"]))
    regions = [n.decode() for n in file["hull_regions"][()]]
    for k, center in enumerate(panels["center"][()]):
        key = tuple(np.round(center, 6))
        p = touched.pop(key, None)
        hit = panels["force_max"][k] > 0
        values.equal(name, "/panels/center", hit, p is not None)
        if p is None:
            continue
        values.equal(name, "/panels/region", regions[panels["region"][k]], p["region"])
        for part, line in (("area", "area_m2"), ("length", "length_m"), ("normal", "normal")):
            values.close(name, "/panels/" + part, panels[part][k], p[line], 1e-6)
        for part in ("mean", "p99", "max"):
            force = panels["force_" + part][k]
            values.close(name, "/panels/force_" + part, force,
                         p[f"pressure_{part}_Pa"] * p["area_m2"], 1e-9)
            values.close("summary.json", f"panels[].line_load_{part}_N_per_m",
                         p[f"line_load_{part}_N_per_m"], force / p["length_m"], 1e-9)
    check_windows(values, file, s)


def check_windows(values, file, s):
    """Loads on panels anew, from the touches in windows of ten steps behind average_from."""
    name, touches, panels = "run.h5", file["contacts"], file["panels"]
    of_sphere = file["shapes/hull_panel"][()]
    first = round(AVERAGE_FROM / STEP)
    steps = round(s["panel_rule"]["window_s"] / STEP)
    windows = (round(DURATION / STEP) - first + 1) // steps
    frame = touches["frame"][()]
    push = np.linalg.norm(touches["normal_force"][()], axis=1)
    load = np.zeros((len(panels["area"]), windows))
    window = (frame - first) // steps
    good = (frame >= first) & (window < windows)
    np.add.at(load, (of_sphere[touches["sphere"][()]][good], window[good]), push[good] / steps)
    for part, want in (("mean", load.mean(axis=1)), ("max", load.max(axis=1))):
        values.close(name, "/panels/force_" + part, panels["force_" + part][()], want, 1e-4)
    values.close(name, "/shapes/hull_panel", panels["force_mean"][()], load.mean(axis=1), 1e-4)
