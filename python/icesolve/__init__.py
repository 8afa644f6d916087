# SPDX-License-Identifier: GPL-3.0-or-later
"""icesolve from Python: cases written and run, runs and sweeps read into xarray, charts.

    import icesolve
    hull = icesolve.spherize("hull.stl", radius=0.1)
    floe = icesolve.spherize("floe.stl", radius=0.05)
    icesolve.write_case("first.cfg", {"hull": {"spheres": hull, "draught": 1.44, "speed": 0.5},
                                      ...})
    run = icesolve.run("first.cfg", seeds=3)
    print(run.resistance)
    scene = icesolve.Scene("first.cfg")                     # stepped from here
    scene.step(100)

All numbers are SI. The programs are those beside ICESOLVE_BIN where it is set, else those on the
PATH, else those built in this checkout.
"""
from .cases import CaseError, write_case
from .plots import plot_floes, plot_history, plot_resistance
from .programs import ProgramError, make_field, run, spherize
from .runs import Estimate, Run, RunWarning, open_run
from .scene import Scene
from .sweeps import open_sweep

__all__ = [
    "CaseError", "Estimate", "ProgramError", "Run", "RunWarning", "Scene", "make_field", "open_run",
    "open_sweep", "plot_floes", "plot_history", "plot_resistance", "run", "spherize", "write_case",
]
