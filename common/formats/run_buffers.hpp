// SPDX-License-Identifier: GPL-3.0-or-later
/// The inside of RunWriter: run.h5 and the rows that are not in it yet. Used by run_file.cpp and
/// run_rows.cpp only.
#pragma once

#include <algorithm>

#include "common/formats/run_column.hpp"
#include "common/formats/run_file.hpp"

namespace ice {

namespace run_parts {
// Rows per chunk [-]. Chunks are compressed, so that one written again with more rows has another
// length and place; a kill in between leaves a file whose last chunk cannot be read (1 of 6
// kills of a run that flushes ten times a second). Hence only whole chunks are written while the
// run continues.
//
// Larger chunks compress better and lose more rows to a kill; smaller ones make the file larger,
// and HDF5's index of them in memory: an hour of level ice had 27 500 chunks of 64 contacts, and
// their index took 8.5 MB after 40 minutes.
constexpr std::uint64_t kMostFrames = 20;
constexpr std::uint64_t kHistoryChunk = 64;
constexpr std::uint64_t kContactChunk = 1024;

// Frames per chunk of a run with so many floes: of a million floes 20 frames would take 1.4 GB.
inline std::uint64_t frames_per_chunk(std::uint64_t floes) {
    // Frames of a chunk at most [bytes]. A larger value needs more memory, a smaller one compresses
    // less.
    constexpr std::uint64_t kBytes = 32 << 20;
    return std::clamp<std::uint64_t>(kBytes / (kFrameFloeBound * std::max<std::uint64_t>(floes, 1)),
                                     1, kMostFrames);
}
}  // namespace run_parts

struct RunWriter::Buffers {
    Buffers(const std::filesystem::path& path, const std::filesystem::path& part,
            const RunHeader& header);
    void create_history(const RunHeader& header);
    void create_frames(const RunHeader& header);
    void create_regions(const RunHeader& header);
    void create_contacts(const RunHeader& header);
    void write_whole_chunks();
    void write_all();
    void write_rows(bool all);

    // run_rows.cpp
    void copy_rows(const std::filesystem::path& earlier, const RunPosition& stop);
    void copy_saved_rows(const std::filesystem::path& folder, const RunPosition& stop);
    void save_rows();

    // every column of one kind, whatever its type
    template <class Work>
    void for_history(const Work& work) {
        for (Column<double>* column : {&time, &contact, &friction, &total, &moment, &pose,
                                       &contacts, &moving, &overlap, &energy})
            work(*column);
        if (ship_is_free)
            for (Column<double>* column : {&ship_velocity, &ship_angles, &thrust, &tow})
                work(*column);
        work(region_contact);
        work(region_friction);
        for (Column<double>& column : tracks) work(column);
    }
    template <class Work>
    void for_frames(const Work& work) {
        work(frame_time);
        work(ship_position);
        if (ship_is_free) work(ship_orientation);
        for (Column<float>* column : {&position, &orientation, &velocity, &spin, &floe_force})
            work(*column);
        work(state);
    }
    template <class Work>
    void for_contacts(const Work& work) {
        work(contact_time);
        for (Column<std::int32_t>* column : {&contact_frame, &contact_floe, &contact_sphere})
            work(*column);
        for (Column<float>* column : {&contact_point, &contact_push, &contact_rub}) work(*column);
    }

    template <class T>
    using Column = run_parts::Column<T>;

    std::filesystem::path final_path, part_path;
    Hdf5File file;
    int dimension = 3;
    std::size_t bodies = 0;
    std::uint64_t samples = 0, frames = 0, contact_rows = 0;  // buffered, not on disk yet
    RunPosition written;                                      // in `file`
    RunPosition saved;                                        // of these, in saved rows
    bool torn = false;  // rows could not be written: the file is never whole again

    // history: time, forces and moment [S,3], pose [S,7], scalars, then one table per tracked floe
    Column<double> time, contact, friction, total, moment, pose;
    Column<double> contacts, moving, overlap, energy;
    bool ship_is_free = false;  // the ship: it has a motion of its own
    Column<double> ship_velocity, ship_angles, thrust, tow;
    Column<float> region_contact, region_friction;  // [S,R,3]
    std::size_t regions = 0;                        // of the hull
    std::vector<Column<double>> tracks;
    // frames
    Column<double> frame_time, ship_position, ship_orientation;
    Column<float> position, orientation, velocity, spin, floe_force;
    Column<std::uint8_t> state;
    // contacts of hull and floes, any number per frame
    Column<double> contact_time;
    Column<std::int32_t> contact_frame, contact_floe, contact_sphere;
    Column<float> contact_point, contact_push, contact_rub;
};

}  // namespace ice
