# SPDX-License-Identifier: GPL-3.0-or-later
"""read_xdmf.py WRITE_SAMPLE_RUN ICEPOST: exports a made-up run, reads and draws it with ParaView.

Calls itself again with pvpython under Xvfb; skipped (exit code 77) where either is not installed.
"""
import os
import shutil
import subprocess
import sys
import tempfile


def blocks_of(reader, time):
    """Names and data of the blocks that are there at a time."""
    from paraview import servermanager
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    return {data.GetMetaData(k).Get(data.NAME()): data.GetBlock(k)
            for k in range(data.GetNumberOfBlocks()) if data.GetBlock(k)}


def near(found, expected):
    return all(abs(a - b) < 1e-5 for a, b in zip(found, expected))


def read_in_paraview(folder):
    """Times and poses as ParaView sees them: the ship goes on at 1 m/s, from 0 to 8 m at t = 0."""
    from paraview import simple
    path = os.path.join(folder, "run.xdmf")
    run = simple.XDMFReader(FileNames=[path])
    run.UpdatePipelineInformation()
    times = list(run.TimestepValues)
    assert len(times) == 45 and times[0] == 0 and abs(times[40] - 4.0) < 1e-9, times
    first, later = blocks_of(run, times[0]), blocks_of(run, times[40])
    hull = [name for name in later if name.startswith("hull: ")]
    assert sorted(hull) == HULL, sorted(later)
    assert "contacts" not in first and "contacts" in later

    # the whole hull, 8 x 2 x 1.2 m, 4 m ahead after 4 s
    bounds = [later[name].GetBounds() for name in hull]
    box = [min(b[k] for b in bounds) if k % 2 == 0 else max(b[k] for b in bounds) for k in range(6)]
    assert near(box, (4, 12, -1, 1, -0.7, 0.5)), box
    assert max(later[name].GetCellData().GetArray("load_Pa").GetRange()[1] for name in hull) > 0

    floes = later["floes"]
    assert floes.GetNumberOfPoints() == 6 * 8 and floes.GetNumberOfCells() == 6 * 12
    cells = floes.GetCellData()
    assert cells.GetArray("body").GetRange() == (1.0, 6.0)
    assert cells.GetArray("contact_force_N").GetNumberOfComponents() == 3
    assert cells.GetArray("state") is not None

    points = later["bodies"].GetPointData()
    assert later["bodies"].GetNumberOfPoints() == later["bodies"].GetNumberOfCells() == 6
    turn = points.GetArray("orientation")
    assert turn.GetNumberOfComponents() == 4
    assert abs(sum(v * v for v in turn.GetTuple(0)) - 1) < 1e-6

    # at 4 s five floes press with 300 N on the bottom, 1 m behind a bow at x = 12 m
    contacts = later["contacts"]
    assert near(contacts.GetPoint(0), (11, -0.5, -0.7)), contacts.GetPoint(0)
    assert contacts.GetPointData().GetArray("normal_force_N").GetTuple(0) == (0, 0, 300)
    assert later["water"].GetBounds()[4:] == (0, 0)

    # the other reader that the dialogue offers; it gives no names
    other = simple.Xdmf3ReaderS(FileName=[path])
    other.UpdatePipeline(times[40])
    assert other.GetDataInformation().GetNumberOfCells() == sum(
        block.GetNumberOfCells() for block in later.values())

    shapes = simple.XDMFReader(FileNames=[os.path.join(folder, "shapes.xdmf")])
    assert sorted(blocks_of(shapes, 0)) == ["floe shape 1", "hull"]
    print("ParaView read", len(times), "times")


HULL = ["hull: bottom", "hull: hull"]


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
        files = os.path.join(folder, "paraview")
        assert sorted(os.listdir(files)) == ["arrays.h5", "run.xdmf", "shapes.xdmf", "view.py"]
        inside = ["xvfb-run", "-a", "pvpython"]
        code = subprocess.run([*inside, os.path.abspath(__file__), "--inside", files],
                              check=False).returncode
        if code != 0:
            return code
        picture = os.path.join(folder, "view.png")
        subprocess.run([*inside, os.path.join(files, "view.py"), picture], check=True)
        # an empty view of this size packs into 5.7 kB, the sample run into 19 kB
        assert os.path.getsize(picture) > 10_000, os.path.getsize(picture)
        return 0


if __name__ == "__main__":
    sys.exit(main())
