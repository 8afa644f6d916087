// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/window_forces.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "common/base/assert.hpp"
#include "common/formats/checkpoint_file.hpp"
#include "solver/record/find_peaks.hpp"

namespace ice {

namespace {

// Bits of a double that a class leaves out [-]. Its exponent and the first 7 digits of its mantissa
// remain: 128 classes between powers of two, so that a quantile is right to 0.4 %. Forces over
// eight powers of two then take as much memory as kExact forces. One bit more left out halves
// classes and memory, and doubles that error.
constexpr int kDropped = 45;

// The bits of positive doubles rise with their values, so the leading ones number classes of equal
// width on each octave: 2^-7 of the value, 0.4 % from a class' middle. No logarithm is needed.
std::int32_t class_of(double force) {
    return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(force) >> kDropped);
}

double lower_bound_of(std::int32_t number) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(number) << kDropped);
}

double middle_of(std::int32_t number) {
    return 0.5 * (lower_bound_of(number) + lower_bound_of(number + 1));
}

// Lists of many one after the other, and how long each is.
template <class Row>
void carry_lists(CheckpointFile& file, const std::string& name,
                 std::vector<std::vector<Row>>& all) {
    std::vector<std::int64_t> counts;
    std::vector<Row> flat;
    for (const auto& list : all) {
        counts.push_back(static_cast<std::int64_t>(list.size()));
        flat.insert(flat.end(), list.begin(), list.end());
    }
    file.carry_each(name + ".lengths", counts);
    file.carry(name, flat);
    auto next = flat.begin();
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto end = next + std::clamp<std::ptrdiff_t>(counts[k], 0, flat.end() - next);
        all[k].assign(next, end);
        next = end;
    }
}

}  // namespace

void WindowForces::add(double force) {
    ICE_ASSERT(force > 0.0);
    sum_ += force;
    largest_ = std::max(largest_, force);
    if (!classes_.empty()) return count(force);
    if (forces_.size() < kExact) return forces_.push_back(force);
    // The first force beyond kExact turns the list into classes: memory no longer grows with the
    // run.
    for (const double one : forces_) count(one);
    count(force);
    forces_ = {};
}

void WindowForces::count(double force) {
    const std::int32_t number = class_of(force);
    const auto place =
        std::lower_bound(classes_.begin(), classes_.end(), number,
                         [](const Class& c, std::int32_t n) { return c.number < n; });
    if (place != classes_.end() && place->number == number)
        ++place->count;
    else
        classes_.insert(place, {number, 1});
}

std::int64_t WindowForces::added() const {
    return std::accumulate(classes_.begin(), classes_.end(),
                           static_cast<std::int64_t>(forces_.size()),
                           [](std::int64_t sum, const Class& c) { return sum + c.count; });
}

double WindowForces::quantile(double share, std::int64_t windows) const {
    ICE_ASSERT(windows >= added());
    if (classes_.empty()) {
        std::vector<double> forces = forces_;
        // windows without a load are not stored
        forces.resize(static_cast<std::size_t>(windows), 0.0);
        return ice::quantile(std::move(forces), share);
    }
    // so many windows have this force or more
    // Counted from above, where the loads are: windows without a load have no class.
    auto above = windows - static_cast<std::int64_t>(std::max(
                               0.0, std::ceil(share * static_cast<double>(windows)) - 1.0));
    for (auto c = classes_.rbegin(); c != classes_.rend(); ++c) {
        above -= c->count;
        if (above <= 0) return std::min(middle_of(c->number), largest_);
    }
    return 0.0;
}

void WindowForces::carry(CheckpointFile& file, const std::string& name,
                         std::vector<WindowForces>& all) {
    // a list of classes is stored as two columns, and made from them again when it is read
    std::vector<std::vector<double>> forces;
    std::vector<std::vector<std::int32_t>> numbers(all.size()), counts(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        forces.push_back(std::move(all[k].forces_));
        for (const Class& c : all[k].classes_) {
            numbers[k].push_back(c.number);
            counts[k].push_back(c.count);
        }
    }
    carry_lists(file, name + ".forces", forces);
    carry_lists(file, name + ".class_numbers", numbers);
    carry_lists(file, name + ".class_counts", counts);
    file.column(name + ".sum", all, &WindowForces::sum_);
    file.column(name + ".largest", all, &WindowForces::largest_);
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].forces_ = std::move(forces[k]);
        all[k].classes_.clear();
        for (std::size_t n = 0; n < std::min(numbers[k].size(), counts[k].size()); ++n)
            all[k].classes_.push_back({numbers[k][n], counts[k][n]});
    }
}

}  // namespace ice
