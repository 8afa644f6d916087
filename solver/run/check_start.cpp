// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/check_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"
#include "common/formats/widest_spacing.hpp"
#include "solver/record/solid_overlap.hpp"
#include "solver/run/check_sheet.hpp"
#include "solver/run/unfelt_hull.hpp"
#include "solver/scene/ice_extent.hpp"
#include "solver/scene/tunnelling_speed.hpp"

namespace ice {

namespace {

// A part of the hull in the ice belt that is worth a warning when no sphere represents it: the
// edges of a deck or a transom in full-bodied hulls stay below it. A share of the area [-]: a
// larger one leaves such parts unsaid, a smaller one warns of edges; only the warning depends on
// it.
constexpr double kWorryingUnfelt = 0.005;

// Pairs that a message names [-]. More hide the advice.
constexpr std::size_t kMostNamed = 5;

const Shape& shape_of(const Scene& scene, std::int32_t body) {
    return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
}

double smallest_radius(const Shape& shape) {
    return *std::min_element(shape.radius.begin(), shape.radius.end());
}

// All pairs whose bounds meet, held floes among them, but not unbroken ice with unbroken ice.
std::vector<BodyPair> pairs_at_start(Scene& scene, const Case& parameters) {
    Bodies& b = scene.bodies;
    std::vector<BodyPair> pairs;
    std::vector<std::uint8_t> all_free(b.size(), 0);
    b.held.swap(all_free);  // or two held floes would be no pair
    list_moving(b);
    find_pairs(scene, 0.0, pairs);
    b.held.swap(all_free);
    list_moving(b);
    const auto stays = [&](std::int32_t i) {
        return i > 0 && parameters.floes[static_cast<std::size_t>(b.group[i])].hold == Hold::always;
    };
    std::erase_if(pairs, [&](const BodyPair& p) { return stays(p.a) && stays(p.b); });
    return pairs;
}

// Where floes lie in heaps, some of the heap's overlaps are enough: floes that do not overlap have
// some 30 others within their bounds at most.
std::size_t most_worth_a_look(const Scene& scene) { return 1000 + 100 * scene.bodies.size(); }

// Bodies of the sheet of level ice have no number that a user knows.
std::string name_of(const World& w, std::int32_t body) {
    if (body == 0) return "the hull";
    return w.edge.has_slot(static_cast<std::size_t>(body)) ? std::string("the level ice")
                                                           : fmt::format("floe {}", body);
}

std::string describe(const World& w, const StartOverlap& o) {
    const std::string who =
        o.inside < 0 ? fmt::format("{} and {}", name_of(w, o.a), name_of(w, o.b))
                     : fmt::format("{} lies wholly inside {}: they", name_of(w, o.inside),
                                   name_of(w, o.inside == o.a ? o.b : o.a));
    return fmt::format(
        "{} overlap by {:.3g} m at the start, at x = {:.2f}, y = {:.2f}, z = {:.2f} m", who,
        o.depth, o.point.x(), o.point.y(), o.point.z());
}

std::string describe(const World& w, const std::vector<StartOverlap>& overlaps,
                     const char* separator) {
    std::string text;
    for (std::size_t k = 0; k < std::min(overlaps.size(), kMostNamed); ++k)
        text += (k > 0 ? separator : "") + describe(w, overlaps[k]);
    if (overlaps.size() > kMostNamed)
        text += fmt::format("{}and {} pairs more", separator, overlaps.size() - kMostNamed);
    return text;
}

// How to separate them. The first remedy needs no new field: for a hull in loose ice, the place at
// which its bow lies before all of it.
std::string remedy(const World& w, const std::vector<StartOverlap>& overlaps) {
    const bool in_sheet = std::any_of(overlaps.begin(), overlaps.end(), [&](const auto& o) {
        return o.a != kShip && w.edge.has_slot(static_cast<std::size_t>(o.b));
    });
    if (in_sheet)
        return "a sheet has no openings for [[floes]]: lay them beside level_ice.extent, or leave "
               "one of the two out; --allow-overlap runs it all the same";
    std::string move = "move the hull (hull.position)";
    const Eigen::AlignedBox2d& ice = w.scene.start.loose;
    const bool in_hull = std::any_of(overlaps.begin(), overlaps.end(), [&](const auto& o) {
        return o.a == kShip && !is_unbroken(w.scene, w.parameters, static_cast<std::size_t>(o.b));
    });
    if (in_hull && !ice.isEmpty() && w.parameters.ship_speed(0.0) > 0.0) {
        const double ahead = box_of(w.scene, kShip).max().x() - ice.min().x();
        const double x = std::floor(10.0 * (w.scene.bodies.position[kShip].x() - ahead)) / 10.0;
        move += fmt::format(": with x = {:g} m its bow lies before the ice", x);
    }
    return move +
           ", widen floes.gap or lower simulation.jitter; --allow-overlap runs it all the same";
}

// The set with the widest spacing, if spheres of other bodies pass between its own.
void warn_of_spacing(const World& w, std::vector<Warning>& warnings) {
    const bool centres = w.parameters.normal == NormalRule::centres;
    // the limits of both rules: with "surface" a sphere's feature reaches farther than the
    // sphere
    const double limit = centres ? 2.0 : kWidestSpacing;
    std::vector<double> in_radii;
    for (const Shape& shape : w.scene.shapes)
        in_radii.push_back(shape.spacing / smallest_radius(shape));
    // of the hull and of floes that were laid; check_sheet() says it of level ice
    const std::vector<std::int32_t>& row = w.scene.bodies.shape;
    const auto end = w.edge.has_sheet()
                         ? row.begin() + static_cast<std::ptrdiff_t>(w.edge.first_body())
                         : row.end();
    const auto widest = std::max_element(row.begin(), end, [&](auto l, auto r) {
        return in_radii[static_cast<std::size_t>(l)] < in_radii[static_cast<std::size_t>(r)];
    });
    if (in_radii[static_cast<std::size_t>(*widest)] <= limit * (1.0 + kSpacingRounding)) return;
    const Shape& shape = w.scene.shapes[static_cast<std::size_t>(*widest)];
    const std::string text = fmt::format(
        "the surface spheres of {} are {:.3g} m apart; above {:g} radii corners may pass between "
        "them{}: make its set with a spacing of {:.3g} m",
        name_of(w, static_cast<std::int32_t>(widest - row.begin())), shape.spacing, limit,
        centres ? " (contact.normal = \"centres\")" : "", limit * smallest_radius(shape));
    warnings.push_back({text});
}

// The hull between the ice's lower side and the water line, where no sphere fits.
// Do ship and floes meet as solids, without the hull's spheres?
bool meet_as_solids(const World& w) {
    const std::vector<Shape>& shapes = w.scene.shapes;
    return w.parameters.normal == NormalRule::surface && w.parameters.contact.is_rigid() &&
           std::none_of(shapes.begin(), shapes.end(),
                        [](const Shape& shape) { return shape.convex.empty(); });
}

void warn_of_unfelt_hull(const World& w, std::vector<Warning>& warnings) {
    if (w.scene.dimension != 3 || meet_as_solids(w)) return;
    // how deep any ice floats: below it the hull meets none at the start
    double low = 0.0;
    for (std::size_t i = 1; i < w.scene.bodies.size(); ++i)
        low = std::min(low, box_of(w.scene, i).min().z());
    const UnfeltHull hull = measure_unfelt_hull(w.scene, low, 0.0);
    if (hull.share <= kWorryingUnfelt) return;
    const double radius = w.scene.shapes[0].largest_radius;
    warnings.push_back({fmt::format(
        "no contact sphere represents {:.2g} % of the hull between the water line and {:.3g} m "
        "below it (farthest from a sphere: {:.3g} m, at x = {:.2f}, y = {:.2f}, z = {:.2f} m of "
        "the ship); no contact acts there and ice can enter the hull: make the hull's set with "
        "spheres smaller than {:.3g} m",
        100.0 * hull.share, -low, hull.distance, hull.at.x(), hull.at.y(), hull.at.z(), radius)});
}

void warn_of_speed(const World& w, std::vector<Warning>& warnings) {
    const Case& p = w.parameters;
    const double limit = tunnelling_speed(w.scene, p.time_step);
    // rows of the table beyond the end are never reached: the end itself counts instead
    double ship = std::abs(p.ship_speed(p.duration));
    for (const auto& [time, speed] : p.speed_table)
        if (time <= p.duration) ship = std::max(ship, std::abs(speed));
    double fastest = ship;
    std::int32_t who = 0;
    const Bodies& b = w.scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i) {
        // floes that drift meet the ship with the relative speed
        const double speed = (b.velocity[i] - b.velocity[kShip]).norm();
        if (speed <= fastest) continue;
        fastest = speed;
        who = static_cast<std::int32_t>(i);
    }
    if (fastest <= limit) return;
    const std::string text = fmt::format(
        "{} moves at {:.3g} m/s, but bodies may pass through each other above {:.3g} m/s, a "
        "contact sphere's diameter per step: lower simulation.time_step to {:.2g} s",
        who == 0 ? "the ship" : name_of(w, who) + ", seen from the ship,", fastest, limit,
        p.time_step * limit / fastest);
    warnings.push_back({text});
}

}  // namespace

