# SPDX-License-Identifier: GPL-3.0-or-later
"""read_pvd.py WRITE_SAMPLE_RUN ICEPOST: exports a made-up run and reads it with ParaView.

Calls itself again with pvpython under Xvfb; skipped (exit code 77) where either is not installed.
"""
import os
import shutil
import subprocess
import sys
import tempfile


def read_in_paraview(folder):
    """Times and poses as ParaView sees them: the ship goes on at 1 m/s, from 0 to 8 m at t = 0."""
    from paraview import servermanager, simple

    def open_pvd(name):
        reader = simple.PVDReader(FileName=os.path.join(folder, name))
        reader.UpdatePipelineInformation()
        return reader

    hull = open_pvd("hull.pvd")
    times = list(hull.TimestepValues)
    assert len(times) == 45 and times[0] == 0 and abs(times[40] - 4.0) < 1e-9, times
    for time in (times[0], times[40]):
        hull.UpdatePipeline(time)
        bounds = hull.GetDataInformation().GetBounds()
        assert abs(bounds[0] - time) < 1e-5 and abs(bounds[1] - time - 8) < 1e-5, bounds

    floes = open_pvd("floes.pvd")
    floes.UpdatePipeline(times[40])
    data = servermanager.Fetch(floes)
    assert data.GetNumberOfPolys() == 6 * 12
    assert data.GetCellData().GetArray("body").GetRange() == (1.0, 6.0)

    contacts = open_pvd("contacts.pvd")
    contacts.UpdatePipeline(times[40])
    force = servermanager.Fetch(contacts).GetPointData().GetArray("normal_force")
    assert force.GetTuple(0) == (0, 0, 300), force.GetTuple(0)
    print("ParaView read", len(times), "times")


def main():
    if sys.argv[1] == "--inside":
        read_in_paraview(sys.argv[2])
        return 0
    if not shutil.which("pvpython") or not shutil.which("xvfb-run"):
        print("skipped: apt-get install paraview xvfb xauth")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], os.path.join(folder, "run.h5")], check=True)
        subprocess.run([sys.argv[2], "-q", "paraview", folder], check=True)
        return subprocess.run(["xvfb-run", "-a", "pvpython", os.path.abspath(__file__), "--inside",
                               os.path.join(folder, "paraview")], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
