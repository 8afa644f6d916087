// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_liggghts.hpp"

#include <fmt/compile.h>

namespace ice {

void write_liggghts_spheres(const SphereSet& set, const RigidBody& body, const Sink& sink) {
    write_rows(sink, set.size(), [&](fmt::memory_buffer& out, std::size_t k) {
        // about the centre of mass, axes of the mesh: the template's inertia tensor is full
        const Vec3 c = set.centers[k] - body.centroid;
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{} {} {} {}\n"), c.x(), c.y(), c.z(),
                       set.radii[k]);
    });
}

std::string liggghts_text(const RigidBody& body, std::size_t count, const std::string& id,
                          const std::string& spheres_file) {
    // Mass and inertia are stated: LIGGGHTS would estimate them from the spheres, which may be a
    // hollow layer.
    const Mat3& inertia = body.inertia;
    return fmt::format(
        "# {4} spheres as one rigid particle, made by spherize; SI units.\n"
        "# In an input script: units si, atom_style granular, create_box, then include this file;\n"
        "# fix particledistribution/discrete, fix insert/* and fix multisphere follow.\n"
        "# Run in the folder of the spheres or change the path. A second template needs its own\n"
        "# fix ID, seed and type (2, 3, ...).\n"
        "# Mass and inertia tensor (xx xy xz yy yz zz about the centre of mass) are those of the\n"
        "# solid at {0} kg/m3; its centre of mass is the origin of the spheres, at\n"
        "# {1} {2} {3} m in the mesh's frame.\n"
        "# use_density keeps the spheres where they are; use_volume would move them.\n"
        "fix {5} all particletemplate/multisphere 15485863 atom_type 1 density constant {0} &\n"
        "    nspheres {4} ntry 100000 spheres file \"{6}\" scale 1 &\n"
        "    mass {7} inertia_tensor {8} {9} {10} {11} {12} {13} &\n"
        "    use_density type 1\n",
        body.density, body.centroid.x(), body.centroid.y(), body.centroid.z(), count, id,
        spheres_file, body.mass, inertia(0, 0), inertia(0, 1), inertia(0, 2), inertia(1, 1),
        inertia(1, 2), inertia(2, 2));
}

}  // namespace ice