std::vector<StartOverlap> find_start_overlaps(Scene& scene, const Case& parameters) {
    std::vector<BodyPair> pairs = pairs_at_start(scene, parameters);
    // a heap of floes would give millions of pairs; some of them suffice for the message
    pairs.resize(std::min(pairs.size(), most_worth_a_look(scene)));
    std::vector<StartOverlap> found(pairs.size());
    parallel_for(pairs.size(), 2, [&](std::size_t k) {
        const auto [a, b] = pairs[k];
        const PairOverlap pair = measure_overlap(scene, a, b);
        found[k] = {a, b, pair.depth, pair.point, pair.inside};
    });

    // A contact may be deeper than the meshes alone show: the larger depth counts.
    std::vector<Contact> contacts;
    ContactFinder().find(scene, pairs, ContactRule(parameters), 0.0, 0.0, contacts);
    std::size_t k = 0;
    for (const Contact& c : contacts) {
        while (found[k].a != c.a || found[k].b != c.b) ++k;  // both in the order of the pairs
        // face planes extend beyond the vertex where the faces end: a gap below zero there is no
        // overlap
        if (-c.gap <= found[k].depth || !is_inside(scene, c.a, c.point) ||
            !is_inside(scene, c.b, c.point))
            continue;
        found[k].depth = -c.gap;
        found[k].point = c.point;
    }
    // overlap that position correction tolerates, (12), is no fault of the case
    std::erase_if(found, [&](const StartOverlap& o) {
        return o.depth <= kToleratedOverlap * std::min(smallest_radius(shape_of(scene, o.a)),
                                                       smallest_radius(shape_of(scene, o.b)));
    });
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& l, const auto& r) { return l.depth > r.depth; });
    return found;
}

std::vector<Warning> check_start(World& world, bool allow_overlap) {
    std::vector<Warning> warnings;
    const auto overlaps = find_start_overlaps(world.scene, world.parameters);
    if (!overlaps.empty() && !allow_overlap)
        throw bad_input(world.parameters.file.string(), describe(world, overlaps, "\n  "),
                        remedy(world, overlaps));
    if (!overlaps.empty()) warnings.push_back({describe(world, overlaps, "; ")});
    warn_of_speed(world, warnings);
    warn_of_spacing(world, warnings);
    for (Warning& warning : check_sheet(world, allow_overlap))
        warnings.push_back(std::move(warning));
    warn_of_unfelt_hull(world, warnings);
    return warnings;
}

}  // namespace ice
