#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""values_test.py PROGRAMS SOURCE [--stop]: every number that leaves the programs has a value that
is not theirs. --stop ends it behind the first module that finds a fault.

The modules check_*.py make small inputs and runs and compare what the programs write with values by
hand or by numpy. elsewhere.toml names the rest, with the test that knows its value. A name that a
program writes and neither knows is a fault, and so is one that no program writes any more."""
import pathlib
import sys
import tempfile
import tomllib

try:
    import check_crush
    import check_field
    import check_flow
    import check_hit
    import check_hit_summary
    import check_level
    import check_page
    import check_regions
    import check_run_file
    import check_section
    import check_sheared
    import check_ship
    import check_spheres
    import check_tables
    import names
    from values import Values
    from workshop import Workshop
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

HERE = pathlib.Path(__file__).parent
CHECKS = [check_spheres, check_regions, check_field, check_hit, check_hit_summary, check_crush,
          check_sheared, check_run_file, check_ship, check_flow, check_level, check_section,
          check_tables, check_page]


def elsewhere(source):
    """Names by format of elsewhere.toml, and what is wrong with it."""
    seen, faults = {}, []
    for entry in tomllib.loads((HERE / "elsewhere.toml").read_text(encoding="utf-8"))["value"]:
        file, _, title = entry["test"].partition(": ")
        path = source / file
        if not path.is_file() or title not in path.read_text(encoding="utf-8"):
            faults.append(f"elsewhere.toml: there is no test {entry['test']}")
        seen.setdefault(entry["format"], set()).update(entry["names"])
    return seen, faults


def main():
    programs, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    values = Values()
    stop = "--stop" in sys.argv[3:]
    with tempfile.TemporaryDirectory(prefix="ice-values-") as folder:
        work = Workshop(folder, programs, source)
        for module in CHECKS:
            module.make(work)
            module.check(work, values)
            if stop and values.faults:
                print("\n".join(values.faults))
                sys.exit(1)
        written = {form: set().union(*(names.of_file(file) for file in files))
                   for form, files in work.files.items()} | work.names
    others, faults = elsewhere(source)
    faults += values.faults
    for form in sorted(written.keys() | others.keys() | values.seen.keys()):
        there = written.get(form, set())
        known = values.seen.get(form, set()) | others.get(form, set())
        faults += [f"{form}: {name} has no test with a value that is not the program's own"
                   for name in sorted(there - known)]
        faults += [f"{form}: {name} is written no more" for name in sorted(known - there)]
        faults += [f"elsewhere.toml: {form}: {name} has a value here, take it out"
                   for name in sorted(values.seen.get(form, set()) & others.get(form, set()))]
    print("\n".join(faults) if faults else "")
    counts = {form: len(found) for form, found in sorted(written.items())}
    print(f"{sum(counts.values())} names {counts}, "
          f"{sum(map(len, values.seen.values()))} with values here, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
