// SPDX-License-Identifier: GPL-3.0-or-later
// Loads that break ice, against beams on water solved by finite elements.
//
// Tolerances: 5e-3 of a place is half an element beside the largest moment; 1e-3 is the constant
// 0.680, printed with three digits; 0.005 m is half of a last printed digit; 4e-3 is tan x - x at
// 0.1 rad.
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/bending/breaking_load.hpp"
#include "solver/bending/ice_plate.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kPi = std::numbers::pi;

// 1 m of sea ice.
const IcePlate kPlate{1.0, 5e5, 5e9, 0.3, 1025.0 * 9.81};

// A beam from x = 0 (free end) to its far end, of breadth x^taper, on a foundation:
//     (x^taper w'')'' + x^taper w = q,
// by cubic Hermite elements: the wedge on water in characteristic lengths (taper 1), or a beam of
// even breadth in lengths 1 / (sqrt 2 lambda) (taper 0).
struct BentBeam {
    double stress = 0.0;      // largest |w''|
    double at = 0.0;          // where
    double deflection = 0.0;  // at x = 0
};

template <class Load>
BentBeam bend(int taper, const Load& load, double tip_force, double finest) {
    std::vector<double> x{0.0};
    while (x.back() < 12.0) x.push_back(x.back() + finest * (x.back() < 2.0 ? 1.0 : 4.0));
    const auto n = static_cast<Eigen::Index>(2 * x.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(n);
    force[0] = tip_force;
    const double gauss[3][2]{{-std::sqrt(0.6), 5.0 / 9}, {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}};
    const auto curvature = [](double s, double h) -> Eigen::Vector4d {
        return Eigen::Vector4d(12 * s - 6, h * (6 * s - 4), 6 - 12 * s, h * (6 * s - 2)) / (h * h);
    };
    for (std::size_t e = 0; e + 1 < x.size(); ++e) {
        const double h = x[e + 1] - x[e];
        const auto first = static_cast<Eigen::Index>(2 * e);
        for (const auto& [g, weight] : gauss) {
            const double s = 0.5 * (1.0 + g), at = x[e] + s * h, breadth = taper ? at : 1.0;
            const Eigen::Vector4d value(1 - 3 * s * s + 2 * s * s * s, h * s * (1 - s) * (1 - s),
                                        s * s * (3 - 2 * s), h * s * s * (s - 1));
            const Eigen::Vector4d curve = curvature(s, h);
            for (int i = 0; i < 4; ++i) {
                force[first + i] += 0.5 * h * weight * load(at) * value[i];
                for (int j = 0; j < 4; ++j)
                    entries.emplace_back(
                        first + i, first + j,
                        0.5 * h * weight * breadth * (curve[i] * curve[j] + value[i] * value[j]));
            }
        }
    }
    Eigen::SparseMatrix<double> stiffness(n, n);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd w =
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness).solve(force);
    BentBeam out;
    out.deflection = w[0];
    for (std::size_t e = 0; e + 1 < x.size(); ++e) {
        const double h = x[e + 1] - x[e];
        const double bent =
            std::abs(curvature(0.5, h).dot(w.segment<4>(static_cast<Eigen::Index>(2 * e))));
        if (bent <= out.stress) continue;
        out.stress = bent;
        out.at = x[e] + 0.5 * h;
    }
    return out;
}

// The wedge under a unit force, spread evenly over its area from the tip to `ratio`. The bracket is
// M / x = P / (b0 bracket) at the worst place, from sigma = 6 M / (b0 x h^2) and
// P = b0 / 6 sigma h^2 bracket.
BentBeam bent_wedge(double ratio) {
    return bend(
        1, [&](double x) { return x < ratio ? 2.0 * x / (ratio * ratio) : 0.0; }, 0.0, 0.001);
}

}  // namespace

TEST_CASE("a wedge on water breaks under Nevel's load", "[bending][twin]") {
    // load length over l, bracket, radius of the crack over l, deflection of the tip: a wedge beam
    // solved elsewhere
    const auto [ratio, bracket, radius, deflection] =
        GENERATE(table<double, double, double, double>({{0.05, 1.151, 0.394, 2.127},
                                                        {0.1, 1.255, 0.511, 2.067},
                                                        {0.2, 1.452, 0.679, 1.951},
                                                        {0.3, 1.653, 0.811, 1.840},
                                                        {0.5, 2.102, 1.036, 1.632},
                                                        {0.7, 2.644, 1.241, 1.444}}));
    const BentBeam wedge = bent_wedge(ratio);
    CHECK(1.0 / wedge.stress == Near(bracket).epsilon(0.002));  // its last digit, and elements
    CHECK(wedge.at == Near(radius).epsilon(0.01));
    CHECK(wedge.deflection == Near(deflection).epsilon(0.001));
    CHECK(nevel_bracket(ratio) == Near(1.0 / wedge.stress).epsilon(0.01));
}

