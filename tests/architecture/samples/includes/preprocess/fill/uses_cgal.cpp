// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/measure/signed_distance.hpp"
#include <CGAL/Surface_mesh.h>
#include <hdf5.h>
#include <openssl/evp.h>
