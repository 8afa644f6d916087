// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/faces.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace ice {

namespace {

// A part this negative is still no normal of another place: 3 degrees where faces are square.
constexpr double kBelongs = -0.05;

}  // namespace

Faces Faces::meeting(std::span<const Vec3> normals) {
    Faces out;
    out.count = static_cast<int>(normals.size());
    for (std::size_t k = 0; k < normals.size(); ++k) out.normal[k] = normals[k];
    const Vec3 &f = out.normal[0], &g = out.normal[1], &h = out.normal[2];
    if (out.count == 2) {
        const double c = f.dot(g);
        out.part = {f - c * g, g - c * f, f.cross(g).normalized()};
        out.size = 1.0 - c * c;
    }
    if (out.count == 3) {
        const double volume = f.dot(g.cross(h)), sign = volume < 0.0 ? -1.0 : 1.0;
        out.part = {sign * g.cross(h), sign * h.cross(f), sign * f.cross(g)};
        out.size = std::abs(volume);
    }
    return out;
}

Faces Faces::turned(const Mat3& turn) const {
    Faces out = *this;
    if (count == 0) return out;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
        out.normal[k] = turn * normal[k];
    for (std::size_t k = 0; k < 3; ++k) out.part[k] = turn * part[k];
    return out;
}

bool Faces::have(const Vec3& n, double most_along, double slack) const {
    const double least = kBelongs * size - slack;  // no `part` is longer than 1
    if (n.dot(part[0]) < least || n.dot(part[1]) < least) return false;
    const double last = n.dot(part[2]);
    return count == 2 ? std::abs(last) <= most_along + slack : last >= least;
}

}  // namespace ice
