# SPDX-License-Identifier: GPL-3.0-or-later
"""damage.py must tell good, refused, wrong, silent, mute, crashed and hanging programs apart."""
import math
import os
import stat
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import damage_mesh  # noqa: E402
import hull_damage  # noqa: E402

FLOE = os.path.join(HERE, "../../meshes/paper-floe-3d.obj")
FLOE_VOLUME = 0.24

# Stands in for spherize: an undamaged mesh (no "-" and number in its name) is always good.
STAND_IN = """#!{python}
import json, os, re, signal, sys, time
def answer(volume, repairs):
    with open(sys.argv[sys.argv.index("--json") + 1], "w") as file:
        json.dump({{"volume_m3": volume, "repairs": repairs}}, file)
    sys.exit(0)
if not re.search("-[0-9]+-", os.path.basename(sys.argv[1])):
    answer({volume}, [])
{behaviour}
"""
REPAIRS = '[{"step": "repaired", "count": 1}]'


def run_damage(behaviour, *options):
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "stand-in")
        with open(program, "w", encoding="ascii") as file:
            file.write(STAND_IN.format(python=sys.executable, volume=FLOE_VOLUME,
                                       behaviour=behaviour))
        os.chmod(program, stat.S_IRWXU)
        done = subprocess.run(
            [sys.executable, "-B", os.path.join(HERE, "damage.py"), "--spherize", program,
             "--meshes", FLOE, "--count", "10", "--jobs", "2", "--places-every", "0", *options],
            capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class Answers(unittest.TestCase):
    def test_a_program_that_repairs_everything_passes(self):
        code, text = run_damage(f"answer({FLOE_VOLUME} * 1.009, {REPAIRS})")
        self.assertEqual(code, 0, text)
        self.assertIn("8 of 8 repairable copies are good: 100.00 %", text)

    def test_a_volume_two_percent_off_is_wrong(self):
        for volume in (FLOE_VOLUME * 1.02, FLOE_VOLUME * 0.98, -FLOE_VOLUME, "None", "math.nan"):
            code, text = run_damage(f"import math\nanswer({volume}, {REPAIRS})")
            self.assertEqual(code, 1, text)
            self.assertIn("10 of 10 copies wrong", text)

    def test_a_program_that_refuses_everything_is_not_wrong_but_too_weak(self):
        refusal = 'sys.exit("x" if print("a.obj: bad\\n  mend it", file=sys.stderr) else 2)'
        code, text = run_damage(refusal)
        self.assertEqual(code, 1, text)
        self.assertIn("0 of 8 repairable", text)
        self.assertIn("0 of 10 copies wrong", text)
        code, text = run_damage(refusal, "--at-least", "0")
        self.assertEqual(code, 0, text)

    def test_a_refusal_without_a_remedy_is_found(self):
        code, text = run_damage('print("a.obj: bad", file=sys.stderr)\nsys.exit(2)',
                                "--at-least", "0")
        self.assertEqual(code, 1, text)
        self.assertIn("mute", text)

    def test_repairs_that_are_not_listed_are_found(self):
        code, text = run_damage(f"answer({FLOE_VOLUME}, [])")
        self.assertEqual(code, 1, text)
        self.assertIn("flip silent", text)
        self.assertNotIn("jitter silent", text)

    def test_only_the_kinds_asked_for_are_tried(self):
        code, text = run_damage(f"answer({FLOE_VOLUME}, [])", "--kinds", "jitter", "truncate")
        self.assertEqual(code, 0, text)
        self.assertIn("1 of 1 repairable", text)
        self.assertIn("0 of 2 copies wrong", text)

    def test_crashes_and_other_exit_codes_are_found(self):
        for behaviour in ("os.kill(os.getpid(), signal.SIGSEGV)", "sys.exit(1)", "sys.exit(3)"):
            code, text = run_damage(behaviour, "--at-least", "0")
            self.assertEqual(code, 1, text)
            self.assertIn("truncate crash", text)

    def test_a_program_that_hangs_is_stopped_and_found(self):
        # the undamaged mesh must be answered within the limit on a busy machine, too
        code, text = run_damage("time.sleep(600)", "--at-least", "0", "--timeout", "8", "--kinds",
                                "nan")
        self.assertEqual(code, 1, text)
        self.assertIn("nan hang", text)

    def test_a_mesh_that_is_not_good_undamaged_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            code, text = run_damage("sys.exit(2)", "--keep", folder, "--at-least", "0")
            kept = os.listdir(folder)
        self.assertEqual(code, 1, text)
        self.assertEqual(len([name for name in kept if name.endswith(".txt")]), 10, kept)


class Copies(unittest.TestCase):
    def setUp(self):
        self.mesh = damage_mesh.read_obj(FLOE)

    def damaged(self, kind, seed):
        copy = self.mesh.copy()
        damage_mesh.DAMAGE[kind](copy, damage_mesh.Dice("test", seed))
        return copy

    def faces(self, mesh):
        """Each face as its points from the least one on."""
        found = []
        for t in mesh.triangles:
            points = mesh.corners(t)
            first = points.index(min(points))
            found.append(tuple(points[first:] + points[:first]))
        return found

    def test_the_same_key_gives_the_same_bytes_and_another_one_others(self):
        for index in range(40):
            again = [damage_mesh.damaged_copy(self.mesh, "floe", seed, index) for seed in (1, 1, 2)]
            self.assertEqual(again[0], again[1])
            self.assertEqual(again[0][0], damage_mesh.KINDS[index % len(damage_mesh.KINDS)])
            if again[0][0] in ("jitter", "crack", "split"):
                self.assertNotEqual(again[0][3], again[2][3])

    def test_each_kind_does_what_it_says(self):
        whole = self.faces(self.mesh)
        for seed in range(20):
            for kind in ("delete", "hole"):
                left = self.faces(self.damaged(kind, seed))
                self.assertEqual(len(left), len(whole) - 1)
                self.assertTrue(set(left) < set(whole))
            self.assertEqual(len(set(self.faces(self.damaged("flip", seed))) - set(whole)), 6)
            self.assertGreater(len(self.damaged("duplicate", seed).triangles), len(whole))
            parts = self.damaged("split", seed)
            self.assertEqual(sorted(self.faces(parts)), sorted(whole))
            for kind in ("jitter", "crack"):
                moved = self.damaged(kind, seed)
                for before, after in zip(self.mesh.triangles, moved.triangles):
                    for p, q in zip(self.mesh.corners(before), moved.corners(after)):
                        self.assertLessEqual(max(abs(a - b) for a, b in zip(p, q)), 1.01e-6)
            self.assertEqual(len(moved.vertices), 36)
            spoilt = self.damaged("nan", seed)
            self.assertTrue(any(not math.isfinite(value) for t in spoilt.triangles
                                for point in spoilt.corners(t) for value in point))

    def test_each_kind_of_real_hulls_does_what_it_says(self):
        for index in range(10):
            copies = {kind: damage_mesh.damaged_copy(
                self.mesh, "floe", 1, index * len(damage_mesh.KINDS)
                + damage_mesh.KINDS.index(kind)) for kind in damage_mesh.HULLS}
            for kind, (name, done, _, data, truth) in copies.items():
                self.assertEqual((name, done), (kind, [kind]))
                volume = damage_mesh.volume_of(truth)
                if kind == "waterline":
                    self.assertTrue(0.4 * FLOE_VOLUME < volume < 0.9 * FLOE_VOLUME)
                elif kind in ("rudder", "posts"):
                    self.assertTrue(FLOE_VOLUME < volume < 1.03 * FLOE_VOLUME)
                else:
                    self.assertAlmostEqual(volume, FLOE_VOLUME, 9)
                self.assertNotEqual(data, damage_mesh.obj_bytes(self.mesh))
        for kind, more in (("rudder", 12), ("sheet", 2), ("skin", 12)):
            self.assertEqual(len(self.damaged(kind, 1).triangles), 12 + more)

    def test_places_are_judged_by_exact_solid_angles_and_distances(self):
        try:
            import check_spheres  # pylint: disable=import-outside-toplevel
            import numpy  # pylint: disable=import-outside-toplevel
        except ImportError as missing:
            self.skipTest(str(missing))
        box = check_spheres.corners_of(hull_damage.make_box((0, 0, 0), (2, 2, 2)))
        points = numpy.array([(0, 0, 0), (0.99, 0.99, 0.99), (1.01, 0, 0), (3, 4, 1)])
        winding = check_spheres.winding_numbers(points, box)
        self.assertTrue(numpy.allclose(winding, [1, 1, 0, 0], atol=1e-9))
        far = check_spheres.distances(points, box)
        self.assertTrue(numpy.allclose(far, [1, 0.01, 0.01, math.sqrt(4 + 9)], atol=1e-9))

    def test_binary_stl_is_as_long_as_its_count_says(self):
        data = damage_mesh.stl_bytes(self.mesh)
        self.assertEqual(len(data), 84 + 50 * 12)
        self.assertFalse(data.startswith(b"solid"))


if __name__ == "__main__":
    unittest.main()
