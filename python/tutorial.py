#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""From a hull's mesh to a resistance curve with intervals: tutorial.py [FOLDER]

Run it cell by cell in an editor that knows "# %%", or whole. FOLDER (tutorial) gets all files."""
import os
import sys
from pathlib import Path

import icesolve

meshes = Path(__file__).resolve().parents[1] / "meshes"
folder = Path(sys.argv[1] if len(sys.argv) > 1 else "tutorial").resolve()
folder.mkdir(parents=True, exist_ok=True)
os.chdir(folder)
seconds = float(os.environ.get("TUTORIAL_SECONDS", 30.0))  # of the slowest run: less is faster

# %% contact spheres of hull and floe
hull = icesolve.spherize(meshes / "paper-hull-3d.obj", radius=0.1)
floe = icesolve.spherize(meshes / "paper-floe-3d.obj", radius=0.05)

# %% a case: dictionaries, checked against the program's own schema
icesolve.write_case("curve.cfg", {
    "simulation": {"duration": seconds},
    "hull": {"spheres": hull, "draught": 1.44, "position": [-9.6, 0], "speed": 0.5},
    "floes": [{"spheres": floe, "count": [18, 9], "gap": [0.1, 0.1]}],
    "output": {"average_from": 0.5 * seconds},
})

# %% three speeds over the same way, three seeds each
for speed in (0.5, 0.75, 1.0):
    time = seconds * 0.5 / speed
    run = icesolve.run("curve.cfg", f"runs/speed-{speed}", seeds=3, overwrite=True, report=False,
                       settings={"hull.speed": speed, "simulation.duration": time,
                                 "output.average_from": 0.5 * time,
                                 "simulation.jitter": 0.003})
    print(f"{speed} m/s: {run.resistance}")

# %% the curve, one run against time, the floes at its end
curve = icesolve.open_sweep("runs")
icesolve.plot_resistance(curve, "resistance.pdf")
icesolve.plot_history(run, "history.png")
icesolve.plot_floes(run, float(run.frames.frame_time[-1]), "floes.png")
print(curve.resistance.to_series().round(1).to_string())

# %% the same case stepped from here, with a cross wind of 50 N on each floe
scene = icesolve.Scene("curve.cfg")


def wind(now):
    now.applied_force[1:, 1] = 50.0


scene.step(int(0.5 * seconds / scene.time_step), loads=wind)
free = scene.held == 0
print(f"t = {scene.time:.2f} s: f_x = {scene.force[0]:.0f} N, free floes "
      f"drift at {scene.velocity[free, 1].mean():.3f} m/s")
