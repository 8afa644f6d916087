// SPDX-License-Identifier: GPL-3.0-or-later
/// The certificate of a sphere set, spherize's JSON.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ice {

/// One place of the solid where no sphere fits.
struct ThinFeature {
    std::array<double, 3> at{};  ///< [m]
    double size = 0.0;           ///< extent of the unfilled surface there [m]
};

/// Certificate of a sphere set (schema spherize/1, docs/contract.md, section 2).
struct SpheresReport {
    int dimension = 3;
    double radius = 0.0, spacing = 0.0;
    std::int64_t spheres = 0, surface_spheres = 0;
    double volume = 0.0, area = 0.0;
    std::array<double, 3> centroid{};
    std::array<double, 6> inertia_unit_density{};  ///< xx, yy, zz, xy, xz, yz
    double protrusion_max = 0.0, covering_radius = 0.0;
    double gap_p50 = 0.0, gap_p99 = 0.0, gap_max = 0.0;
    double normal_error_mean_deg = 0.0, normal_error_p99_deg = 0.0;
    std::vector<ThinFeature> thin_features;
    std::vector<std::pair<std::string, std::int64_t>> repairs;  ///< step, count
    std::map<std::string, std::string> guessed;
    std::vector<std::string> warnings;
    std::map<std::string, double> seconds;
    std::string source_mesh, command_line;
};

/// The certificate as JSON text.
std::string spheres_report_text(const SpheresReport& report);

}  // namespace ice
