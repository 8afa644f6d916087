// SPDX-License-Identifier: GPL-3.0-or-later
/// Straight-line and polynomial fits to measured points, and how sure their coefficients are.
#pragma once

#include <Eigen/Core>

namespace ice {

/// Half width of a 95 % interval per standard deviation [-], of the normal distribution.
inline constexpr double kNormalHalfWidth = 1.959963984540054;

/// The solution of min |a x - b|, in the units of the caller's columns and rows.
struct LeastSquares {
    Eigen::VectorXd x;  ///< [C] one per column of a
    double chi2;        ///< |a x - b|^2 [-] where rows are in standard deviations, else [b^2]
};

/// @param a  points x coefficients, rows in units of the points' standard deviations, or as they
///           are; of full rank, else the columns that the rest determines get any value
/// @param b  [R] one value per row of a
/// @pre a has a row
LeastSquares solve_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// How far coefficients may be off: t sqrt(covariance(i, i)) is the half width of a 95 % interval.
struct FitSpread {
    Eigen::MatrixXd covariance;  ///< [C,C] of the coefficients
    double t;                    ///< [-]; NaN where no point is left over to judge by
    double scatter;              ///< chi^2 per degree of freedom; 0 without any
};

/// @param weighted  the rows of `a` are in units of the points' standard deviations: the intervals
///                  are those of the points, wider where the points miss the curve by more.
///                  Else the misses alone decide (Student).
FitSpread spread_of_fit(const Eigen::MatrixXd& a, double chi2, bool weighted);

}  // namespace ice
