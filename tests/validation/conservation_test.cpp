// SPDX-License-Identifier: GPL-3.0-or-later
// What no step may create or lose: momentum, angular momentum, energy.
#include <catch2/catch.hpp>

#include "solver/run/measure_imbalance.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/validation/paper_case.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

void keep_worst(Imbalance& worst, const Imbalance& now) {
    worst.linear = std::max(worst.linear, now.linear);
    worst.angular = std::max(worst.angular, now.angular);
    worst.together = std::max(worst.together, now.together);
}

Imbalance worst_until(World& w, double time) {
    Imbalance worst;
    while (w.time < time) {
        const Momenta before = momenta_of(w);
        step(w);
        keep_worst(worst, measure_imbalance(before, w));
    }
    return worst;
}

void add_rows(const std::string& which, const Imbalance& worst) {
    const test::Tolerance bound = test::within(kBalanceTolerance);
    test::validate({which + ", every step: change of a floe's momentum against loads and impulses",
                    "", 0.0, worst.linear, bound, "momentum is kept"});
    test::validate({which + ", every step: change of a floe's angular momentum", "", 0.0,
                    worst.angular, bound, "angular momentum is kept"});
    test::validate({which + ", every step: the floes' momentum against the ship's force", "", 0.0,
                    worst.together, bound, "action and reaction"});
}

}  // namespace

TEST_CASE("the paper's 2D case balances in every step", "[validation][conservation]") {
    World w = test::paper_2d({GENERATE("contact.normal=surface", "contact.normal=centres")});
    const Imbalance worst = worst_until(w, 12.0);
    REQUIRE(w.constraints.size() > 10);
    add_rows("paper's 2D case", worst);
}

TEST_CASE("the paper's 3D case balances in every step", "[validation][conservation]") {
    World w = test::paper_3d({"contact.normal=surface"});
    const Imbalance worst = worst_until(w, 12.0);
    REQUIRE(w.constraints.size() > 10);
    add_rows("paper's 3D case", worst);
}
