# SPDX-License-Identifier: GPL-3.0-or-later
"""load_vtp.py SPHERIZE: VTK reads from the vtp what h5py reads from the sphere set."""
import os
import sys

import tetrahedron

try:
    import h5py
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as error:
    print(f"skipped: {error} (apt-get install python3-vtk9 python3-h5py)")
    sys.exit(77)

with tetrahedron.workshop() as folder:
    tetrahedron.export(folder, "vtp")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(folder, "tetra.vtp"))
    reader.Update()
    assert reader.GetErrorCode() == 0
    spheres = reader.GetOutput()
    with h5py.File(os.path.join(folder, "tetra.h5")) as file:
        count = file["center"].shape[0]
        assert count > 100
        assert spheres.GetNumberOfPoints() == spheres.GetNumberOfVerts() == count
        assert (vtk_to_numpy(spheres.GetPoints().GetData()) == file["center"][:]).all()
        for name in ("radius", "normal", "area", "volume", "layer", "region"):
            array = vtk_to_numpy(spheres.GetPointData().GetArray(name))
            assert array.dtype == file[name].dtype, (name, array.dtype)
            assert (array == file[name][:]).all(), name
        assert spheres.GetPointData().GetNormals().GetName() == "normal"
        ids = vtk_to_numpy(spheres.GetVerts().GetConnectivityArray())
        assert (ids == range(count)).all()
    print(f"VTK read {count} spheres")
