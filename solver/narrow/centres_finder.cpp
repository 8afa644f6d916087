// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/centres_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/parallel.hpp"
#include "solver/narrow/emit_centres.hpp"
#include "solver/narrow/search_pair.hpp"
#include "solver/narrow/separation.hpp"
#include "solver/narrow/thread_batch.hpp"

namespace ice {

struct CentresFinder::Batch {
    std::vector<Candidate> candidates;
    std::vector<ListedSpheres> listed;

    void forget() {
        candidates.clear();
        listed.clear();
    }

    // of the pair at hand
    PairSearch search;
    TouchingSpheres touching;
};

namespace {

// A pair takes about a microsecond: below this many, waking threads costs more than they save.
constexpr std::size_t kSerialPairs = 128;

// A pair's spheres are listed as far ahead as it goes in so many steps, within these bounds: more
// keeps more spheres, less has to be found anew sooner.
constexpr double kLookAhead = 5.0;
constexpr double kLeastShare = 0.6, kMostShare = 0.8;  // of the ice's radius

// What rounding may add to a separation, by far [m].
constexpr double kRounding = 1e-6;

// Appends two spheres to a list of `count`.
void append(const PairView& view, std::int32_t i, std::int32_t j, std::size_t count,
            std::vector<ListedSpheres>& out) {
    const std::size_t k = count % ListedSpheres::kPairs;
    if (k == 0) out.emplace_back();
    ListedSpheres& block = out.back();
    const Vec3 a = view.center_a(i);
    const Vec3 b = view.shape_b.center[j] + view.scene.crushed.recess_of(view.pair.b, j);
    block.ax[k] = static_cast<float>(a.x());
    block.ay[k] = static_cast<float>(a.y());
    block.az[k] = static_cast<float>(a.z());
    block.bx[k] = static_cast<float>(b.x());
    block.by[k] = static_cast<float>(b.y());
    block.bz[k] = static_cast<float>(b.z());
    block.radii[k] = static_cast<float>(view.shape_a.radius[i] + view.shape_b.radius[j]);
    block.a[k] = i;
    block.b[k] = j;
}

// Fills the last block of a list of `count` up.
void fill_up(std::size_t count, std::vector<ListedSpheres>& out) {
    for (std::size_t k = count % ListedSpheres::kPairs; k % ListedSpheres::kPairs != 0; ++k) {
        ListedSpheres& block = out.back();
        for (auto* values : {block.ax, block.ay, block.az, block.bx, block.by, block.bz})
            values[k] = 0.0f;
        block.radii[k] = -ListedSpheres::kNowhere;
        block.a[k] = block.b[k] = -1;
    }
}

// What rounding to floats costs a gap at most [m].
double float_slack(const PairView& view) {
    const double extent = 2.0 * (view.shape_a.blocks.size + 2.0 * view.shape_b.blocks.size);
    return static_cast<double>(SphereBlocks::kFloatShare) * (extent + view.shift.norm());
}

// How far a sphere of b may have gone relative to one of a since they were listed [m]: two
// rotations differ by sqrt(8) sin(angle / 2), and a point at 1 goes 2 sin(angle / 2).
double gone_since(const SphereLists::Row& row, const PairView& view, double crushed) {
    return (view.shift - row.shift).norm() + crushed +
           view.shape_b.bounding_radius * (view.turn - row.turn).norm() / std::numbers::sqrt2;
}

// Measures the spheres that touch in floats; appends the candidates.
void measure(const PairView& view, const TouchingSpheres& touching, double most,
             std::vector<Candidate>& out) {
    for (std::size_t k = 0; k < touching.count; ++k) {
        const std::int32_t i = touching.a[k], j = touching.b[k];
        const Gap gap = measure_gap_centres(view.center_a(i), view.shape_a.radius[i],
                                            view.center_b(j), view.shape_b.radius[j]);
        if (gap.valid && gap.gap <= most && !view.is_gone_a(i) && !view.is_gone_b(j))
            out.push_back({i, j, gap});
    }
}

// Is no sphere of one body nearer to the other than their separation()?
bool are_held(const PairView& view) {
    return view.shape_a.bounds.hold_spheres && view.shape_b.bounds.hold_spheres &&
           view.scene.crushed.is_whole(view.pair.a) && view.scene.crushed.is_whole(view.pair.b);
}

}  // namespace

CentresFinder::Found CentresFinder::look(std::size_t k, BodyPair pair, const Step& step,
                                         Batch& batch) {
    const auto& [scene, travel, dt, margin] = step;
    Found found{&batch, batch.candidates.size(), 0, batch.listed.size(), 0, false};
    const PairView view(scene, pair);
    SphereLists::Row& row = lists_.row(k);
    const double closing = dt * closing_speed(scene, pair), most = closing + margin;
    const double way = travel.way(pair.a) + travel.way(pair.b);
    const double crushed = travel.crushed(pair.a) + travel.crushed(pair.b);
    double gone = gone_since(row, view, crushed - row.crushed);
    std::span<const ListedSpheres> listed = lists_.listed(k);
    const FloatPose pose = to_floats(view.turn, view.shift);
    const double slack = float_slack(view);
    const bool held = are_held(view);
    if (gone + most > row.range) {
        const double apart = separation(view, most, row.axis);
        if (apart > most) {
            lists_.wake(k) =
                way + (apart - kRounding - margin) / (held ? 1.0 : separation_share(view));
            return found;
        }
        const double radius = view.shape_b.largest_radius;
        const double ahead =
            std::clamp(kLookAhead * closing, kLeastShare * radius, kMostShare * radius);
        row.range = margin + std::max(ahead, closing);
        row.turn = view.turn;
        row.shift = view.shift;
        row.crushed = crushed;
        gone = 0.0;
        std::size_t count = 0;
        batch.search.for_each_near(
            view, row.range, 0.0,
            [&](std::int32_t i, std::int32_t j) { append(view, i, j, count++, batch.listed); },
            &Shape::balls);
        fill_up(count, batch.listed);
        found.anew = true;
        found.blocks = batch.listed.size() - found.block;
        listed = std::span(batch.listed).subspan(found.block);
    }
    const double unsure = slack + crushed - row.crushed;
    find_touching(listed, pose, static_cast<float>(most + unsure), batch.touching);
    lists_.wake(k) =
        way + std::min(batch.touching.least - unsure - margin, row.range - margin - gone);
    measure(view, batch.touching, most, batch.candidates);
    found.count = batch.candidates.size() - found.first;
    if (found.count > 0 && !(held && batch.touching.least + slack + kRounding <= most) &&
        are_apart(view, most))
        found.count = 0;
    return found;
}

void CentresFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs,
                         const Travel& travel, double dt, double margin,
                         std::vector<Contact>& out) {
    const std::uint64_t call = next_call();
    lists_.match(pairs);
    awake_.resize(pairs.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        awake_[count] = k;  // without a branch that nothing foretells; what is no number is awake
        count += travel.soon(pairs[k].a) + travel.soon(pairs[k].b) < lists_.wake(k) ? 0 : 1;
    }
    awake_.resize(count);
    found_.resize(awake_.size());
    parallel_for(awake_.size(), kSerialPairs, [&](std::size_t n) {
        found_[n] =
            look(awake_[n], pairs[awake_[n]], {scene, travel, dt, margin}, batch_of<Batch>(call));
    });
    touching_.clear();
    std::size_t contacts = 0;
    for (std::size_t n = 0; n < awake_.size(); ++n) {
        const Found& found = found_[n];
        if (found.anew)
            lists_.keep(awake_[n],
                        std::span(found.batch->listed).subspan(found.block, found.blocks));
        if (found.count == 0) continue;
        touching_.push_back({pairs[awake_[n]], n, contacts});
        contacts += found.count;
    }
    out.resize(contacts);
    parallel_for(touching_.size(), kSerialPairs, [&](std::size_t n) {
        const Touching& t = touching_[n];
        const Found& found = found_[t.found];
        emit_centres(PairView(scene, t.pair),
                     std::span(found.batch->candidates).subspan(found.first, found.count),
                     out.data() + t.contact);
    });
}

}  // namespace ice
