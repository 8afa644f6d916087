// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/base/time_rounding.hpp"
#include "common/formats/summary_file.hpp"
#include "solver/contact/solve_contacts.hpp"
#include "solver/record/long_series.hpp"
#include "solver/record/measure_step.hpp"
#include "solver/record/solid_overlap.hpp"

namespace ice {

class CheckpointFile;

/// Properties of a run that RunStatistics needs.
struct StatisticsOptions {
    std::vector<std::string> region_names;  ///< of the hull
    double average_from = 0.0;              ///< [s]; means use steps that end at or after it
    bool rigid = true;                      ///< contact.crushing_pressure is inf
    double worrying_overlap = 0.0;          ///< [m]; deeper ones are worth a warning
    double tunnelling_speed = std::numeric_limits<double>::infinity();  ///< [m/s]; faster ones, too
    bool bends = false;  ///< are there floes held until they bend?
};

/// Collects the values of summary.json, step by step.
class RunStatistics {
public:
    explicit RunStatistics(StatisticsOptions options);

    /// @param time      at the end of the step [s] @param dt  its length [s]
    /// @param residual  residual_impulse() [N s] where a solver stage of the step did not converge
    void add(const StepRecord& record, double time, double dt, std::optional<double> residual);

    /// Adds the overlaps of solids found at the end of a step, at `time` [s].
    void add_check(const OverlapFound& found, const StepRecord& record, double time);

    /// Fills in forces, regions, contacts, energy and warnings of a summary.
    /// @pre the summary holds the ledger's energies
    void fill(Summary& summary) const;

    /// Writes or sets its state, by the file's direction (recorder_state.cpp).
    void carry(CheckpointFile& file);

private:
    struct Region {
        std::int64_t hits = 0;
        double max_impulse = 0.0;      ///< [N s]
        Vec3 impulse = Vec3::Zero();   ///< sum over the averaged time [N s]
        Vec3 friction = Vec3::Zero();  ///< the part of friction in it
    };

    bool is_averaged(double time) const { return time >= options_.average_from - kTimeRounding; }

    /// Averaged steps of a doubtful kind.
    struct Doubtful {
        double force = 0.0;  ///< sum of their forces along x [N]
        std::int64_t steps = 0;
    };

    /// Loads on the hull at the checks in the averaged time.
    struct UnseenLoads {
        double all = 0.0, doubtful = 0.0;  ///< sums along x; of floes in worrying overlaps [N s]
        std::int64_t pressing = 0;         ///< floes that press on the hull
        std::int64_t missing = 0;          ///< floes that lie in it unseen and do not press
    };

    void add_averaged(const StepRecord& record, double dt);
    void add_regions(const StepRecord& record, bool averaged);
    void add_jam(const StepRecord& record, double time);
    void add_unseen_loads(const std::vector<UnseenOverlap>& worrying, const StepRecord& record);

    // run_statistics_warnings.cpp
    void warn(Summary& summary) const;
    Warning warn_of_jam(const Summary& summary) const;
    Warning warn_of_overlap(const Summary& summary) const;
    Warning warn_of_unseen() const;
    void judge_start(Summary& summary) const;
    std::optional<double> unseen_share() const;
    Warning warn_of_tunnelling(const Summary& summary) const;
    std::optional<double> change_without(const Doubtful& kind, double mean) const;

    StatisticsOptions options_;
    double averaged_time_ = 0.0;                             ///< [s]
    LongSeries total_[3];                                    ///< per averaged step, per axis [N]
    Vec3 contact_ = Vec3::Zero(), friction_ = Vec3::Zero();  ///< sums of its parts [N]
    double breaking_x_ = 0.0;  ///< sum along x by floes held until they bend [N]
    std::vector<Region> regions_;
    std::set<std::pair<std::int32_t, std::int32_t>> touching_;  ///< (floe, region) of the last step
    std::int64_t steps_ = 0, unconverged_ = 0, jammed_steps_ = 0;
    double contacts_ = 0.0, contacts_max_ = 0.0, max_overlap_ = 0.0;  ///< overlap [m]
    std::int64_t checks_ = 0,
                 doubtful_checks_ = 0;  ///< of the solids; with a worrying unseen overlap
    double unseen_overlap_ = 0.0, unseen_time_ = 0.0;  ///< [m], [s]
    std::int32_t unseen_a_ = 0, unseen_b_ = 0;
    UnseenLoads unseen_loads_;
    double kinetic_ = 0.0, kinetic_max_ = 0.0;  ///< [J]
    double impulse_ = 0.0, residual_ = 0.0;     ///< sums over the averaged time [N s]
    Doubtful jam_, fast_;
    double first_jam_time_ = 0.0, deepest_time_ = 0.0, closing_time_ = 0.0;  ///< [s]
    double closing_speed_ = 0.0;                                             ///< [m/s]
    std::int32_t first_jam_floe_ = 0, closing_a_ = 0, closing_b_ = 0;
    Vec3 first_jam_point_ = Vec3::Zero();  ///< [m]
};

}  // namespace ice
