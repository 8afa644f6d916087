# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs as xarray datasets."""
from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np
import xarray


@dataclass(frozen=True)
class Estimate:
    """A mean with the half width of its 95 % interval, both in `unit`; nan: the half width is not
    known."""

    mean: float
    ci95: float
    unit: str = "N"

    def __str__(self) -> str:
        return f"{self.mean:.6g} +- {self.ci95:.2g} {self.unit}"


class RunWarning(str):
    """The text of a warning, and its verdict on the mean resistance.

    `affects_mean`: True or False; None: nothing was measured. `share`: of the mean, at most about
    so much [-]; None: not measured.
    """

    affects_mean: bool | None
    share: float | None

    def __new__(cls, text: str, affects_mean: bool | None = None, share: float | None = None):
        warning = super().__new__(cls, text)
        warning.affects_mean = affects_mean
        warning.share = share
        return warning


def read_warnings(summary: dict) -> list[RunWarning]:
    """The warnings of a summary.json; those of older programs are texts without a verdict."""
    return [RunWarning(w["text"], w.get("affects_mean"), w.get("share")) if isinstance(w, dict)
            else RunWarning(w) for w in summary["warnings"]]


def affected_percent(warnings: list[RunWarning]) -> float:
    """The largest share of the mean that warnings affect [%], 100 at most; 0: none affects it.

    nan: a warning affects it, or may do so, and no share of any was measured. The same number is
    the column `affected_%` of `icepost table`.
    """
    affecting = [w for w in warnings if w.affects_mean is not False]
    shares = [min(w.share, 1.0) for w in affecting if w.affects_mean and w.share is not None]
    if shares:
        return 100.0 * max(shares)
    return float("nan") if affecting else 0.0


class Run:
    """A run folder. Datasets are read at their first use.

    `summary` is summary.json as a dictionary, `ensemble` the one of all members, or None.
    """

    def __init__(self, folder: str | Path, ensemble: dict | None = None):
        self.folder = Path(folder)
        self.ensemble = ensemble
        self.summary: dict = _json(self.folder / "summary.json")
        file = self.folder / "run.h5"
        self.file = file if file.exists() else self.folder / "run.h5.part"  # of a killed run

    def __repr__(self) -> str:
        return f"<icesolve run {self.folder}: resistance {self.resistance}>"

    @property
    def unit(self) -> str:
        """Of forces: N, in 2D N/m."""
        return "N/m" if self.summary["dimension"] == 2 else "N"

    @property
    def warnings(self) -> list[RunWarning]:
        """The run's warnings: texts with `affects_mean` and `share`."""
        return read_warnings(self.summary)

    @property
    def resistance(self) -> Estimate:
        """Mean resistance [N, in 2D N/m], positive where the ice slows the ship.

        Of an ensemble Student's interval over its members, else that of the force's
        autocorrelation: the numbers of summary.json.
        """
        if self.ensemble:
            return Estimate(self.ensemble["mean_N"], _number(self.ensemble["ci95_N"]), self.unit)
        part = self.summary["resistance"]
        return Estimate(part["mean_N"], _number(part["ci95_N"]), self.unit)

    @cached_property
    def history(self) -> xarray.Dataset:
        """Of the ship against `time` [s]: `force`, `contact_force`, `friction_force` [N] and
        `moment` [N m] on it (time, xyz), `pose` (time, 7): position [m] and quaternion, counts of
        `contacts` and `moving_floes`, `max_overlap` [m], `kinetic_energy` [J] (time). In 2D
        forces, moments and energies are per metre of breadth."""
        return self._group("ship")

    @cached_property
    def regions(self) -> xarray.Dataset:
        """`contact_force`, `friction_force` [N; 2D: N/m] (time, hull_regions, xyz)."""
        return self._group("regions")

    @cached_property
    def frames(self) -> xarray.Dataset:
        """Of each floe against `frame_time` [s]: `position` [m], `orientation` (w, x, y, z),
        `velocity` [m/s], `angular_velocity` [rad/s], `contact_force` [N; 2D: N/m], `state` (0
        held, 1 moving, 2 behind the hull); (frame_time, body, ...)."""
        return self._group("frames")

    @cached_property
    def contacts(self) -> xarray.Dataset:
        """Touches of hull and floes, one row each: `contact_time` [s], `floe`, from 1, `point`
        (3,) [m], ship axes, `normal_force`, `friction_force` (3,) [N; 2D: N/m]."""
        return self._group("contacts")

    @property
    def averaged(self) -> xarray.Dataset:
        """The part of `history` that the means of summary.json are taken of."""
        late = self.history.time.values >= self.summary["average_from_s"] - 1e-9
        return self.history.isel(time=late)

    def mean(self, name: str = "force", axis: str = "x") -> float:
        """Mean of a force of `averaged` [N; 2D: N/m], in world axes: the bits of summary.json where
        each row is a step, because the sum goes in the same order. The resistance is -mean(). nan
        without a row."""
        series = self.averaged[name].sel(xyz=axis).values
        return float(np.cumsum(series)[-1] / len(series)) if len(series) else float("nan")

    def outline(self, floe: int) -> np.ndarray:
        """Vertices of a floe's mesh in its own axes (V, 3) [m]. @param floe  its row, from 0"""
        with h5py.File(self.file) as file:
            shape = int(file["frames/body_shape"][floe])
            first, last = file["shapes/vertex_offset"][shape:shape + 2]
            return file["shapes/vertices"][first:last].astype(float)

    def _group(self, name: str) -> xarray.Dataset:
        data = xarray.open_dataset(self.file, group=name, engine="h5netcdf")
        with h5py.File(self.file) as file:  # labels of dimensions lie above the groups
            labels = {d: _label(d, file[d]) for d in data.dims
                      if d in file and d not in data.coords}
        data = data.assign_coords(labels)
        data.attrs.update(title=self.summary["title"], source=f"icesolve {self.summary['version']}",
                          history=self.summary["command_line"], Conventions="CF-1.8")
        return data


def open_run(folder: str | Path) -> Run:
    """Opens a run folder; of an ensemble its first member, with `ensemble` set.

    @raises FileNotFoundError where the folder has no summary.json
    """
    folder = Path(folder)
    if not (folder / "summary.json").exists():
        raise FileNotFoundError(f"{folder} has no summary.json: it is no run folder, "
                                "or the run has not ended")
    ensemble = _json(folder / "summary.json").get("ensemble")
    if not ensemble:
        return Run(folder)
    return Run(folder / f"seed-{ensemble['seeds'][0]}", ensemble)


def _json(path: Path) -> dict:
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def _label(name: str, stored: h5py.Dataset) -> xarray.Variable:
    known = [k for k in ("units", "long_name", "meaning") if k in stored.attrs]
    words = {k: _text(stored.attrs[k]) for k in known}
    return xarray.Variable(name, [_text(v) for v in stored[()]], words)


def _text(value):
    return value.decode() if isinstance(value, bytes) else value
