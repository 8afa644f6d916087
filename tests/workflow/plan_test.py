# SPDX-License-Identifier: GPL-3.0-or-later
"""plan_test.py SOURCE BIN: sweep files and their plans; needs no Snakemake."""
import os
import sys
import tempfile
import tomllib

from sweep_case import BIN, SOURCE, SWEEP, make_case, read, write

sys.path.insert(0, f"{SOURCE}/workflow")
from plan_sweep import SweepError, plan_sweep, write_plan

FIELD = """[set]
"simulation.jitter" = 0.01
[axes]
"field.ice.thickness" = [0.5, 0.7]
"field.seed" = [1, 2]
"""


def plan(text, name="sweep.toml"):
    write(f"{folder}/{name}", text)
    return plan_sweep(f"{folder}/{name}", None, BIN)


def expect_fault(text, *parts):
    try:
        plan(text)
    except SweepError as error:
        for part in parts:
            assert part in str(error), (part, str(error))
        return
    raise AssertionError(f"no complaint about {text}")


with tempfile.TemporaryDirectory() as folder:
    make_case(folder)
    good = SWEEP.format(speeds="[0.5, '2 kn']", seeds=3)

    # every combination is a run; keys may be dotted or quoted; all runs share the case's inputs
    p = plan(good)
    assert p.axes == ["hull.speed", "simulation.seed"], p.axes
    assert len(p.runs) == 6
    run = p.runs["hull.speed=2_kn__simulation.seed=3"]
    assert "hull.speed=2 kn" in run.overrides and "simulation.seed=3" in run.overrides
    assert "simulation.jitter=0.01" in run.overrides
    assert [os.path.basename(path) for path in run.inputs] == ["hull.spheres.h5", "floe.spheres.h5"]
    assert [i.program for i in p.inputs] == ["spherize", "spherize"]
    assert p.inputs[0].options == ["--slice", "y=0", "-r", "0.1", "-s", "0.05", "--mode", "surface"]
    assert plan(good.replace("hull.speed", '"hull.speed"')).runs == p.runs

    # the seeds of level ice need no jitter: they change the sizes of its pieces
    sheet = f'case = "{SOURCE}/cases/level-ice-icebreaker/case.cfg"\n[axes]\nseeds = 2\n'
    assert len(plan(sheet).runs) == 2
    expect_fault(f"{sheet}[set]\nlevel_ice.scatter = 0\n", "level_ice.scatter is 0")

    # the plan that icepost reads is TOML and is not written twice
    assert not os.path.exists(f"{folder}/out")  # planning writes nothing
    write_plan(p)
    stored = tomllib.loads(read(f"{folder}/out/runs.toml"))
    assert stored["title"] == "Test <sweep>"
    assert stored["run"][5]["values"] == {"hull.speed": "2 kn", "simulation.seed": 3}
    before = os.stat(f"{folder}/out/runs.toml").st_mtime_ns
    write_plan(p)
    assert os.stat(f"{folder}/out/runs.toml").st_mtime_ns == before

    # tied keys follow their axis
    tied = good.replace("simulation.duration = 2.0\n", "")
    p = plan(tied + '[tied."hull.speed"]\n"simulation.duration" = [4.0, 3.0]\n')
    assert "simulation.duration=3.0" in p.runs["hull.speed=2_kn__simulation.seed=1"].overrides

    # meshes as an axis: made once each, with the options of the set they stand for
    p = plan(SWEEP.format(speeds="[0.5, 1.0]", seeds=1) +
             'hull.mesh = ["meshes/paper-hull-2d.obj", "meshes/paper-floe-2d.obj"]\n')
    assert len(p.runs) == 4 and len(p.inputs) == 3, p.inputs
    made = [i for i in p.inputs if i.output.startswith(f"{folder}/out/inputs/")]
    assert [m.options for m in made] == 2 * [p.inputs[0].options]
    assert f"hull.spheres={made[0].output}" in next(iter(p.runs.values())).overrides

    # fields as an axis: one per combination of their keys
    write(f"{folder}/case/field.toml", 'pattern = "grid"\n')
    write(f"{folder}/case/spheres.txt", read(f"{folder}/case/spheres.txt") +
          "field.toml -o field.h5\n")
    p = plan('case = "case/case.cfg"\n' + FIELD, "field.toml")
    fields = [i for i in p.inputs if i.program == "icefield"]
    assert len(fields) == 4 and fields[3].options[-3:] == ["ice.thickness=0.7", "--set", "seed=2"]
    assert p.out == os.path.abspath("results/field")

    # specifications as an axis: other keys and seeds change each
    write(f"{folder}/brick.toml", 'pattern = "brick"\n')
    p = plan('case = "case/case.cfg"\n' + FIELD.replace('"field.seed" = [1, 2]', (
        '"field.specification" = ["case/field.toml", "brick.toml"]\nseeds = 2\n'
        '[tied."simulation.seed"]\n"field.seed" = [7, 8]')), "kinds.toml")
    fields = [i for i in p.inputs if i.program == "icefield"]
    assert len(p.runs) == 8 and len(fields) == 8, fields
    assert fields[-1].source == f"{folder}/brick.toml" and "seed=8" in fields[-1].options
    assert fields[-1].output.endswith("8-brick.h5"), fields[-1].output
    assert "field.ice.thickness=0.7__field.specification=brick.toml__simulation.seed=2" in p.runs

    expect_fault(good + 'ax = 1\n', "no key of a case is called 'ax'")
    expect_fault("treads = 2\n" + good, "unknown key 'treads'", "did you mean 'threads'?")
    expect_fault("threads = 0\n" + good, "'threads' is wrong", "whole number")
    expect_fault(good.replace("hull.speed", "hull.sped"), "did you mean 'hull.speed'?")
    expect_fault(good.replace("[0.5, '2 kn']", "0.5"), "'hull.speed' is no list")
    expect_fault(good.replace("[0.5, '2 kn']", "[]"), "'hull.speed' is no list")
    expect_fault(good.replace("'2 kn'", "0.5"), "a value twice")
    expect_fault(good.replace("seeds = 3", "seeds = 'a'"), "'seeds' is wrong")
    expect_fault(good.replace("simulation.jitter = 0.01\n", ""), "simulation.jitter is 0")
    expect_fault(good.split("[axes]")[0], "'axes' is missing")
    expect_fault(good.split("[axes]")[0] + "[axes]\n", "'axes' is empty")
    expect_fault(good.replace('case = "case/case.cfg"\n', ""), "'case' is missing")
    expect_fault(good.replace("case.cfg", "none.cfg"), "none.cfg", "not readable")
    expect_fault(good + 'floes.mesh = ["none.obj"]\n', "no file", "none.obj")
    expect_fault(good + "simulation.duration = [1, 2]\n", "in [set] and in [axes]")
    expect_fault(good + "[tied.hull.speed]\nice.density = [900]\n", "no list of 2 values")
    expect_fault(good + "[tied.ice.density]\nhull.speed = [1, 2]\n", "belongs to no axis")
    # wrong values, all of them in one message, whichever table they are in
    expect_fault(good.replace("'2 kn'", "-999.0, '2 knn'").replace(
        "[set]", "[set]\nice.density = -1.0"), "3 values that no run can have",
        "ice.density = -1 is outside", "hull.speed = -999 is outside [-50, 50] m/s",
        '"2 knn" is not a number', "nothing was computed")
    expect_fault(sheet.replace("seeds = 2", '"level_ice.thickness" = [0.6, -0.6]\nseeds = 2'),
                 "1 value that", "level_ice.thickness = -0.6 is outside")
    assert not os.path.exists(f"{folder}/out/inputs/no hull yet")
    expect_fault("[axes", "is no TOML")
    try:
        plan_sweep(f"{folder}/sweep.toml", None, "/none")
    except SweepError as error:
        assert "is no TOML" in str(error) or "no program" in str(error)
    print("ok")
