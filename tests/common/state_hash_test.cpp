// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/state_hash.hpp"

#include <catch2/catch.hpp>
#include <set>

using ice::StateHash;

namespace {

std::uint64_t hash(std::initializer_list<double> values) {
    StateHash state;
    for (const double v : values) state.add(v);
    return state.value();
}

}  // namespace

TEST_CASE("equal sequences hash equal, and order, sign of zero and last bit count", "[base]") {
    CHECK(hash({1.0, 2.0}) == hash({1.0, 2.0}));
    CHECK(hash({1.0, 2.0}) != hash({2.0, 1.0}));
    CHECK(hash({0.0}) != hash({-0.0}));
    CHECK(hash({1.0}) != hash({1.0 + 2.220446049250313e-16}));
    CHECK(hash({}) != hash({0.0}));
}

TEST_CASE("10000 neighbouring states have 10000 different hashes", "[base]") {
    std::set<std::uint64_t> seen;
    for (int k = 0; k < 10000; ++k) seen.insert(hash({1e-3 * k, 7.0}));
    CHECK(seen.size() == 10000);
}

TEST_CASE("the hash of 1, 2, 3 is what it was in release 0.1", "[base]") {
    // hashes stored with golden cases depend on it
    CHECK(hash({1.0, 2.0, 3.0}) == 0x0d7895ec0629b84full);
    StateHash words;
    words.add(std::uint64_t{0x3ff0000000000000});  // the bits of 1.0
    CHECK(words.value() == hash({1.0}));
}
