# SPDX-License-Identifier: GPL-3.0-or-later
"""open_run.py PROGRAM: opens what PROGRAM writes with h5py, and with xarray where installed."""
import os
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:
    print("skipped: h5py is not installed (apt-get install python3-h5py)")
    sys.exit(77)

with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "run.h5")
    subprocess.run([sys.argv[1], path, "--killed"], check=True)
    with h5py.File(path + ".part", "r") as run:
        assert run["frames/position"].shape == (40, 6, 3), run["frames/position"].shape
        assert run["time"].shape == (384,)

    subprocess.run([sys.argv[1], path], check=True)
    with h5py.File(path, "r") as run:
        assert run.attrs["format"] == "icesolve-result"
        assert run.attrs["case_toml"].startswith("title")
        assert run["frames/position"].shape == (45, 6, 3)
        assert run["ship/force"].dims[0].keys() == ["time"]
        assert run["tracked/6"].shape == (450, 22)
        assert run.attrs["average_from"] == 1.5
        assert run["regions/contact_force"].shape == (450, 2, 3)
        assert "origin of the hull's mesh" in run["ship/moment"].attrs["reference_point"]
        assert len(run["tracked/6"].attrs["column_units"].split(",")) == 22
        contacts = run["contacts/floe"].shape[0]
        assert contacts > 40 and run["contacts/point"].shape == (contacts, 3), contacts

        def every_dimension_has_a_label(name, item):
            if not isinstance(item, h5py.Dataset) or h5py.h5ds.is_scale(item.id):
                return
            labelled = [len(dim) > 0 for dim in item.dims]
            assert all(labelled) or (not any(labelled) and name.startswith("shapes/")), name

        run.visititems(every_dimension_has_a_label)

    try:
        import xarray
    except ImportError:
        print("xarray is not installed: only h5py was tried")
        sys.exit(0)
    for group, variable, dims in [("ship", "force", ("time", "xyz")),
                                  ("frames", "orientation", ("frame_time", "body", "wxyz")),
                                  ("contacts", "normal_force", ("contact_time", "xyz")),
                                  ("regions", "friction_force", ("time", "hull_regions", "xyz")),
                                  ("panels", "force_max", ("panel",)),
                                  ("tracked", "6", ("time", "track_columns"))]:
        for engine in ("h5netcdf", "netcdf4"):
            try:
                data = xarray.open_dataset(path, group=group, engine=engine)
            except ValueError as error:
                if "unrecognized engine" not in str(error):
                    raise
                continue
            assert data[variable].dims == dims, (engine, data[variable].dims)
            assert abs(float(data[variable].sum())) >= 0.0
            print(engine, group, "ok")
    root = xarray.open_dataset(path, engine="h5netcdf")
    assert list(root.xyz.values) == ["x", "y", "z"], root.xyz.values  # text, not bytes
    assert list(root.hull_regions.values) == ["hull", "bottom"], root.hull_regions.values
