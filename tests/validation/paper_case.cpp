// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/paper_case.hpp"

#include "common/formats/spheres_file.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "solver/case/read_case.hpp"
#include "solver/run/run.hpp"
#include "tests/support/temporary_file.hpp"

namespace ice::test {

namespace {

const std::string kRoot = ICE_SOURCE_DIR;

TriangleMesh read(const std::string& name) {
    const std::string file = kRoot + "/meshes/" + name + ".obj";
    std::vector<std::pair<std::string, std::int64_t>> repairs;
    return make_solid(read_mesh(file, {}), file, {}, repairs, nullptr);
}

FillOptions surface(double radius, double spacing) {
    FillOptions options;
    options.radius = radius;
    options.spacing = spacing;
    options.surface_only = true;
    return options;
}

}  // namespace

SphereSet set_of_mesh(const std::string& name, const FillOptions& options) {
    SpheresReport report;
    return fill_spheres(read(name), options, report);
}

SphereSet set_of_section(const std::string& name, const FillOptions& options) {
    SpheresReport report;
    const TriangleMesh mesh = read(name);
    return fill_discs(slice_solid(mesh, 0.0), mesh.region_names, options, report);
}

SphereSet set_of_prism(const std::string& name, double breadth, const FillOptions& options) {
    SpheresReport report;
    const TriangleMesh mesh = read(name);
    TriangleMesh prism = extrude(slice_solid(mesh, 0.0), mesh.region_names);
    for (Vec3& v : prism.vertices) v.y() *= breadth;  // 1 m broad as extruded
    return fill_spheres(prism, options, report);
}

World world_of_case(const std::string& name, const SphereSet& hull, const SphereSet& floe,
                    std::vector<std::string> overrides) {
    const TemporaryFile hull_file(".spheres.h5", ""), floe_file(".spheres.h5", "");
    write_spheres(hull_file.path(), hull);
    write_spheres(floe_file.path(), floe);
    overrides.push_back("hull.spheres=" + hull_file.path().string());
    overrides.push_back("floes.spheres=" + floe_file.path().string());
    return build_world(read_case(kRoot + "/cases/" + name + "/case.cfg", overrides));
}

World paper_2d(const std::vector<std::string>& overrides) {
    const FillOptions options = surface(0.1, 0.05);
    return world_of_case("paper-2d-u0.5", set_of_section("paper-hull-2d", options),
                         set_of_section("paper-floe-2d", options), overrides);
}

World paper_3d(const std::vector<std::string>& overrides) {
    FillOptions lattice;
    lattice.radius = 0.05;
    lattice.arrangement = Arrangement::lattice;
    return world_of_case("paper-3d", set_of_mesh("paper-hull-3d", surface(0.1, 0.1)),
                         set_of_mesh("paper-floe-3d", lattice), overrides);
}

}  // namespace ice::test
