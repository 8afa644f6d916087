# SPDX-License-Identifier: GPL-3.0-or-later
"""The names of all numbers in a file that the programs write: columns, keys, datasets, attributes.

A name is what a reader types: `resistance.mean_N` of a JSON file, `contact_fx_N` of a CSV file,
`/ship/force` or `/solid@volume` of an HDF5 file. Items of a list share one name with `[]`. Names
that are data themselves, as those of regions, are replaced by what they stand for: `<region>`.
"""
import csv
import json

import h5py

# lists of names that are data, under which key, and what they stand for
NAMED_BY_DATA = {"regions": "<region>", "seconds": "<stage>", "stage_seconds": "<stage>",
                 "guessed": "<guess>"}
# bookkeeping of HDF5's dimension scales, which readers see as dimensions
OF_HDF5 = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS",
           "_Netcdf4Dimid", "_Encoding"}


def of_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return set(next(csv.reader(file)))


def of_json(path):
    with open(path, encoding="utf-8") as file:
        return set(leaves(json.load(file), ""))


def leaves(value, name):
    """Dotted names of all leaves; a list of numbers or texts is a leaf with one name."""
    if isinstance(value, dict) and value:
        stand_in = NAMED_BY_DATA.get(name.rsplit(".", 1)[-1])
        for key, item in value.items():
            part = stand_in or key
            yield from leaves(item, f"{name}.{part}" if name else part)
    elif isinstance(value, list) and any(isinstance(item, dict) for item in value):
        for item in value:
            yield from leaves(item, name + "[]")
    elif value not in ([], {}):  # an empty list has no number, and its items' names are not known
        yield name


def of_hdf5(path):
    names = set()

    def look(name, item):
        path = "/" + name if name else "/"
        if isinstance(item, h5py.Dataset):
            names.add(tracked(path))
        for attribute in item.attrs:
            if attribute not in OF_HDF5:
                names.add(tracked(path) + "@" + attribute)

    with h5py.File(path, "r") as file:
        look("", file)
        file.visititems(look)
    return names


def tracked(path):
    """/tracked/7 is one of many."""
    head, _, last = path.rpartition("/")
    return head + "/<floe>" if head == "/tracked" and last.isdigit() else path


READERS = {"csv": of_csv, "json": of_json, "h5": of_hdf5}


def of_file(path):
    return READERS[str(path).rsplit(".", 1)[-1]](path)
