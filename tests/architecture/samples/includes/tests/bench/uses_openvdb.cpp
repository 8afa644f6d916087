// SPDX-License-Identifier: GPL-3.0-or-later
#include <openvdb/openvdb.h>

#include <CGAL/Surface_mesh.h>
