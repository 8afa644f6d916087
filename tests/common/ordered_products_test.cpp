// SPDX-License-Identifier: GPL-3.0-or-later
// Exact values: numbers whose sum depends on the order tell which order was used.
#include "common/math/ordered_products.hpp"

#include <catch2/catch.hpp>

using namespace ice;

namespace {

// (1 + 1e16) - 1e16 is 0, because doubles of this size are 2 apart; 1 + (1e16 - 1e16) is 1.
const Vec3 kTelling(1.0, 1e16, -1e16), kOnes(1.0, 1.0, 1.0);

Mat3 quarter_turn_about_z() {
    Mat3 r;
    r << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return r;
}

}  // namespace

TEST_CASE("sums of products have the order that the header states", "[math][analytic]") {
    CHECK(ordered_dot(kTelling, kOnes) == 0.0);
    const Mat3 rows = kOnes * kTelling.transpose();
    // the first two rows as (a + b) + c, the last as a + (b + c)
    CHECK(ordered_product(rows, kOnes) == Vec3(0.0, 0.0, 1.0));
    // all rows as (a + b) + c
    CHECK(ordered_transposed(rows.transpose(), kOnes) == Vec3(0.0, 0.0, 0.0));
    CHECK(ordered_product(rows, Mat3(kOnes * kOnes.transpose())).row(0).isZero(0.0));
    CHECK(ordered_product(rows, Mat3(kOnes * kOnes.transpose())).row(2) ==
          Eigen::RowVector3d::Ones());
}

TEST_CASE("a quarter turn about z swaps the first two entries of a diagonal tensor",
          "[math][analytic]") {
    const Mat3 r = quarter_turn_about_z(), t = Vec3(1.0, 2.0, 3.0).asDiagonal();
    CHECK(ordered_turned(r, t) == Mat3(Vec3(2.0, 1.0, 3.0).asDiagonal()));
    CHECK(ordered_turned(r, t, Vec3::UnitX()) == Vec3(2.0, 0.0, 0.0));
    CHECK(ordered_turned(r, t, Vec3::UnitY()) == Vec3(0.0, 1.0, 0.0));
    CHECK(ordered_product(r, Vec3(1.0, 2.0, 3.0)) == Vec3(-2.0, 1.0, 3.0));
    CHECK(ordered_transposed(r, Vec3(1.0, 2.0, 3.0)) == Vec3(2.0, -1.0, 3.0));
}

TEST_CASE("quaternions multiply as Hamilton's units, and a length of 0 stays", "[math][analytic]") {
    const Eigen::Quaterniond i(0, 1, 0, 0), j(0, 0, 1, 0), k(0, 0, 0, 1);
    CHECK(ordered_product(i, j).coeffs() == k.coeffs());
    CHECK(ordered_product(j, k).coeffs() == i.coeffs());
    CHECK(ordered_product(k, i).coeffs() == j.coeffs());
    CHECK(ordered_product(j, i).coeffs() == Eigen::Vector4d(-k.coeffs()));
    CHECK(ordered_product(i, i).w() == -1.0);
    CHECK(ordered_normalized({1, 1, 1, 1}).coeffs() == Eigen::Vector4d::Constant(0.5));
    CHECK(ordered_normalized({0, 0, 0, 0}).coeffs() == Eigen::Vector4d::Zero());
}
