// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/pair_kinds.hpp"

#include <algorithm>

namespace ice {

void PairKinds::begin(const PairView& view, bool prefer_a) {
    view_ = &view;
    prefer_a_ = prefer_a;
    a_.begin(view.shape_a);
    b_.begin(view.shape_b);
    bounds_.begin();
}

void PairKinds::Body::begin(const Shape& shape) {
    ++pair_;
    places_.clear();
    surfaces_.clear();
    surfaces_.reserve(kMost);
    place_at_.resize(std::max(place_at_.size(), shape.center.size()));
    kind_at_.resize(std::max(kind_at_.size(), shape.kinds));
}

}  // namespace ice
