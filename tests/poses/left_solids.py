# SPDX-License-Identifier: GPL-3.0-or-later
"""What floes have left of each other's solids at a checkpoint, as meshes."""
import h5py
import numpy as np

from run_poses import Solid


def loop_round(plane, edges):
    """The corners of a face, anticlockwise: edges run so round their left plane."""
    after = {begin: end for begin, end, left, _ in edges if left == plane}
    after |= {end: begin for begin, end, _, right in edges if right == plane}
    loop = [next(iter(after))]
    while len(loop) < len(after):
        loop.append(after[loop[-1]])
    return loop


def convex_mesh(corners, planes, edges):
    """The convex solid with these corners and edges (begin, end, left, right)."""
    triangles = []
    for plane in range(planes):
        loop = loop_round(plane, edges)
        triangles += [(loop[0], loop[k], loop[k + 1]) for k in range(1, len(loop) - 1)]
    sides = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
    assert len(sides) == 3 * len(triangles) and all((q, p) in sides for p, q in sides), "not closed"
    return Solid(corners, np.array(triangles))


def left_solids(checkpoint):
    """{body: Solid} of the convex floes that other floes have crushed; body axes."""
    with h5py.File(checkpoint, "r") as file:
        got = {name: file[f"crushed_solids.{name}"][:]
               for name in ("body", "planes", "corners", "edges", "corner")}
        edges = np.stack([file[f"crushed_solids.edge_{name}"][:]
                          for name in ("begin", "end", "left", "right")], axis=1)
    corner_of = np.concatenate([[0], np.cumsum(got["corners"])])
    edge_of = np.concatenate([[0], np.cumsum(got["edges"])])
    return {int(body): convex_mesh(got["corner"][corner_of[k]:corner_of[k + 1]],
                                   int(got["planes"][k]),
                                   edges[edge_of[k]:edge_of[k + 1]].tolist())
            for k, body in enumerate(got["body"])}
