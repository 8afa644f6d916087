# SPDX-License-Identifier: GPL-3.0-or-later
"""A plate whose upper face has two regions: a sphere on their border, whose share of the surface
lies to 80 % in one of them, belongs to that one."""
import h5py
import numpy as np

from solids import prism

BORDER, LENGTH, WIDTH, HEIGHT, RADIUS = 0.58, 1.0, 0.6, 0.3, 0.05
OUTLINE = [(0, 0), (BORDER, 0), (LENGTH, 0), (LENGTH, WIDTH), (BORDER, WIDTH), (0, WIDTH)]


def make(work):
    vertices, groups = prism(OUTLINE, 0.0, HEIGHT)
    del groups["deck"]
    groups["aft"] = [(6, 7, 10), (6, 10, 11)]
    groups["fore"] = [(7, 8, 9), (7, 9, 10)]
    work.mesh("plate.obj", (vertices, groups))
    work.run("spherize", "plate.obj", "-r", RADIUS, "--arrangement", "lattice", "-o", "plate.h5")


def check(work, values):
    with h5py.File(work / "plate.h5") as file:
        center, names = file["center"][()], [n.decode() for n in file["region_names"][()]]
        top = np.flatnonzero((file["normal"][:, 2] > 0.999) & (file["normal_spread"][()] < 1e-6))
        x = center[top, 0]
        # cells of the lattice are 0.1 m wide: one column of spheres has its border within
        cut = np.abs(x - BORDER) < RADIUS
        share = (BORDER - (x[cut] - RADIUS)) / (2 * RADIUS)
        values.close("spheres.h5", "/region", share, np.full(cut.sum(), 0.8), 1e-9)
        values.within("spheres.h5", "/region", cut.sum(), 2, len(top))
        got = [names[r] for r in file["region"][()][top]]
        values.equal("spheres.h5", "/region", got, ["aft" if at < BORDER else "fore" for at in x])
