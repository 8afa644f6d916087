// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/centres_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/narrow/feature/separation.hpp"

namespace ice {

namespace {

// A pair takes about a microsecond: below this many [-], waking threads costs more than they save.
// Results do not depend on it.
constexpr std::size_t kSerialLists = 128;

// A pair's list covers its motion in so many steps, within these bounds: a longer one has more
// spheres to measure, a shorter one is renewed sooner. Tried: 0.15, 0.3 and 0.4 radii (15, 4 and
// 7 % slower), more than 0.8 (no gain). Contacts are the same.
constexpr double kListLookAhead = 5.0;                         // steps [-]
constexpr double kLeastListShare = 0.6, kMostListShare = 0.8;  // of the ice's radius

// Generous bound of the rounding error of a separation [m]. Smaller could leave out a pair that
// touches; with a larger one pairs are measured a little sooner.
constexpr double kSeparationRounding = 1e-6;

// Largest relative motion of a sphere of b and one of a since they were listed [m]: two rotations
// differ by sqrt(8) sin(angle / 2), and a point at distance 1 moves by 2 sin(angle / 2).
double gone_since(const SphereLists::Row& row, const PairView& view, double crushed) {
    return (view.translation_ab - row.translation).norm() + crushed +
           view.shape_b.bounding_radius * (view.rotation_ab - row.rotation).norm() /
               std::numbers::sqrt2;
}

// Measures the spheres that touch in whole units; appends the candidates.
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
bool enclose_spheres(const PairView& view) {
    return view.shape_a.bounds.enclose_spheres && view.shape_b.bounds.enclose_spheres &&
           view.scene.crushed.is_whole(view.pair.a) && view.scene.crushed.is_whole(view.pair.b);
}

}  // namespace

// Finds the spheres whose gap is at most `range` [m], and others.
void CentresFinder::find_near(const PairView& view, double range, PairSearch& search,
                              std::vector<Near>& out) {
    out.clear();
    search.for_each_near(
        view, range, 0.0,
        [&](std::int32_t i, std::int32_t j) {
            out.push_back(
                {view.center_a(i) - view.translation_ab,
                 view.shape_b.center[j] + view.scene.crushed.displacement_of(view.pair.b, j),
                 view.shape_a.radius[i] + view.shape_b.radius[j], i, j});
        },
        &Shape::balls);
}

// Makes a list of spheres in units as small as the farthest of them allows [m]; returns the unit.
double CentresFinder::list_spheres(const std::vector<Near>& near, std::vector<ListedSpheres>& out) {
    constexpr std::size_t kPairs = ListedSpheres::kPairs;
    double farthest = 0.0;
    for (const Near& n : near)
        farthest =
            std::max({farthest, n.a.cwiseAbs().maxCoeff(), n.b.cwiseAbs().maxCoeff(), n.radii});
    // Sixteen bits per number halve the memory that a pass over the list reads. Their rounding is a
    // known share of the unit, by which the caller widens its range.
    const double unit = near.empty() ? 1.0 : farthest / ListedSpheres::kMost;
    const auto in_units = [&](double length) {
        return static_cast<std::int16_t>(std::lround(length / unit));
    };
    for (std::size_t n = 0; n < near.size(); ++n) {
        const std::size_t k = n % kPairs;
        if (k == 0) {
            ListedSpheres& fill = out.emplace_back();
            std::fill_n(fill.radii, kPairs, static_cast<std::int16_t>(-ListedSpheres::kMost - 1));
        }
        ListedSpheres& block = out.back();
        block.ax[k] = in_units(near[n].a.x());
        block.ay[k] = in_units(near[n].a.y());
        block.az[k] = in_units(near[n].a.z());
        block.bx[k] = in_units(near[n].b.x());
        block.by[k] = in_units(near[n].b.y());
        block.bz[k] = in_units(near[n].b.z());
        block.radii[k] = in_units(near[n].radii);
        block.a[k] = near[n].i;
        block.b[k] = near[n].j;
    }
    return unit;
}

CentresFinder::Found CentresFinder::measure_pair(std::size_t k, BodyPair pair, const Step& step,
                                                 Batch& batch) {
    const auto& [scene, motion, dt, margin] = step;
    Found found{&batch, batch.candidates.size(), 0, batch.listed.size(), 0, false};
    const PairView view(scene, pair);
    SphereLists::Row& row = lists_.row(k);
    const double closing = dt * closing_speed(scene, pair), most = closing + margin;
    const double path = motion.path(pair.a) + motion.path(pair.b);
    const double crushed = motion.crushed(pair.a) + motion.crushed(pair.b);
    double gone = gone_since(row, view, crushed - row.crushed);
    std::span<const ListedSpheres> listed = lists_.listed(k);
    const bool enclosed = enclose_spheres(view);
    // A gap shrinks by at most `gone`, so the list holds all gaps up to range - gone. The step
    // needs those up to `most`: where that is more, the list is renewed.
    if (gone + most > row.range) {
        const double apart = separation(view, most, row.axis);
        // Solids this far apart need no list. The pair is clear until both bodies' paths have
        // used up the distance.
        if (apart > most) {
            lists_.clearance(k) = path + (apart - kSeparationRounding - margin) /
                                             (enclosed ? 1.0 : separation_share(view));
            return found;
        }
        // The list reaches as far as the pair closes in some steps, at least as far as in this
        // one.
        const double radius = view.shape_b.largest_radius;
        const double ahead =
            std::clamp(kListLookAhead * closing, kLeastListShare * radius, kMostListShare * radius);
        row.range = margin + std::max(ahead, closing);
        row.rotation = view.rotation_ab;
        row.translation = view.translation_ab;
        row.crushed = crushed;
        gone = 0.0;
        find_near(view, row.range, batch.search, batch.near);
        row.unit = list_spheres(batch.near, batch.listed);
        found.anew = true;
        found.blocks = batch.listed.size() - found.block;
        listed = std::span(batch.listed).subspan(found.block);
    }
    // Places in whole units are off by up to kError units, and spheres crushed since the list
    // was made lie elsewhere by up to the crushed depth: both widen the range.
    const double rounding = ListedSpheres::kError * row.unit;
    const double unsure = rounding + crushed - row.crushed;
    const FloatPose pose =
        to_floats(view.rotation_ab, (view.translation_ab - row.translation) / row.unit);
    find_touching(listed, pose, static_cast<float>((most + unsure) / row.unit), batch.touching);
    // Two things can end the pair's clearance: the nearest listed spheres come within the
    // margin, or spheres that were not listed, all beyond row.range then, may have done so.
    const double least = batch.touching.least * row.unit;
    lists_.clearance(k) = path + std::min(least - unsure - margin, row.range - margin - gone);
    measure(view, batch.touching, most, batch.candidates);
    found.count = batch.candidates.size() - found.first;
    // A sphere represents surface beyond its body's rim, but bodies that are apart have no
    // contact. Where spheres stay within their hulls the touching spheres already prove that
    // the hulls are near enough, and the separation need not be computed.
    if (found.count > 0 && !(enclosed && least + rounding + kSeparationRounding <= most) &&
        separation(view, most, row.axis) > most)
        found.count = 0;
    return found;
}

void CentresFinder::find(const Scene& scene, const std::vector<BodyPair>& pairs,
                         const MotionBounds& motion, double dt, double margin,
                         std::vector<Contact>& out) {
    batches_.prepare();
    batches_.for_each([](Batch& batch) {
        batch.candidates.clear();
        batch.listed.clear();
    });
    lists_.carry_over(pairs);
    // To check a clearance costs a comparison; only the pairs whose bodies have used theirs up
    // are measured.
    pairs_to_measure_.resize(pairs.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        pairs_to_measure_[count] = k;  // no unpredictable branch; a not-a-number is measured
        count += motion.path_after_step(pairs[k].a) + motion.path_after_step(pairs[k].b) <
                         lists_.clearance(k)
                     ? 0
                     : 1;
    }
    pairs_to_measure_.resize(count);
    found_.resize(pairs_to_measure_.size());
    parallel_for(pairs_to_measure_.size(), kSerialLists, [&](std::size_t n) {
        found_[n] = measure_pair(pairs_to_measure_[n], pairs[pairs_to_measure_[n]],
                                 {scene, motion, dt, margin}, batches_.own());
    });
    touching_.clear();
    // Gathered in the order of the pairs: the contacts do not depend on which thread found
    // them.
    std::size_t contacts = 0;
    for (std::size_t n = 0; n < pairs_to_measure_.size(); ++n) {
        const Found& found = found_[n];
        if (found.anew)
            lists_.keep(pairs_to_measure_[n],
                        std::span(found.batch->listed).subspan(found.block, found.blocks));
        if (found.count == 0) continue;
        touching_.push_back({pairs[pairs_to_measure_[n]], n, contacts});
        contacts += found.count;
    }
    out.resize(contacts);
    // Places in `out` are known now, so all threads write at once.
    parallel_for(touching_.size(), kSerialLists, [&](std::size_t n) {
        const Touching& t = touching_[n];
        const Found& found = found_[t.found];
        make_centre_contacts(PairView(scene, t.pair),
                             std::span(found.batch->candidates).subspan(found.first, found.count),
                             batches_.own().contacts, out.data() + t.contact);
    });
}

}  // namespace ice
