// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/separation.hpp"
#include "solver/narrow/manifold/check_depths.hpp"
#include "solver/narrow/manifold/deep_seats.hpp"
#include "solver/narrow/manifold/find_polygon.hpp"
#include "solver/narrow/manifold/make_centre_contacts.hpp"
#include "solver/narrow/manifold/make_contacts.hpp"
#include "solver/narrow/manifold/measure_spheres.hpp"
#include "solver/narrow/manifold/reduce_manifold.hpp"
#include "solver/narrow/neighbours/search_pair.hpp"

namespace ice {

namespace {

// A pair takes some microseconds, its state a twentieth of that: below this many [-], waking
// threads costs more than they save. With 256 one of two threads waited for a fifth of the packed
// scene's narrow phase. Results do not depend on it.
constexpr std::size_t kSerialPairs = 64, kSerialStates = 1024;

// Sets pair.candidates to the contacts of a pair.
// @pre the bodies are apart (separation) by no more than the margin
void search_contacts(const PairView& view, double margin, FoundBatch::Pair& pair) {
    // search in floats, measurement in doubles, meshes for deep ones, then reduction
    const SphereRange range(view, margin);
    pair.spheres.clear();
    pair.search.for_each_near(view, range.margin, range.patch_radius,
                              [&](std::int32_t i, std::int32_t j) {
                                  pair.spheres.push_back({i, j});
                              });
    group_by_types(view, pair.rows, pair.spheres);
    measure_spheres(view, range, pair.spheres, pair.candidates);
    check_depths(view, pair.candidates);
    reduce_manifold(view, margin, pair.reduction, pair.candidates);
}

// The same for spheres that are known to be near.
void measure_known(const PairView& view, double margin, std::span<const SpherePair> near,
                   FoundBatch::Pair& pair) {
    measure_spheres(view, SphereRange(view, margin), near, pair.candidates);
    check_depths(view, pair.candidates);
    reduce_manifold(view, margin, pair.reduction, pair.candidates);
}

// The spheres that may be candidates while the pair moves within `skin`, and the least gap that
// they may have, less that motion; appends them.
double find_near(const PairView& view, double margin, const Skin& skin, FoundBatch::Pair& pair,
                 std::vector<SpherePair>& out) {
    const std::size_t first = out.size();
    const SphereRange range(view, margin + skin.distance);
    pair.search.for_each_near(view, range.margin, range.patch_radius + skin.distance,
                              [&](std::int32_t i, std::int32_t j) {
                                  out.push_back({i, j});
                              });
    return bound_spheres(view, range.patch_radius, skin, first, pair.rows, out);
}

// Are these two spheres? In a list seats (list_near_seats) come behind them.
bool is_pair(const SpherePair& s) { return s.a >= 0 && s.b >= 0; }

// Spheres of deep bodies have passed each other: their solids tell which contacts are lost. Those
// of two convex ones are the polygon's corners, of others their deep seats.
void find_lost(const PairView& view, double apart, double most, FoundBatch::Pair& pair) {
    pair.polygon.corners.clear();
    pair.seats.clear();
    if (is_deep(view, apart))
        find_lost_polygon(view, pair.candidates, most, pair.clipping, pair.polygon);
    pair.spheres.clear();
    list_near_seats(view, apart, 0.0, pair.spheres);
    find_deep_seats(view, pair.spheres, pair.candidates, pair.seats);
}

// The exact axes of two convex solids; early out where they are farther apart than `enough` [m].
SeparatingAxes axes_of(const PairView& view, double enough) {
    const SolidPair solids = solids_of(view);
    return find_axes(solids.a, solids.b, solids.pose, enough);
}

}  // namespace

void ContactFinder::begin_batches() {
    batches_.prepare();
    batches_.for_each([](FoundBatch& batch) { batch.clear(); });
}

// Keeps the corners of the polygon in which two solids meet, if they do.
void ContactFinder::meet(const PairView& view, ContactRule rule, const SeparatingAxes& axes,
                         const Within& within, Found& found, FoundBatch& batch) {
    if (axes.widest() > within.most) return;
    const SolidPair solids = solids_of(view);
    find_polygon(solids, axes, within.most, {view, within.step}, batch.pair.clipping,
                 batch.pair.polygon);
    if (!rule.crushes) return keep_polygon(found, batch);
    found.corners.first = batch.corners.size();
    append_pressed(solids, batch.pair.polygon, batch.pair.section, batch.corners);
    found.corners.count = batch.corners.size() - found.corners.first;
}

// The same for bodies in several parts.
void ContactFinder::meet_parts(const PairView& view, double most, Found& found, FoundBatch& batch) {
    found.corners.first = batch.corners.size();
    find_part_polygons(view.shape_a.parts, view.shape_b.parts,
                       {view.rotation_ab, view.translation_ab}, most, batch.pair.parts,
                       batch.corners);
    found.corners.count = batch.corners.size() - found.corners.first;
}

void ContactFinder::keep_polygon(Found& found, FoundBatch& batch) {
    found.corners = {batch.corners.size(), batch.pair.polygon.corners.size()};
    for (const PolygonCorner& corner : batch.pair.polygon.corners)
        batch.corners.push_back({corner, batch.pair.polygon.normal});
}

void ContactFinder::keep_all(Found& found, FoundBatch& batch) {
    found.candidates = FoundPart::append(batch.pair.candidates, batch.candidates);
    keep_polygon(found, batch);
    found.seats = FoundPart::append(batch.pair.seats, batch.seats);
}

void ContactFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs, ContactRule rule,
                         double dt, double margin, std::vector<Contact>& out) {
    if (rule.normal == NormalRule::centres) {
        MotionBounds motion;  // no paths yet: all pairs are measured
        motion.update(scene, dt);
        return CentresFinder().find(scene, pairs, motion, dt, margin, out);
    }
    // without lists every pair is measured, for worlds of one step and for tests
    pairs_to_measure_.resize(pairs.size());
    std::iota(pairs_to_measure_.begin(), pairs_to_measure_.end(), std::size_t{0});
    found_.assign(pairs.size(), Found{});
    begin_batches();
    parallel_for(pairs.size(), kSerialPairs, [&](std::size_t k) {
        FoundBatch& batch = batches_.own();
        // Contacts are wanted up to the distance that the pair can close in the step (section
        // 2, margin).
        const double most = dt * closing_speed(scene, pairs[k]) + margin;
        const PairView view(scene, pairs[k]);
        found_[k].batch = &batch;
        switch (pair_rule_of(scene, pairs[k], rule)) {
            case PairRule::parts:
                return meet_parts(view, most, found_[k], batch);
            case PairRule::solids:
                return meet(view, rule, axes_of(view, most), {dt, margin, most}, found_[k], batch);
            case PairRule::spheres:
                break;
        }
        batch.pair.candidates.clear();
        const double apart = separation(view);
        if (apart <= most) search_contacts(view, most, batch.pair);
        find_lost(view, apart, most, batch.pair);
        keep_all(found_[k], batch);
    });
    emit(scene, pairs, rule, out);
}

void ContactFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs,
                         const MotionBounds& motion, ContactRule rule, double dt, double margin,
                         std::vector<Contact>& out) {
    if (rule.normal == NormalRule::centres)
        return centres_.find(scene, pairs, motion, dt, margin, out);
    cache_.carry_over(pairs);
    // The state of a pair costs a comparison of path lengths; only pairs that the cache cannot
    // prove apart are measured.
    states_.resize(pairs.size());
    parallel_for(pairs.size(), kSerialStates, [&](std::size_t k) {
        states_[k] = cache_.state(k, scene, pairs[k], motion, dt, margin,
                                  pair_rule_of(scene, pairs[k], rule));
    });
    pairs_to_measure_.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (states_[k] != PairCache::State::separated) pairs_to_measure_.push_back(k);
    found_.assign(pairs_to_measure_.size(), Found{});
    begin_batches();
    parallel_for(pairs_to_measure_.size(), kSerialPairs, [&](std::size_t n) {
        const std::size_t k = pairs_to_measure_[n];
        FoundBatch& batch = batches_.own();
        found_[n].batch = &batch;
        const double most = dt * closing_speed(scene, pairs[k]) + margin;
        if (states_[k] != PairCache::State::polygon)
            find_listed(scene, pairs[k], k, motion, {dt, margin, most}, found_[n], batch);
        else if (pair_rule_of(scene, pairs[k], rule) == PairRule::parts)
            meet_parts(PairView(scene, pairs[k]), most, found_[n], batch);
        else
            meet(PairView(scene, pairs[k]), rule, cache_.axes(k), {dt, margin, most}, found_[n],
                 batch);
    });
    // Lists are stored by one thread, in the order of the pairs: their places do not depend on the
    // threads.
    for (std::size_t n = 0; n < pairs_to_measure_.size(); ++n) {
        const Found& found = found_[n];
        if (found.renewed)
            cache_.keep(pairs_to_measure_[n], found.spheres.of(found.batch->spheres));
    }
    emit(scene, pairs, rule, out);
}

