# SPDX-License-Identifier: GPL-3.0-or-later
"""A case stepped from Python: its bodies as arrays, loads of one's own."""
from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from .cases import CaseError
from .programs import setting_words

_BUILT = Path(__file__).resolve().parents[2] / "build" / "release" / "python"


class Scene:
    """A case made ready to be stepped.

        scene = icesolve.Scene("first.cfg", {"hull.speed": 0.8})
        scene.step(100)
        print(scene.time, scene.force, scene.position[3])

    Arrays have one row per body, row 0 the ship, row k floe k. They are views of the solver's own
    memory: always of the present, never copied; take `.copy()` of values to be kept. In 2D y, and
    rotations about x and z, are zero, and forces and moments are per metre of breadth.

    | array | shape | content |
    |---|---|---|
    | `position` | (N, 3) | centre of mass, of the ship the mesh's origin [m] |
    | `orientation_xyzw` | (N, 4) | unit quaternion, body to world, ordered as scipy's Rotation |
    | `velocity`, `angular_velocity` | (N, 3) | [m/s], [rad/s], world axes |
    | `mass` | (N,) | [kg], in 2D [kg/m]; 0 for the ship |
    | `held` | (N,) | 1: part of the unbroken ice until it is released; 2: bent, is released next |
    | `applied_force`, `applied_moment` | (N, 3) | to write: [N], [N m] about the centre of mass |

    @param case      a case file
    @param settings  keys of it to override
    @param threads   of the solver, 0 for all; one is fastest below some 500 floes
    @raises CaseError where icesolve would refuse the case
    """

    def __init__(self, case: str | Path, settings: Mapping[str, object] | None = None,
                 threads: int = 1):
        try:
            self._world = _module().World(str(case), setting_words(settings or {}), threads)
        except ValueError as error:
            raise CaseError(str(error)) from None
        for name in ("position", "orientation_xyzw", "velocity", "angular_velocity", "mass", "held",
                     "applied_force", "applied_moment"):
            setattr(self, name, getattr(self._world, name))

    def step(self, count: int = 1, loads: Callable[[Scene], None] | None = None) -> None:
        """Goes `count` steps of `time_step`; 0 or less goes none.

        @param loads  called before each step with the scene; the values that it leaves in
            `applied_force` and `applied_moment` act through the step. Nothing resets them: they act
            in later steps, too, as do values written there without it. Loads on the ship and on
            held floes have no effect.
        @raises ValueError where a load is not a finite number, or in 2D not of the plane
        """
        for _ in range(count):
            if loads:
                loads(self)
            self._check_loads()
            self._world.step()

    @property
    def time(self) -> float:
        """Simulated time [s]; 0 before the first step."""
        return self._world.time

    @property
    def steps(self) -> int:
        """Steps done since the start, a count."""
        return self._world.steps

    @property
    def time_step(self) -> float:
        """Of the case [s], constant."""
        return self._world.time_step

    @property
    def duration(self) -> float:
        """Of the case [s]; the scene can go on beyond it."""
        return self._world.duration

    @property
    def force(self) -> np.ndarray:
        """Of the ice on the ship in the last step (3,) [N; 2D: N/m], world axes: the sum of
        `contact_force` and `friction_force`. The resistance is -force[0]. Zero before the first
        step."""
        return self.contact_force + self.friction_force

    @property
    def contact_force(self) -> np.ndarray:
        """The normal parts of `force` (3,) [N; 2D: N/m]."""
        return self._world.forces()["contact"]

    @property
    def friction_force(self) -> np.ndarray:
        """The tangential parts of `force` (3,) [N; 2D: N/m]."""
        return self._world.forces()["friction"]

    @property
    def moment(self) -> np.ndarray:
        """Of the ice on the ship about its mesh's origin (3,) [N m; 2D: N], world axes."""
        return self._world.forces()["moment"]

    @property
    def contacts(self) -> np.ndarray:
        """Contacts of the last step, a structured array (C,), a copy; C = 0 without any: bodies
        `a` < `b`, `point` (3,) [m], `normal` (3,) from a to b, a unit vector, `gap` [m] at the
        step's start, < 0 in an overlap, `normal_impulse` and `friction_impulse` (3,) on b [N s;
        2D: N s/m]."""
        return self._world.contacts()

    @property
    def energy(self) -> dict[str, float]:
        """Work of the ship and of the applied loads since the start, and the residual of the
        energy ledger [J; 2D: J/m]."""
        return {"ship_work": self._world.ship_work, "applied_work": self._world.applied_work,
                "residual": self._world.energy_residual()}

    def _check_loads(self) -> None:
        force, moment = self.applied_force, self.applied_moment
        if not (np.isfinite(force).all() and np.isfinite(moment).all()):
            row = int(np.argmin(np.isfinite(force).all(axis=1) & np.isfinite(moment).all(axis=1)))
            raise ValueError(f"the load applied to body {row} is not a finite number")
        if self._world.dimension == 2 and (force[:, 1].any() or moment[:, (0, 2)].any()):
            raise ValueError("in 2D a load has no force along y and no moment about x or z")


def _module():
    """The compiled part: beside this file where it is installed, else in this checkout's build."""
    name = "icesolve._world"
    if name in sys.modules:
        return sys.modules[name]
    # waiting threads that spin are several times slower where the cores are not free
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    for folder in (Path(__file__).parent, Path(os.environ.get("ICESOLVE_MODULE", _BUILT))):
        for file in sorted(folder.glob("_world.*.so")):
            spec = importlib.util.spec_from_file_location(name, file)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            sys.modules[name] = module
            return module
    raise ImportError("icesolve.Scene needs the compiled module _world: "
                      "./bootstrap.sh python builds it")
