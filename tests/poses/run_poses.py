# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids and their places from a run folder's run.h5."""
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


class Run:
    """Frames of a run; body 0 is the hull, floes are numbered from 1."""

    def __init__(self, folder):
        path = pathlib.Path(folder)
        path = path / "run.h5" if path.is_dir() else path
        with h5py.File(path, "r") as file:
            if file.attrs["dimension"] != 3:
                sys.exit(f"{path}: a run in 2D; poses are checked in 3D only")
            shapes = file["shapes"]
            v, t = shapes["vertex_offset"][:], shapes["triangle_offset"][:]
            vertices, triangles = shapes["vertices"][:].astype(float), shapes["triangles"][:]
            self.solids = [Solid(vertices[v[k]:v[k + 1]], triangles[t[k]:t[k + 1]])
                           for k in range(len(v) - 1)]
            frames = file["frames"]
            self.time = frames["frame_time"][:]
            self.shape_of = np.concatenate([[0], frames["body_shape"][:]])
            ship = frames["ship_position"][:][:, None]
            self.position = np.concatenate([ship, frames["position"][:].astype(float)], axis=1)
            turn = np.zeros((len(self.time), len(self.shape_of), 4))
            turn[:, 0, 0] = 1.0
            turn[:, 1:] = frames["orientation"][:]
            self.orientation = turn / np.linalg.norm(turn, axis=2, keepdims=True)

    def solid(self, body):
        return self.solids[self.shape_of[body]]

    def rotation(self, frame, body):
        """Body to world, 3 x 3."""
        w, x, y, z = self.orientation[frame, body]
        return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    def name(self, body):
        return "hull" if body == 0 else f"floe {body}"
