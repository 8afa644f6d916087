# SPDX-License-Identifier: GPL-3.0-or-later
"""read_run.py results/channel/run.h5: a run in h5py and xarray (apt-get install python3-h5py
python3-xarray python3-h5netcdf). A run that was killed left run.h5.part: that opens, too."""
import sys

import h5py
import xarray

path = sys.argv[1]
with h5py.File(path) as run:  # what there is: common/formats/run_file.hpp
    print(run.attrs["title"], "by", run.attrs["created_by"])
root = xarray.open_dataset(path, engine="h5netcdf")  # labels: time, x y z, ...
ship = xarray.open_dataset(path, group="ship", engine="h5netcdf").assign_coords(root.coords)
frames = xarray.open_dataset(path, group="frames", engine="h5netcdf").assign_coords(xyz=root.xyz)
contacts = xarray.open_dataset(path, group="contacts", engine="h5netcdf")

late = ship.sel(time=slice(float(ship.time[-1]) / 3, None))  # the last two thirds
print(f"resistance {-float(late.force.sel(xyz=b'x').mean()):.1f} {ship.force.units}")
print(f"floes that moved: {int((frames.state > 0).any('frame_time').sum())}")
deepest = frames.position.sel(xyz=b"z").min("body")
print(f"deepest floe at {float(deepest.min()):.2f} m, t = {float(deepest.idxmin()):.1f} s")
push = (contacts.normal_force**2).sum("xyz")**0.5  # at contacts.point, in the ship's frame
print(f"hardest place: {contacts.point[int(push.argmax())].values} m" if push.size else "no hits")
