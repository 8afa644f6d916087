# SPDX-License-Identifier: GPL-3.0-or-later
"""load_yade.py SPHERIZE: YADE runs the exported script, and loads a second body by it."""
import json
import os

import tetrahedron
from tetrahedron import CENTROID, MASS, check, inertia

# run inside YADE; one line of JSON for each body
LOOK = """
import json, runpy
load = runpy.run_path("tetra.yade.py")["load"]
clumps = [load(), load(position=(10, 0, 0), orientation=(0, 1, 0, 0))]
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), NewtonIntegrator()]
O.dt = 1e-9
O.step()
for clump, members in clumps:
    state = O.bodies[clump].state
    turn = state.ori.toRotationMatrix()
    spheres = [(list(O.bodies[k].state.pos), O.bodies[k].shape.radius, O.bodies[k].state.mass)
               for k in members if isinstance(O.bodies[k].shape, Sphere)]
    print("BODY", json.dumps({"mass": state.mass, "pos": list(state.pos),
                              "moments": list(state.inertia),
                              "axes": [[turn[i, k] for i in range(3)] for k in range(3)],
                              "spheres": spheres, "members": len(members)}))
print("BODIES", len(O.bodies))
"""

tetrahedron.skip_without("yade")
with tetrahedron.workshop() as folder:
    tetrahedron.export(folder, "yade", "csv")
    with open(os.path.join(folder, "look.py"), "w", encoding="utf-8") as script:
        script.write(LOOK)
    output = tetrahedron.run(["yade", "-n", "-x", "look.py"], folder, "BODIES")
    here, there = [json.loads(line[5:]) for line in output.splitlines()
                   if line.startswith("BODY ")]

    check("mass", here["mass"], MASS, 1e-12)
    check("centre of mass", here["pos"], CENTROID, 1e-12)
    axes, moments = here["axes"], here["moments"]
    tensor = [sum(moments[k] * axes[k][i] * axes[k][j] for k in range(3))
              for i in range(3) for j in range(3)]
    check("inertia", tensor, [v for row in inertia() for v in row], 1e-12)

    # the spheres of the first body are those of the csv, in the mesh's frame
    with open(os.path.join(folder, "tetra.csv"), encoding="utf-8") as file:
        wanted = [[float(word) for word in line.split(",")[:4]] for line in file.readlines()[1:]]
    assert len(wanted) > 100 and here["members"] == len(wanted) + 1
    check("spheres", [v for pos, radius, _ in here["spheres"] for v in pos + [radius]],
          [v for row in wanted for v in row], 1e-12)

    # the second one has the same shape about another centre, turned by 180 degrees about x
    check("second mass", there["mass"], MASS, 1e-12)
    check("second place", there["pos"], [10.0, 0.0, 0.0], 1e-12)
    check("second moments", there["moments"], moments, 1e-12)
    local = [[sum(axes[k][i] * (pos[i] - here["pos"][i]) for i in range(3)) for k in range(3)]
             for pos, _, _ in here["spheres"]]
    check("second spheres", [v for pos, _, _ in there["spheres"] for v in pos],
          [v for x, y, z in local for v in (10 + x, -y, -z)], 1e-12)

    # as a script of its own it makes the body and nothing else
    with open(os.path.join(folder, "count.py"), "w", encoding="utf-8") as script:
        script.write("exec(open('tetra.yade.py').read())\nprint('BODIES', len(O.bodies))\n")
    output = tetrahedron.run(["yade", "-n", "-x", "count.py"], folder, "BODIES")
    assert f"BODIES {len(wanted) + 2}" in output  # spheres, carrier of the mass, clump
