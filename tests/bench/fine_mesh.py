# SPDX-License-Identifier: GPL-3.0-or-later
"""Time of spherize on a mesh of a million triangles, for radii from L/500 to more than fit:

    /usr/bin/python3 tests/bench/fine_mesh.py [build/release/bin]

A Wigley hull (L 100, B 10, T 6.25 m) as a binary STL, in which each triangle has its own corners.
Prints wall and processor seconds of each radius. The goals are those of two idle cores: 20 s, and
2 s where no sphere fits.
"""
import argparse
import os
import resource
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
LENGTH, BREADTH, DRAUGHT = 100.0, 10.0, 6.25


def quads(points, turned):
    """Two triangles for each cell of a grid of points (n, m, 3): (2 (n-1) (m-1), 3, 3)."""
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    cells = [np.stack(corners, 2).reshape(-1, 3, 3) for corners in ((a, b, c), (a, c, d))]
    return np.concatenate(cells)[:, ::-1] if turned else np.concatenate(cells)


def wigley(along, down):
    """Outward triangles (t, 3, 3) [m] of a closed Wigley hull, those without area left out."""
    x = np.linspace(-LENGTH / 2, LENGTH / 2, along + 1)
    z = np.linspace(-DRAUGHT, 0, down + 1)
    xs, zs = np.meshgrid(x, z, indexing="ij")
    ys = BREADTH / 2 * (1 - (2 * xs / LENGTH) ** 2) * (1 - (zs / DRAUGHT) ** 2)
    port = np.stack([xs, ys, zs], -1)
    starboard = port * np.array([1, -1, 1])
    deck = np.stack([starboard[:, -1], port[:, -1]], 1)
    triangles = np.concatenate([quads(port, True), quads(starboard, False), quads(deck, True)])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    triangles = triangles[np.linalg.norm(normals, axis=1) > 1e-12]
    volume = np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6
    return triangles if volume > 0 else triangles[:, ::-1]


def write_stl(path, triangles):
    rows = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    rows["v"] = triangles
    path.write_bytes(b" " * 80 + np.uint32(len(triangles)).tobytes() + rows.tobytes())


def timed(command):
    """Exit code, wall and processor seconds of a command."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    code = subprocess.run(command, check=False, capture_output=True).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (code, time.monotonic() - start,
            after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("bin", nargs="?", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--radii", type=float, nargs="*", metavar="M",
                        default=[0.2, 1.0, 2.5, 3.1, 50.0], help="[m] (%(default)s)")
    parser.add_argument("--along", type=int, default=2500,
                        help="cells along the hull (%(default)s)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = Path(folder) / "wigley.stl", Path(folder) / "out.h5"
        triangles = wigley(options.along, 100)
        write_stl(mesh, triangles)
        print(f"{len(triangles)} triangles, {os.cpu_count()} processors")
        print("| radius [m] | exit code | wall [s] | processor [s] |\n|---|---|---|---|")
        for radius in options.radii:
            code, wall, used = timed([options.bin / "spherize", mesh, "-r", str(radius), "-o", out,
                                      "-q"])
            print(f"| {radius:g} | {code} | {wall:.1f} | {used:.1f} |", flush=True)


if __name__ == "__main__":
    main()
