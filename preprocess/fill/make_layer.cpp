// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/make_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/base/parallel.hpp"
#include "preprocess/fill/layer_tile.hpp"
#include "preprocess/fill/mirror_seat.hpp"
#include "preprocess/fill/point_grid.hpp"
#include "preprocess/fill/seat_lines.hpp"
#include "preprocess/fill/surface_samples.hpp"

namespace ice {

namespace {

// Seats depend on all of these but the last.

// A tile's edge [spacings]: a thousand seats of a flat face. Larger tiles leave threads fewer
// tasks; smaller ones copy more seats of their neighbours. At least 4, or tiles of one colour would
// meet.
constexpr double kTile = 32.0;
// Distance of the samples that fronts may start from [spacings], in 3D and in 2D, where samples
// alone close the gaps. Smaller settles more seeds; larger may miss places that no front reaches.
constexpr double kSeedSize = 0.7, kLineSize = 0.1;
// In 2D a sample that has no seat this near gets one [spacings]. Smaller places more discs, larger
// leaves wider gaps in the outline.
constexpr double kCoveredInPlane = 0.62;
// Depth of a seed of use in a fine mesh [radii]. Smaller settles more seeds for nothing, larger may
// leave out places where a sphere touches.
constexpr double kDeep = 0.75;
// Of fewer seeds than this one thread is faster [-]. Only time depends on it.
constexpr std::size_t kManySeeds = 20000;

struct Tile {
    std::array<int, 3> at;
    std::vector<Seed> seeds;
    std::vector<Seat> own;
};

class LayerMaker {
public:
    LayerMaker(const SurfaceTree& tree, const LayerOptions& options)
        : tree_(tree), solid_(tree), o_(options), width_(kTile * options.spacing) {}

    std::vector<Vec3> make() {
        // Edges first: their spheres are the fixed points from which fronts start, and which
        // gaps keep.
        lines_ = seat_lines(tree_, o_);
        make_seeds();
        if (o_.dimension == 3) {
            for (const Seat& seat : lines_) tile_at(tile_of(seat.center)).own.push_back(seat);
            fill_tiles([](LayerTile& work, const Tile& tile) { work.advance_front(tile.seeds); });
            // only now gaps: a gap at a tile's rim is one only if the neighbour's front left
            // it, too
            fill_tiles([](LayerTile& work, const Tile& tile) {
                work.close_gaps();
                work.cover(tile.seeds);
            });
        } else {
            cover_outline();
        }
        return collect();
    }

private:
    std::array<int, 3> tile_of(const Vec3& p) const {
        std::array<int, 3> at;
        for (int d = 0; d < 3; ++d)
            at[static_cast<std::size_t>(d)] = static_cast<int>(std::floor(p[d] / width_));
        return at;
    }

    Tile& tile_at(const std::array<int, 3>& at) {
        const auto [found, fresh] = index_.try_emplace(at, tiles_.size());
        if (fresh) tiles_.push_back({at, {}, {}});
        return tiles_[found->second];
    }

    // A layer of a few thousand seats is done before other threads are awake.
    bool is_large() const { return seed_count_ > kManySeeds; }

    void make_seeds() {
        const double size = (o_.dimension == 2 ? kLineSize : kSeedSize) * o_.spacing;
        const SurfaceSampler sampler(tree_.mesh(), size, o_.dimension, o_.mirror);
        // Small triangles have many seeds, and settling a useless one is slow. A sphere cannot
        // touch at a sample whose seat is not deep enough: such a seed is skipped.
        const bool fine = is_fine_for(tree_, o_.radius);
        std::vector<SurfaceSample> samples;
        for (std::size_t t = 0; t < sampler.triangle_count(); ++t) {
            sampler.sample(t, samples);
            for (const SurfaceSample& sample : samples) {
                const Vec3 seat = sample.point - o_.radius * sample.normal;
                const double aside = 2.0 * std::sqrt(sample.area);
                if (fine && !tree_.is_clear(seat, kDeep * o_.radius - aside)) continue;
                tile_at(tile_of(seat)).seeds.push_back({seat, sample.triangle});
                ++seed_count_;
            }
        }
    }

