# SPDX-License-Identifier: GPL-3.0-or-later
"""What a free ship costs beside one on a prescribed course: processor time of the pre-sawn channel.

    python3 tests/bench/ship_cost.py [build/release/bin] [--rounds N]

One thread. Of a round all ships run one after the other, so that other load of the machine meets
all alike; printed are the medians. The contacts differ a little where the ship heaves or pitches,
as the ice moves it.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "cases/presawn-channel"
SIX = '["surge", "sway", "heave", "roll", "pitch", "yaw"]'
HELD = ["propulsion.hold_speed=0.5"]
SHIPS = {"on a prescribed course": [],
         "free in surge, a thousand times its mass": ['ship.free=["surge"]',
                                                      "ship.mass='27000000 kg'", *HELD],
         "free in heave, pitch and roll": ['ship.free=["heave", "pitch", "roll"]'],
         "free in all six": [f"ship.free={SIX}", *HELD]}


def cpu_seconds(program, settings, folder):
    words = [word for text in ["simulation.duration=20", "output.average_from=10",
                               "output.frames_every=2", *settings] for word in ("--set", text)]
    child = subprocess.Popen([program, CASE / "case.cfg", "-q", "--threads", "1", "--no-report",
                              "--overwrite", "--out", folder, *words])
    _, status, used = os.wait4(child.pid, 0)
    if status:
        sys.exit(f"icesolve ended with status {status}: {settings}")
    return used.ru_utime


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("bin", nargs="?", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--rounds", type=int, default=5, help="(%(default)s)")
    options = parser.parse_args()
    subprocess.run([ROOT / "cases/prepare.sh", CASE], check=True, capture_output=True)
    times = {name: [] for name in SHIPS}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for name, settings in SHIPS.items():
                times[name].append(cpu_seconds(options.bin.resolve() / "icesolve", settings,
                                               f"{folder}/{list(SHIPS).index(name)}"))
    base = statistics.median(times["on a prescribed course"])
    print("| the ship | cpu s | over a prescribed course |\n|---|---|---|")
    for name, values in times.items():
        middle = statistics.median(values)
        print(f"| {name} | {middle:.2f} | {middle / base:.3f} |")


if __name__ == "__main__":
    main()
