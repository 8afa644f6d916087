#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""package_test.py SOURCE BIN: `import icesolve` with the programs of BIN."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

SOURCE, BIN = Path(sys.argv[1]), Path(sys.argv[2])
os.environ["ICESOLVE_BIN"] = str(BIN)
sys.path.insert(0, str(SOURCE / "python"))
try:
    import icesolve
    from icesolve.cases import write_specification
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        os.chdir(cls.folder)
        warnings.simplefilter("ignore")  # short runs warn that they are short
        subprocess.run([sys.executable, SOURCE / "python" / "tutorial.py", "tutorial"], check=True,
                       env={**os.environ, "PYTHONPATH": str(SOURCE / "python"),
                            "TUTORIAL_SECONDS": "4"}, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        cls.tutorial = cls.folder / "tutorial"
        cls.last = icesolve.open_run(cls.tutorial / "runs" / "speed-1.0")

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.temporary.cleanup()

    def test_the_tutorial_draws_its_three_pictures(self):
        for name, begins in (("resistance.pdf", b"%PDF"), ("history.png", b"\x89PNG"),
                             ("floes.png", b"\x89PNG")):
            data = (self.tutorial / name).read_bytes()
            self.assertTrue(data.startswith(begins), name)
            self.assertGreater(len(data), 5000, name)

    def test_means_have_the_bits_of_the_summary(self):
        part = self.last.summary["resistance"]
        self.assertEqual(-self.last.mean(), part["mean_N"])
        self.assertEqual(-self.last.mean("contact_force"), part["contact_mean_N"])
        self.assertEqual(-self.last.mean("friction_force"), part["friction_mean_N"])
        self.assertEqual(self.last.mean(axis="z"), self.last.summary["vertical"]["mean_N"])

    def test_history_is_that_of_the_csv_file(self):
        with open(self.last.folder / "forces.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        history = self.last.history
        self.assertEqual(len(rows), history.sizes["time"])
        at = len(rows) * 2 // 3
        for name, axis in (("contact_force", "x"), ("friction_force", "y"), ("contact_force", "z")):
            column = f"{name.split('_')[0]}_f{axis}_N"
            value = float(history[name].sel(xyz=axis)[at])
            self.assertAlmostEqual(value, float(rows[at][column]), delta=1e-5 * abs(value) + 1e-9)
        self.assertEqual(history.force.units, "N")
        self.assertEqual(history.time.units, "s")

    def test_an_ensemble_has_students_interval(self):
        summary = json.loads((self.tutorial / "runs/speed-1.0/summary.json").read_text())
        means = summary["ensemble"]["means_N"]
        self.assertEqual(len(means), 3)
        mean = sum(means) / 3
        spread = math.sqrt(sum((m - mean) ** 2 for m in means) / 2)
        estimate = self.last.resistance
        self.assertAlmostEqual(estimate.mean, mean, delta=1e-9 * mean)
        # Student's t for two degrees of freedom, 97.5 %: 4.302653
        self.assertAlmostEqual(estimate.ci95, 4.302653 * spread / math.sqrt(3), delta=1e-5 * mean)

    def test_a_sweep_is_ordered_by_speed_and_leaves_members_out(self):
        sweep = icesolve.open_sweep(self.tutorial / "runs")
        self.assertEqual(list(sweep.speed.values), [0.5, 0.75, 1.0])
        self.assertEqual(list(sweep.run.values), ["speed-0.5", "speed-0.75", "speed-1.0"])
        self.assertEqual(float(sweep.resistance[2]), self.last.resistance.mean)
        self.assertEqual(sweep.resistance.units, "N")
        self.assertAlmostEqual(float(sweep.thickness[0]), 0.3, delta=1e-9)  # of the paper's floe

    def folder_with(self, name, warned):
        """A run folder of a summary with these warnings alone."""
        folder = self.folder / name
        folder.mkdir(parents=True)
        summary = {**self.last.summary, "warnings": warned}
        (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
        return folder

    def test_warnings_keep_their_verdicts(self):
        jam = {"text": "a jam", "affects_mean": True, "share": 0.25}
        overlap = {"text": "an overlap", "affects_mean": False, "share": 0.01}
        found = icesolve.open_run(self.folder_with("warned/jam", [jam, overlap])).warnings
        self.assertEqual(found, ["a jam", "an overlap"])  # texts, as before
        self.assertEqual([(w.affects_mean, w.share) for w in found], [(True, 0.25), (False, 0.01)])
        unknown = icesolve.open_run(self.folder_with("warned/older", ["a text"])).warnings[0]
        self.assertEqual((unknown, unknown.affects_mean, unknown.share), ("a text", None, None))

        self.folder_with("warned/none", [overlap])
        self.folder_with("warned/more", [{**jam, "share": 7.11}])  # no more than the whole mean
        sweep = icesolve.open_sweep(self.folder / "warned")
        affected = dict(zip(sweep.run.values, sweep.affected.values))
        self.assertTrue(math.isnan(affected.pop("older")))
        self.assertEqual(affected, {"jam": 25.0, "more": 100.0, "none": 0.0})
        self.assertEqual(sweep.affected.units, "%")

    def test_frames_follow_the_floes(self):
        frames = self.last.frames
        # floe 0 of 18 x 9 pieces of 0.8 x 0.8 m and gaps of 0.1 m, held or pushed ahead of the ship
        self.assertEqual(frames.position.dims, ("frame_time", "body", "xyz"))
        self.assertEqual(frames.sizes["body"], 18 * 9)
        moved = (frames.state.values[-1] > 0).sum()
        self.assertEqual(int(moved), self.last.summary["floes"]["moved"])
        self.assertEqual(self.last.outline(3).shape[1], 3)

    def test_a_wrong_case_names_its_key_and_is_not_written(self):
        for case, said in (({"hull": {"sphere": "x"}}, "sphere"),
                           ({"simulation": {"duration": "long"}}, "simulation.duration"),
                           ({"simulation": {"dimension": 4}}, "simulation.dimension")):
            with self.assertRaises(icesolve.CaseError) as caught:
                icesolve.write_case("wrong.cfg", case)
            self.assertIn(said, str(caught.exception))
        self.assertFalse(Path("wrong.cfg").exists())

    def test_a_specification_becomes_a_field(self):
        write_specification("field.toml", {
            "pattern": "voronoi", "seed": 1, "ice": {"thickness": 0.3},
            "spheres": {"radius": 0.1, "spacing": 0.2}, "area": {"size": [6.0, 6.0]},
            "floes": {"mean_size": 1.5, "concentration": 0.7}})
        field = icesolve.make_field("field.toml", "field.h5")
        self.assertGreater(field.stat().st_size, 1000)

    def test_a_program_that_refuses_speaks_for_itself(self):
        with self.assertRaises(icesolve.ProgramError) as caught:
            icesolve.run("missing.cfg")
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("missing.cfg", str(caught.exception))
        with self.assertRaises(icesolve.ProgramError) as caught:
            icesolve.run(self.tutorial / "curve.cfg", self.tutorial / "runs" / "speed-1.0")
        self.assertIn("holds an ensemble", str(caught.exception))

    def test_progress_goes_from_little_to_all(self):
        shares = []
        run = icesolve.run(self.tutorial / "curve.cfg", "progress", report=False,
                           settings={"simulation.duration": 1.0, "output.average_from": 0.5},
                           progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1.0)
        self.assertEqual(run.summary["status"], "completed")
        self.assertIsNone(run.ensemble)

    def test_folders_without_runs_say_so(self):
        with self.assertRaises(FileNotFoundError):
            icesolve.open_run("nowhere")
        Path("empty").mkdir()
        with self.assertRaises(FileNotFoundError):
            icesolve.open_sweep("empty")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
