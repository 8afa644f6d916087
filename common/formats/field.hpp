// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/formats/sphere_set.hpp"

namespace ice {

/// One floe of a field: a shape and where it lies.
struct FieldFloe {
    std::int32_t shape = 0;  ///< row of Field::shapes
    /// x, y of the centre of mass [m]; its height is the solver's affair: it depends on densities.
    std::array<double, 2> position{};
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
    bool fixed = false;  ///< unbroken ice, which never moves
};

/// An ice field, made by icefield and read by icesolve. All spheres have one radius, all shapes
/// one region.
struct Field {
    double radius = 0.0, spacing = 0.0;  ///< of the spheres [m]
    std::string mode;                    ///< "fill" or "surface"
    std::array<double, 4> area{};        ///< x, y of the least and the greatest corner [m]
    double concentration = 0.0;          ///< area of the loose floes over `area`'s [-]
    std::string specification;           ///< the TOML it was made from, verbatim
    std::int64_t seed = 0;               ///< of the specification
    std::string created_by, command_line;

    std::vector<SphereSet> shapes;  ///< [K] body axes: z = 0 halfway up, origin at the centroid
    /// [F] loose floes first, then unbroken ice; as the specification numbers them
    std::vector<FieldFloe> floes;
};

}  // namespace ice
