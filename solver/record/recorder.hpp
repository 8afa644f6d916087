// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the run folder during the run (docs/contract.md, section 5).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/formats/run_file.hpp"
#include "common/formats/summary_file.hpp"
#include "solver/case/case.hpp"
#include "solver/live_edge/live_edge.hpp"
#include "solver/record/csv_file.hpp"
#include "solver/record/energy_ledger.hpp"
#include "solver/record/hull_contacts.hpp"
#include "solver/record/panel_loads.hpp"
#include "solver/record/run_statistics.hpp"
#include "solver/record/ship_statistics.hpp"

namespace ice {

class CheckpointFile;

/// The world after a step, as the recorder sees it.
struct StepView {
    const Scene& scene;
    const std::vector<Contact>& contacts;
    const std::vector<Constraint>& constraints;
    const EnergyLedger& ledger;
    double time;                     ///< at the end of the step [s]
    bool converged;                  ///< both stages of the contact solver
    const FreeShip* ship = nullptr;  ///< null for a prescribed course
    const LiveEdge* edge = nullptr;  ///< null without level ice
};

/// Lengths of a run's files, for a run that is continued from them.
struct RecordPosition {
    RunPosition run;
    std::vector<std::int64_t> csv_bytes;  ///< of forces.csv, then of the tracked floes' files
};

/// run.h5, forces.csv, floe_<id>.csv and the numbers of summary.json.
///
/// Rows of the histories are means over history_every (contacts, forces) or the maximum (overlap);
/// tracked floes' poses are those at the end of the row.
class Recorder {
public:
    /// @throws Error (exit code 2) where a tracked floe does not exist or is named twice.
    Recorder(const Case& parameters, const Scene& scene);

    /// Creates the folder's files and stores the first frame.
    /// @throws Error (exit code 1) when it cannot.
    void open(const std::filesystem::path& folder, const std::string& command_line,
              const Scene& scene);
    /// Continues an earlier run from its files in `earlier`, which may be `folder`:
    /// their first rows as far as `position`.
    /// @pre the state was carried over (run/state_fields.hpp)
    /// @return names of the files whose earlier rows are missing there: those begin now
    std::vector<std::string> resume(const std::filesystem::path& folder,
                                    const std::string& command_line, const Scene& scene,
                                    const std::filesystem::path& earlier,
                                    const RecordPosition& position);
    /// Saves all rows up to now from a kill. @return their numbers
    RecordPosition save_rows();
    /// Writes all rows up to now into their own files, for a run that ends here. @return their
    /// numbers
    RecordPosition write_rows();
    /// Bytes of the rows of run.h5 that wait to be written.
    std::uint64_t waiting_bytes() const { return run_->waiting_bytes(); }
    /// Will the next rows cause a write?
    bool is_about_to_write() const { return run_->is_about_to_write(); }

    void add(const StepView& view);

    /// How a free ship travelled; nothing for a prescribed course.
    std::optional<FreeTravel> travel(const StepView& view) const;

    /// Completes and renames the files, and fills the summary's recorded part.
    void finish(const StepView& view, Summary& summary);

    /// Writes or sets its state, by the file's direction (recorder_state.cpp).
    void carry(CheckpointFile& file);

private:
    RecordPosition position_of(RunPosition run);
    void add_history(const StepView& view, const StepRecord& record);
    void add_ship(const StepView& view);
    void flush_history(const StepView& view);
    void add_frame(const StepView& view);
    bool is_check_due(double time) const;

    Case parameters_;
    double dt_;                       ///< time step [s]
    std::filesystem::path folder_;    ///< from open() or resume() on
    std::optional<RunWriter> run_;    ///< from open() or resume() on
    std::vector<CsvFile> csv_files_;  ///< forces.csv, then the tracked floes'
    RunStatistics statistics_;
    PanelLoads panel_loads_;
    ShipStatistics ship_statistics_;
    std::vector<std::int32_t> track_of_;  ///< per body, its number among the tracked floes, or -1
    std::vector<FloeForces> tracked_;     ///< per tracked floe, in the last step

    HistoryRow row_;
    std::vector<RegionForce> row_regions_;  ///< impulses on the hull's regions in the row [N s]
    int row_steps_ = 0;
    std::vector<FloeForces> tracked_sum_;  ///< per tracked floe, since the last row
    std::vector<Vec3> frame_impulse_;      ///< ship on floe since the last frame [N s]
    HullContacts hull_contacts_;           ///< since the last frame
    double last_frame_ = 0.0;              ///< its time [s]
    std::int64_t frames_ = 0, rows_ = 0;
};

/// Equal states, equal hashes: poses, momenta and the last step's impulses, bit for bit.
std::uint64_t state_hash(const Scene& scene, const std::vector<Constraint>& constraints);

/// Floes whose centre is aft of the hull's aftmost point.
bool is_behind(const Scene& scene, std::size_t floe);

}  // namespace ice
