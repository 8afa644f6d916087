// SPDX-License-Identifier: GPL-3.0-or-later
/// The slow twin of the lattice fill: points decided by their distance alone.
#pragma once

#include <algorithm>

#include "common/geometry/surface_tree.hpp"
#include "preprocess/fill/lattice.hpp"

namespace ice::test {

/// Decides lattice points by SurfaceTree: inside, and at least `clearance` from the surface.
///
/// A block of points is decided at once where the distance of its middle is enough, else halved
/// down to the single point, so that 1e6 points take a second.
class BlockDecider {
public:
    BlockDecider(const SurfaceTree& tree, const LatticeFrame& frame, double clearance)
        : tree_(tree), frame_(frame), clearance_(clearance * (1.0 - 1e-9)) {}

    LatticeBits decide() {
        bits_.assign(frame_.rows() * frame_.words(), 0);
        decide_block({0, 0, 0}, frame_.count);
        return std::move(bits_);
    }

private:
    using Index = std::array<std::int64_t, 3>;

    void decide_block(const Index& from, const Index& size) {
        Eigen::AlignedBox3d box;  // rows of one block may be shifted against each other
        const Index last{from[0] + size[0] - 1, from[1] + size[1] - 1, from[2] + size[2] - 1};
        for (const std::int64_t i : {from[0], last[0]})
            for (const std::int64_t j : {from[1], std::min(from[1] + 1, last[1]), last[1]})
                for (const std::int64_t k : {from[2], std::min(from[2] + 1, last[2]),
                                             std::max(last[2] - 1, from[2]), last[2]})
                    box.extend(frame_.point(i, j, k));
        if (size[1] > 1) box.extend(box.max() + 0.5 * frame_.step);
        const double reach = 0.5 * box.diagonal().norm();
        const Foot foot = tree_.closest(box.center());
        const double depth = foot.inside ? foot.distance : -foot.distance;
        if (depth + reach < clearance_) return;
        if (depth - reach >= clearance_) {
            for (std::int64_t k = from[2]; k <= last[2]; ++k)
                for (std::int64_t j = from[1]; j <= last[1]; ++j)
                    for (std::int64_t i = from[0]; i <= last[0]; ++i)
                        bits_[frame_.row(j, k) * frame_.words() +
                              static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
            return;
        }
        const auto longest =
            static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
        if (size[longest] == 1) return;  // reach is zero: one of the two held
        Index half = size, rest = size, middle = from;
        half[longest] = size[longest] / 2;
        rest[longest] = size[longest] - half[longest];
        middle[longest] += half[longest];
        decide_block(from, half);
        decide_block(middle, rest);
    }

    const SurfaceTree& tree_;
    const LatticeFrame& frame_;
    double clearance_;
    LatticeBits bits_;
};

}  // namespace ice::test
