// SPDX-License-Identifier: GPL-3.0-or-later
// Panels beside flows found in other ways: peer_fields.csv, printed by peer_fields.py.
//
// Tolerances: 10 % is what a thin ship leaves out at a breadth of a tenth of the length.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "solver/flow/solve_panels.hpp"
#include "solver/flow/wetted_panels.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

struct Field {
    std::vector<Vec3> place, velocity;
};

Field read_field(const std::string& body) {
    std::ifstream file(ICE_PEER_FIELDS);
    Field out;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name, word;
        std::getline(words, name, ',');
        if (name != body) continue;
        double number[6];
        for (double& n : number) {
            REQUIRE(std::getline(words, word, ','));
            n = std::stod(word);
        }
        out.place.emplace_back(number[0], number[1], number[2]);
        out.velocity.emplace_back(number[3], number[4], number[5]);
    }
    REQUIRE(out.place.size() == 24);
    return out;
}

// rms of the difference, in m/s for a ship at 1 m/s, and of the peer's own speed
std::pair<double, double> differ(const PanelFlow& flow, const Field& peer) {
    const auto samples = flow_at(flow, peer.place);
    double off = 0.0, all = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        off += (samples[k].velocity - peer.velocity[k]).squaredNorm() / 24.0;
        all += peer.velocity[k].squaredNorm() / 24.0;
    }
    return {std::sqrt(off), std::sqrt(all)};
}

}  // namespace

TEST_CASE("off an ellipsoid the panels' flow is Lamb's", "[flow][analytic][peer]") {
    TriangleMesh mesh = test::make_globe(1.0, 36);
    for (Vec3& v : mesh.vertices) v = Vec3(5.0 * v.z(), v.y(), -0.7 * v.x());
    const PanelFlow flow = solve_panels(make_wetted_hull(mesh, 0.0, {10.0, 8000}).body);
    const auto [off, all] = differ(flow, read_field("ellipsoid"));
    CAPTURE(off, all);
    CHECK(all > 0.02);
    CHECK(off < tolerance(0.001));  // the surface speed is within 0.005 (panels_test.cpp)
}

TEST_CASE("a Wigley hull's flow is a thin ship's, the better the thinner it is", "[flow][peer]") {
    const auto share = [](double breadth, const char* body) {
        const TriangleMesh mesh = test::make_wigley(10.0, breadth, 1.0, 40, 10);
        const PanelFlow flow = solve_panels(make_wetted_hull(mesh, 0.0, {10.0, 8000}).body);
        const auto [off, all] = differ(flow, read_field(body));
        CAPTURE(body, off, all);
        CHECK(off < tolerance(0.1) * all);
        return off / all;
    };
    // what the thin ship leaves out is of first order in breadth over length
    const double broad = share(1.0, "wigley_1"), thin = share(0.5, "wigley_0.5");
    CAPTURE(broad, thin);
    CHECK(thin < 0.75 * broad);
}
