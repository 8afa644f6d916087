// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/base/parallel.hpp"
#include "solver/narrow/check_depths.hpp"
#include "solver/narrow/deep_seats.hpp"
#include "solver/narrow/make_centre_contacts.hpp"
#include "solver/narrow/make_contacts.hpp"
#include "solver/narrow/measure_spheres.hpp"
#include "solver/narrow/reduce_manifold.hpp"
#include "solver/narrow/search_pair.hpp"
#include "solver/narrow/separation.hpp"
#include "solver/narrow/solid_contacts.hpp"
#include "solver/narrow/thread_batch.hpp"

namespace ice {

struct FoundBatch {
    std::vector<Candidate> candidates;  // that are contacts
    std::vector<SpherePair> spheres;
    std::vector<PolygonCorner> corners;
    std::vector<DeepSeat> seats;

    void forget() {
        candidates.clear();
        corners.clear();
        seats.clear();
        spheres.clear();
    }
};

namespace {

// A pair takes some microseconds, its state a twentieth of that: below this many, waking
// threads costs more than they save. With 256 one of two threads waited for a fifth of the packed
// scene's narrow phase. Results do not depend on it.
constexpr std::size_t kSerialPairs = 64, kSerialStates = 1024;

// Work memory for the search of a pair; kept between pairs.
struct Workspace {
    PairSearch search;
    std::vector<SpherePair> spheres;
    std::vector<Candidate> candidates;
    std::vector<DeepSeat> seats;
};

// Sets work.candidates to the contacts of a pair.
// @pre the bodies are apart (separation) by no more than the margin
void search_contacts(const PairView& view, double margin, Workspace& work) {
    // search in floats, measurement in doubles, meshes for deep ones, then reduction
    const SphereRange range(view, margin);
    work.spheres.clear();
    work.search.for_each_near(view, range.margin, range.reach, [&](std::int32_t i, std::int32_t j) {
        work.spheres.push_back({i, j});
    });
    group_by_types(view, work.spheres);
    measure_spheres(view, range, work.spheres, work.candidates);
    check_depths(view, work.candidates);
    reduce_manifold(view, margin, work.candidates);
}

// The same for spheres that are known to be near.
void measure_known(const PairView& view, double margin, std::span<const SpherePair> near,
                   Workspace& work) {
    measure_spheres(view, SphereRange(view, margin), near, work.candidates);
    check_depths(view, work.candidates);
    reduce_manifold(view, margin, work.candidates);
}

// The spheres that may be candidates while the pair moves within `skin`, and the least gap that
// they may have, less that motion; appends them.
double find_near(const PairView& view, double margin, const Skin& skin, PairSearch& search,
                 std::vector<SpherePair>& out) {
    const std::size_t first = out.size();
    const SphereRange range(view, margin + skin.distance);
    search.for_each_near(view, range.margin, range.reach + skin.distance,
                         [&](std::int32_t i, std::int32_t j) {
                             out.push_back({i, j});
                         });
    return bound_spheres(view, range.reach, skin, first, out);
}

// Spheres of deep bodies have passed each other: their solids tell which contacts are lost. Those
// of two convex ones are a polygon's corners (null: none is lost), of others their deep seats.
const ContactPolygon* find_lost(const PairView& view, double apart, double most,
                                const std::vector<Candidate>& found, std::vector<DeepSeat>& seats) {
    seats.clear();
    if (is_deep(view, apart)) return find_lost_polygon(view, found, most);
    if (has_deep_seats(view, apart)) find_deep_seats(view, found, seats);
    return nullptr;
}

// The exact axes of two convex solids; early out where they are farther apart than `enough` [m].
SeparatingAxes axes_of(const PairView& view, double enough) {
    return find_axes(view.shape_a.convex, view.shape_b.convex,
                     {view.rotation_ab, view.translation_ab}, enough);
}

}  // namespace

// Keeps the corners of the polygon in which two solids meet, if they do.
void ContactFinder::meet(const PairView& view, const SeparatingAxes& axes, double most,
                         Found& found, FoundBatch& batch) {
    if (axes.widest() <= most) keep_polygon(&find_polygon(view, axes, most), found, batch);
}

void ContactFinder::keep_polygon(const ContactPolygon* polygon, Found& found, FoundBatch& batch) {
    if (polygon == nullptr) return;
    found.corner = batch.corners.size();
    found.corners = polygon->corners.size();
    found.normal = polygon->normal;
    batch.corners.insert(batch.corners.end(), polygon->corners.begin(), polygon->corners.end());
}

void ContactFinder::keep_seats(const std::vector<DeepSeat>& seats, Found& found,
                               FoundBatch& batch) {
    found.seat = batch.seats.size();
    found.seats = seats.size();
    batch.seats.insert(batch.seats.end(), seats.begin(), seats.end());
}

void ContactFinder::keep_candidates(const std::vector<Candidate>& candidates, Found& found,
                                    FoundBatch& batch) {
    found.first = batch.candidates.size();
    found.count = candidates.size();
    batch.candidates.insert(batch.candidates.end(), candidates.begin(), candidates.end());
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
    const std::uint64_t call = next_call();
    parallel_for(pairs.size(), kSerialPairs, [&](std::size_t k) {
        thread_local Workspace work;  // keeps its memory between pairs
        FoundBatch& batch = batch_of<FoundBatch>(call);
        // Contacts are wanted up to the distance that the pair can close in the step (section
        // 2, margin).
        const double most = dt * closing_speed(scene, pairs[k]) + margin;
        const PairView view(scene, pairs[k]);
        found_[k].batch = &batch;
        if (meets_in_polygon(scene, pairs[k], rule)) {
            meet(view, axes_of(view, most), most, found_[k], batch);
            return;
        }
        work.candidates.clear();
        const double apart = separation(view);
        if (apart <= most) search_contacts(view, most, work);
        keep_candidates(work.candidates, found_[k], batch);
        keep_polygon(find_lost(view, apart, most, work.candidates, work.seats), found_[k], batch);
        keep_seats(work.seats, found_[k], batch);
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
                                  meets_in_polygon(scene, pairs[k], rule));
    });
    pairs_to_measure_.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (states_[k] != PairCache::State::separated) pairs_to_measure_.push_back(k);
    found_.assign(pairs_to_measure_.size(), Found{});
    const std::uint64_t call = next_call();
    parallel_for(pairs_to_measure_.size(), kSerialPairs, [&](std::size_t n) {
        const std::size_t k = pairs_to_measure_[n];
        FoundBatch& batch = batch_of<FoundBatch>(call);
        found_[n].batch = &batch;
        found_[n].sphere = batch.spheres.size();
        const double most = dt * closing_speed(scene, pairs[k]) + margin;
        if (states_[k] == PairCache::State::polygon)
            meet(PairView(scene, pairs[k]), cache_.axes(k), most, found_[n], batch);
        else
            find_listed(scene, pairs[k], k, motion, {dt, margin, most}, found_[n], batch);
    });
    // Lists are stored by one thread, in the order of the pairs: their places do not depend on the
    // threads.
    for (std::size_t n = 0; n < pairs_to_measure_.size(); ++n) {
        const Found& found = found_[n];
        if (states_[pairs_to_measure_[n]] == PairCache::State::stale)
            cache_.keep(pairs_to_measure_[n],
                        std::span(found.batch->spheres).subspan(found.sphere, found.spheres));
    }
    emit(scene, pairs, rule, out);
}

