#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""read_run.py results/paper-3d/run.h5: a run in h5py and xarray. The resistance is summary.json's.
A run that was killed left run.h5.part: that opens, too, and gives the mean up to there."""
import sys
import tomllib

try:
    import h5netcdf  # noqa: F401: xarray reads with it
    import h5py
    import xarray
except ImportError as error:
    sys.exit(f"read_run.py: {error}. Install it for this Python, {sys.executable}:\n"
             "  apt-get install python3-h5py python3-xarray python3-h5netcdf   (/usr/bin/python3)\n"
             "  python3 -m pip install h5py xarray h5netcdf                    (any other)")
if len(sys.argv) != 2:
    sys.exit("usage: read_run.py RUN/run.h5")
path = sys.argv[1]
with h5py.File(path) as run:  # what there is: common/formats/run_file.hpp
    print(run.attrs["title"], "by", run.attrs["created_by"])
    average_from = run.attrs.get("average_from")
    if average_from is None:  # an older run: the case with all its keys is inside
        average_from = tomllib.loads(run.attrs["case_toml"])["output"]["average_from"]
    has_regions = "regions" in run
root = xarray.open_dataset(path, engine="h5netcdf")  # labels: time, x y z, ...
ship = xarray.open_dataset(path, group="ship", engine="h5netcdf").assign_coords(root.coords)
frames = xarray.open_dataset(path, group="frames", engine="h5netcdf").assign_coords(xyz=root.xyz)
contacts = xarray.open_dataset(path, group="contacts", engine="h5netcdf")

late = ship.sel(time=slice(float(average_from) - 1e-9, None))  # times carry rounding errors
if not late.time.size:
    sys.exit(f"read_run.py: the run ended before {float(average_from):g} s, where its mean begins")
x, z = 0, 2  # labels of xyz are text, in older runs bytes
print(f"resistance {-float(late.force.isel(xyz=x).mean()):.1f} {ship.force.units}")
if has_regions:
    regions = xarray.open_dataset(path, group="regions", engine="h5netcdf")
    regions = regions.assign_coords(root.coords).isel(xyz=x).sel(time=late.time)
    means = -(regions.contact_force + regions.friction_force).mean("time")
    for name, part in zip(means.hull_regions.values, means.values):
        print(f"    of it on {name}: {part:.1f}")
print(f"floes that moved: {int((frames.state > 0).any('frame_time').sum())}")
deepest = frames.position.isel(xyz=z).min("body")
print(f"deepest floe at {float(deepest.min()):.2f} m, t = {float(deepest.idxmin()):.1f} s")
push = (contacts.normal_force**2).sum("xyz")**0.5  # at contacts.point, in the ship's frame
print(f"hardest place: {contacts.point[int(push.argmax())].values} m" if push.size else "no hits")
