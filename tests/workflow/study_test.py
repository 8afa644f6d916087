# SPDX-License-Identifier: GPL-3.0-or-later
"""study_test.py SOURCE BIN: sensitivity studies and their plans; needs no Snakemake."""
import os
import subprocess
import sys
import tempfile
import tomllib

from sweep_case import BIN, SOURCE, make_case, read, write

sys.path.insert(0, f"{SOURCE}/workflow")
from plan_sensitivity import plan_study
from plan_sweep import SweepError, write_plan

STUDY = """title = "Test"
case = "case/case.cfg"
out = "out"
seeds = 2
[set]
simulation.duration = 2.0
"""
FIELD_CASE = """[simulation]
duration = 1.0
time_step = 0.02
[hull]
spheres = "hull.spheres.h5"
speed = 0.5
[[floes]]
pattern = "file"
file = "field.h5"
[contact]
crushing_pressure = "0.2 MPa"
"""
BRICK = """pattern = "brick"
ice.thickness = 0.3
spheres.radius = "50 mm"
spheres.spacing = 0.1
floes.size = [1.0, 0.8]
floes.count = [14, 3]
floes.gap = ["20 mm", "20 mm"]
"""


def plan(text, name="study.toml"):
    write(f"{folder}/{name}", text)
    return plan_study(f"{folder}/{name}", None, BIN)


def expect_fault(text, *parts):
    try:
        plan(text)
    except SweepError as error:
        for part in parts:
            assert part in str(error), (part, str(error))
        return
    raise AssertionError(f"no complaint about {text}")


def tables(p):
    """runs.toml as icepost reads it."""
    return tomllib.loads(p.text())


def labels(p, name):
    return list(dict.fromkeys(run.label for run in p.runs.values() if run.input == name))


