// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Signed solid angle of a triangle seen from p, as a share of the whole sphere [-]: -0.5 to 0.5,
/// positive from behind (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983). Places
/// in [m].
double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Generalised winding number of any set of triangles: the solid angle they cover seen from a
/// point, over 4 pi. 1 inside and 0 outside a closed outward surface, in between near openings.
///
/// Jacobson et al., "Robust inside-outside segmentation using generalized winding numbers",
/// SIGGRAPH 2013; triangles farther than beta times their reach together as one dipole, Barill et
/// al., "Fast winding numbers for soups and clouds", SIGGRAPH 2018 (first order). A triangle
/// without area counts nothing. Thread-safe once built. Build O(T log T).
class WindingNumber {
public:
    /// Distance over reach [-] from which a node acts as a dipole: errors of up to 0.04. Larger is
    /// more accurate and slower.
    static constexpr double kBeta = 2.0;

    /// Copies the needed data of the mesh.
    explicit WindingNumber(const TriangleMesh& mesh);

    /// @param beta  accuracy: errors of up to 0.16 / beta^2; infinity adds up all solid angles
    /// Winding number [-] at p [m]; 0 for an empty mesh.
    double at(const Vec3& p, double beta = kBeta) const;

    /// Whether |at(p)| > 0.5 by the exact sum: beta grows while 0.5 is within the error. On the
    /// surface either answer is possible.
    bool contains(const Vec3& p) const;

private:
    struct Node {
        Vec3 center;                        ///< area-weighted
        Vec3 area;                          ///< sum of area vectors [m2]
        double reach = 0.0;                 ///< of the triangles from the center [m]
        std::int32_t first = 0, count = 0;  ///< leaf: range of corners_; inner node: count 0
        std::int32_t right = 0;  ///< inner node: second child; the first is the next node
    };

    std::int32_t build(const TriangleMesh& mesh, std::vector<std::int32_t>& order,
                       const std::vector<Vec3>& centers, std::int32_t first, std::int32_t count);

    std::vector<Node> nodes_;
    std::vector<std::array<Vec3, 3>> corners_;
};

}  // namespace ice
