# SPDX-License-Identifier: GPL-3.0-or-later
"""Time per simulated second in level ice with many pieces alive:

    python3 tests/bench/edge_speed.py [build/release/bin] [--until 66] [--measure 2] [--threads 2]

The 100 m icebreaker at 4 kn in 1 m of ice whose cracks are half as long as by default
(level_ice.length_factor = 0.17): about 500 pieces are alive after 66 s. The run is stopped there,
goes on for `measure` seconds, and these are timed, without reading the checkpoint and the report.
Further words are settings of the case.
"""
import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "cases/level-ice-icebreaker"


def run(options, folder, until, *words):
    settings = ["level_ice.length_factor=0.17", "output.average_from=1",
                f"simulation.duration={until}", *options.settings]
    subprocess.run([options.bin.resolve() / "icesolve", CASE / "case.cfg", "-q", "--no-report",
                    "--threads", str(options.threads), "--checkpoint-every", str(options.until),
                    "--out", folder, *words,
                    *(word for text in settings for word in ("--set", text))], check=True)
    return json.loads((Path(folder) / "summary.json").read_text(encoding="utf8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("bin", nargs="?", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("settings", nargs="*", help="of the case, key=value")
    parser.add_argument("--until", type=float, default=66.0, help="[s] (%(default)s)")
    parser.add_argument("--measure", type=float, default=2.0, help="[s] (%(default)s)")
    parser.add_argument("--threads", type=int, default=2, help="(%(default)s)")
    options = parser.parse_args()
    subprocess.run([ROOT / "cases/prepare.sh", CASE], check=True, capture_output=True)
    with tempfile.TemporaryDirectory() as folder:
        before = run(options, folder, options.until)
        after = run(options, folder, options.until + options.measure, "--restart",
                    Path(folder) / "checkpoint.h5")
        log = (Path(folder) / "run.log").read_text(encoding="utf8")
    broken, gone = re.findall(r"(\d+) pieces? broke off.* (\d+) pieces? far astern", log)[-1]
    print(f"{int(broken) - int(gone)} pieces alive, {options.threads} threads:\n")
    print("| stage | wall s per simulated second |\n|---|---|")
    stages = {name: seconds - before["stage_seconds"][name]
              for name, seconds in after["stage_seconds"].items()}
    stages["all"] = sum(stages.values())
    for name, seconds in stages.items():
        print(f"| {name} | {seconds / options.measure:.3f} |")


if __name__ == "__main__":
    main()
