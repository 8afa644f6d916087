// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the run folder while the run goes on (CONTRACT.md, section 5).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/formats/run_file.hpp"
#include "common/formats/summary_file.hpp"
#include "solver/case/case.hpp"
#include "solver/record/csv_file.hpp"
#include "solver/record/energy_ledger.hpp"
#include "solver/record/tally.hpp"

namespace ice {

/// The world after a step, as the recorder sees it.
struct StepView {
    const Scene& scene;
    const std::vector<Contact>& contacts;
    const std::vector<Constraint>& constraints;
    const EnergyLedger& ledger;
    double time;     ///< at the end of the step [s]
    bool converged;  ///< both stages of the contact solver
};

/// run.h5, forces.csv, floe_<id>.csv and the numbers of summary.json.
///
/// Rows of the histories are means over history_every (contacts, forces) or the maximum (overlap);
/// tracked floes' poses are those at the end of the row.
class Recorder {
public:
    /// Creates the folder's files. @throws Error (exit code 1) when it cannot.
    Recorder(const std::filesystem::path& folder, const Case& parameters, const Scene& scene,
             const std::string& command_line);

    void add(const StepView& view);

    /// Completes and renames the files, and fills the summary's recorded part.
    void finish(const StepView& view, Summary& summary);

private:
    void add_history(const StepView& view, const StepRecord& record);
    void flush_history(const StepView& view);
    void add_frame(const StepView& view);

    Case parameters_;
    double dt_;
    RunWriter run_;
    CsvFile forces_;
    std::vector<CsvFile> floe_files_;
    Tally tally_;

    HistoryRow row_;
    int row_steps_ = 0;
    std::vector<FloeForces> floe_forces_;  ///< of the last step, per body
    std::vector<FloeForces> tracked_sum_;  ///< per tracked floe, since the last row
    std::vector<Vec3> frame_impulse_;      ///< ship on floe since the last frame [N s]
    std::vector<Quaternion> last_orientation_;
    double last_frame_ = 0.0;
    std::int64_t frames_ = 0, rows_ = 0;
};

/// Equal states, equal hashes: poses, momenta and the last step's impulses.
std::uint64_t state_hash(const Scene& scene, const std::vector<Constraint>& constraints);

/// Floes whose centre is aft of the hull's aftmost point.
bool is_behind(const Scene& scene, std::size_t floe);

}  // namespace ice
