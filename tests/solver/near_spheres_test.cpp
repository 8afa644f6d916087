// SPDX-License-Identifier: GPL-3.0-or-later
// The search for near spheres: nothing missed, bits on every instruction set.
#include "solver/narrow/neighbours/near_spheres.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/support/every_instruction_set.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

std::vector<SearchSphere> random_spheres(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1.0, 1.0), size(0.05, 0.1);
    std::vector<SearchSphere> out(count);
    for (SearchSphere& s : out) {
        s.center = Vec3(2.0 * place(random), place(random), 0.2 * place(random));
        s.normal_extent = size(random);
        s.tangent_extent = size(random) - 0.05;
    }
    return out;
}

const FloatPose kPose{{{0.6f, -0.8f, 0.0f}, {0.8f, 0.6f, 0.0f}, {0.0f, 0.0f, 1.0f}},
                      {0.3f, -0.2f, 0.25f}};
const FloatBox kBox{{-0.5f, -0.4f, -0.1f}, {0.6f, 0.3f, 0.3f}};

std::vector<std::int32_t> all_groups(const SphereBlocks& blocks) {
    std::vector<std::int32_t> out(blocks.group_count);
    for (std::size_t g = 0; g < out.size(); ++g) out[g] = static_cast<std::int32_t>(g);
    return out;
}

void check_same(const NearSpheres& got, const NearSpheres& expected) {
    REQUIRE(got.count == expected.count);
    const auto same = [&](const auto& g, const auto& e) {
        return std::equal(e.begin(), e.begin() + static_cast<std::ptrdiff_t>(expected.count),
                          g.begin());
    };
    CHECK(same(got.x, expected.x));
    CHECK(same(got.y, expected.y));
    CHECK(same(got.z, expected.z));
    CHECK(same(got.normal_extent, expected.normal_extent));
    CHECK(same(got.tangent_extent, expected.tangent_extent));
    CHECK(same(got.own, expected.own));
    CHECK(same(got.id, expected.id));
    CHECK(std::equal(got.box.low, got.box.low + 3, expected.box.low));
    CHECK(std::equal(got.box.high, got.box.high + 3, expected.box.high));
}

}  // namespace

