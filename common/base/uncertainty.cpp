// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/uncertainty.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace ice {

double student_quantile(double degrees, double chance) {
    return boost::math::quantile(
        boost::math::complement(boost::math::students_t(degrees), 0.5 * chance));
}

}  // namespace ice
