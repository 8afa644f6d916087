// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/base/uncertainty.hpp"

namespace ice {

LeastSquares solve_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    ICE_ASSERT(a.rows() > 0);
    LeastSquares out;
    // QR, not the normal equations, which square the condition number of the columns.
    out.x = a.colPivHouseholderQr().solve(b);
    out.chi2 = (a * out.x - b).squaredNorm();
    return out;
}

FitSpread spread_of_fit(const Eigen::MatrixXd& a, double chi2, bool weighted) {
    const Eigen::Index n = a.cols();
    const auto degrees = static_cast<double>(a.rows() - n);
    const double scatter = degrees > 0.0 ? chi2 / degrees : 0.0;
    // If the fit is as good as the weights imply, the intervals follow from them; else they are
    // wider.
    const double scale = weighted ? std::max(1.0, scatter) : scatter;
    // Covariance (a^T a)^-1 times the variance of a point. With known deviations the points follow
    // the normal distribution; with a variance from the misses they follow Student's.
    return {(a.transpose() * a).ldlt().solve(Eigen::MatrixXd::Identity(n, n)) * scale,
            weighted        ? kNormalHalfWidth
            : degrees > 0.0 ? student_quantile(degrees, 0.05)
                            : std::nan(""),
            scatter};
}

}  // namespace ice