TEST_CASE("blocks hold every sphere once, near others, within the boxes of group and cluster",
          "[search]") {
    const std::size_t count = GENERATE(1u, 15u, 16u, 17u, 256u, 257u, 5000u);
    const auto spheres = random_spheres(count, 3);
    const SphereBlocks blocks(spheres);
    REQUIRE(blocks.count == count);
    REQUIRE(blocks.x.size() == blocks.group_count * SphereBlocks::kGroup);
    std::vector<int> seen(count, 0);
    double volume = 0.0;
    for (std::size_t k = 0; k < blocks.id.size(); ++k) {
        if (blocks.id[k] < 0) continue;
        const SearchSphere& s = spheres[static_cast<std::size_t>(blocks.id[k])];
        ++seen[static_cast<std::size_t>(blocks.id[k])];
        REQUIRE(blocks.x[k] == static_cast<float>(s.center.x()));
        REQUIRE(blocks.own[k] == Near(std::hypot(s.normal_extent, s.tangent_extent)));
        const std::size_t group = k / 16, cluster = group / 16;
        REQUIRE(blocks.groups.low[1][group] <= blocks.y[k]);
        REQUIRE(blocks.groups.high[1][group] >= blocks.y[k]);
        REQUIRE(blocks.clusters.low[2][cluster] <= blocks.z[k]);
        REQUIRE(blocks.clusters.high[2][cluster] >= blocks.z[k]);
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    for (std::size_t g = 0; g < blocks.group_count; ++g) {
        double box = 1.0;
        for (int d = 0; d < 3; ++d) box *= blocks.groups.high[d][g] - blocks.groups.low[d][g];
        volume += box;
    }
    // all groups together fill the spheres' box of 4 x 2 x 0.4 m, they do not lie across each other
    CHECK(volume <= 3.2);
}

TEST_CASE("a sphere is found by its own range, and by nothing less", "[search][analytic]") {
    // 0.05 + 0.03 and 0.01 + 0.02 with along 0.04 and across 0.07: hypot(0.12, 0.10)
    const double range = std::hypot(0.12, 0.10);
    const double distance = range * GENERATE(0.9999, 1.0001);
    const std::vector<SearchSphere> one{{Vec3(0, 0, 0), 0.05, 0.01}};
    const std::vector<SearchSphere> other{{Vec3(0.6, 0.0, 0.8) * distance, 0.03, 0.02}};
    const SphereBlocks a(one), b(other);
    const FloatPose still{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    NearSpheres few, many;
    pick_spheres(a, {0}, still, kBox, 1.0f, few);
    pick_spheres(b, {0}, still, kBox, 1.0f, many);
    NearPairs pairs;
    find_near_pairs(few, 0, 1, many, {0.04f, 0.07f}, pairs);
    REQUIRE(pairs.end.size() == 1);
    CHECK(pairs.end[0] == (distance <= range ? 1 : 0));
}

TEST_CASE("every instruction set finds what the reference finds, bit for bit", "[search][simd]") {
    const std::size_t count =
        GENERATE(0u, 1u, 2u, 3u, 5u, 7u, 8u, 9u, 15u, 16u, 17u, 31u, 33u, 255u, 300u, 5000u);
    const auto spheres = random_spheres(count, static_cast<unsigned>(count) + 1);
    const SphereBlocks blocks(spheres);
    const SphereBlocks asking(random_spheres(40, 77));
    std::vector<std::int32_t> expected_groups, groups;
    NearSpheres expected_picked, picked, expected_few, few, expected_again, again;
    NearPairs expected_pairs, pairs;
    const SearchRange range{0.11f, 0.08f};
    reference::find_groups(blocks, kBox, 0.2f, expected_groups);
    reference::pick_spheres(blocks, all_groups(blocks), kPose, kBox, 0.1f, expected_picked);
    reference::pick_spheres(asking, all_groups(asking), kPose, kBox, 0.2f, expected_few);
    reference::pick_spheres(expected_picked, {{-0.1f, -0.1f, -0.1f}, {0.2f, 0.2f, 0.2f}}, 0.05f,
                            expected_again);
    // rows are tested a few at a time: from any of them, and with any number left over
    const std::size_t first = std::min<std::size_t>(GENERATE(0u, 1u), expected_few.count);
    const std::size_t last =
        std::max(first, expected_few.count -
                            std::min<std::size_t>(GENERATE(0u, 1u, 2u, 3u), expected_few.count));
    reference::find_near_pairs(expected_few, first, last, expected_picked, range, expected_pairs);
    if (count == 5000) REQUIRE(expected_again.count > 50);  // or nothing is compared
    if (count == 5000) REQUIRE(expected_pairs.partner.size() > 200);
    test::on_every_instruction_set([&] {
        find_groups(blocks, kBox, 0.2f, groups);
        CHECK(groups == expected_groups);
        pick_spheres(blocks, all_groups(blocks), kPose, kBox, 0.1f, picked);
        check_same(picked, expected_picked);
        pick_spheres(asking, all_groups(asking), kPose, kBox, 0.2f, few);
        check_same(few, expected_few);
        pick_spheres(picked, {{-0.1f, -0.1f, -0.1f}, {0.2f, 0.2f, 0.2f}}, 0.05f, again);
        check_same(again, expected_again);
        find_near_pairs(few, first, last, picked, range, pairs);
        REQUIRE(pairs.end == expected_pairs.end);
        CHECK(std::equal(expected_pairs.partner.begin(), expected_pairs.partner.end(),
                         pairs.partner.begin()));
    });
}
