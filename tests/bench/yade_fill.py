# SPDX-License-Identifier: GPL-3.0-or-later
"""yade -n -x yade_fill.py HULL.gts RADIUS: times YADE's hexagonal fill of a closed surface.

Prints one line, "spheres N seconds S"; the time includes YADE's search tree, not the reading.
"""
import sys
import time

import gts
from yade import pack

with open(sys.argv[1], encoding="utf-8") as file:
    surface = gts.read(file)
start = time.perf_counter()
spheres = pack.regularHexa(pack.inGtsSurface(surface), radius=float(sys.argv[2]), gap=0)
print("spheres", len(spheres), "seconds", time.perf_counter() - start, flush=True)
