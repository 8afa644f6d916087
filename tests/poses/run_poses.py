# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids and their places from a run folder's run.h5 and, of level ice, its pieces.h5."""
import pathlib
import sys

import h5py
import numpy as np


class Solid:
    """A closed mesh in its body's axes."""

    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles
        self.box = np.array([vertices.min(axis=0), vertices.max(axis=0)])
        self.thickness = float((self.box[1] - self.box[0]).min())
        corners = vertices[triangles]
        self.volume = float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6.0)
        self.samples = None


def solids_of(group):
    """The meshes of a group that lie one after the other."""
    v, t = group["vertex_offset"][:], group["triangle_offset"][:]
    vertices, triangles = group["vertices"][:].astype(float), group["triangles"][:]
    return [Solid(vertices[v[k]:v[k + 1]], triangles[t[k]:t[k + 1]]) for k in range(len(v) - 1)]


class Run:
    """Frames of a run; body 0 is the hull, floes are numbered from 1.

    In level ice the floes are the pieces that broke off. A piece has no place (NaN) before and
    after its time; the unbroken sheet is left out.
    """

    def __init__(self, folder):
        path = pathlib.Path(folder)
        path = path / "run.h5" if path.is_dir() else path
        with h5py.File(path, "r") as file:
            if file.attrs["dimension"] != 3:
                sys.exit(f"{path}: a run in 2D; poses are checked in 3D only")
            self.solids = solids_of(file["shapes"])
            # crushed ice, where known (take_crushed): {body: Solid} and {body: Notches}
            self.left, self.notches = {}, {}
            frames = file["frames"]
            self.time = frames["frame_time"][:]
            self.shape_of = np.concatenate([[0], frames["body_shape"][:]])
            ship = frames["ship_position"][:][:, None]
            self.position = np.concatenate([ship, frames["position"][:].astype(float)], axis=1)
            turn = np.zeros((len(self.time), len(self.shape_of), 4))
            turn[:, 0, 0] = 1.0
            turn[:, 1:] = frames["orientation"][:]
            self.orientation = turn / np.linalg.norm(turn, axis=2, keepdims=True)
            bodies = frames["body"][:]
        pieces = path.with_name("pieces.h5")
        if pieces.exists():
            with h5py.File(pieces, "r") as file:
                self.take_pieces(file["pieces"], bodies)

    def take_pieces(self, pieces, bodies):
        """Pieces in place of the slots that they take one after another."""
        column = 1 + np.searchsorted(bodies, pieces["body"][:])  # body 0 is the hull
        self.solids = [self.solids[0], *solids_of(pieces)]
        self.shape_of = np.arange(len(self.solids))
        columns = np.concatenate([[0], column])
        self.position, self.orientation = self.position[:, columns], self.orientation[:, columns]
        time = self.time[:, None]
        there = (pieces["born"][:] <= time) & (time < pieces["gone"][:])
        self.position[:, 1:][~there] = np.nan

    def solid(self, body):
        return self.solids[self.shape_of[body]]

    def solid_to(self, body, other):
        """The body's solid that the other one meets: without the ice that floes have crushed."""
        whole = self.solid(body)
        return whole if 0 in (body, other) else self.left.get(body, whole)

    def rotation(self, frame, body):
        """Body to world, 3 x 3."""
        w, x, y, z = self.orientation[frame, body]
        return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    def name(self, body):
        return "hull" if body == 0 else f"floe {body}"