void ContactFinder::find_listed(const Scene& scene, BodyPair pair, std::size_t k,
                                const MotionBounds& motion, const Within& within, Found& found,
                                FoundBatch& batch) {
    thread_local Workspace work;
    const PairView view(scene, pair);
    auto state = states_[k];
    std::span<const SpherePair> near = cache_.listed(k);
    if (state == PairCache::State::stale) {
        // the skin is used up: a new list, with a skin that lasts for some steps
        const Skin skin = skin_of(scene, pair, within.step);
        const double least = find_near(view, within.margin, skin, work.search, batch.spheres);
        near = std::span(batch.spheres).subspan(found.sphere);
        found.spheres = near.size();
        cache_.renew(k, view, motion, skin, std::min(least - within.margin, skin.distance));
        state = cache_.state(k, scene, pair, motion, within.step, within.margin, false);
        if (state == PairCache::State::separated) return;
    }
    // a pair too fast for a list is searched afresh
    if (state == PairCache::State::stale)
        search_contacts(view, within.most, work);
    else
        measure_known(view, within.most, near, work);
    keep_candidates(work.candidates, found, batch);
    // As find_lost, where the cache cannot rule it out: for seats it also keeps how far the bodies
    // may move before one can be deep.
    if (!cache_.may_be_deep(k)) return;
    if (is_convex_pair(view))
        return keep_polygon(find_lost_polygon(view, work.candidates, within.most), found, batch);
    cache_.set_seat_clearance(k, view, find_deep_seats(view, work.candidates, work.seats));
    keep_seats(work.seats, found, batch);
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
        contacts += found.count + found.corners + found.seats;
    }
    out.resize(contacts);
    parallel_for(found_.size(), kSerialPairs, [&](std::size_t n) {
        const Found& found = found_[n];
        if (found.corners > 0)
            emit_polygon(PairView(scene, pairs[pairs_to_measure_[n]]), rule, found.normal,
                         std::span(found.batch->corners).subspan(found.corner, found.corners),
                         out.data() + found.contact + found.count);
        if (found.seats > 0)
            emit_deep_seats(PairView(scene, pairs[pairs_to_measure_[n]]), rule,
                            std::span(found.batch->seats).subspan(found.seat, found.seats),
                            out.data() + found.contact + found.count);
        if (found.count > 0)
            make_contacts(PairView(scene, pairs[pairs_to_measure_[n]]),
                          std::span(found.batch->candidates).subspan(found.first, found.count),
                          out.data() + found.contact);
    });
}

namespace reference {

void find_contacts(const Scene& scene, BodyPair pair, ContactRule how, double margin,
                   std::vector<Contact>& out) {
    const PairView view(scene, pair);
    const auto append = [&](const ContactPolygon& polygon) {
        out.resize(out.size() + polygon.corners.size());
        emit_polygon(view, how, polygon.normal, polygon.corners,
                     out.data() + (out.size() - polygon.corners.size()));
    };
    if (meets_in_polygon(scene, pair, how)) {
        const SeparatingAxes axes = axes_of(view, margin);
        if (axes.widest() <= margin) append(find_polygon(view, axes, margin));
        return;
    }
    const double apart = separation(view);
    if (apart > margin) return;
    const bool centres = how.normal == NormalRule::centres;
    std::vector<Candidate> candidates;
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
        reduce_manifold(view, margin, candidates);
    }
    out.resize(out.size() + candidates.size());
    Contact* first = out.data() + (out.size() - candidates.size());
    centres ? make_centre_contacts(view, candidates, first)
            : make_contacts(view, candidates, first);
    // Under "centres" bodies are their spheres: no solid can be deeper than these tell.
    if (centres) return;
    std::vector<DeepSeat> seats;
    if (const ContactPolygon* polygon = find_lost(view, apart, margin, candidates, seats))
        append(*polygon);
    out.resize(out.size() + seats.size());
    emit_deep_seats(view, how, seats, out.data() + (out.size() - seats.size()));
}

}  // namespace reference

}  // namespace ice
