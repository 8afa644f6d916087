// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "solver/narrow/kind_bound.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// The spheres of a pair in a's axes, and what their kinds decide; each is made when it is first
/// asked for. Keeps its memory between pairs.
class PairKinds {
public:
    struct Place {
        Vec3 center;       ///< a's axes [m]
        bool gone;         ///< driven right through its body
        std::int8_t kind;  ///< number within the pair; -1 where there are too many
    };

    /// Forgets everything. @param prefer_a  as for measure_gap_surface
    void begin(const PairView& view, bool prefer_a);

    /// Good until the next question about the same body.
    const Place& a(std::int32_t i) {
        return a_.place(i, [&] {
            const std::int8_t kind =
                a_.number(view_->shape_a.kind[i], [&] { return view_->sphere_a(i); });
            return Place{view_->center_a(i), view_->is_gone_a(i), kind};
        });
    }
    const Place& b(std::int32_t j) {
        return b_.place(j, [&] {
            const std::int8_t kind =
                b_.number(view_->shape_b.kind[j], [&] { return view_->sphere_b(j); });
            return Place{view_->center_b(j), view_->is_gone_b(j), kind};
        });
    }

    /// The KindBound of spheres i and j, which are at `a` and `b`: the least gap, and the normals
    /// where there may be one.
    std::pair<double, PossibleNormals> bound(std::int32_t i, std::int32_t j, const Place& a,
                                             const Place& b, double reach, const Leeway& leeway) {
        if (a.kind < 0 || b.kind < 0) {
            const SphereSurface of_a = view_->sphere_a(i), of_b = view_->sphere_b(j);
            return {KindBound(of_a, of_b, prefer_a_, reach, leeway).least(a.center, b.center),
                    PossibleNormals::all()};
        }
        KindBound& kinds = bounds_.get(a.kind, b.kind, a_.surface(a.kind), b_.surface(b.kind),
                                       prefer_a_, reach, leeway);
        const double least = kinds.least(a.center, b.center);
        if (least == std::numeric_limits<double>::infinity())
            return {least, PossibleNormals::none()};
        return {least, kinds.possible()};
    }

private:
    // That many kinds of a body are told apart in a pair.
    static constexpr std::size_t kMost = 64;

    // What was made of a pair; of earlier pairs nothing is valid, and nothing has to be cleared.
    class Body {
    public:
        void begin(const Shape& shape);
        template <class Make>
        const Place& place(std::int32_t k, const Make& make) {
            Stamp& at = place_at_[static_cast<std::size_t>(k)];
            if (at.pair != pair_) {
                const Place made = make();
                at = {pair_, static_cast<std::int32_t>(places_.size())};
                places_.push_back(made);
            }
            return places_[static_cast<std::size_t>(at.row)];
        }
        template <class Make>
        std::int8_t number(std::int32_t kind, const Make& make) {
            Stamp& at = kind_at_[static_cast<std::size_t>(kind)];
            if (at.pair != pair_) {
                if (surfaces_.size() == kMost) return -1;
                at = {pair_, static_cast<std::int32_t>(surfaces_.size())};
                surfaces_.emplace_back(make());
            }
            return static_cast<std::int8_t>(at.row);
        }
        const SphereSurface& surface(std::int8_t kind) const {
            return surfaces_[static_cast<std::size_t>(kind)];
        }

    private:
        struct Stamp {
            std::uint64_t pair = 0;
            std::int32_t row = 0;
        };
        std::vector<Place> places_;
        std::vector<SphereSurface> surfaces_;  // never moves: it holds kMost
        std::vector<Stamp> place_at_, kind_at_;
        std::uint64_t pair_ = 0;
    };

    // One T for each two kinds, made from `arguments`.
    template <class T>
    class Table {
    public:
        void begin() {
            made_.clear();
            ++pair_;
        }
        template <class... Arguments>
        T& get(std::int8_t a, std::int8_t b, const Arguments&... arguments) {
            auto& at = at_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
            if (at.pair != pair_) {
                at = {pair_, static_cast<std::uint32_t>(made_.size())};
                made_.emplace_back(arguments...);
            }
            return made_[at.row];
        }

    private:
        struct Stamp {
            std::uint64_t pair = 0;
            std::uint32_t row = 0;
        };
        std::vector<T> made_;
        std::array<std::array<Stamp, kMost>, kMost> at_;
        std::uint64_t pair_ = 0;
    };

    const PairView* view_ = nullptr;
    bool prefer_a_ = false;
    Body a_, b_;
    Table<KindBound> bounds_;
};

}  // namespace ice
