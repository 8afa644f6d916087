#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ship_matrix_test.py SOURCE BIN: examples/ship_matrix.py with small files made here.

Matrices written as Capytaine and as WAMIT write them come out as they went in, about the centre of
gravity, and icesolve takes the file. Skipped (exit code 77) without numpy, of Capytaine's without
xarray and h5netcdf."""
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

try:
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
try:
    import h5netcdf  # noqa: F401
    import xarray
except ImportError:
    xarray = None

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


MASS, CENTRE = 28800.0, (0.5, 0.0, 1.2)
SLOW, FAST = (0, 1, 5), (2, 3, 4)


def convert(folder, *words, fails=False):
    done = subprocess.run([sys.executable, SOURCE / "examples/ship_matrix.py", *words], cwd=folder,
                          capture_output=True, text=True)
    if fails:
        return done.returncode, done.stderr
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    (folder / "ship.toml").write_text(done.stdout)
    return tomllib.loads(done.stdout)


def matrix_of(table):
    return numpy.array([table[m] for m in MOTIONS])


def about_centre(matrix, about):
    """About the centre of gravity, by the energy of unit velocities there, one or two at a time."""
    def energy(motion):
        turn = motion[3:]
        old = numpy.concatenate([motion[:3] + numpy.cross(turn, numpy.subtract(about, CENTRE)),
                                 turn])
        return old @ matrix @ old

    unit = numpy.eye(6)
    return numpy.array([[0.5 * (energy(i + j) - energy(i) - energy(j)) for j in unit]
                        for i in unit])


def expected(slow, fast, about):
    out = numpy.zeros((6, 6))
    for matrix, group in ((slow, SLOW), (fast, FAST)):
        out[numpy.ix_(group, group)] = about_centre(matrix, about)[numpy.ix_(group, group)]
    return out


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


def same(found, matrix, digits):
    numpy.testing.assert_allclose(matrix_of(found), matrix, rtol=0,
                                  atol=digits * numpy.abs(matrix).max())


class Converter(Files):
    @unittest.skipIf(xarray is None, "xarray or h5netcdf is missing")
    def test_capytaine_in_any_order(self):
        self.write_capytaine()
        found = convert(self.path, "ship.nc", "--about", "1", "0", "-2", "--centre-of-gravity",
                        *map(str, CENTRE), "--damping", "1.1")
        about = (1.0, 0.0, -2.0)
        self.assertEqual(found["about"], list(CENTRE))
        same(found["added_mass"], expected(ADDED[0], ADDED[2], about), 1e-12)
        same(found["damping"], expected(DAMPING[1], DAMPING[1], about), 1e-12)

    def test_wamit_with_its_units(self):
        self.write_wamit()
        words = ("ship.1", "--about", "0", "0", "0", "--length", str(LENGTH),
                 "--density", str(DENSITY), "--centre-of-gravity", *map(str, CENTRE))
        found = convert(self.path, *words, "--fast", "1", "--damping", "20")
        # fifteen digits in the file
        same(found["added_mass"], expected(ADDED[0], ADDED[1], (0, 0, 0)), 1e-11)
        same(found["damping"], expected(DAMPING[2], DAMPING[2], (0, 0, 0)), 1e-11)

    def test_wamit_s_limits(self):
        self.write_wamit(periods=(-1.0, 2 * numpy.pi, 0.0))
        found = convert(self.path, "ship.1", "--about", *map(str, CENTRE), "--length", str(LENGTH),
                        "--density", str(DENSITY))
        same(found["added_mass"], expected(ADDED[0], ADDED[2], CENTRE), 1e-11)
        self.assertNotIn("damping", found)

    def test_what_is_missing_is_said(self):
        self.write_wamit()
        (self.path / "broken.1").write_text("1.0 1 1 0.5 0.1\nnonsense\n")
        faults = [(("ship.1", "--about", "0", "0", "0"), "--length and --density"),
                  (("none.1", "--about", "0", "0", "0"), "not found"),
                  (("broken.1", "--about", "0", "0", "0", "--length", "1", "--density", "1"),
                   "broken.1:2")]
        if xarray is not None:
            self.write_capytaine(motions=("Surge", "Sway", "Heave", "Roll", "Pitch"))
            faults.append((("ship.nc", "--about", "0", "0", "0"), "no motion yaw"))
        for words, said in faults:
            code, text = convert(self.path, *words, fails=True)
            self.assertEqual(code, 2)
            self.assertIn(said, text)


class Solver(Files):
    """Thrust on mass and added mass from rest: v = F t / (m + A)."""

    def setUp(self):
        super().setUp()
        box = [(x, y, z) for x in (-5, 5) for y in (-1, 1) for z in (-1.44, 1.44)]
        faces = ((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7),
                 (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3))
        (self.path / "box.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in box) + "".join(
            f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces))
        self.assertEqual(*self.run_program("spherize", "box.obj", "--radius", "0.2",
                                           "-o", "box.spheres.h5"))
        (self.path / "case.cfg").write_text(CASE)
        self.write_wamit()
        convert(self.path, "ship.1", "--about", "0", "0", "0", "--length", str(LENGTH), "--density",
                str(DENSITY), "--damping", "1")

    def test_a_ship_has_the_added_mass_of_the_file(self):
        self.assertEqual(*self.run_program("icesolve", "case.cfg", "--out", "run", "--no-report"))
        ship = json.loads((self.path / "run/summary.json").read_text())["ship"]
        # F = (m + A) dv/dt + D v from rest; eleven digits in the file
        mass, damping = MASS + ADDED[0][0][0], DAMPING[1][0][0]
        # the mean over the steps that end at 1 s or later, each with its speed
        times = numpy.arange(1.0, 2.005, 0.01)
        speeds = 3600.0 / damping * (1 - numpy.exp(-damping / mass * times))
        self.assertAlmostEqual(ship["speed_mean"] / speeds.mean(), 1.0, delta=1e-5)

    def test_couplings_that_are_left_out_are_named(self):
        code, _, text = self.run_program("icesolve", "case.cfg", "--check",
                                         "--set", "ship.free=['surge','sway']")
        self.assertEqual(code, 0)
        self.assertIn("couples motions by up to", text)

    def test_what_is_wrong_with_a_file_is_said(self):
        text = (self.path / "ship.toml").read_text()
        line = 1 + text[:text.index("surge = [")].count("\n")
        for fault, said in (
                (text.replace("about = ", "abuot = "), "did you mean 'about'"),
                (text.replace("surge = [", "surge = [1.0, ", 1), f"ship.toml:{line}"),
                (text.replace("yaw = ", "# ", 1), "required key 'added_mass.yaw' is missing"),
                (text.replace("[damping]\nsurge = ", "[damping]\n# "),
                 "required key 'damping.surge'"),
                (text.replace("[added_mass]\nsurge = [", "[added_mass]\nsurge = [-"), "below 0")):
            self.assertNotEqual(fault, text)
            (self.path / "ship.toml").write_text(fault)
            code, _, error = self.run_program("icesolve", "case.cfg", "--check")
            self.assertEqual(code, 2, error)
            self.assertIn(said, error)
        (self.path / "ship.toml").unlink()
        code, _, error = self.run_program("icesolve", "case.cfg", "--check")
        self.assertEqual(code, 2, error)
        self.assertIn("examples/ship_matrix.py", error)

    def test_two_sources_of_added_mass_are_refused(self):
        for setting in ("ship.added_mass='computed'", "ship.added_mass=[0.1,0,0,0,0,0]"):
            code, _, error = self.run_program("icesolve", "case.cfg", "--check", "--set", setting)
            self.assertEqual(code, 2, error)
            self.assertIn("keep one", error)

    def run_program(self, name, *words):
        done = subprocess.run([BIN / name, *words], cwd=self.path, capture_output=True, text=True)
        return done.returncode, 0, done.stderr + done.stdout


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
mass = 28800.0
matrix = "ship.toml"
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
