// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/live_edge/describe_edge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ice {

namespace {

// Share of all ice [-] below which an area is the rounding of sums and differences of areas.
// Larger values hide ice; smaller ones print "-7e-15 m2".
constexpr double kNoArea = 1e-9;

}  // namespace

IceAreas without_rounding(IceAreas areas) {
    const double all =
        areas.sheet + areas.pieces + areas.crushed + std::abs(areas.brash) + areas.astern;
    for (double* area : {&areas.crushed, &areas.brash})
        if (std::abs(*area) < kNoArea * all) *area = 0.0;
    return areas;
}

namespace {

std::string pieces_text(std::int64_t count) {
    return fmt::format("{} piece{}", count, count == 1 ? "" : "s");
}

// The published ranges are beside the numbers because they are the quickest check of a case:
// cracks far outside them mean a wrong strength, modulus or thickness.
std::string describe_strip(const LiveEdge& edge) {
    const IceAreas areas = without_rounding(edge.areas());
    const auto pieces = edge.pieces();
    std::string out = fmt::format(
        "level ice: {} broke off, {:.4g} m; crushed {:.3g} m, brash {:.3g} m; {} far astern taken "
        "out",
        pieces_text(edge.broken()), areas.pieces, areas.crushed, areas.brash,
        pieces_text(edge.retired()));
    if (pieces.empty()) return out;
    double length = 0.0, load = 0.0;
    for (const IcePiece& piece : pieces) {
        length += piece.radius;
        load += piece.load;
    }
    const auto count = static_cast<double>(pieces.size());
    return out + fmt::format(
                     "\nlevel ice: cracks {:.2g} m from the tip, {:.2g} thicknesses (ships: 3 to "
                     "10); {:.3g} kN/m each",
                     length / count, length / count / edge.thickness(), 1e-3 * load / count);
}

}  // namespace

std::optional<CrackParticulars> measure_cracks(const LiveEdge& edge) {
    const auto pieces = edge.pieces();
    if (edge.is_strip() || pieces.empty()) return std::nullopt;
    double radius = 0.0, load = 0.0, angle = 0.0;
    Eigen::AlignedBox1d channel;
    for (const IcePiece& piece : pieces) {
        radius += piece.radius;
        load += piece.load;
        // the opening angle of section 5, 2 A / R^2, at most that of a half disc
        angle += std::min(2.0 * area_of(piece.outline) / (piece.radius * piece.radius),
                          std::numbers::pi);
        for (const Vec2& p : piece.outline) channel.extend(Eigen::Matrix<double, 1, 1>(p.x()));
    }
    const auto count = static_cast<double>(pieces.size());
    // All ice that is gone from the channel, over the length along which pieces broke off: the mean
    // breadth of the channel.
    const IceAreas areas = without_rounding(edge.areas());
    const double broken = areas.pieces + areas.crushed + areas.brash;
    return CrackParticulars{.pieces = count,
                            .radius = radius / count,
                            .characteristic_length = edge.length(),
                            .thickness = edge.thickness(),
                            .opening_deg = angle / count * 180.0 / std::numbers::pi,
                            .load = load / count,
                            .channel_breadth = broken / channel.sizes().x()};
}

std::string describe_edge(const LiveEdge& edge) {
    if (edge.is_strip()) return describe_strip(edge);
    const IceAreas areas = without_rounding(edge.areas());
    std::string out = fmt::format(
        "level ice: {} broke off, {:.4g} m2; crushed {:.3g} m2, brash {:.3g} m2; {} far astern "
        "taken out",
        pieces_text(edge.broken()), areas.pieces, areas.crushed, areas.brash,
        pieces_text(edge.retired()));
    const auto cracks = measure_cracks(edge);
    if (!cracks) return out;
    return out +
           fmt::format(
               "\nlevel ice: cracks {:.2g} m from the load, {:.2g} characteristic lengths (ships: "
               "{}), {:.2g} thicknesses ({}); opening {:.0f} degrees; {:.3g} kN each; channel "
               "{:.3g} m broad",
               cracks->radius, cracks->per_length(), kCracksPerLength, cracks->per_thickness(),
               kCracksPerThickness, cracks->opening_deg, 1e-3 * cracks->load,
               cracks->channel_breadth);
}

}  // namespace ice
