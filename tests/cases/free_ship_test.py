#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""free_ship_test.py PROGRAMS [FOLDER]: the same ice, with and without a prescribed course.

A flared wedge of 6 m goes through rows of floes that are released as it touches them. Held at a
speed by its thrust, the free ship's mean resistance is within the interval of the
ship on a prescribed course. The speed to which a net thrust brings it is the one at which that
thrust meets the resistance on a prescribed course, within both intervals, as `icepost hv` finds
them. FOLDER keeps the runs."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
WAY, AVERAGED_FROM = 30.0, 10.0  # [m]: the bow is in the ice, five ship's lengths in all
SPEED, SPEEDS = 1.0, (0.6, 1.0, 1.4)
OPEN_WATER = 2.0  # [m/s]

# outlines of deck and bottom, bow ahead
DECK = ((-3, -1), (1, -1), (3, 0), (1, 1), (-3, 1))
BOTTOM = ((-3, -0.8), (0.4, -0.8), (1.6, 0), (0.4, 0.8), (-3, 0.8))

CASE = """[simulation]
duration = 30.0
time_step = 0.02
[hull]
spheres = "hull.h5"
position = [-3.5, 0]
draught = 0.5
speed = 1.0
[flow]
model = "none"
[[floes]]
spheres = "floe.h5"
count = [38, 5]
gap = [0.04, 0.04]
hold = "until-hull-contact"
[contact]
crushing_pressure = "1 MPa"
"""


def write_prism(path, low, high, z):
    """A solid between two outlines of as many corners, one above the other."""
    n = len(low)
    corners = [(*p, z[0]) for p in low] + [(*p, z[1]) for p in high]
    faces = [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n))]
    faces += [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    triangles = [(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)]
    path.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) +
                    "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles),
                    encoding="utf-8")


def run(folder, *words):
    done = subprocess.run([str(w) for w in words], cwd=folder, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, f"{words}: {done.stderr}"


def solve(folder, name, speed, *settings):
    sets = [f"hull.speed={speed}", f"simulation.duration={WAY / speed}",
            f"output.average_from={AVERAGED_FROM / speed}", *settings]
    words = [word for s in sets for word in ("--set", s)]
    run(folder, PROGRAMS / "icesolve", "case.cfg", "--out", name, "-q", "--no-report", "--verify",
        *words)
    return json.loads((folder / name / "summary.json").read_text(encoding="utf-8"))


def speeds_of(folder):
    """Speed with its interval by both ways, as icepost hv finds them."""
    run(folder, PROGRAMS / "icepost", "hv", "runs", "--thrust", "thrust.toml", "-o", "hv.html",
        "--csv", "hv.csv")
    found = {}
    for row in csv.DictReader((folder / "hv.csv").open(encoding="utf-8", newline="")):
        if row["source"] in ("prescribed course", "free ship"):
            found[row["source"]] = [float(row[k]) for k in ("speed", "speed_low", "speed_high")]
            print(f"{row['source']}: {row['speed']} m/s, {row['speed_low']} to {row['speed_high']}")
    return found


def check(folder):
    write_prism(folder / "hull.obj", BOTTOM, DECK, (-0.5, 0.4))
    a, b = 0.36, 0.3
    floe = ((-a, -b), (a, -b), (a, b), (-a, b))
    write_prism(folder / "floe.obj", floe, floe, (-0.1, 0.1))
    run(folder, PROGRAMS / "spherize", "hull.obj", "-r", "0.2", "-o", "hull.h5")
    run(folder, PROGRAMS / "spherize", "floe.obj", "-r", "0.1", "-o", "floe.h5")
    (folder / "case.cfg").write_text(CASE, encoding="utf-8")
    surge = "ship.free=['surge']"
    prescribed = {u: solve(folder, f"runs/prescribed-{u}", u) for u in SPEEDS}
    held = solve(folder, "held", SPEED, surge, f"propulsion.hold_speed={SPEED}")

    on_course, steered = prescribed[SPEED]["resistance"], held["resistance"]
    print(f"{SPEED} m/s: prescribed {on_course['mean_N']:.1f} +- {on_course['ci95_N']:.1f} N, held "
          f"{steered['mean_N']:.1f} +- {steered['ci95_N']:.1f} N")
    assert abs(steered["mean_N"] - on_course["mean_N"]) <= on_course["ci95_N"]
    assert on_course["ci95_N"] < 0.1 * on_course["mean_N"]
    # what the thrust gives, the ice takes
    assert abs(held["ship"]["speed_mean"] - SPEED) < 0.02, held["ship"]["speed_mean"]
    assert abs(held["ship"]["thrust_mean_N"] - steered["mean_N"]) < 0.03 * steered["mean_N"]

    # a thrust that meets the resistance on a prescribed course at its speed
    pull = on_course["mean_N"] / (1 - SPEED / OPEN_WATER / 3 - 2 / 3 * (SPEED / OPEN_WATER)**2)
    solve(folder, "runs/free", SPEED, surge, f"propulsion.bollard_pull={pull}",
          f"propulsion.open_water_speed={OPEN_WATER}")
    (folder / "thrust.toml").write_text(f"[[thrust]]\nname = 'net'\nbollard_pull = {pull}\n"
                                        f"open_water_speed = {OPEN_WATER}\n", encoding="utf-8")
    found = speeds_of(folder)
    (_, low, high), (_, free_low, free_high) = found["prescribed course"], found["free ship"]
    assert low <= free_high and free_low <= high, found
    assert high - low < SPEED and free_high - free_low < SPEED, found


if len(sys.argv) > 2:
    pathlib.Path(sys.argv[2]).mkdir(parents=True, exist_ok=True)
    check(pathlib.Path(sys.argv[2]).resolve())
else:
    with tempfile.TemporaryDirectory() as place:
        check(pathlib.Path(place))
