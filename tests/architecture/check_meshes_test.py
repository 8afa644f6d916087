# SPDX-License-Identifier: GPL-3.0-or-later
"""meshes/check_meshes.py must find what is wrong with a mesh, and nothing in a good one."""
import math
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../meshes"))
import check_meshes  # noqa: E402
import icebreaker_form as form  # noqa: E402
import make_icebreaker  # noqa: E402
import make_meshes  # noqa: E402

HULL = make_meshes.obj_text("paper-hull-3d", make_meshes.hull_3d())
HULL_VOLUME = check_meshes.closed_forms()["paper-hull-3d"]


def faults(text):
    return " | ".join(check_meshes.faults("paper-hull-3d", text, HULL_VOLUME))


class CheckMeshes(unittest.TestCase):
    def test_a_good_mesh_has_no_faults(self):
        self.assertEqual(faults(HULL), "")

    def test_a_missing_triangle_opens_the_mesh(self):
        self.assertIn("not closed", faults(HULL[:HULL.rindex("f ")]))

    def test_one_triangle_turned_inside_is_found(self):
        self.assertIn("f 15 14 17\n", HULL)
        self.assertIn("not closed", faults(HULL.replace("f 15 14 17\n", "f 14 15 17\n")))

    def test_a_mesh_turned_inside_out_has_the_wrong_volume(self):
        lines = [" ".join(["f"] + line.split()[:0:-1]) if line.startswith("f ") else line
                 for line in HULL.splitlines()]
        found = faults("\n".join(lines) + "\n")
        self.assertIn("has volume -", found)
        self.assertNotIn("not closed", found)

    def test_a_vertex_moved_by_1e_7_m_is_found(self):
        moved = HULL.replace("v 10.0 0.0 0.36\n", "v 10.0000001 0.0 0.36\n")
        self.assertIn("has volume", faults(moved))
        self.assertIn("differs from what make_meshes.py writes", faults(moved))

    def test_a_deck_tip_off_the_centre_plane_is_not_symmetric(self):
        self.assertIn("not mirror symmetric",
                      faults(HULL.replace("v 10.0 0.0 0.36\n", "v 10.0 0.01 0.36\n")))

    def test_a_triangle_before_the_first_group_is_found(self):
        self.assertIn("outside the named groups", faults(HULL.replace("g bow\n", "")))


class Variants(unittest.TestCase):
    def test_steeper_stems_and_finer_entrances_stay_closed_with_the_exact_volume(self):
        for stem_deg in (20, 45, 70, 89):
            for entrance_deg in (20, 30, 45, 80):
                foot = 10.0 - 1.8 / math.tan(math.radians(stem_deg))
                shoulder = 1.0 / math.tan(math.radians(entrance_deg))
                if foot - shoulder <= 2.4:
                    continue  # the wedge would reach the propeller slope
                profile = check_meshes.hull_profile_area(10.0, 1.8, stem_deg, 2.4,
                                                         [0.66, 0.86, 1.8, 1.8, 0.0])
                mesh = make_meshes.hull_3d(stem_deg=stem_deg, entrance_deg=entrance_deg)
                found = check_meshes.faults("variant", make_meshes.obj_text("variant", mesh),
                                            2.0 * profile - 1.8 * shoulder)
                self.assertEqual(found, [], (stem_deg, entrance_deg))


def icebreaker(triangles):
    """Vertices, triangles and groups of the hull at this fineness."""
    name = "icebreaker"
    return check_meshes.read_obj(make_icebreaker.obj_text(name, make_icebreaker.make(triangles)))


class Icebreaker(unittest.TestCase):
    def test_closed_forms_are_the_sums_of_half_breadths(self):
        steps = 4000  # midpoint rule in x: its error falls with the square of the step
        for z in (-7.5, -5.0, -1.0, 0.0, 0.4, 3.0, 5.0):
            aft, fore = max(form.run_x(z), 0.0), form.stem_x(z)
            width = (fore - aft) / steps
            area = sum(2 * form.half_breadth(aft + (k + 0.5) * width, z) for k in range(steps))
            self.assertAlmostEqual(area * width / form.waterline_area(z), 1.0, delta=1e-6)

    def test_the_profile_and_the_half_breadth_end_together(self):
        for k in range(201):
            x = form.LENGTH * k / 200
            keel = form.keel_z(x)
            if keel > form.KEEL:
                self.assertLess(form.half_breadth(x, keel), 1e-6)
                self.assertGreater(form.half_breadth(x, keel + 1e-3), 1e-5)

    def test_no_section_and_no_water_line_has_a_dent(self):
        heights = [form.KEEL + 13.0 * k / 130 for k in range(131)]
        for k in range(1, 100):
            section = [form.half_breadth(k, z) for z in heights if z >= form.keel_z(k)]
            for lower, upper in zip(section, section[1:]):
                self.assertLessEqual(lower, upper + 1e-9, k)
        for z in heights:
            line = [form.half_breadth(x / 2, z) for x in range(201)]
            line = [y for y in line if y > 0]
            for a, b, c in zip(line, line[1:], line[2:]):
                self.assertLessEqual(a + c, 2 * b + 1e-9, z)  # convex to the water

    def test_finer_meshes_come_to_the_form_with_the_square_of_the_edge(self):
        closed = form.volume_below(form.DECK), form.volume_below(0.0)
        errors = []
        for count in (2000, 32000):
            vertices, triangles, _ = icebreaker(count)
            self.assertLess(abs(len(triangles) - count), 0.1 * count)
            wet = check_meshes.icebreaker_figures(vertices, triangles)["displaced_volume"]
            errors.append((closed[0] - check_meshes.volume(vertices, triangles), closed[1] - wet))
        for coarse, fine in zip(*errors):
            self.assertGreater(fine, 0.0)  # chords of a convex form lie inside
            self.assertGreater(coarse / fine, 10.0)  # 16 for a quarter of the edge
            self.assertLess(coarse / fine, 25.0)

    def test_every_fineness_is_closed_symmetric_and_well_shaped(self):
        for count in (500, 1000, 3000, 12000, 20011):
            vertices, triangles, groups = icebreaker(count)
            edges = {(t[k - 1], t[k]) for t in triangles for k in range(3)}
            self.assertEqual(len(edges), 3 * len(triangles))
            self.assertTrue(all((b, a) in edges for a, b in edges))
            self.assertEqual(len(vertices) - len(edges) // 2 + len(triangles), 2)  # a sphere
            self.assertTrue(check_meshes.symmetric(vertices, triangles, groups))
            self.assertLess(max(check_meshes.aspect(vertices, t) for t in triangles), 12.0)
            self.assertEqual(set(groups), set(make_icebreaker.GROUPS))

    def test_a_stem_moved_by_a_decimetre_is_found(self):
        vertices, triangles, groups = icebreaker(8000)
        moved = [(x, y, z + 0.1) if y == 0.0 and x > form.FOREFOOT_X and -1.0 < z < 1.0
                 else (x, y, z) for x, y, z in vertices]
        self.assertEqual(check_meshes.icebreaker_faults(vertices, triangles, groups), [])
        found = " ".join(check_meshes.icebreaker_faults(moved, triangles, groups))
        self.assertIn("stem_deg", found)


if __name__ == "__main__":
    unittest.main()
