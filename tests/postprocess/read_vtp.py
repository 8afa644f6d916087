# SPDX-License-Identifier: GPL-3.0-or-later
"""read_vtp.py WRITE_SAMPLE_RUN ICEPOST: exports a made-up run and reads it with VTK."""
import os
import subprocess
import sys
import tempfile

try:
    from vtkmodules.vtkFiltersCore import vtkMassProperties
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLPolyDataReader
except ImportError:
    print("skipped: VTK is not installed (apt-get install python3-vtk9)")
    sys.exit(77)

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], os.path.join(folder, "run.h5")], check=True)
    subprocess.run([sys.argv[2], "-q", "paraview", folder], check=True)
    out = os.path.join(folder, "paraview")

    def read(name, folder="frames"):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(out, folder, name))
        reader.Update()
        assert reader.GetErrorCode() == 0, name
        return reader.GetOutput()

    floes = read("floes_00040.vtp")
    assert floes.GetNumberOfPoints() == 6 * 8 and floes.GetNumberOfPolys() == 6 * 12
    body = floes.GetCellData().GetArray("body")
    assert body.GetRange() == (1.0, 6.0), body.GetRange()
    assert floes.GetCellData().GetArray("contact_force").GetNumberOfComponents() == 3
    assert floes.GetCellData().GetArray("state") is not None

    hull = read("hull_00040.vtp")
    bounds = hull.GetBounds()  # x from 0 to 8 m, 4 m ahead after 4 s
    assert all(abs(a - b) < 1e-5 for a, b in zip(bounds, (4, 12, -1, 1, -0.7, 0.5))), bounds

    bodies = read("bodies_00040.vtp")
    assert bodies.GetNumberOfPoints() == bodies.GetNumberOfVerts() == 6
    turn = bodies.GetPointData().GetArray("orientation")
    assert turn.GetNumberOfComponents() == 4
    assert abs(sum(v * v for v in turn.GetTuple(0)) - 1) < 1e-6

    # at 4 s five floes press with 300 N on the bottom, 1 m behind a bow at x = 12 m
    contacts = read("contacts_00040.vtp")
    assert contacts.GetNumberOfPoints() == contacts.GetNumberOfVerts() > 0
    assert all(abs(a - b) < 1e-5 for a, b in zip(contacts.GetPoint(0), (11, -0.5, -0.7)))
    assert contacts.GetPointData().GetArray("normal_force").GetTuple(0) == (0, 0, 300)
    assert read("contacts_00000.vtp").GetNumberOfPoints() == 0

    load = read("hull_load.vtp", ".")
    mass = vtkMassProperties()
    mass.SetInputData(load)
    assert abs(mass.GetSurfaceArea() - 56) < 1e-4, mass.GetSurfaceArea()  # 8 x 2 x 1.2 m
    assert load.GetCellData().GetArray("load").GetRange()[1] > 0

    shapes = vtkXMLMultiBlockDataReader()
    shapes.SetFileName(os.path.join(out, "shapes.vtm"))
    shapes.Update()
    assert shapes.GetOutput().GetNumberOfBlocks() == 2
    print("VTK read", len(os.listdir(os.path.join(out, "frames"))), "files")
