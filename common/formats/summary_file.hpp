// SPDX-License-Identifier: GPL-3.0-or-later
/// `summary.json`: the results of a run, for other programs.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/formats/load_statistics.hpp"
#include "common/formats/particulars.hpp"
#include "common/formats/warning.hpp"

namespace ice {

/// Statistics of one force component over t >= average_from; newtons, in 2D per metre of breadth.
struct ForceStatistics {
    double mean = 0.0, contact_mean = 0.0, friction_mean = 0.0;
    double std = 0.0, max = 0.0;  ///< max: of the magnitude, with the sign it had
    double ci95 = 0.0;            ///< half width of the 95 % interval of the mean; NaN: too short

    /// Integrated autocorrelation time [s]: number of independent samples = averaged time /
    /// correlation time. NaN if the averaged time is too short.
    double correlation_time = std::numeric_limits<double>::quiet_NaN();
    double effective_samples =
        std::numeric_limits<double>::quiet_NaN();             ///< number of independent samples [-]
    double trend = std::numeric_limits<double>::quiet_NaN();  ///< change over the averaged time of
                                                              ///< the straight line through it [N]
    /// Resistance of a case with floes held until they bend: the force before they break off, and
    /// all else; they add up to `mean`.
    std::optional<double> breaking_mean = std::nullopt, submersion_mean = std::nullopt;
    std::optional<bool> trend_significant =
        std::nullopt;  ///< at 99 % (kTrendChance); none: too short
};

/// Loads on one region of the hull.
struct RegionStatistics {
    std::int64_t hits = 0;                  ///< count: times a floe began to touch the region
    double max_impulse = 0.0;               ///< largest impulse of one floe in one step [N s]
    std::array<double, 3> mean{};           ///< mean force of the ice on the region, world axes [N]
    std::array<double, 3> contact_mean{};   ///< its normal forces; NaN in files without them
    std::array<double, 3> friction_mean{};  ///< its friction; NaN in files without it
    /// None in files without them; line_load: of the hardest panel at each instant.
    std::optional<PeakStatistics> force_peaks = std::nullopt, line_load_peaks = std::nullopt;
};

/// Loads on the hull's panels.
struct PanelSummary {
    double size = 0.0, window = 0.0;      ///< [m], [s]; 0 in files without panels
    std::int64_t count = 0, touched = 0;  ///< counts: of the hull; with a load
    std::vector<std::pair<std::string, PanelLoad>> hardest;  ///< region's name, panel
};

/// Several runs of one case that differ in a seed (`icesolve --seeds`).
struct Ensemble {
    double mean = 0.0;          ///< of the members' mean resistances [N], in 2D [N/m]
    double ci95 = 0.0;          ///< half width of Student's 95 % interval of it; NaN for one member
    std::vector<double> means;  ///< [M] mean resistance of each member [N], in 2D [N/m]
    std::vector<std::int64_t> seeds;  ///< [M] of each member
};

/// The flow around the hull that a run took its water's motion from.
struct FlowSummary {
    std::string model;        ///< "double-body" or "file"
    std::int64_t panels = 0;  ///< 0: from elsewhere
    double residual = 0.0;    ///< area-rms of the normal velocity left, over the speed [-]
};

/// Content of summary.json (schema icesolve-summary/1, docs/contract.md, section 5).
struct Summary {
    std::string status = "completed";  ///< completed | interrupted | failed
    std::string title, simd = "scalar";
    std::int64_t steps = 0;                          ///< count
    double simulated_s = 0.0, wall_s = 0.0;          ///< [s]
    int threads = 1, dimension = 3;                  ///< count; 3 or 2
    std::uint64_t state_hash = 0;                    ///< of the bodies at the end, bit by bit
    std::int64_t hull_spheres = 0, ice_spheres = 0;  ///< counts
    std::int64_t floes_total = 0, floes_moved = 0, floes_behind = 0;  ///< counts
    double average_from = 0.0;                                        ///< start of the means [s]
    ShipParticulars ship;
    IceParticulars ice;
    std::optional<CrackParticulars> cracks;  ///< of a sheet in 3D from which pieces broke off
    TravelParticulars travel;
    ForceStatistics resistance, lateral, vertical;
    std::map<std::string, RegionStatistics> regions;
    PanelSummary panels;
    double contacts_mean = 0.0, contacts_max = 0.0;  ///< counts of contacts per step
    double max_overlap = 0.0;                        ///< deepest of a contact [m]
    /// Deepest overlap of two solids less that of their contacts [m]; NaN: not measured.
    double unseen_overlap = std::numeric_limits<double>::quiet_NaN();
    std::int64_t unconverged_steps = 0;  ///< count, of `steps`
    /// Impulses that unconverged steps lack, as a share of all in the averaged time [-]; NaN:
    /// unknown.
    double residual_share = std::numeric_limits<double>::quiet_NaN();
    std::map<std::string, double> energy;     ///< [J], keys end in _J; residual_share [-]
    std::map<std::string, double> imbalance;  ///< worst step's, per kind; empty without --verify
    std::map<std::string, double> stage_seconds;  ///< wall time per stage of the step [s]
    std::optional<double> lindqvist_submersion;   ///< [N]; none where the hull has no waterline
    std::vector<FormulaValue> formulas;           ///< of the same ship and ice [N]
    /// Flexural strength in the formulas [Pa] where it is not that of `ice`; NaN else. Not in the
    /// file.
    double formula_strength = std::numeric_limits<double>::quiet_NaN();
    std::optional<FlowSummary> flow;   ///< none: no flow around the hull
    std::optional<Ensemble> ensemble;  ///< of an ensemble's folder
    std::vector<Warning> warnings;
    std::string case_file, command_line;
};

/// The summary as JSON text, keys in the contract's order, numbers with all digits. In 2D every
/// key that ends in _N, _Ns or _J has a twin with _per_m behind it: forces per metre of breadth.
std::string summary_text(const Summary& summary);

/// Reads summary.json back. Warnings may be a plain list of texts, as older programs wrote them.
/// @throws Error (exit code 2) naming the file and the key.
Summary read_summary(const std::filesystem::path& path);

/// All numbers of a JSON file by dotted key, e.g. "resistance.mean_N"; array elements as "key.0".
/// @throws Error (exit code 2) naming the file when it is no JSON.
std::map<std::string, double> read_json_numbers(const std::filesystem::path& path);

}  // namespace ice
