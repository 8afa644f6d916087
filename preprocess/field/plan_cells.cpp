// SPDX-License-Identifier: GPL-3.0-or-later
// Patterns "voronoi" and "power-law": random sites, the cells around them, and floes that are
// these cells made smaller.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/base/counter_random.hpp"
#include "common/base/error.hpp"
#include "preprocess/field/fit_cells.hpp"
#include "preprocess/field/plan_floes.hpp"

namespace ice {

namespace {

// Area of the floes over the field's at most [-]: shrunk() drops short edges, which needs some
// water. A larger value lets floes reach beyond their cells, into each other; a smaller one refuses
// fields that have room.
constexpr double kDensest = 0.975;
// Length over a cell's size [-] up to which an edge ends in one corner: spheres have no room on
// shorter ones. A larger value leaves floes with fewer corners, a smaller one keeps edges without a
// sphere of their own.
constexpr double kShortEdge = 0.02;
// Miss of the mean size [-] beyond which the count of floes is corrected, once. A larger value
// leaves the mean farther from the one wanted; a smaller one plans the floes a second time more
// often.
constexpr double kSizeMiss = 0.005;
// Error of an area over the smallest area [-]: while sites still move, and of the final cells.
// Smaller ones take more Newton steps.
constexpr double kRoughFit = 0.1;
constexpr double kFit = 1e-6;

// Streams of random numbers: no two uses share one.
constexpr std::uint64_t kPlaces = 0, kSizes = std::uint64_t{1} << 40;

double disc(double size) { return 0.25 * std::numbers::pi * size * size; }

std::vector<Vec2> random_sites(const Rectangle& area, std::size_t count, std::int64_t seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    std::vector<Vec2> sites;
    for (std::size_t k = 0; k < count; ++k)
        sites.push_back(area.min() +
                        area.sizes().cwiseProduct(Vec2(random_unit(s, kPlaces + 2 * k),
                                                       random_unit(s, kPlaces + 2 * k + 1))));
    return sites;
}

void move_to_centroids(const std::vector<PowerCell>& cells, std::vector<Vec2>& sites) {
    for (std::size_t k = 0; k < sites.size(); ++k)
        if (!cells[k].corners.empty()) sites[k] = centroid_of(cells[k].corners);
}

// A cell without its short edges, of the given area about its centroid: inside the cell, since it
// is convex and the floe smaller.
Outline shrunk(const Outline& cell, double area) {
    const double shortest = kShortEdge * std::sqrt(area);
    Outline out;
    for (const Vec2& corner : cell)
        if (out.empty() || (corner - out.back()).norm() >= shortest) out.push_back(corner);
    while (out.size() > 3 && (out.front() - out.back()).norm() < shortest) out.pop_back();
    out = without_straight_corners(out);
    const Vec2 centre = centroid_of(out);
    const double scale = std::sqrt(area / area_of(out));
    for (Vec2& corner : out) corner = centre + scale * (corner - centre);
    return out;
}

void refuse_count(double count) {
    if (count > kMostFloes)
        throw bad_input("area.size", fmt::format("would take {:.3g} floes", count),
                        "a million is the most: use a smaller area or larger floes");
    if (count < 1.0)
        throw bad_input("area.size",
                        "is too small for a single floe of this size and concentration",
                        "use a larger area, smaller floes or a higher concentration");
}

std::vector<Outline> voronoi_floes(const FieldSpec& s, const Rectangle& area, std::size_t count) {
    std::vector<Vec2> sites = random_sites(area, count, s.seed);
    const std::vector<double> weights(count, 0.0);
    std::vector<PowerCell> cells = power_cells(sites, weights, area);
    for (int round = 0; round < s.relaxations; ++round) {
        move_to_centroids(cells, sites);
        cells = power_cells(sites, weights, area);
    }
    std::vector<Outline> out;
    for (const PowerCell& cell : cells)
        // every cell by the same share, so that the field has its concentration everywhere
        out.push_back(shrunk(cell.corners, s.concentration * area_of(cell.corners)));
    return out;
}

double mean_size(const std::vector<Outline>& floes) {
    double sum = 0.0;
    for (const Outline& floe : floes) sum += size_of(floe);
    return sum / static_cast<double>(floes.size());
}

// Cells differ, so that their mean size is a little below that of equal ones.
std::vector<Outline> plan_voronoi(const FieldSpec& s, const Rectangle& area) {
    const double equal = s.concentration * area.volume() / disc(s.mean_size);
    refuse_count(std::round(equal));
    auto floes = voronoi_floes(s, area, static_cast<std::size_t>(std::lround(equal)));
    const double ratio = mean_size(floes) / s.mean_size;
    // the number of floes is proportional to 1 / size^2
    const double better = std::round(static_cast<double>(floes.size()) * ratio * ratio);
    if (std::abs(ratio - 1.0) > kSizeMiss && better >= 1.0 &&
        better != static_cast<double>(floes.size()))
        floes = voronoi_floes(s, area, static_cast<std::size_t>(better));
    return floes;
}

// Mean of d^2 over N(> d) ~ d^-a between the bounds [m2].
double mean_square(const FieldSpec& s) {
    const double a = s.exponent, low = s.smallest, high = s.largest;
    const double share = std::pow(low, -a) - std::pow(high, -a);
    // the limit of the expression below for a -> 2
    if (std::abs(a - 2.0) < 1e-6) return 2.0 * std::log(high / low) / share;
    return a / (2.0 - a) * (std::pow(high, 2.0 - a) - std::pow(low, 2.0 - a)) / share;
}

// As many floes as there is ice for, one in each of that many equal parts of the distribution: a
// few large floes more or less would change the concentration.
std::vector<double> draw_areas(const FieldSpec& s, double ice) {
    const double count = std::round(ice / disc(std::sqrt(mean_square(s))));
    refuse_count(count);
    const double low = std::pow(s.smallest, -s.exponent), high = std::pow(s.largest, -s.exponent);
    std::vector<double> areas;
    for (std::size_t k = 0; static_cast<double>(k) < count; ++k) {
        const double u =
            (static_cast<double>(k) + random_unit(static_cast<std::uint64_t>(s.seed), kSizes + k)) /
            count;
        // the share u of the floes, counted from the smallest, has diameters below this one
        areas.push_back(disc(std::pow(low + u * (high - low), -1.0 / s.exponent)));
    }
    return areas;
}

std::vector<Outline> plan_power_law(const FieldSpec& s, const Rectangle& area) {
    const std::vector<double> floes = draw_areas(s, s.concentration * area.volume());
    double sum = 0.0;
    for (const double floe : floes) sum += floe;
    if (sum > kDensest * area.volume())
        throw bad_input("area.size",
                        fmt::format("is too small for {} floes of these sizes", floes.size()),
                        "use a larger area or a narrower range of sizes");
    std::vector<double> wanted;  // a cell per floe, all the water shared
    for (const double floe : floes) wanted.push_back(floe * area.volume() / sum);

    std::vector<Vec2> sites = random_sites(area, floes.size(), s.seed);
    // the sites move after every round, so that a rough fit will do; only the last one must be
    // exact
    std::vector<double> weights(floes.size(), 0.0);
    std::vector<PowerCell> cells;
    for (int round = 0; round < s.relaxations; ++round) {
        cells = fit_cells(sites, wanted, area, kRoughFit, weights);
        move_to_centroids(cells, sites);
    }
    cells = fit_cells(sites, wanted, area, kFit, weights);
    std::vector<Outline> out;
    for (std::size_t k = 0; k < floes.size(); ++k) {
        // fit_cells returns the cells of its last step, whether their areas are met or not
        const double got = cells[k].corners.empty() ? 0.0 : area_of(cells[k].corners);
        if (std::abs(got - wanted[k]) > 1e-3 * wanted[k])
            throw run_failed("floes", "no cells of these sizes were found",
                             "try another seed, a larger area or a narrower range of sizes");
        out.push_back(shrunk(cells[k].corners, floes[k]));
    }
    return out;
}

}  // namespace

FieldPlan plan_cells(const FieldSpec& s) {
    FieldPlan plan;
    const Vec2 low(s.origin[0], s.origin[1] - 0.5 * s.extent[1]);
    plan.area = Rectangle(low, Vec2(low + Vec2(s.extent[0], s.extent[1])));
    plan.loose = s.pattern == FieldPattern::voronoi ? plan_voronoi(s, plan.area)
                                                    : plan_power_law(s, plan.area);
    return plan;
}

}  // namespace ice
