// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/base/parallel.hpp"
#include "solver/narrow/decisive_spheres.hpp"
#include "solver/narrow/finish_pair.hpp"
#include "solver/narrow/measure_spheres.hpp"
#include "solver/narrow/pair_kinds.hpp"
#include "solver/narrow/search_pair.hpp"
#include "solver/narrow/separation.hpp"
#include "solver/narrow/thread_batch.hpp"

namespace ice {

struct FoundBatch {
    std::vector<Candidate> candidates;  // that are contacts
    std::vector<SpherePair> spheres;

    void forget() {
        candidates.clear();
        spheres.clear();
    }
};

namespace {

// A pair takes some microseconds, a look at one a twentieth of that: below this many, waking
// threads costs more than they save.
constexpr std::size_t kSerialPairs = 64, kSerialLooks = 1024;

// What the search of a pair needs; kept between pairs.
struct Workspace {
    PairSearch search;
    PairKinds kinds;
    DecisiveSpheres decisive;
    std::vector<SpherePair> spheres;
    std::vector<Candidate> candidates;
};

// Sets work.candidates to those that are contacts.
// @pre the bodies are apart (separation) by no more than the margin
void search_contacts(const PairView& view, NormalRule rule, double margin, Workspace& work) {
    const SphereRange range(view, rule, margin);
    work.spheres.clear();
    work.search.for_each_near(view, range.margin, range.reach, [&](std::int32_t i, std::int32_t j) {
        work.spheres.push_back({i, j, 0.0f});
    });
    if (rule == NormalRule::surface) group_by_kinds(view, work.spheres);
    measure_spheres(view, rule, range, work.spheres, work.candidates);
    choose_contacts(view, rule, margin, work.candidates);
}

// The same of what is known to be near, under the rule "surface".
void measure_known(const PairView& view, double margin, std::span<const SpherePair> near,
                   double gone, Workspace& work) {
    constexpr NormalRule rule = NormalRule::surface;
    work.decisive.begin(view.shape_a.center.size(), view.shape_b.center.size());
    work.decisive.pick(near, gone, margin, work.spheres);
    measure_spheres(view, rule, SphereRange(view, rule, margin), work.spheres, work.candidates);
    choose_contacts(view, rule, margin, work.candidates);
}

// The least gap that two spheres may have while the pair moves within `leeway`, less that motion,
// and along what normals; infinite where they will be no candidates.
std::pair<double, PossibleNormals> least_gap(const SphereRange& range, const Leeway& leeway,
                                             PairKinds& kinds, std::int32_t i, std::int32_t j) {
    const PairKinds::Place &a = kinds.a(i), &b = kinds.b(j);
    if (a.gone || b.gone) return {std::numeric_limits<double>::infinity(), PossibleNormals::none()};
    return kinds.bound(i, j, a, b, range.reach, leeway);
}

float rounded_down(double value) {
    return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

// The spheres that may be candidates while the pair moves within `leeway`, and the least gap that
// they may have, less that motion; appends them.
double find_near(const PairView& view, double margin, const Leeway& leeway, Workspace& work,
                 std::vector<SpherePair>& out) {
    const std::size_t first = out.size();
    work.kinds.begin(view, prefers_a(view));
    const SphereRange range(view, NormalRule::surface, margin + leeway.distance);
    double least = std::numeric_limits<double>::infinity();
    work.search.for_each_near(
        view, range.margin, range.reach + leeway.distance, [&](std::int32_t i, std::int32_t j) {
            const auto [gap, possible] = least_gap(range, leeway, work.kinds, i, j);
            if (gap == std::numeric_limits<double>::infinity()) return;
            least = std::min(least, gap);
            out.push_back({i, j, rounded_down(gap), possible});
        });
    group_by_kinds(view, std::span(out).subspan(first));
    return least;
}

}  // namespace

void ContactFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs, NormalRule rule,
                         double dt, double margin, std::vector<Contact>& out) {
    awake_.resize(pairs.size());
    std::iota(awake_.begin(), awake_.end(), std::size_t{0});
    found_.assign(pairs.size(), Found{});
    const std::uint64_t call = next_call();
    parallel_for(pairs.size(), kSerialPairs, [&](std::size_t k) {
        thread_local Workspace work;  // keeps its memory between pairs
        FoundBatch& batch = batch_of<FoundBatch>(call);
        const double most = dt * closing_speed(scene, pairs[k]) + margin;
        const PairView view(scene, pairs[k]);
        work.candidates.clear();
        if (separation(view) <= most) search_contacts(view, rule, most, work);
        found_[k] = {&batch, batch.candidates.size(), work.candidates.size(), 0, 0, 0};
        batch.candidates.insert(batch.candidates.end(), work.candidates.begin(),
                                work.candidates.end());
    });
    emit(scene, pairs, rule, out);
}

void ContactFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs,
                         const Travel& travel, NormalRule rule, double dt, double margin,
                         std::vector<Contact>& out) {
    if (rule == NormalRule::centres) return centres_.find(scene, pairs, travel, dt, margin, out);
    dormant_.match(pairs);
    states_.resize(pairs.size());
    parallel_for(pairs.size(), kSerialLooks, [&](std::size_t k) {
        states_[k] = dormant_.look(k, scene, pairs[k], travel, dt, margin);
    });
    awake_.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (states_[k] != DormantPairs::State::asleep) awake_.push_back(k);
    found_.assign(awake_.size(), Found{});
    const std::uint64_t call = next_call();
    parallel_for(awake_.size(), kSerialPairs, [&](std::size_t n) {
        thread_local Workspace work;
        const std::size_t k = awake_[n];
        FoundBatch& batch = batch_of<FoundBatch>(call);
        Found& found = found_[n];
        found = {&batch, batch.candidates.size(), 0, batch.spheres.size(), 0, 0};
        std::span<const SpherePair> near = dormant_.near(k);
        auto state = states_[k];
        if (state == DormantPairs::State::unknown) {
            const PairView view(scene, pairs[k]);
            const Leeway leeway = dormant_leeway(scene, pairs[k], dt);
            const double least = find_near(view, margin, leeway, work, batch.spheres);
            near = std::span(batch.spheres).subspan(found.sphere);
            found.spheres = near.size();
            dormant_.settle(k, view, travel, leeway, std::min(least - margin, leeway.distance));
            state = dormant_.look(k, scene, pairs[k], travel, dt, margin);
            if (state == DormantPairs::State::asleep) return;
        }
        const PairView view(scene, pairs[k]);
        const double most = dt * closing_speed(scene, pairs[k]) + margin;
        // a pair too fast for what can be known in advance is searched afresh
        if (state == DormantPairs::State::unknown)
            search_contacts(view, rule, most, work);
        else
            measure_known(view, most, near, dormant_.gone(k), work);
        found.count = work.candidates.size();
        batch.candidates.insert(batch.candidates.end(), work.candidates.begin(),
                                work.candidates.end());
    });
    for (std::size_t n = 0; n < awake_.size(); ++n) {
        const Found& found = found_[n];
        if (states_[awake_[n]] == DormantPairs::State::unknown)
            dormant_.keep(awake_[n],
                          std::span(found.batch->spheres).subspan(found.sphere, found.spheres));
    }
    emit(scene, pairs, rule, out);
}

