// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/write/sink.hpp"

namespace ice {

/// The set as a VTK XML file (.vtp) for ParaView, mesh frame: one point and one vertex cell per
/// sphere with the arrays radius, normal, area, volume, layer and region; binary, appended raw,
/// little-endian. Point Gaussian or a glyph scaled by radius shows the spheres. Normals are
/// Float32, as in the sphere set's file. Equal sets give equal bytes.
void write_vtp(const SphereSet& set, const Sink& sink);

}  // namespace ice
