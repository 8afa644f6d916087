#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""scene_test.py SOURCE BIN MODULE: scenes stepped from Python, with the compiled module MODULE."""
import os
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

SOURCE, BIN, MODULE = (Path(word) for word in sys.argv[1:4])
os.environ.update(ICESOLVE_BIN=str(BIN), ICESOLVE_MODULE=str(MODULE))
sys.path.insert(0, str(SOURCE / "python"))
try:
    import numpy as np

    import icesolve
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

SECONDS = 3.0


class Scenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        os.chdir(cls.temporary.name)
        warnings.simplefilter("ignore")  # short runs warn that they are short
        meshes = SOURCE / "meshes"
        cls.hull = icesolve.spherize(meshes / "paper-hull-3d.obj", radius=0.1)
        cls.floe = icesolve.spherize(meshes / "paper-floe-3d.obj", radius=0.05)
        icesolve.write_case("field.cfg", {
            "simulation": {"duration": SECONDS},
            "hull": {"spheres": cls.hull, "draught": 1.44, "position": [-9.6, 0], "speed": 1.0},
            "floes": [{"spheres": cls.floe, "count": [6, 5], "gap": [0.1, 0.1]}]})
        icesolve.write_case("single.cfg", {
            "simulation": {"duration": SECONDS},
            "hull": {"spheres": cls.hull, "draught": 1.44, "position": [-30, 0], "speed": 0.0},
            "drag": {"coefficient": 0.0},
            "floes": [{"spheres": cls.floe, "pattern": "single", "position": [0, 0],
                       "hold": "never"}]})

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.temporary.cleanup()

    def test_steps_have_the_bits_of_a_run(self):
        run = icesolve.run("field.cfg", "run", report=False)
        history, scene = run.history, icesolve.Scene("field.cfg")
        rows = history.sizes["time"]
        self.assertGreater(rows, 100)
        forces = np.zeros((rows, 3))
        for row in range(rows):
            scene.step()
            forces[row] = scene.force
        np.testing.assert_array_equal(forces, history.force.values)
        self.assertGreater(np.abs(forces).max(), 0.0)
        np.testing.assert_array_equal(scene.moment, history.moment.values[-1])
        work = run.summary["energy"]
        self.assertEqual(scene.energy["ship_work"], work["ship_work_J"])
        self.assertEqual(scene.energy["residual"], work["residual_J"])
        self.assertAlmostEqual(scene.time, SECONDS)
        self.assertEqual(scene.steps, rows)

    def test_arrays_are_the_solvers_memory(self):
        scene = icesolve.Scene("field.cfg")
        position, before = scene.position, scene.position.copy()
        self.assertEqual(position.shape, (31, 3))
        scene.step(20)
        self.assertIs(scene.position, position)
        self.assertAlmostEqual(position[0, 0] - before[0, 0], 20 * scene.time_step, delta=1e-12)
        for name in ("position", "orientation_xyzw", "velocity", "angular_velocity", "mass",
                     "held"):
            with self.assertRaises(ValueError):
                getattr(scene, name)[0] = 1.0
        np.testing.assert_allclose(np.linalg.norm(scene.orientation_xyzw, axis=1), 1.0, atol=1e-12)
        self.assertEqual(scene.mass[0], 0.0)
        # 0.8 x 0.8 x 0.3 m of ice of 900 kg/m3 unless the mesh says otherwise: all floes alike
        self.assertEqual(len(set(scene.mass[1:])), 1)
        del scene
        self.assertTrue(np.isfinite(position).all())  # the array keeps the memory alive

    def test_an_applied_force_moves_a_floe_as_newton_says(self):
        scene = icesolve.Scene("single.cfg")
        begun = scene.position[1].copy()

        def wind(now):
            now.applied_force[1] = (30.0, -10.0, 0.0)

        steps = 100
        scene.step(steps, loads=wind)
        time = steps * scene.time_step
        expected = np.array([30.0, -10.0]) * time / scene.mass[1]
        np.testing.assert_allclose(scene.velocity[1, :2], expected, rtol=1e-12)
        # velocities after steps 1, 2, ... n carry it: n (n + 1) / 2 dt^2 F / m
        distance = expected * scene.time_step * (steps + 1) / 2
        np.testing.assert_allclose(scene.position[1, :2] - begun[:2], distance, rtol=1e-9)
        self.assertAlmostEqual(scene.energy["applied_work"],
                               0.5 * scene.mass[1] * (expected @ expected), delta=1e-9)
        scene.applied_force[:] = 0.0
        speed = scene.velocity[1, :2].copy()
        scene.step(10)
        np.testing.assert_allclose(scene.velocity[1, :2], speed, rtol=1e-12)

    def test_the_ships_contacts_add_up_to_its_force(self):
        scene = icesolve.Scene("field.cfg")
        while not scene.force.any():
            scene.step()
        contacts = scene.contacts
        of_ship = contacts[contacts["a"] == 0]
        along = of_ship["normal"] * of_ship["normal_impulse"][:, None]
        impulse = along + of_ship["friction_impulse"]
        # sums of a few hundred terms in another order
        np.testing.assert_allclose(-impulse.sum(axis=0) / scene.time_step, scene.force,
                                   atol=1e-9 * np.abs(scene.force).max())

    def test_what_cannot_be_says_so(self):
        with self.assertRaises(icesolve.CaseError) as caught:
            icesolve.Scene("field.cfg", {"hull.sped": 1.0})
        self.assertIn("hull.speed", str(caught.exception))
        scene = icesolve.Scene("single.cfg")
        scene.applied_moment[1, 2] = np.nan
        with self.assertRaises(ValueError) as caught:
            scene.step()
        self.assertIn("body 1", str(caught.exception))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
