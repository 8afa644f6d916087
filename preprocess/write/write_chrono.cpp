// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_chrono.hpp"

#include <fmt/compile.h>

namespace ice {

void write_chrono_spheres(const SphereSet& set, const RigidBody& body, const Sink& sink) {
    // DEM-Engine moves a clump in its principal axes about its centre of mass
    const Mat3 to_principal = body.axes.toRotationMatrix().transpose();
    sink("x,y,z,r\n");
    write_rows(sink, set.size(), [&](fmt::memory_buffer& out, std::size_t k) {
        const Vec3 c = to_principal * (set.centers[k] - body.centroid);
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{},{},{},{}\n"), c.x(), c.y(), c.z(),
                       set.radii[k]);
    });
}

}  // namespace ice
