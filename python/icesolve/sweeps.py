# SPDX-License-Identifier: GPL-3.0-or-later
"""Many runs as one dataset."""
from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import xarray

from .runs import affected_percent, open_run, read_warnings


def open_sweep(folder: str | Path) -> xarray.Dataset:
    """All runs and ensembles below a folder, ordered by speed.

    Along `run` (names of the folders): `resistance` and `ci95` [N, in 2D N/m], `speed` [m/s],
    `thickness` [m], `lindqvist` [N], `status` and `affected` [%], the largest share of the mean
    that a warning affects (0: none does), each (run,); unknown numbers are nan. Members of an
    ensemble are no runs of their own; its warnings are those of all members.
    @raises FileNotFoundError where there is no run; ValueError for runs in 2D and in 3D
    """
    rows = []
    for found in _folders(Path(folder)):
        run = open_run(found)
        estimate, summary = run.resistance, run.summary
        rows.append((summary["ship"]["speed_mean"], str(found.relative_to(folder)), estimate.mean,
                     estimate.ci95, summary["ice"]["thickness_m"],
                     summary["lindqvist_submersion_N"], summary["status"], _affected(found),
                     run.unit))
    if not rows:
        raise FileNotFoundError(f"no run in {folder}: a run folder has a summary.json")
    units = {row[-1] for row in rows}
    if len(units) > 1:
        raise ValueError(f"{folder} has runs in 2D and in 3D: open them one by one")
    rows.sort(key=lambda row: row[:2])
    speed, name, mean, ci95, thickness, formula, status, affected, _ = zip(*rows)
    unit = units.pop()
    data = xarray.Dataset(
        {"resistance": ("run", np.array(mean)), "ci95": ("run", np.array(ci95)),
         "thickness": ("run", np.array(thickness, dtype=float)),
         "lindqvist": ("run", np.array(formula, dtype=float)), "status": ("run", list(status)),
         "affected": ("run", np.array(affected))},
        coords={"run": list(name), "speed": ("run", np.array(speed))})
    for key, text, of in (("resistance", "mean resistance", unit),
                          ("ci95", "half width of its 95 % interval", unit),
                          ("thickness", "ice thickness", "m"),
                          ("lindqvist", "Lindqvist's submersion resistance", "N"),
                          ("affected", "largest share of the mean that a warning affects", "%"),
                          ("speed", "mean speed of the ship", "m/s")):
        data[key].attrs.update(long_name=text, units=of)
    return data


def _affected(folder: Path) -> float:
    # the folder's own summary: of an ensemble it has the warnings of all members
    with open(folder / "summary.json", encoding="utf-8") as file:
        return affected_percent(read_warnings(json.load(file)))


def _folders(root: Path) -> list[Path]:
    """Folders with a summary.json, none below another one."""
    found = []
    for path, folders, files in os.walk(root):
        if "summary.json" in files:
            found.append(Path(path))
            folders.clear()
        folders.sort()
    return found
