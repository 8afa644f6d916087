// SPDX-License-Identifier: GPL-3.0-or-later
/// `summary.json` and spherize's JSON: the numbers other programs read.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ice {

/// Statistics of one force component over t >= average_from; newtons, in 2D per metre of breadth.
struct ForceStatistics {
    double mean = 0.0, contact_mean = 0.0, friction_mean = 0.0;
    double std = 0.0, max = 0.0;  ///< max: of the magnitude, with the sign it had
    double ci95 = 0.0;            ///< half width of the 95 % interval of the mean, from batch means
};

/// What one region of the hull felt.
struct RegionStatistics {
    std::int64_t hits = 0;                  ///< times a floe began to touch the region
    double max_impulse = 0.0;               ///< largest impulse of one floe in one step [N s]
    std::array<double, 3> mean{};           ///< mean force of the ice on the region, world axes [N]
    std::array<double, 3> contact_mean{};   ///< of it normal forces; NaN in files without them
    std::array<double, 3> friction_mean{};  ///< of it friction; likewise
};

/// Content of summary.json (schema icesolve-summary/1, CONTRACT.md section 5).
struct Summary {
    std::string status = "completed";  ///< completed | interrupted | failed
    std::string title, simd = "scalar";
    std::int64_t steps = 0;
    double simulated_s = 0.0, wall_s = 0.0;
    int threads = 1, dimension = 3;
    std::uint64_t state_hash = 0;
    std::int64_t hull_spheres = 0, ice_spheres = 0;
    std::int64_t floes_total = 0, floes_moved = 0, floes_behind = 0;
    double average_from = 0.0;
    ForceStatistics resistance, lateral, vertical;
    std::map<std::string, RegionStatistics> regions;
    double contacts_mean = 0.0, contacts_max = 0.0, max_overlap = 0.0;
    std::int64_t unconverged_steps = 0;
    std::map<std::string, double> energy;         ///< [J], keys end in _J; residual_share [-]
    std::map<std::string, double> imbalance;      ///< worst step's, per kind; empty: not asked for
    std::map<std::string, double> stage_seconds;  ///< wall time per stage of the step
    std::optional<double> lindqvist_submersion;   ///< [N]; none where the hull has no waterline
    std::vector<std::string> warnings;
    std::string case_file, command_line;
};

/// The summary as JSON text, keys in the contract's order, numbers with all digits.
std::string summary_text(const Summary& summary);

/// Reads summary.json back.
/// @throws Error (exit code 2) naming the file and the key.
Summary read_summary(const std::filesystem::path& path);

/// All numbers of a JSON file by dotted key, e.g. "resistance.mean_N"; array elements as "key.0".
/// @throws Error (exit code 2) naming the file when it is no JSON.
std::map<std::string, double> read_json_numbers(const std::filesystem::path& path);

/// One place of the solid where no sphere fits.
struct ThinFeature {
    std::array<double, 3> at{};  ///< [m]
    double size = 0.0;           ///< extent of the unfilled surface there [m]
};

/// Certificate of a sphere set (schema spherize/1, CONTRACT.md section 2).
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
