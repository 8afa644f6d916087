#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""contract_test.py REPOSITORY: docs/contract.md names every option, column, JSON key and dataset.

Taken from the sources that write them, so that a new name comes into the contract with its code."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
FORMATS = ROOT / "common/formats"


def json_keys(*files):
    """Keys of json["key"] = ... and of {"key", value} in these sources."""
    names = set()
    for name in files:
        text = (FORMATS / name).resolve().read_text(encoding="utf-8")
        names |= set(re.findall(r'(?:json|out)\["(\w+)"\]', text))
        names |= set(re.findall(r'\{"(\w+)",', text))
    return {n for n in names if not n.endswith("_") and n != "text"}


def columns():
    text = (ROOT / "solver/record/csv_file.cpp").read_text(encoding="utf-8")
    lists = re.findall(r'Columns =((?:\s*"[^"]*")+);', text)
    return {c for block in lists for c in "".join(re.findall(r'"([^"]*)"', block)).split(",")}


def options():
    """Long options that the programs declare, as words: --print-schema is print-schema."""
    names = set()
    for name in ("preprocess/spherize.cpp", "preprocess/icefield.cpp", "solver/iceflow.cpp",
                 "solver/icesolve_options.cpp", "postprocess/icepost.cpp"):
        text = (ROOT / name).read_text(encoding="utf-8")
        names |= set(re.findall(r'"(?:-\w,)?--([a-z-]+)"', text))
    return names


def datasets(*files):
    """Last parts of the names of datasets, such as vertices of /mesh/vertices."""
    names = set()
    for name in files:
        text = (FORMATS / name).read_text(encoding="utf-8")
        names |= {n.rsplit("/", 1)[-1] for n in re.findall(r'"(/[a-z_]+(?:/[a-z_]+)?)"', text)}
    return names - {"hdf5"}


def main():
    text = (ROOT / "docs/contract.md").read_text(encoding="utf-8")
    words = set(re.findall(r"\[?\w+\]?", text))
    words |= {w.strip("[]") for w in words}
    words |= set(re.findall(r"--([a-z-]+)", text))
    # line_load_{mean,p99,max}_N_per_m stands for three names
    for kind in ("mean", "p99", "max"):
        words |= {f"line_load_{kind}_N_per_m", f"pressure_{kind}_Pa"}
    sources = {
        "options": options(),
        "summary.json": json_keys("summary_file.cpp", "particulars_json.cpp",
                                  "load_statistics_json.cpp",
                                  "../../solver/record/energy_ledger.cpp"),
        "spherize --json": json_keys("spheres_report.cpp"),
        "iceflow --json": json_keys("flow_report.cpp"),
        "columns": columns(),
        "sphere sets": datasets("spheres_file.cpp"),
        "fields": datasets("field_file.cpp"),
        "runs": datasets("run_file.cpp", "run_parts.cpp"),
    }
    faults = [f"{kind}: {name}" for kind, names in sources.items() for name in sorted(names)
              if name not in words]
    few = [kind for kind, names in sources.items() if len(names) < 10]
    for fault in faults:
        print("docs/contract.md does not name", fault)
    for kind in few:
        print("hardly any names found of", kind)
    sys.exit(1 if faults or few else 0)


if __name__ == "__main__":
    main()
