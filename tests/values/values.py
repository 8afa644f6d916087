# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares numbers of the programs with values made apart from them, and remembers which."""
import numpy as np


class Values:
    """What was compared, and what was wrong.

    A format is a kind of file, such as "summary.json"; a name is as in names.py."""

    def __init__(self):
        self.seen = {}
        self.faults = []

    def equal(self, form, name, got, want):
        """A text, a count or another exact value."""
        self._record(form, name)
        same = np.array_equal(got, want) if isinstance(want, np.ndarray) else got == want
        if not same:
            self.faults.append(f"{form}: {name} is {got}, should be {want}")

    def close(self, form, name, got, want, rel=1e-9, margin=0.0):
        """Numbers or arrays: within `margin`, or `rel` of the largest value, of `want`."""
        self._record(form, name)
        try:
            got, want = np.asarray(got, float), np.asarray(want, float)
            if got.shape != want.shape:
                raise ValueError(f"shape {got.shape} instead of {want.shape}")
            allowed = max(margin, rel * float(np.max(np.abs(want), initial=0.0)))
            off = float(np.max(np.abs(got - want), initial=0.0))
            if not off <= allowed:  # NaN, too
                raise ValueError(f"{got.ravel()[:6]}, should be {want.ravel()[:6]}: off by "
                                 f"{off:.3g}, allowed are {allowed:.3g}")
        except (TypeError, ValueError) as fault:
            self.faults.append(f"{form}: {name}: {fault}")

    def within(self, form, name, got, low, high):
        """A number of which only bounds are known."""
        self._record(form, name)
        if not np.all((np.asarray(got) >= low) & (np.asarray(got) <= high)):
            self.faults.append(f"{form}: {name} is {got}, should be {low} to {high}")

    def _record(self, form, name):
        self.seen.setdefault(form, set()).add(name)
