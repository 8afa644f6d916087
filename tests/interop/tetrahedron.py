# SPDX-License-Identifier: GPL-3.0-or-later
"""A solid with known mass and inertia, as a mesh and as spheres: what the interop tests share.

The tetrahedron (0,0,0), (a,0,0), (0,b,0), (0,0,c), moved away from the origin. Its inertia tensor
is full and has three different moments, and its spheres, which do not reach into the corners, have
another centre than the solid: a program that takes either from the spheres is found out.
"""
import os
import shutil
import subprocess
import sys
import tempfile

EDGES = (1.2, 1.0, 0.8)   # a, b, c [m]
SHIFT = (3.0, -2.0, 1.0)  # of the right-angled corner [m]
DENSITY = 917.0           # [kg/m3]

MASS = DENSITY * EDGES[0] * EDGES[1] * EDGES[2] / 6
CENTROID = tuple(s + e / 4 for s, e in zip(SHIFT, EDGES))


def inertia():
    """About the centroid, rows of a 3x3 tensor [kg m2].

    With int x^2 dm = m a^2/10 and int x y dm = m a b/20 about the corner, less m a^2/16 and
    m a b/16: second moments 3/80 m a^2 and -1/80 m a b about the centroid.
    """
    second = [[MASS / 80 * p * q * (3 if i == j else -1) for j, q in enumerate(EDGES)]
              for i, p in enumerate(EDGES)]
    trace = sum(second[i][i] for i in range(3))
    return [[(trace if i == j else 0) - second[i][j] for j in range(3)] for i in range(3)]


def skip_without(program):
    if shutil.which(program) is None:
        print(f"skipped: {program} is not installed (apt-get install {program})")
        sys.exit(77)


def export(folder, *formats):
    """Fills the tetrahedron by spherize (sys.argv[1]) and exports it as tetra.* into folder."""
    x, y, z = SHIFT
    corners = [SHIFT, (x + EDGES[0], y, z), (x, y + EDGES[1], z), (x, y, z + EDGES[2])]
    with open(os.path.join(folder, "tetra.obj"), "w", encoding="utf-8") as mesh:
        mesh.writelines("v {!r} {!r} {!r}\n".format(*corner) for corner in corners)
        mesh.write("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    options = [option for name in formats for option in ("--export", name)]
    subprocess.run([sys.argv[1], "tetra.obj", "-r", "0.05", "-o", "tetra.h5", "-q",
                    "--density", str(DENSITY)] + options, check=True, cwd=folder)


def check(what, got, expected, tolerance):
    """Two numbers or sequences agree within tolerance times the largest expected magnitude."""
    if not hasattr(got, "__len__"):
        got, expected = [got], [expected]
    assert len(got) == len(expected), f"{what}: {len(got)} values, not {len(expected)}"
    error = max(abs(g - e) for g, e in zip(got, expected)) / max(abs(e) for e in expected)
    print(f"{what}: relative error {error:.1e}")
    assert error <= tolerance, f"{what}: got {list(got)[:9]}, expected {list(expected)[:9]}"


def run(command, folder, words=""):
    """Runs a program; its output, or an end that shows it when it fails or lacks `words`."""
    result = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            encoding="utf-8", errors="replace", timeout=240, check=False)
    if result.returncode != 0 or words not in result.stdout:
        sys.exit(f"{command[0]} ended with {result.returncode}:\n{result.stdout[-4000:]}")
    return result.stdout


def workshop():
    return tempfile.TemporaryDirectory(prefix="ice-interop-")