void ContactFinder::emit(const Scene& scene, const std::vector<BodyPair>& pairs, NormalRule rule,
                         std::vector<Contact>& out) {
    std::size_t contacts = 0;
    for (Found& found : found_) {
        found.contact = contacts;
        contacts += found.count;
    }
    out.resize(contacts);
    parallel_for(found_.size(), kSerialPairs, [&](std::size_t n) {
        const Found& found = found_[n];
        if (found.count > 0)
            emit_pair(PairView(scene, pairs[awake_[n]]), rule,
                      std::span(found.batch->candidates).subspan(found.first, found.count),
                      out.data() + found.contact);
    });
}

namespace reference {

void find_contacts(const Scene& scene, BodyPair pair, NormalRule rule, double margin,
                   std::vector<Contact>& out) {
    const PairView view(scene, pair);
    if (separation(view) > margin) return;
    const SphereRange range(view, rule, margin);
    std::vector<Candidate> candidates;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(view.shape_a.center.size()); ++i)
        for (std::int32_t j = 0; j < static_cast<std::int32_t>(view.shape_b.center.size()); ++j) {
            const SphereSurface a = view.sphere_a(i), b = view.sphere_b(j);
            if (!range.holds(a, b) || view.is_gone_a(i) || view.is_gone_b(j)) continue;
            const Gap gap = rule == NormalRule::centres
                                ? measure_gap_centres(a.center, a.radius, b.center, b.radius)
                                : measure_gap_surface(a, b, prefers_a(view));
            if (is_candidate(view, rule, range, i, j, gap)) candidates.push_back({i, j, gap});
        }
    choose_contacts(view, rule, margin, candidates);
    out.resize(out.size() + candidates.size());
    emit_pair(view, rule, candidates, out.data() + (out.size() - candidates.size()));
}

}  // namespace reference

}  // namespace ice
