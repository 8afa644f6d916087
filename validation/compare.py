#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes published tests anew and lays the results beside the measurements.

    python3 validation/compare.py run uikku            # all tests: validation/uikku/computed.csv
    python3 validation/compare.py sensitivity uikku    # one input at a time: sensitivity.csv
    python3 validation/compare.py page                 # docs/validation-measured.md from the files

A data set is a folder with set.toml (which column of data.csv sets which key of the case, how far
the ship goes, which inputs are uncertain), data.csv (the published numbers and their source),
case.cfg and make_hull.py. Only the standard library is needed.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import sys
import tomllib

import measured_page

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
COLUMNS = ["test", "mean_kN", "ci95_kN", "breaking_kN", "submersion_kN", "std_kN", "max_kN",
           "lindqvist_kN", "riska_kN", "jeong_kN", "commit"]


def read_set(folder):
    with open(folder / "set.toml", "rb") as file:
        return tomllib.load(file)


def read_table(path):
    """Rows of a CSV file whose lines that begin with # are remarks; none where it is missing."""
    if not path.exists():
        return []
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def write_table(path, columns, rows, remark):
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(f"# {remark}\n")
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def program(name, folder):
    path = pathlib.Path(folder) / name
    if not path.exists():
        sys.exit(f"compare.py: no program {path}; run ./bootstrap.sh build or give --programs")
    return str(path)


def settings_of(data_set, test, distance):
    """Keys of the case for one row of data.csv: its columns, and times from the distance [m]."""
    values = {key: float(test[column]) * factor
              for key, (column, factor) in data_set["keys"].items()}
    speed = values["hull.speed"]
    step = min(data_set["step"] / speed, data_set["longest_step"])
    steps = round(distance / speed / step)
    return {**values, "simulation.time_step": step, "simulation.duration": steps * step,
            "output.average_from": steps * step * (1.0 - data_set["averaged_part"]),
            "output.frames_every": steps * step / 20}


def make_hull(folder, out, data_set, programs, options=()):
    """The sphere set of a hull in `out`, which an equal call made before is kept."""
    mesh, spheres = out / "hull.obj", out / "hull.spheres.h5"
    out.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, str(folder / "make_hull.py"), *options, "--out", str(mesh)],
                   check=True)
    if not spheres.exists() or spheres.stat().st_mtime < mesh.stat().st_mtime:
        subprocess.run([program("spherize", programs), "-q", str(mesh), *data_set["spherize"],
                        "-o", str(spheres)], check=True)