void ContactFinder::find_listed(const Scene& scene, BodyPair pair, std::size_t k,
                                const MotionBounds& motion, const Within& within, Found& found,
                                FoundBatch& batch) {
    const PairView view(scene, pair);
    std::span<const SpherePair> near = cache_.listed(k);
    if (states_[k] == PairCache::State::stale) {
        const Skin skin = skin_of(scene, pair, within.step);
        if (!lasts(scene, pair, skin, within.step)) {  // too fast for a list
            search_contacts(view, within.most, batch.pair);
            find_lost(view, cache_.apart(k), within.most, batch.pair);
            return keep_all(found, batch);
        }
        // the skin is used up: a new list, with a skin that lasts for some steps
        found.spheres.first = batch.spheres.size();
        const double least = find_near(view, within.margin, skin, batch.pair, batch.spheres);
        const double seats = list_near_seats(view, cache_.apart(k), skin.distance, batch.spheres);
        found.spheres.count = batch.spheres.size() - found.spheres.first;
        found.renewed = true;
        near = found.spheres.of(batch.spheres);
        cache_.renew(k, view, motion, skin,
                     {std::min(least - within.margin, skin.distance), seats});
        if (cache_.state(k, scene, pair, motion, within.step, within.margin, PairRule::spheres) ==
            PairCache::State::separated)
            return;
    }
    const auto seats = std::partition_point(near.begin(), near.end(), is_pair);
    measure_known(view, within.most, {near.begin(), seats}, batch.pair);
    // as find_lost, where the cache cannot rule it out
    batch.pair.polygon.corners.clear();
    batch.pair.seats.clear();
    if (cache_.may_be_deep(k)) {
        if (is_convex_pair(view))
            find_lost_polygon(view, batch.pair.candidates, within.most, batch.pair.clipping,
                              batch.pair.polygon);
        else
            find_deep_seats(view, {seats, near.end()}, batch.pair.candidates, batch.pair.seats);
    }
    keep_all(found, batch);
}

// Lists of "centres" are dropped as a whole: they cannot drop single rows.
void ContactFinder::forget(const std::vector<std::int32_t>& bodies) {
    cache_.forget(bodies);
    centres_ = {};
}