TEST_CASE("a beam on water breaks under its closed formula's load", "[bending][analytic][twin]") {
    // in lengths 1 / (sqrt 2 lambda) with E I = rho_w g = 1: P_f = sigma h^2 / 6 over the largest
    // moment of a unit force at the end
    const BentBeam beam = bend(
        0, [](double) { return 0.0; }, 1.0, 0.002);
    const double lambda = std::pow(3.0 * kPlate.water_weight / kPlate.elastic_modulus, 0.25);
    const double expected = kPlate.flexural_strength / 6.0 / beam.stress * std::sqrt(2.0) * lambda;
    CHECK(beam_breaking_load(kPlate) == Near(expected).epsilon(1e-3));
    CHECK(beam.at / std::sqrt(2.0) == Near(kPi / 4.0).epsilon(5e-3));
    // the printed form's three digits: 0.680
    CHECK(beam_breaking_load(kPlate) ==
          Near(0.680 * kPlate.flexural_strength *
               std::pow(kPlate.water_weight / kPlate.elastic_modulus, 0.25))
              .epsilon(1e-3));
}

TEST_CASE("loads grow with strength, thickness and angle as their formulas say",
          "[bending][analytic]") {
    IcePlate thick = kPlate;
    thick.thickness = 16.0;
    CHECK(characteristic_length(kPlate) == Near(14.61).margin(0.005));
    CHECK(characteristic_length(thick) == Near(8.0 * characteristic_length(kPlate)));
    CHECK(beam_breaking_load(thick) == Near(32.0 * beam_breaking_load(kPlate)));  // h^(5/4)
    // five wedges over a straight edge: 5/3 tan 18 deg x 1.05
    CHECK(wedge_breaking_load(kPlate, kPi, 0.0) ==
          Near(1.75 * std::tan(kPi / 10.0) * kPlate.flexural_strength));
    // a load spread over a fifth of l
    CHECK(wedge_breaking_load(kPlate, kPi, 0.2 * characteristic_length(kPlate)) ==
          Near(5.0 / 3.0 * std::tan(kPi / 10.0) * 1.454 * kPlate.flexural_strength));
    // one narrow wedge
    CHECK(wedge_breaking_load(kPlate, 0.5, 0.0) ==
          Near(std::tan(0.25) * 0.35 * kPlate.flexural_strength));
    CHECK(kashtelyan_breaking_load(kPlate, kPi / 2) == Near(0.25 * kPlate.flexural_strength));
    CHECK(kashtelyan_breaking_load(kPlate, kPi) == Near(kPlate.flexural_strength));
}

TEST_CASE("a piece's outline does not depend on how it is turned", "[bending][analytic]") {
    const TriangleMesh box = test::make_box_mesh(Vec3(4, 3, 0.5));
    const Mat3 turn =
        Eigen::AngleAxisd(GENERATE(0.0, 0.4, 1.0, 2.5), Vec3::UnitZ()).toRotationMatrix();
    const PieceOutline piece = measure_outline(box, turn);
    CHECK(piece.area == Near(12.0));
    CHECK(piece.depth == Near(2.0 * 12.0 / 5.0));  // both corners' heights over the diagonal
    CHECK(piece.thickness == Near(0.5));
    CHECK(opening_angle(piece) == Near(24.0 / (4.8 * 4.8)));
}

TEST_CASE("a piece stands for the sector of its area and depth", "[bending][analytic]") {
    CHECK(opening_angle({0.5 * kPi * 9.0, 3.0, 1.0}) == Near(kPi));  // a half disc
    CHECK(opening_angle({0.5 * 0.8 * 9.0, 3.0, 1.0}) == Near(0.8));  // a sector of 0.8 rad
    CHECK(opening_angle({100.0, 3.0, 1.0}) == kPi);                  // a long strip
    CHECK(opening_angle({3.0, 0.0, 1.0}) == kPi);
    // a slender wedge, tip to crack: its angle to the third order
    const double half = 0.1;
    CHECK(opening_angle({std::tan(half), 1.0, 1.0}) == Near(2.0 * half).epsilon(4e-3));
}

TEST_CASE("a piece's load has the case's factor, angle and table", "[bending]") {
    Case p;
    p.water_density = 1025.0;
    const PieceOutline piece{0.25 * kPi, 1.0, 1.0};  // a quarter disc
    CHECK(breaking_load(piece, p) == Near(wedge_breaking_load(kPlate, kPi / 2, 0.0)));
    p.bending.model = BendingModel::kashtelyan;
    p.bending.factor = 3.1;
    CHECK(breaking_load(piece, p) == Near(3.1 / 4.0 * 5e5));
    p.bending.opening_angle = kPi;
    CHECK(breaking_load(piece, p) == Near(3.1 * 5e5));
    CHECK(speed_factor(p.bending, 2.0) == 1.0);
    p.bending.factor_table = {{0.0, 1.0}, {1.0, 3.0}};
    CHECK(speed_factor(p.bending, -1.0) == 1.0);
    CHECK(speed_factor(p.bending, 0.5) == Near(2.0));
    CHECK(speed_factor(p.bending, 5.0) == 3.0);
    p.dimension = 2;
    CHECK(breaking_load(piece, p) == Near(3.1 * beam_breaking_load(kPlate)));
}