def run_case(folder, out, name, settings, programs):
    """Runs the case with settings beside the hull in `out`; returns summary.json's content."""
    case = out / f"{name}.cfg"
    case.write_text((folder / "case.cfg").read_text(encoding="utf-8").replace(
        "../../cases/", str(ROOT / "cases") + "/"), encoding="utf-8")
    command = [program("icesolve", programs), str(case), "--out", str(out / name), "--overwrite",
               "-q"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    done = subprocess.run(command, env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False,
                          stderr=subprocess.PIPE, text=True)
    (out / f"{name}.log").write_text(done.stderr, encoding="utf-8")
    if done.returncode:
        sys.exit(f"compare.py: {name} failed: {done.stderr}")
    return json.loads((out / name / "summary.json").read_text(encoding="utf-8"))


def total_of(summary, author):
    """A formula's resistance for the hull of the run [kN]; empty where the case lacks an input."""
    for formula in summary["formulas"]:
        if formula["name"].startswith(author) and formula["part"] == "total":
            return f"{formula['value_N'] / 1e3:.0f}"
    return ""


def row_of(test, summary):
    r = summary["resistance"]
    values = {"mean": r["mean_N"], "ci95": r["ci95_N"], "breaking": r["breaking_mean_N"],
              "submersion": r["submersion_mean_N"], "std": r["std_N"], "max": r["max_N"]}
    # a run too short for an interval has none
    return {"test": test,
            **{f"{k}_kN": "" if v is None else f"{v / 1e3:.1f}" for k, v in values.items()},
            "lindqvist_kN": total_of(summary, "Lindqvist"), "riska_kN": total_of(summary, "Riska"),
            "jeong_kN": total_of(summary, "Jeong"), "commit": summary["git_commit"]}


def run_all(jobs, compute, what, target, columns, remark):
    """Rows of `compute` for all of `what`; the table is written after each: none gets lost."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(compute, one) for one in what]
        for _ in concurrent.futures.as_completed(futures):
            write_table(target, columns, [f.result() for f in futures if f.done()], remark)
    print(target)


def run(arguments):
    folder = HERE / arguments.set
    data_set, tests = read_set(folder), read_table(folder / "data.csv")
    chosen = arguments.tests.split(",") if arguments.tests else [t["test"] for t in tests]
    unknown = set(chosen) - {t["test"] for t in tests}
    if unknown:
        sys.exit(f"compare.py: {folder}/data.csv has no test {', '.join(sorted(unknown))}")
    out = pathlib.Path(arguments.out) / arguments.set
    make_hull(folder, out, data_set, arguments.programs)
    distance = arguments.distance or data_set["distance"]

    def compute(test):
        settings = settings_of(data_set, test, distance)
        summary = run_case(folder, out, test["test"], settings, arguments.programs)
        print(f"{arguments.set} {test['test']}: {summary['resistance']['mean_N'] / 1e3:.0f} kN",
              file=sys.stderr)
        return row_of(test["test"], summary)

    target = pathlib.Path(arguments.table or folder / "computed.csv")
    run_all(arguments.jobs, compute, [t for t in tests if t["test"] in chosen], target, COLUMNS,
            f"python3 validation/compare.py run {arguments.set}"
            + (f" --tests {arguments.tests}" if arguments.tests else "")
            + (f" --distance {distance:g}" if arguments.distance else ""))


def sensitivity(arguments):
    folder = HERE / arguments.set
    data_set = read_set(folder)
    test = next(t for t in read_table(folder / "data.csv") if t["test"] == data_set["base_test"])
    out = pathlib.Path(arguments.out) / arguments.set
    base = settings_of(data_set, test, arguments.distance or data_set["distance"])

    def compute(job):
        number, (entry, value) = job
        where, name = out, f"{test['test']}-{entry['key']}-{value}".replace(" ", "")
        settings = dict(base)
        if "hull_option" in entry:
            where = out / f"hull-{number}"
            make_hull(folder, where, data_set, arguments.programs,
                      [entry["hull_option"], str(value)])
        elif entry.get("relative"):
            settings[entry["key"]] = base[entry["key"]] * value
        else:
            settings[entry["key"]] = value
        r = run_case(folder, where, name, settings, arguments.programs)["resistance"]
        return {"input": entry["key"], "value": value,
                "relative": int(entry.get("relative", False)),
                "mean_kN": f"{r['mean_N'] / 1e3:.1f}", "ci95_kN": f"{r['ci95_N'] / 1e3:.1f}"}

    make_hull(folder, out, data_set, arguments.programs)
    jobs = [(entry, value) for entry in data_set["uncertain"] for value in entry["values"]]
    target = pathlib.Path(arguments.table or folder / "sensitivity.csv")
    run_all(arguments.jobs, compute, list(enumerate(jobs)), target,
            ["input", "value", "relative", "mean_kN", "ci95_kN"],
            f"python3 validation/compare.py sensitivity {arguments.set}")


def page(arguments):
    text = measured_page.make(HERE, read_set, read_table)
    pathlib.Path(arguments.page).write_text(text, encoding="utf-8", newline="\n")
    print(arguments.page)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, function in (("run", run), ("sensitivity", sensitivity)):
        command = commands.add_parser(name)
        command.set_defaults(function=function)
        command.add_argument("set", help="folder of validation/, as uikku")
        command.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side")
        command.add_argument("--distance", type=float,
                             help="way of the ship [m], shorter for a trial")
        command.add_argument("--out", default=str(ROOT / "results" / "validation"),
                             help="run folders")
        command.add_argument("--table", help="the CSV file instead of the data set's own")
        command.add_argument("--programs", default=str(ROOT / "build" / "release" / "bin"))
        if name == "run":
            command.add_argument("--tests", help="comma-separated names; default: all")
    command = commands.add_parser("page")
    command.set_defaults(function=page)
    command.add_argument("--page", default=str(ROOT / "docs/validation-measured.md"))
    arguments = parser.parse_args()
    arguments.function(arguments)


if __name__ == "__main__":
    main()
