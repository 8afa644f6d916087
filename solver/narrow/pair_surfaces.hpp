// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/narrow/pair_view.hpp"

namespace ice {

/// The spheres of a pair in a's axes, each brought there when it is first asked for.
///
/// Keeps its memory between pairs.
class PairSurfaces {
public:
    struct Entry {
        SphereSurface surface;
        bool gone;  ///< driven right through its body
    };

    explicit PairSurfaces() = default;
    void begin(const PairView& view) {
        a_.begin(view.shape_a.center.size());
        b_.begin(view.shape_b.center.size());
    }
    /// The answer is good until the next question about the same body.
    const Entry& a(const PairView& view, std::int32_t i) {
        return a_.get(i, [&] { return Entry{view.sphere_a(i), view.is_gone_a(i)}; });
    }
    const Entry& b(const PairView& view, std::int32_t j) {
        return b_.get(j, [&] { return Entry{view.sphere_b(j), view.is_gone_b(j)}; });
    }

private:
    class Body {
    public:
        void begin(std::size_t spheres) {
            made_.clear();
            ++pair_;
            if (at_.size() < spheres) at_.resize(spheres, {0, 0});
        }
        template <class Make>
        const Entry& get(std::int32_t k, const Make& make) {
            Place& place = at_[static_cast<std::size_t>(k)];
            if (place.pair != pair_) {
                place = {pair_, static_cast<std::int32_t>(made_.size())};
                made_.push_back(make());
            }
            return made_[static_cast<std::size_t>(place.row)];
        }

    private:
        struct Place {
            std::uint64_t pair;
            std::int32_t row;
        };
        std::vector<Entry> made_;
        std::vector<Place> at_;  // per sphere; of the present pair only where it says so
        std::uint64_t pair_ = 0;
    };
    Body a_, b_;
};

}  // namespace ice
