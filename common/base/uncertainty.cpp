// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/uncertainty.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "common/base/assert.hpp"

namespace ice {

double student_quantile(double degrees, double chance) {
    ICE_ASSERT(degrees > 0.0 && chance > 0.0 && chance < 1.0);
    // Both sides together: half the chance lies beyond each end. The complement keeps the digits of
    // small chances, which 1 - chance would lose.
    return boost::math::quantile(
        boost::math::complement(boost::math::students_t(degrees), 0.5 * chance));
}

double chance_of_at_least(std::int64_t count, std::int64_t trials, double each) {
    ICE_ASSERT(count > 0 && count <= trials && each > 0.0 && each < 1.0);
    return boost::math::cdf(boost::math::complement(
        boost::math::binomial(static_cast<double>(trials), each), static_cast<double>(count - 1)));
}

}  // namespace ice
