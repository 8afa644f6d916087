// SPDX-License-Identifier: GPL-3.0-or-later
/// `run.h5`: poses, shapes and forces of a run, readable by h5py and xarray.
///
/// Layout (S samples, F frames, B floes):
///
///     /time [S] s                    /ship/contact_force, friction_force, force, moment [S,3]
///     /ship/pose [S,7] m, w x y z    /ship/contacts, moving_floes, max_overlap, kinetic_energy [S]
///     /regions/contact_force, friction_force [S,R,3]   of the ice on each region of the hull
///     /panels/center, normal [P,3]  /panels/area, length, force_mean, force_p99, force_max [P]
///     /panels/panel, region [P]     /shapes/hull_panel [hull spheres]   by finish() only
///     /frames/frame_time [F] s         /frames/body [B]  (ids, from 1)
///     /frames/position [F,B,3]         /frames/orientation [F,B,4] w x y z, body to world
///     /frames/velocity, angular_velocity, contact_force [F,B,3]   /frames/state [F,B]
///     of a free ship: /ship/velocity, angles, tow_force [S,3], thrust [S]
///                             /frames/ship_orientation [F,4] w x y z, ship to world
///     /frames/ship_position [F,3]      /frames/body_shape, body_group, mass [B], inertia [B,3]
///     /contacts/contact_time [C] s     hull contacts, forces as means since the frame before
///     /contacts/frame, floe, sphere [C]   /contacts/point [C,3] m in the ship frame
///     /contacts/normal_force, friction_force [C,3]
///     /shapes/vertex_offset, vertices, triangle_offset, triangles, region, sphere_offset, spheres
///     of a case with a flow around its hull: /flow/point [A,3] m, /flow/velocity [A,3],
///     /flow/arrow [A]
///     /tracked/floe [K] ids            /tracked/<id> [S,22], columns named in track_columns()
///     /region_names, /hull_regions, /xyz, /wxyz, /pose_parts, /track_columns   labels
///
/// Every dimension outside /shapes is labelled by a dimension scale, so that xarray names it.
/// Times, histories and masses are double; poses, meshes and forces on regions float. Datasets have
/// `units` and, where the name is not enough, `long_name`; "/" has `average_from` [s].
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "common/formats/run_data.hpp"

namespace ice {

/// Floe in a frame before it is compressed [bytes]: 16 floats and its state.
inline constexpr std::uint64_t kFrameFloeBytes = 16 * sizeof(float) + sizeof(FloeState);
/// These bytes, rounded up to whole floats: bounds count with them. The frames of a chunk depend on
/// it, and so the bytes of a file with many floes.
inline constexpr std::uint64_t kFrameFloeBound = 17 * sizeof(float);

/// Length of a run file's datasets, for a run that is continued from it.
struct RunPosition {
    std::int64_t samples = 0, frames = 0, contacts = 0;  ///< rows on disk
    std::vector<Eigen::Quaterniond> last_orientation;    ///< of the last frame, signs as stored
};

/// Writes run.h5 during the run, as `run.h5.part`, renamed by finish().
///
/// Rows are buffered and flushed to disk with every 20th frame, so that a killed run can be read up
/// to there (without frames, with every 16384th sample), its histories and contacts up to the last
/// whole 64 rows: a compressed chunk cannot safely be written again with more rows. FileTurn keeps
/// read_run() out while rows are written, and a flush waits until it has read. Quaternions are
/// stored with the sign nearer to the frame before.
///
/// All functions throw Error (exit code 1) naming the file when the disk is full.
class RunWriter {
public:
    RunWriter(const std::filesystem::path& path, const RunHeader& header);
    /// Goes on with a run whose files lie in the folder `earlier`, which may be that of `path`:
    /// the rows up to `position` come, bit by bit, from its saved rows, run.h5 or run.h5.part,
    /// whichever holds them. Nothing of `earlier` changes before they are copied.
    RunWriter(const std::filesystem::path& path, const RunHeader& header,
              const std::filesystem::path& earlier, const RunPosition& position);
    /// True when none of these held the rows: the file then begins without them.
    bool begins_late() const { return begins_late_; }
    RunWriter(RunWriter&&) noexcept;
    ~RunWriter();  ///< without finish() the .part file stays, readable up to its last flush

    /// @param regions one per region of the hull (header.shapes[0]); without them NaN is stored
    void add(const HistoryRow& row, const std::vector<RegionForce>& regions = {});
    /// Call once after each add(HistoryRow) when floes are tracked.
    /// @param rows one per tracked floe, in the order of header.tracked
    void add_tracked(const std::vector<TrackRow>& rows);
    void add(const RunFrame& frame);
    /// Saves all rows so that a kill at any moment leaves them readable, in files
    /// checkpoint-rows-*.h5 beside run.h5, and returns their numbers.
    RunPosition save_rows();
    /// Writes all rows to run.h5 itself, for a run that ends here. @return their numbers
    RunPosition write_rows();
    /// Bytes of the rows that are not in the file yet, uncompressed.
    std::uint64_t waiting_bytes() const;
    /// True where the next sample or frame makes it write to the disk.
    bool is_about_to_write() const;
    /// Writes buffered rows, closes and renames. Nothing may be added afterwards.
    void finish(const HullPanels& panels = {});

private:
    struct Buffers;
    std::unique_ptr<Buffers> buffers_;
    bool begins_late_ = false;
};

/// Removes the files of saved rows; finish() does so, too.
void remove_saved_rows(const std::filesystem::path& folder);

/// Names of the columns of /tracked/<id>, SI units, world axes; the times are those of /time.
const std::vector<std::string>& track_columns();

/// A whole run in memory.
struct RunData {
    RunHeader header;
    std::vector<HistoryRow> history;
    std::vector<RegionHistory> regions;         ///< of the hull; none in files of before
    std::vector<std::vector<TrackRow>> tracks;  ///< per tracked floe
    std::vector<RunFrame> frames;
    HullPanels panels;  ///< empty in files of before and of killed runs
};

/// Reads run.h5, or run.h5.part of a killed or running run. A running one is read as
/// its last flush left it; where a kill tore a flush, arrays that belong together give as many rows
/// as the shortest has.
/// @throws Error (exit code 2) naming the file and the dataset.
RunData read_run(const std::filesystem::path& path);

}  // namespace ice
