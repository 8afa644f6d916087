# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts with matplotlib: each returns its axes, and writes a file where one is named."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from .runs import Run


def plot_resistance(sweep: xarray.Dataset, file: str | Path | None = None) -> Axes:
    """Resistance against speed with 95 % intervals, and Lindqvist's submersion part where known.

    @param sweep  of open_sweep(), at least one run
    @param file  also written; the ending chooses its kind, such as .png or .pdf
    """
    axes = _axes("speed [m/s]", f"resistance [{sweep.resistance.units}]")
    axes.errorbar(sweep.speed, sweep.resistance, yerr=sweep.ci95, fmt="o-", capsize=3,
                  label="icesolve, 95 % interval")
    if np.isfinite(sweep.lindqvist).any():
        axes.plot(sweep.speed, sweep.lindqvist, "--", label="Lindqvist 1989, submersion")
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend()
    return _saved(axes, file)


def plot_history(run: Run, file: str | Path | None = None, window: float | None = None) -> Axes:
    """Resistance against time, its mean over `window` [s] (a twentieth of the run unless given)
    and the mean with its interval, from where the averages begin.

    The window is cut to whole rows, one at least. @pre at least two rows of history
    """
    time = run.history.time.values
    force = -run.history.force.sel(xyz="x").values
    axes = _axes("time [s]", f"resistance [{run.unit}]")
    axes.plot(time, force, lw=0.4, color="0.7", label="each row")
    rows = max(1, round((window or (time[-1] - time[0]) / 20.0) / (time[1] - time[0])))
    smooth = np.convolve(force, np.full(rows, 1.0 / rows), mode="valid")
    axes.plot(time[rows - 1:] - 0.5 * (time[rows - 1] - time[0]), smooth,
              label=f"mean over {rows * (time[1] - time[0]):.3g} s")
    part = run.summary["resistance"]
    start = run.summary["average_from_s"]
    axes.hlines(part["mean_N"], start, time[-1], color="k", label="mean, 95 % interval")
    if part["ci95_N"] is not None:
        axes.fill_between([start, time[-1]], part["mean_N"] - part["ci95_N"],
                          part["mean_N"] + part["ci95_N"], color="k", alpha=0.15, lw=0)
    axes.set_ylim(bottom=min(0.0, smooth.min()), top=1.3 * max(smooth.max(), part["mean_N"]))
    axes.legend()
    return _saved(axes, file)


def plot_floes(run: Run, time: float, file: str | Path | None = None) -> Axes:
    """The floes from above at the frame nearest to a time [s], as the convex outlines of their
    meshes, coloured by their centre's depth [m]. @pre a run in 3D with frames"""
    frame = run.frames.sel(frame_time=time, method="nearest")
    axes = _axes("x [m]", "y [m]")
    outlines, depth = [], []
    for floe in range(frame.sizes["body"]):
        at = frame.position.values[floe]
        turn = Rotation.from_quat(np.roll(frame.orientation.values[floe], -1))  # x, y, z, w
        points = (turn.apply(run.outline(floe)) + at)[:, :2]
        outlines.append(points[ConvexHull(points).vertices])
        depth.append(-at[2])
    shapes = PolyCollection(outlines, array=np.array(depth), cmap="viridis", edgecolor="k", lw=0.3)
    axes.add_collection(shapes)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.figure.colorbar(shapes, ax=axes, location="bottom", label="depth of the centre [m]")
    axes.set_title(f"t = {float(frame.frame_time):.4g} s")
    return _saved(axes, file)


def _axes(x: str, y: str) -> Axes:
    # no pyplot: it would choose a window, and keep every figure
    axes = Figure(figsize=(7.0, 4.5), layout="constrained").add_subplot()
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return axes


def _saved(axes: Axes, file: str | Path | None) -> Axes:
    if file:
        axes.figure.savefig(file, dpi=150)
    return axes
