// SPDX-License-Identifier: GPL-3.0-or-later
// The flow that a case makes for its hull, and where it is kept.
//
// Tolerance: 1e-12 is rounding of one product.
#include <catch2/catch.hpp>
#include <set>

#include "common/formats/flow_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/run/make_water.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

std::set<std::filesystem::path> flows_in(const TempFolder& folder) {
    std::set<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        if (entry.path().string().ends_with(".flow.h5")) out.insert(entry.path());
    return out;
}

}  // namespace

TEST_CASE("a flow is made once for each draught, its nodes half the thinnest floe apart",
          "[flow][file]") {
    const TempFolder folder;
    const Vec3 hull(6.0, 2.0, 2.0);
    Case p = empty_space(0.01);
    p.flow = FlowModel::double_body;
    p.speed_table = {{0.0, 1.0}};
    p.hull_spheres = folder / "hull.spheres.h5";
    write_spheres(p.hull_spheres, make_box_set(hull, 0.2, 0.4));
    // coarser than 300 000 nodes in the table's box: the floes decide
    const auto make = [&](double draught) {
        World w = plate_world(p, hull, 0.2, 0.4, -draught);
        add_shape(w, make_box_set(Vec3(3.0, 2.5, 0.8), 0.2, 0.4));
        add_shape(w, make_box_set(Vec3(2.0, 2.0, 1.2), 0.2, 0.4));
        return make_water(p, w.scene);
    };
    make(0.5);
    const auto first = flows_in(folder);
    REQUIRE(first.size() == 1);
    CHECK(read_flow(*first.begin()).spacing == Near(0.4).epsilon(1e-12));
    CHECK(read_flow(*first.begin()).draught == Near(0.5).epsilon(1e-12));
    make(0.7);
    CHECK(flows_in(folder).size() == 2);
    make(0.5);
    CHECK(flows_in(folder).size() == 2);
}