    // Runs fill(work, tile) for all tiles, one colour after the other: tiles of one colour are a
    // tile's width apart, and none searches or places farther than two spacings beyond its own.
    template <class Fill>
    void fill_tiles(const Fill& fill) {
        for (int colour = 0; colour < 8; ++colour) {
            if (o_.progress) o_.progress(steps_done_++ / 16.0);
            // Even and odd tiles along each axis make eight colours.
            std::vector<std::size_t> now;
            for (const auto& [at, k] : index_)
                if ((at[0] & 1) + 2 * (at[1] & 1) + 4 * (at[2] & 1) == colour) now.push_back(k);
            std::vector<std::vector<Seat>> placed(now.size());
            parallel_tasks(now.size(), is_large(), [&](std::size_t n) {
                const Tile& tile = tiles_[now[n]];
                LayerTile work(solid_, o_, box_of(tile));
                take_neighbours(tile, work);
                fill(work, tile);
                placed[n] = work.placed();
            });
            for (std::size_t n = 0; n < now.size(); ++n) {
                auto& own = tiles_[now[n]].own;
                own.insert(own.end(), placed[n].begin(), placed[n].end());
            }
        }
    }

    Eigen::AlignedBox3d box_of(const Tile& tile) const {
        const Vec3 low = width_ * Vec3(tile.at[0], tile.at[1], tile.at[2]);
        return {low, low + Vec3::Constant(width_)};
    }

    void take_neighbours(const Tile& tile, LayerTile& work) const {
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x) {
                    const auto near = index_.find({tile.at[0] + x, tile.at[1] + y, tile.at[2] + z});
                    if (near == index_.end()) continue;
                    for (const Seat& seat : tiles_[near->second].own) work.take_seat(seat);
                }
    }

    // 2D: most of the outline is covered by its line already.
    void cover_outline() {
        PointGrid placed(o_.spacing);
        for (const Seat& seat : lines_) placed.add(seat.center);
        const auto taken = [&](const Vec3& p, const Vec3& normal) {
            return placed.any_within(p, kCoveredInPlane * o_.spacing, [&](std::int32_t k) {
                return lines_[static_cast<std::size_t>(k)].agrees(normal);
            });
        };
        for (const auto& [at, k] : index_)
            for (const Seed& seed : tiles_[k].seeds) {
                // tested before and after settling: settling costs most, and may end beside another
                // disc
                if (taken(seed.seat, tree_.normal(seed.triangle))) continue;
                const auto seat = settle(tree_, seed.seat, o_.radius, seed.triangle);
                if (!seat || taken(seat->center, seat->normal)) continue;
                placed.add(seat->center);
                lines_.push_back(*seat);
            }
    }

    // All centres with their images.
    std::vector<Vec3> collect() const {
        std::vector<Vec3> out;
        const auto add = [&](const Seat& seat) {
            out.push_back(seat.center);
            if (o_.mirror && seat.center.y() > 0.0) out.push_back(image_of(seat).center);
        };
        if (o_.dimension == 2)
            for (Seat seat : lines_) {
                seat.center.y() = 0.0;  // but for rounding it is
                add(seat);
            }
        for (const auto& [at, k] : index_)
            for (const Seat& seat : tiles_[k].own) add(seat);
        return out;
    }

    const SurfaceTree& tree_;
    LayerSolid solid_;
    LayerOptions o_;
    double width_;
    std::size_t seed_count_ = 0;
    int steps_done_ = 0;  // of two times eight colours
    std::vector<Seat> lines_;
    std::vector<Tile> tiles_;
    std::map<std::array<int, 3>, std::size_t> index_;
};

}  // namespace

std::vector<Vec3> make_layer(const SurfaceTree& tree, const LayerOptions& options) {
    return LayerMaker(tree, options).make();
}

}  // namespace ice
