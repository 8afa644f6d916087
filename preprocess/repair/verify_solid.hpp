// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Tests that are independent of how a solid was made.
struct SolidProof {
    bool good = false;
    std::string fault;       ///< the failed test; empty where good
    double volume = 0.0;     ///< exact integral over the surface [m3]
    double row_error = 0.0;  ///< worst of three axes: row volume against the exact one [-]
    double overlap = 0.0;    ///< worst of three axes: winding and parity against signs [-]
};

/// Every edge has two triangles that face the same side; the volume is positive; rows along x,
/// y and z give it within 0.5 % (100 x 100 rows, more where a slender solid needs them); and
/// along each axis the volumes by sign, by winding number and by parity of the same rows agree
/// within `overlap_allowed` (1e-4 where surfaces cross without effect, else rounding).
SolidProof verify_solid(const TriangleMesh& mesh, double overlap_allowed = 1e-4);

/// The winding numbers of two surfaces at the same 20 000 places of the box, compared.
struct WindingComparison {
    double differs = 0.0;  ///< volume inside one alone, over the second's [-]
    double unclear = 0.0;  ///< volume where the first is between 0.2 and 0.8, over the second's [-]
    double first_volume = 0.0, second_volume = 0.0;  ///< [m3], within about 1 %
};

/// Compares a surface as it was, open, with the solid made of it: inside is where the winding
/// number is over 0.5. Both are oriented. Places follow a Halton sequence: the same in every run.
WindingComparison compare_windings(const TriangleMesh& open, const TriangleMesh& closed);

}  // namespace ice
