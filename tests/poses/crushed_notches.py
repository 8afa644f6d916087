# SPDX-License-Identifier: GPL-3.0-or-later
"""The notches in floes at a checkpoint: ice that their contact spheres have lost."""
import h5py
import numpy as np

from deepest_point import CHUNK, is_inside
from left_solids import left_solids

# A crushed sphere takes the surface within this many spacings of the spheres along (docs/method.md,
# section 3). The spacing is the largest distance of a sphere of the shape from its nearest one.
PATCH = 0.75
LATTICE = 40  # points along each side of the box in which two bodies may meet


class Notches:
    """Cylinders, one for each crushed sphere, from the surface to the bottom; body axes [m]."""

    def __init__(self, top, move, radius):
        """@param top, move  [K, 3]: where the surface was, and the way that it went inwards"""
        self.top, self.radius = top, radius
        self.length = np.linalg.norm(move, axis=1)
        self.inwards = move / self.length[:, None]

    def hold(self, points):
        """Which of the points lie in a notch [P]."""
        parts = np.array_split(points, len(points) * len(self.top) // CHUNK + 1)
        return np.concatenate([self.hold_part(part) for part in parts])

    def hold_part(self, points):
        away = points[:, None] - self.top
        along = (away * self.inwards).sum(axis=2)
        aside = (away * away).sum(axis=2) - along * along
        return ((along >= 0.0) & (along <= self.length)
                & (aside <= self.radius * self.radius)).any(axis=1)


def spacing_of(centres):
    """The largest distance of a sphere from its nearest one."""
    nearest = []
    for part in np.array_split(centres, len(centres) // 500 + 1):
        away = np.linalg.norm(part[:, None] - centres, axis=2)
        away[away == 0.0] = np.inf
        nearest.append(away.min(axis=1))
    return np.concatenate(nearest).max()


def crushed_notches(run, checkpoint):
    """{body: Notches} of the floes with crushed spheres. @param run  its run.h5"""
    with h5py.File(checkpoint, "r") as file:
        first, move = file["crushed.first"][:], file["crushed.recess"][:]
    with h5py.File(run, "r") as file:
        spheres, offset = file["shapes/spheres"][:].astype(float), file["shapes/sphere_offset"][:]
        shape_of = np.concatenate([[0], file["frames/body_shape"][:]])
    spacing, out = {}, {}
    for body in np.nonzero(first >= 0)[0]:
        shape = shape_of[body]
        own = spheres[offset[shape]:offset[shape + 1]]
        if shape not in spacing:
            spacing[shape] = spacing_of(own[:, :3])
        moves = move[first[body]:first[body] + len(own)]
        moved = np.linalg.norm(moves, axis=1) > 0.0
        if not moved.any():
            continue
        moves, own = moves[moved], own[moved]
        inwards = moves / np.linalg.norm(moves, axis=1)[:, None]
        out[int(body)] = Notches(own[:, :3] - own[:, 3:] * inwards, moves, PATCH * spacing[shape])
    return out


def take_crushed(run, folder):
    """Lets a run know what its checkpoint has crushed: convex floes by floes, floes by spheres."""
    run.left = left_solids(folder / "checkpoint.h5")
    run.notches = crushed_notches(folder / "run.h5", folder / "checkpoint.h5")


def whole_share(box, solids, notches):
    """The share of the volume of two solids' overlap that lies in no notch of either.

    @param box      in which they may meet, in the axes of the first
    @param solids   [(carry, triangles)] of both: carry brings points into the solid's axes
    @param notches  of both; None where a solid has none
    """
    low, high = box
    step = (high - low) / LATTICE
    axes = [low[d] + step[d] * (np.arange(LATTICE) + 0.5) for d in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=3).reshape(-1, 3)
    for carry, triangles in solids:
        points = points[is_inside(carry(points), triangles)]
    if not len(points):
        return 1.0
    crushed = np.zeros(len(points), dtype=bool)
    for (carry, _), of_body in zip(solids, notches):
        if of_body is not None:
            crushed |= of_body.hold(carry(points))
    return 1.0 - crushed.mean()