void ContactFinder::emit(const Scene& scene, const std::vector<BodyPair>& pairs, ContactRule rule,
                         std::vector<Contact>& out) {
    // Counted first, then made in place by all threads: the order is that of the pairs, whatever
    // the number of threads.
    std::size_t contacts = 0;
    for (Found& found : found_) {
        found.contact = contacts;
        contacts += found.candidates.count + found.corners.count + found.seats.count;
    }
    out.resize(contacts);
    parallel_for(found_.size(), kSerialPairs, [&](std::size_t n) {
        // a pair's contacts: its candidates, then the polygon's corners or the deep seats
        const Found& found = found_[n];
        Contact* const first = out.data() + found.contact;
        if (found.corners.count > 0)
            make_polygon_contacts(PairView(scene, pairs[pairs_to_measure_[n]]), rule,
                                  found.corners.of(found.batch->corners),
                                  first + found.candidates.count);
        if (found.seats.count > 0)
            make_seat_contacts(PairView(scene, pairs[pairs_to_measure_[n]]), rule,
                               found.seats.of(found.batch->seats), first + found.candidates.count);
        if (found.candidates.count > 0)
            make_contacts(PairView(scene, pairs[pairs_to_measure_[n]]),
                          found.candidates.of(found.batch->candidates),
                          batches_.own().pair.contacts, first);
    });
}

namespace reference {

void find_contacts(const Scene& scene, BodyPair pair, ContactRule how, double margin,
                   std::vector<Contact>& out) {
    const PairView view(scene, pair);
    FoundBatch::Pair found;
    std::vector<MetCorner> corners;
    const auto append_polygon = [&] {
        for (const PolygonCorner& corner : found.polygon.corners)
            corners.push_back({corner, found.polygon.normal});
        out.resize(out.size() + corners.size());
        make_polygon_contacts(view, how, corners, out.data() + (out.size() - corners.size()));
    };
    const PairRule kind = pair_rule_of(scene, pair, how);
    if (kind == PairRule::parts)
        find_part_polygons(view.shape_a.parts, view.shape_b.parts,
                           {view.rotation_ab, view.translation_ab}, margin, found.parts, corners);
    if (kind == PairRule::solids) {
        const SeparatingAxes axes = axes_of(view, margin);
        if (axes.widest() <= margin)
            find_polygon(solids_of(view), axes, margin, {}, found.clipping, found.polygon);
        if (how.crushes) append_pressed(solids_of(view), found.polygon, found.section, corners);
        if (how.crushes) found.polygon.corners.clear();
    }
    if (kind != PairRule::spheres) return append_polygon();
    const double apart = separation(view);
    if (apart > margin) return;
    const bool centres = how.normal == NormalRule::centres;
    std::vector<Candidate>& candidates = found.candidates;
    // by brute force: every sphere of one body with every sphere of the other
    for (std::int32_t i = 0; i < std::ssize(view.shape_a.center); ++i)
        for (std::int32_t j = 0; j < std::ssize(view.shape_b.center); ++j) {
            if (view.is_gone_a(i) || view.is_gone_b(j)) continue;
            const Feature a = view.sphere_a(i), b = view.sphere_b(j);
            const Gap gap = centres ? measure_gap_centres(a.center, a.radius, b.center, b.radius)
                                    : measure_gap_surface(a, b, prefers_reference_a(view));
            const bool counts =
                centres ? gap.valid && gap.gap <= margin
                        : SphereRange(view, margin).contains(a, b) && is_candidate(view, i, j, gap);
            if (counts) candidates.push_back({i, j, gap});
        }
    if (!centres) {
        check_depths(view, candidates);
        reduce_manifold(view, margin, found.reduction, candidates);
    }
    out.resize(out.size() + candidates.size());
    Contact* first = out.data() + (out.size() - candidates.size());
    // Under "centres" bodies are their spheres: no solid can be deeper than these tell.
    if (centres) {
        CentreContactsWork work;
        return make_centre_contacts(view, candidates, work, first);
    }
    make_contacts(view, candidates, found.contacts, first);
    find_lost(view, apart, margin, found);
    append_polygon();
    out.resize(out.size() + found.seats.size());
    make_seat_contacts(view, how, found.seats, out.data() + (out.size() - found.seats.size()));
}

}  // namespace reference

}  // namespace ice
