# SPDX-License-Identifier: GPL-3.0-or-later
"""yade -n -x yade_fill.py HULL.gts RADIUS: times YADE's hexagonal fill of a closed surface.

Prints one line, "spheres N seconds S cpu C"; the times include YADE's search tree, not the reading.
"""
import sys
import time

import gts
from yade import pack

with open(sys.argv[1], encoding="utf-8") as file:
    surface = gts.read(file)
start, start_cpu = time.perf_counter(), time.process_time()
spheres = pack.regularHexa(pack.inGtsSurface(surface), radius=float(sys.argv[2]), gap=0)
print("spheres", len(spheres), "seconds", time.perf_counter() - start,
      "cpu", time.process_time() - start_cpu, flush=True)
