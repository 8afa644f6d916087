# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV files as arrays by the name of their column."""
import numpy as np


def read_csv(path):
    with open(path, encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        rows = np.loadtxt(file, delimiter=",", ndmin=2)
    return dict(zip(names, rows.T, strict=True))
