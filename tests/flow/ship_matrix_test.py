#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ship_matrix_test.py SOURCE BIN: examples/ship_matrix.py with small files made here.

Matrices written as Capytaine and as WAMIT write them come out as they went in, about the centre of gravity
and as shares, and icesolve takes the lines. Skipped (exit code 77) without xarray and h5netcdf."""
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

try:
    import h5netcdf  # noqa: F401
    import numpy
    import xarray
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SOURCE, BIN = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
LENGTH, DENSITY = 10.0, 1000.0
OMEGAS = (0.1, 1.0, 20.0)


def matrices(seed):
    """Symmetric, positive definite; [kg], [kg m], [kg m2]."""
    random = numpy.random.default_rng(seed)
    out = []
    for _ in OMEGAS:
        root = random.normal(size=(6, 6))
        out.append(1e3 * (root @ root.T + 6.0 * numpy.eye(6)))
    return numpy.array(out)


ADDED, DAMPING = matrices(1), matrices(2)


MASS, CENTRE, GYRATION = 28800.0, (0.5, 0.0, 1.2), (0.8, 2.9, 2.5)
INERTIA = MASS * numpy.array([1, 1, 1, *numpy.square(GYRATION)])
SHIP = ("--mass", str(MASS), "--centre-of-gravity", *map(str, CENTRE), "--gyration", *map(str, GYRATION))
STIFFNESS = (2.0e5, 6.5e4, 1.6e6)


def convert(folder, *words, fails=False):
    done = subprocess.run([sys.executable, SOURCE / "examples/ship_matrix.py", *words, *SHIP], cwd=folder,
                          capture_output=True, text=True)
    if fails:
        return done.returncode, done.stderr
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return tomllib.loads(done.stdout)["ship"]


def about_centre(matrix, about):
    """The diagonal about the centre of gravity, by the kinetic energy of six unit velocities there."""
    out = []
    for k in range(6):
        motion = numpy.zeros(6)
        motion[k] = 1.0
        turn = motion[3:]
        old = numpy.concatenate([motion[:3] + numpy.cross(turn, numpy.subtract(about, CENTRE)), turn])
        out.append(old @ matrix @ old)
    return numpy.array(out)


def expected(slow, fast, about):
    a, b = about_centre(slow, about), about_centre(fast, about)
    return numpy.where([True, True, False, False, False, True], a, b)


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def write_capytaine(self, motions=("Pitch", "Surge", "Sway", "Heave", "Roll", "Yaw")):
        order = [MOTIONS.index(m.lower()) for m in motions]
        shuffled = [field[:, order][:, :, order] for field in (ADDED, DAMPING)]
        dims = ("omega", "radiating_dof", "influenced_dof")
        xarray.Dataset(
            {"added_mass": (dims, shuffled[0]), "radiation_damping": (dims, shuffled[1])},
            {"omega": list(OMEGAS), "radiating_dof": list(motions), "influenced_dof": list(motions),
             "rho": DENSITY}).to_netcdf(self.path / "ship.nc", engine="h5netcdf")

    def write_wamit(self, periods=None):
        lines = []
        for k, omega in enumerate(OMEGAS):
            period = periods[k] if periods else 2 * numpy.pi / omega
            for i in range(6):
                for j in range(6):
                    scale = DENSITY * LENGTH**(3 + (i > 2) + (j > 2))
                    line = f" {period:.15E} {i + 1} {j + 1} {ADDED[k, i, j] / scale:.15E}"
                    if period > 0:
                        line += f" {DAMPING[k, i, j] / scale / omega:.15E}"
                    lines.append(line)
        (self.path / "ship.1").write_text("\n".join(lines) + "\n")


class Converter(Files):
    def test_capytaine_in_any_order(self):
        self.write_capytaine()
        found = convert(self.path, "ship.nc", "--about", "1", "0", "-2", "--damping", "1.1", "--stiffness",
                        *map(str, STIFFNESS))
        about = (1.0, 0.0, -2.0)
        added = expected(ADDED[0], ADDED[2], about)
        self.assertEqual(found["mass"], MASS)
        self.assertEqual(found["centre_of_gravity"], list(CENTRE))
        numpy.testing.assert_allclose(found["added_mass"], added / INERTIA, rtol=1e-12)
        waves = expected(DAMPING[1], DAMPING[1], about)
        waves[2:5] /= 2 * numpy.sqrt(STIFFNESS * (INERTIA + added)[2:5])
        numpy.testing.assert_allclose(found["damping"], waves, rtol=1e-12)

    def test_wamit_with_its_units(self):
        self.write_wamit()
        words = ("ship.1", "--about", "0", "0", "0", "--length", str(LENGTH), "--density", str(DENSITY))
        found = convert(self.path, *words, "--fast", "1", "--damping", "20", "--stiffness",
                        *map(str, STIFFNESS))
        # fifteen digits in the file
        added = expected(ADDED[0], ADDED[1], (0, 0, 0))
        numpy.testing.assert_allclose(found["added_mass"], added / INERTIA, rtol=1e-11)
        numpy.testing.assert_allclose(numpy.take(found["damping"], (0, 1, 5)),
                                      expected(DAMPING[2], DAMPING[2], (0, 0, 0))[[0, 1, 5]], rtol=1e-11)

    def test_wamit_s_limits(self):
        self.write_wamit(periods=(-1.0, 2 * numpy.pi, 0.0))
        found = convert(self.path, "ship.1", "--about", "0", "0", "0", "--length", str(LENGTH), "--density",
                        str(DENSITY))
        numpy.testing.assert_allclose(found["added_mass"], expected(ADDED[0], ADDED[2], (0, 0, 0)) / INERTIA,
                                      rtol=1e-11)
        self.assertNotIn("damping", found)

    def test_what_is_missing_is_said(self):
        self.write_wamit()
        self.write_capytaine(motions=("Surge", "Sway", "Heave", "Roll", "Pitch"))
        (self.path / "broken.1").write_text("1.0 1 1 0.5 0.1\nnonsense\n")
        for words, said in ((("ship.1", "--about", "0", "0", "0"), "--length and --density"),
                            (("ship.nc", "--about", "0", "0", "0"), "no motion yaw"),
                            (("ship.1", "--about", "0", "0", "0", "--length", "1", "--density", "1",
                              "--damping", "1"), "--stiffness"),
                            (("none.1", "--about", "0", "0", "0"), "not found"),
                            (("broken.1", "--about", "0", "0", "0", "--length", "1", "--density", "1"),
                             "broken.1:2")):
            code, text = convert(self.path, *words, fails=True)
            self.assertEqual(code, 2)
            self.assertIn(said, text)


class Solver(Files):
    """Thrust on mass and added mass from rest: v = F t / (m + A)."""

    def test_a_ship_has_the_added_mass_of_the_lines(self):
        box = [(x, y, z) for x in (-5, 5) for y in (-1, 1) for z in (-1.44, 1.44)]
        faces = ((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
                 (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3))
        (self.path / "box.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in box) + "".join(
            f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces))
        self.run_program("spherize", "box.obj", "--radius", "0.2", "-o", "box.spheres.h5")
        self.write_capytaine()
        lines = subprocess.run([sys.executable, SOURCE / "examples/ship_matrix.py", "ship.nc", "--about", "0",
                                "0", "0", *SHIP], cwd=self.path, capture_output=True, text=True, check=True)
        (self.path / "case.cfg").write_text(CASE.replace("[ship]\n", lines.stdout))
        self.run_program("icesolve", "case.cfg", "--out", "run", "--no-report")
        ship = json.loads((self.path / "run/summary.json").read_text())["ship"]
        speed = 3600.0 / (MASS + about_centre(ADDED[0], (0, 0, 0))[0])
        # the mean of the second half of two seconds, of steps that each end with their speed
        self.assertAlmostEqual(ship["speed_mean"] / (1.5 * speed), 1.0, delta=0.01)

    def run_program(self, name, *words):
        done = subprocess.run([BIN / name, *words], cwd=self.path, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


CASE = """[simulation]
duration = 2.0
time_step = 0.01
[environment]
water_density = 1000.0
[hull]
spheres = "box.spheres.h5"
draught = 1.44
speed = 0.0
[ship]
free = ["surge"]
[propulsion]
thrust = 3600.0
[flow]
model = "none"
[output]
average_from = 1.0
[[floes]]
spheres = "box.spheres.h5"
pattern = "single"
position = [100.0, 0.0]
hold = "never"
"""

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
