# SPDX-License-Identifier: GPL-3.0-or-later
"""The notches in floes at a checkpoint: where ice was crushed at their contact spheres."""
import sys

import h5py
import numpy as np

from deepest_point import CHUNK, is_inside
from left_solids import left_solids

# The surface within this many spacings of a crushed sphere goes inwards with it (docs/method.md,
# section 3, patch radius).
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


def spacing_of(spheres):
    """The largest distance of a sphere from the nearest one at about the same height: those of the
    opposite face of a floe may be nearer. It is the nominal spacing or some per cent less. Twice
    the radius where each sphere is alone.

    @param spheres  [S, 4]: centre and radius
    """
    nearest = []
    for part in np.array_split(spheres, len(spheres) // 500 + 1):
        away = part[:, None] - spheres
        distance = np.linalg.norm(away[:, :, :3], axis=2)
        distance[(distance == 0.0) | (np.abs(away[:, :, 2]) > part[:, None, 3])] = np.inf
        nearest.append(distance.min(axis=1))
    nearest = np.concatenate(nearest)
    return nearest[np.isfinite(nearest)].max(initial=2.0 * spheres[:, 3].max())


def crushed_notches(run, checkpoint):
    """{body: Notches} of the floes with crushed spheres; both are files of one run folder."""
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
            spacing[shape] = spacing_of(own)
        moves = move[first[body]:first[body] + len(own)]
        moved = (moves != 0.0).any(axis=1)
        if not moved.any():
            continue
        moves, own = moves[moved], own[moved]
        inwards = moves / np.linalg.norm(moves, axis=1)[:, None]
        out[int(body)] = Notches(own[:, :3] - own[:, 3:] * inwards, moves, PATCH * spacing[shape])
    return out


def take_crushed(run, folder):
    """Gives a run what its checkpoint knows of crushed ice: what floes have cut off convex floes,
    and the notches of crushed spheres."""
    if (folder / "pieces.h5").exists():
        sys.exit(f"{folder}: level ice; its checkpoint knows crushed ice by slot, not by piece")
    run.left = left_solids(folder / "checkpoint.h5")
    run.notches = crushed_notches(folder / "run.h5", folder / "checkpoint.h5")


def whole_share(box, solids, notches):
    """The share of the volume of two solids' overlap that lies in no notch of either, counted on a
    lattice. 1 where no point of the lattice lies in both.

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
