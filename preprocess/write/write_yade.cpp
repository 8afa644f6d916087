// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_yade.hpp"

#include <fmt/compile.h>

namespace ice {

namespace {

constexpr const char* kLoad = R"py(

def load(position=CENTROID, orientation=AXES, material=None):
    """Appends the body as a clump, at rest; returns (clump id, ids of its members).

    position     of its centre of mass [m]; default: where the mesh is
    orientation  turns the principal axes into world axes (Quaternion or (w, x, y, z));
                 default: as the mesh is
    material     of the spheres; default: FrictMat(density=DENSITY), made on the first call
    """
    bodies = Omega().bodies
    if material is None:
        if not _material:
            _material.append(FrictMat(density=DENSITY))
            Omega().materials.append(_material[0])
        material = _material[0]
    [(clump, members)] = ymport.textClumps(SPHERES, discretization=0, material=material)

    # YADE takes centre and axes of a clump from its spheres. One more member, without bound and
    # so without contacts, has all the mass while the spheres have none; the file's axes are the
    # principal ones, ascending, so that YADE's are the same.
    carrier = utils.box((0, 0, 0), (RADIUS,) * 3, material=material, mask=0)
    carrier.bounded = False
    carrier.state.mass, carrier.state.inertia = MASS, MOMENTS
    members = list(members) + [bodies.append(carrier)]
    density, material.density = material.density, 0
    try:
        bodies.addToClump(members[-1:], clump, discretization=0)
    finally:
        material.density = density

    state = bodies[clump].state
    state.mass, state.inertia = MASS, MOMENTS
    if not isinstance(orientation, ymport.Quaternion):
        orientation = ymport.Quaternion(*orientation)
    state.pos, state.ori = position, orientation
    for member, (place, turn) in bodies[clump].shape.members.items():
        bodies[member].state.pos = state.pos + state.ori * place
        bodies[member].state.ori = state.ori * turn
    state.refPos, state.refOri = state.pos, state.ori
    return clump, members


if __name__ == "__main__":
    load()
)py";

}  // namespace

void write_yade_spheres(const SphereSet& set, const RigidBody& body, const Sink& sink) {
    // YADE integrates a clump in its principal axes about its centre of mass
    const Mat3 to_principal = body.axes.toRotationMatrix().transpose();
    sink("#format x_y_z_r_clumpId\n");
    // The shortest digits that read back as the same number; the last column is the clump's number:
    // there is one clump.
    write_rows(sink, set.size(), [&](fmt::memory_buffer& out, std::size_t k) {
        const Vec3 c = to_principal * (set.centers[k] - body.centroid);
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}\t{}\t{}\t{}\t0\n"), c.x(), c.y(),
                       c.z(), set.radii[k]);
    });
}

std::string yade_text(const RigidBody& body, double radius, const std::string& spheres_file) {
    // The numbers of the body as Python constants, then the same functions for every body.
    const Vec3 &c = body.centroid, &m = body.moments;
    const Eigen::Quaterniond& q = body.axes;
    return fmt::format(
               "\"\"\"A rigid body of spheres for YADE, made by spherize; SI units.\n\n"
               "Run it (yade THIS_FILE), or load it as often as wanted from another script:\n"
               "    load = runpy.run_path(\"THIS_FILE\")[\"load\"]\n"
               "Mass and inertia are those of the solid, not of its spheres.\n"
               "\"\"\"\n"
               "import os\n"
               "import sys\n\n"
               "from yade import FrictMat, Omega, utils, ymport\n\n"
               "# YADE runs a script with its own name in __file__\n"
               "_script = sys.argv[0] if __name__ == \"__main__\" else __file__\n"
               "SPHERES = os.path.join(os.path.dirname(os.path.abspath(_script)), \"{}\")\n"
               "RADIUS = {}  # of a sphere [m]\n"
               "DENSITY = {}  # [kg/m3]\n"
               "MASS = {}  # [kg]\n"
               "MOMENTS = ({}, {}, {})  # principal, ascending [kg m2]\n"
               "CENTROID = ({}, {}, {})  # in the mesh's frame [m]\n"
               "AXES = ({}, {}, {}, {})  # w, x, y, z: from principal to mesh axes\n"
               "_material = []\n",
               spheres_file, radius, body.density, body.mass, m.x(), m.y(), m.z(), c.x(), c.y(),
               c.z(), q.w(), q.x(), q.y(), q.z()) +
           kLoad;
}

}  // namespace ice
