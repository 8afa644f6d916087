# SPDX-License-Identifier: GPL-3.0-or-later
"""load_liggghts.py SPHERIZE: LIGGGHTS inserts one particle of the exported template."""
import os

import tetrahedron
from tetrahedron import DENSITY, EDGES, MASS, check, inertia

# the particle is inserted upright somewhere in the box; dumps give what LIGGGHTS computes with
SCRIPT = """units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -9 9 -9 9 -9 9 units box
create_box 1 box
neighbor 0.1 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.3
fix m4 all property/global coefficientFriction peratomtypepair 1 0.1
pair_style gran model hertz tangential history
pair_coeff * *
timestep 1e-6
include tetra.liggghts.in
fix kinds all particledistribution/discrete 32452843 1 tetra 1.0
region middle sphere 0 0 0 5 units box
fix insert all insert/pack seed 32452867 distributiontemplate kinds insert_every once &
    orientation constant 1 0 0 0 particles_in_region 1 region middle
fix rigid all multisphere
run 1
"""
BODY = {"masstotal": 0, "xcm": 3, "inertia": 3, "ex_space": 3, "ey_space": 3, "ez_space": 3}
for name in BODY:
    SCRIPT += f"compute {name} all multisphere property {name}\n"
COLUMNS = [f"c_{name}[{k + 1}]" if size else f"c_{name}"
           for name, size in BODY.items() for k in range(max(size, 1))]
SCRIPT += f"""dump body all local 1 body.txt {' '.join(COLUMNS)}
dump_modify body format "{' '.join(['%.17g'] * len(COLUMNS))}"
dump atoms all custom 1 atoms.txt id x y z radius density
dump_modify atoms format "%d %.17g %.17g %.17g %.17g %.17g"
run 0
"""


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [[float(word) for word in line.split()] for line in file if line[0] in "-0123456789"]


def dump_rows(path):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    lines = text[text.rindex("ITEM: "):].splitlines()[1:]
    return [[float(word) for word in line.split()] for line in lines]


tetrahedron.skip_without("liggghts")
with tetrahedron.workshop() as folder:
    tetrahedron.export(folder, "liggghts")
    with open(os.path.join(folder, "in.tetra"), "w", encoding="utf-8") as script:
        script.write(SCRIPT)
    tetrahedron.run(["liggghts", "-in", "in.tetra"], folder)

    [body] = dump_rows(os.path.join(folder, "body.txt"))
    check("mass", body[0], MASS, 1e-12)

    # R diag(moments) R^T, the axes being the columns of R
    position, moments = body[1:4], body[4:7]
    axes = [body[7:10], body[10:13], body[13:16]]
    tensor = [sum(moments[k] * axes[k][i] * axes[k][j] for k in range(3))
              for i in range(3) for j in range(3)]
    check("inertia", tensor, [v for row in inertia() for v in row], 1e-12)

    # every sphere where the file has it, relative to the centre of mass
    atoms = sorted(dump_rows(os.path.join(folder, "atoms.txt")))
    expected = rows(os.path.join(folder, "tetra.liggghts.txt"))
    assert len(atoms) == len(expected) > 100
    got = sorted(tuple(round(atom[1 + d] - position[d], 9) for d in range(3)) + (atom[4],)
                 for atom in atoms)
    want = sorted(tuple(round(v, 9) for v in row[:3]) + (row[3],) for row in expected)
    check("spheres", [v for row in got for v in row], [v for row in want for v in row], 1e-8)
    assert all(atom[5] == DENSITY for atom in atoms)

    # and there the solid lies a quarter of the edges from its corner, so no sphere is outside
    for row in expected:
        assert all(v - row[3] > -edge / 4 - 1e-9 for v, edge in zip(row[:3], EDGES))
