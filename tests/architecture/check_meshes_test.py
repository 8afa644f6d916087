# SPDX-License-Identifier: GPL-3.0-or-later
"""meshes/check_meshes.py must find what is wrong with a mesh, and nothing in a good one."""
import math
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../meshes"))
import check_meshes  # noqa: E402
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


if __name__ == "__main__":
    unittest.main()
