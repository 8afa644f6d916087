// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged copies: repaired to the right volume or refused, never wrong in silence.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "common/base/error.hpp"
#include "common/base/timer.hpp"
#include "common/geometry/mass_properties.hpp"
#include "preprocess/load/read_mesh.hpp"
#include "preprocess/repair/make_solid.hpp"
#include "tests/support/damage_mesh.hpp"
#include "tests/support/make_meshes.hpp"

using namespace ice;

namespace {

struct Tally {
    int right = 0, refused = 0, wrong = 0;
    double slowest = 0.0;
    std::map<std::string, int> reasons;

    void add(const TriangleMesh& damaged, double volume, const std::string& what) {
        const Timer timer;
        Repairs repairs;
        try {
            const TriangleMesh solid = make_solid(damaged, "mesh", {}, repairs);
            const double error = std::abs(measure_mass(solid).volume / volume - 1.0);
            ++(error <= 0.01 ? right : wrong);
            if (error > 0.01) {
                ++reasons[fmt::format("WRONG by {:.2g} %: {}", 100 * error, what)];
                for (const auto& [step, count] : repairs)
                    ++reasons[fmt::format("   {} {}: {}", what, step, count)];
            }
        } catch (const Error& error) {
            ++refused;
            ++reasons[what + " " + error.what()];
        }
        slowest = std::max(slowest, timer.seconds());
    }
    void print(const std::string& name) const {
        fmt::print("{}: right {}, refused {}, wrong {}, slowest {:.2f} s\n", name, right, refused,
                   wrong, slowest);
        for (const auto& [reason, count] : reasons) fmt::print("    {} x {}\n", count, reason);
    }
};

std::string text(const test::Damage& d) {
    return fmt::format("{}{}{}{}{}{}", d.remove ? "remove " : "", d.turn ? "turn " : "",
                       d.jitter ? "jitter " : "", d.duplicate ? "duplicate " : "",
                       d.split ? "split " : "", d.unweld ? "unweld " : "");
}

Tally damage_and_repair(const TriangleMesh& mesh, int count, unsigned seed) {
    Tally tally;
    const double volume = measure_mass(mesh).volume;
    for (int k = 0; k < count; ++k) {
        std::mt19937 random(seed + static_cast<unsigned>(k));
        const test::Damage damage = test::choose_damage(random);
        tally.add(test::damage_mesh(mesh, damage, random), volume,
                  fmt::format("{}: {}", k, text(damage)));
    }
    return tally;
}

// Worse than any file should be: openings of any size, half of the faces lost.
Tally tear_and_repair(const TriangleMesh& mesh, int count) {
    Tally tally;
    const double volume = measure_mass(mesh).volume;
    for (int k = 0; k < count; ++k) {
        std::mt19937 random(7000u + static_cast<unsigned>(k));
        const double share = 0.5 * (k + 1) / count;
        tally.add(test::tear_mesh(mesh, share, random), volume,
                  fmt::format("{}: torn {}", k, share));
        tally.add(test::thin_mesh(mesh, share, random), volume,
                  fmt::format("{}: thin {}", k, share));
    }
    return tally;
}

Tally truncate_and_repair(const TriangleMesh& mesh, int count) {
    Tally tally;
    const double volume = measure_mass(mesh).volume;
    for (int k = 1; k < count; ++k) {
        const double share = static_cast<double>(k) / count;
        tally.add(test::truncate_mesh(mesh, share), volume,
                  fmt::format("{:.3f} of the faces", share));
    }
    return tally;
}

}  // namespace

TEST_CASE("a hundred damaged copies come back with their volume", "[repair][damage]") {
    const TriangleMesh mesh =
        GENERATE(test::make_globe(1.0, 12), test::make_wigley(10, 2, 1, 24, 8));
    const Tally tally = damage_and_repair(mesh, 50, 1);
    CHECK(tally.right >= 49);
    CHECK(tally.wrong == 0);
}

// What a release is measured by; minutes: preprocess_tests "[.release]"
TEST_CASE("hundreds of damaged copies of many meshes", "[.release]") {
    const std::filesystem::path meshes = std::filesystem::path(ICE_SOURCE_DIR "/meshes");
    std::vector<std::pair<std::string, TriangleMesh>> cases;
    for (const auto& file : std::filesystem::directory_iterator(meshes))
        if (file.path().extension() == ".obj") {
            Repairs repairs;
            cases.emplace_back(file.path().filename().string(),
                               make_solid(read_mesh(file.path(), {}), "", {}, repairs));
        }
    cases.emplace_back("globe 6", test::make_globe(1.0, 6));
    cases.emplace_back("globe 20", test::make_globe(1.0, 20));
    cases.emplace_back("wigley 40 x 12", test::make_wigley(10, 2, 1, 40, 12));
    cases.emplace_back("wigley 100 x 30", test::make_wigley(100, 20, 10, 100, 30));
    for (const auto& [name, mesh] : cases) {
        damage_and_repair(mesh, 300, 100).print(name + " damaged");
        truncate_and_repair(mesh, 100).print(name + " truncated");
        tear_and_repair(mesh, 100).print(name + " torn");
    }
}