with tempfile.TemporaryDirectory() as folder:
    make_case(folder)

    # the case itself and each value, with each seed; one input differs from the case at a time
    p = plan(STUDY)
    base = p.runs["case__seed=1"]
    assert base.input == "" and base.label == ""
    assert "simulation.seed=1" in base.overrides and "simulation.jitter=0.001" in base.overrides
    for run in p.runs.values():
        others = [o for o in run.overrides if o not in base.overrides + ["simulation.seed=2"]]
        assert len(others) == bool(run.input), (run.name, others)
    assert len(p.runs) % 2 == 0 and "case__seed=2" in p.runs
    assert labels(p, "friction ship-ice") == ["0.05", "0.2"]
    # rigid ice has no factor: the range's values; the step has one; a gap keeps its zero
    assert labels(p, "crushing pressure") == ["0.2 MPa", "5 MPa"]
    assert labels(p, "time step") == ["0.0025", "0.01"]
    assert labels(p, "gap or saw cut") == ["0.01 x 0.0", "0.05 x 0.0"]
    # the case's own value is not computed twice
    assert labels(p, "release rule") == ["never", "until-contact"]
    # sphere sets from the same mesh, other options; each made once
    assert labels(p, "hull's spheres") == ["-r 0.07 -s 0.035", "-r 0.14 -s 0.07"]
    made = [i for i in p.inputs if i.output.startswith(f"{folder}/out/inputs/")]
    assert len(made) == 4 and made[0].options[:4] == ["--slice", "y=0", "-r", "0.07"], made
    stored = tables(p)
    bases = {entry["name"]: entry["base"] for entry in stored["input"]}
    assert bases["crushing pressure"] == "inf" and bases["hull's spheres"] == "-r 0.1 -s 0.05"
    assert all(entry["source"] for entry in stored["input"])
    # a slice has no breadth, and the page says so
    left_out = {entry["name"]: entry["why"] for entry in stored["left_out"]}
    assert set(left_out) == {"concentration", "breadth", "far end of the channel",
                             "bending factor", "flexural strength", "size of the pieces"}, left_out
    assert stored["run"][0]["input"] == "" and stored["run"][1]["label"] == "0.2 MPa"
    write_plan(p)
    assert tomllib.loads(read(f"{folder}/out/runs.toml")) == stored

    # seeds differ as the members of icesolve --seeds do; sets that no list makes are measured
    environment = {**os.environ, "SPHERIZE": f"{BIN}/spherize", "ICEFIELD": f"{BIN}/icefield"}
    subprocess.run([f"{SOURCE}/cases/prepare.sh", f"{folder}/case"], check=True, env=environment,
                   capture_output=True)
    subprocess.run([f"{BIN}/icesolve", f"{folder}/case/case.cfg", "--seeds", "1", "--no-report",
                    "-q", "--set", "simulation.duration=0.02", "--set", "output.average_from=0",
                    "--out", f"{folder}/members"], check=True, capture_output=True)
    resolved = tomllib.loads(read(f"{folder}/members/seed-1/case.resolved.cfg"))["simulation"]
    assert (resolved["seed"], resolved["jitter"]) == (1, 0.001), resolved
    recipes = read(f"{folder}/case/spheres.txt")
    write(f"{folder}/case/spheres.txt", "")
    assert "simulation.jitter=0.001" in plan(STUDY).runs["case__seed=1"].overrides
    write(f"{folder}/case/spheres.txt", recipes)

    # a case is a study with the default ranges
    os.chdir(folder)
    direct = plan_study("case/case.cfg", None, BIN)
    assert direct.out == os.path.realpath(f"{folder}/results/case-sensitivity"), direct.out
    assert len(direct.runs) == len(p.runs) // 2 * 3 and direct.title == "Paper 2D, 0.5 m/s"

    # [vary]: other values, further keys, none
    p = plan(STUDY + """[vary]
"contact.friction_ship_ice" = [0.3]
"contact.restitution" = [0.1, 0.5]
"ice.density" = []
""")
    assert labels(p, "friction ship-ice") == ["0.3"]
    assert labels(p, "contact.restitution") == ["0.1", "0.5"]
    assert not labels(p, "ice density")

    # a field: the cut and the breadth of its specification, made anew for each value
    write(f"{folder}/case/field.cfg", FIELD_CASE)
    write(f"{folder}/case/field.toml", BRICK)
    write(f"{folder}/case/spheres.txt", read(f"{folder}/case/spheres.txt") +
          "field.toml -o field.h5\n")
    field_study = STUDY.replace("case.cfg", "field.cfg")
    p = plan(field_study)
    assert labels(p, "gap or saw cut") == ["10 mm", "50 mm"]
    assert labels(p, "breadth") == ["14 x 4", "14 x 6"]
    assert labels(p, "ice's spheres") == ["35 mm, 0.07", "70 mm, 0.14"]
    assert labels(p, "crushing pressure") == ["0.05 MPa", "0.8 MPa"]
    cut = next(run for run in p.runs.values() if run.label == "50 mm")
    field = next(i for i in p.inputs if f"floes.file={i.output}" in cut.overrides)
    assert "floes.gap=[\"50 mm\", \"50 mm\"]" in field.options, field.options
    assert not [o for o in cut.overrides if "seed" in o and o != "simulation.seed=1"]
    assert "simulation.jitter=0.0005" in cut.overrides, cut.overrides

    # a channel: its far end is closed where nothing else is said, so it is opened
    write(f"{folder}/case/field.toml", BRICK + 'edges.breadth = "2 m"\n')
    assert labels(plan(field_study), "far end of the channel") == ["0 m"]
    write(f"{folder}/case/field.toml", BRICK + "edges.breadth = 2.0\nedges.ahead = 0.0\n")
    assert labels(plan(field_study), "far end of the channel") == ["2.0"]

    # ice that is not there to bend has nothing of level ice
    assert not labels(p, "bending factor") and not labels(p, "size of the pieces")

    # loose floes of a field are free by default, which the release rule is varied from
    assert labels(p, "release rule") == ["until-hull-contact", "until-contact"]

    # a random field is another one for each seed
    write(f"{folder}/case/field.toml", """pattern = "voronoi"
seed = 5
ice.thickness = 0.3
area.size = [20, 8]
floes.concentration = 0.8
floes.mean_size = 1.0
""")
    p = plan(field_study)
    assert labels(p, "concentration") == ["0.75", "0.85"]
    assert labels(p, "breadth") == ["20 x 10", "20 x 12"]
    fields = [i for i in p.inputs if i.program == "icefield"]
    assert [f.options[-1] for f in fields if len(f.options) == 2] == ["seed=1", "seed=2"], fields
    assert not [o for run in p.runs.values() for o in run.overrides if "jitter" in o]

    # each seed gives the pieces of level ice other sizes; no floes, so no rule that releases them
    p = plan(STUDY.replace("case/case.cfg", f"{SOURCE}/cases/level-ice-icebreaker/case.cfg"))
    assert not [o for run in p.runs.values() for o in run.overrides if "jitter" in o]
    assert labels(p, "bending factor") == ["0.75", "1.5"]
    assert labels(p, "flexural strength") == ["375 kPa", "625 kPa"]
    assert labels(p, "ice's spheres") == ["0.49 m", "0.98 m"]
    assert not labels(p, "release rule")
    # the spacing that a case leaves to the thickness is varied as that
    level = read(f"{SOURCE}/cases/level-ice-icebreaker/case.cfg")
    write(f"{folder}/case/level.cfg",
          level.replace('spacing = "0.7 m"\n', "").replace('thickness = "1 m"', "thickness = 0.5"))
    p = plan(STUDY.replace("case/case.cfg", "case/level.cfg"))
    assert labels(p, "ice's spheres") == ["0.245", "0.49"], labels(p, "ice's spheres")

    expect_fault(STUDY.replace("title", "titel"), "unknown key 'titel'")
    expect_fault(STUDY.replace("case.cfg", "none.cfg"), "not readable")
    expect_fault(STUDY + '[vary]\n"contact.restitutoin" = [0.1]\n', "did you mean")
    expect_fault(STUDY + '[vary]\n"contact.restitution" = 0.1\n', "no list of values")
    expect_fault(STUDY.replace("seeds = 2", "seeds = 0"), "'seeds' is wrong")
    write(f"{folder}/ranges.toml", '[[range]]\nkeys = ["floes.gap"]\nfactor = [2.0]\n')
    expect_fault('ranges = "ranges.toml"\n' + STUDY, "unknown key 'factor'")
    write(f"{folder}/ranges.toml", '[[range]]\nkeys = ["floes.gpa"]\nfactors = [2.0]\n')
    expect_fault('ranges = "ranges.toml"\n' + STUDY, "did you mean 'floes.gap'?")
    ours = f'ranges = "{SOURCE}/workflow/sensitivity/ranges.toml"\n' + STUDY
    assert list(plan(ours).runs) == list(plan(STUDY).runs)  # every key of ours exists
    write(f"{folder}/ranges.toml", '[[range]]\nkeys = ["field.floes.gap"]\nfactors = [2.0]\n')
    expect_fault('ranges = "ranges.toml"\n' + STUDY, "nothing to vary")
    print("ok", len(direct.runs), "runs of a case")
