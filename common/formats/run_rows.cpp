// SPDX-License-Identifier: GPL-3.0-or-later
// How a run resumes with its run.h5 after a kill. HDF5 changes a file in place, so that one killed
// while it writes may be past reading, with rows of an hour ago. Hence the rows since the last
// checkpoint are also saved in a file of their own, complete before it has its name:
// checkpoint-rows-<samples>-<frames>.h5, after the rows that came before it. Each begins where one
// before it ends, which makes a chain from 0-0 to the checkpoint's rows.
#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "common/base/part_file.hpp"
#include "common/formats/run_buffers.hpp"

namespace ice {

using run_parts::frames_per_chunk;
using run_parts::kContactChunk;
using run_parts::kHistoryChunk;

namespace {

constexpr const char* kSavedRows = "checkpoint-rows-";

std::filesystem::path saved_rows(const std::filesystem::path& folder, std::int64_t samples,
                                 std::int64_t frames) {
    return folder / fmt::format("{}{}-{}.h5", kSavedRows, samples, frames);
}

bool same_folder(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

void remove_saved_rows(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().filename().string().starts_with(kSavedRows))
            std::filesystem::remove(entry.path(), ignored);
}

void RunWriter::Buffers::copy_rows(const std::filesystem::path& earlier, const RunPosition& stop) {
    const Hdf5File from(earlier, Hdf5File::Mode::read);
    // files of saved rows end at checkpoints, possibly later ones than this
    const auto rest = [&](const char* name, std::int64_t wanted, std::int64_t have) {
        const auto rows = static_cast<std::int64_t>(from.shape(name).at(0));
        return static_cast<std::uint64_t>(std::min(wanted - have, rows));
    };
    const std::uint64_t history = rest("/time", stop.samples, written.samples);
    const std::uint64_t poses = rest("/frames/frame_time", stop.frames, written.frames);
    const std::uint64_t touches = rest("/contacts/contact_time", stop.contacts, written.contacts);
    if (history + poses == 0)
        throw bad_input(earlier.string(), "has none of the rows", "this is not that run's file");
    for_history([&](auto& c) { c.copy(from, 0, history, file, kHistoryChunk); });
    for_frames([&](auto& c) { c.copy(from, 0, poses, file, frames_per_chunk(bodies)); });
    for_contacts([&](auto& c) { c.copy(from, 0, touches, file, kContactChunk); });
    written.samples += static_cast<std::int64_t>(history);
    written.frames += static_cast<std::int64_t>(poses);
    written.contacts += static_cast<std::int64_t>(touches);
}

void RunWriter::Buffers::copy_saved_rows(const std::filesystem::path& folder,
                                         const RunPosition& stop) {
    while (written.samples < stop.samples || written.frames < stop.frames)
        copy_rows(saved_rows(folder, written.samples, written.frames), stop);
}

void RunWriter::Buffers::save_rows() {
    // nothing new since the last checkpoint: the chain ends there already
    if (saved.samples == written.samples && saved.frames == written.frames) return;
    PartFile part(saved_rows(final_path.parent_path(), saved.samples, saved.frames));
    Hdf5File to(part.path(), Hdf5File::Mode::create);
    for (const char* group : {"/ship", "/regions", "/tracked", "/frames", "/contacts"})
        to.create_group(group);
    const auto save = [&](auto& column, std::int64_t first, std::int64_t end, std::uint64_t chunk) {
        column.create_like(file, to, chunk);
        column.copy(file, static_cast<std::uint64_t>(first),
                    static_cast<std::uint64_t>(end - first), to, chunk);
    };
    for_history([&](auto& c) { save(c, saved.samples, written.samples, kHistoryChunk); });
    for_frames([&](auto& c) { save(c, saved.frames, written.frames, frames_per_chunk(bodies)); });
    for_contacts([&](auto& c) { save(c, saved.contacts, written.contacts, kContactChunk); });
    to.close();
    part.keep();
    saved = written;
}

RunWriter::RunWriter(const std::filesystem::path& path, const RunHeader& header,
                     const std::filesystem::path& earlier, const RunPosition& position) {
    // Three sources in turn, the most certain first: saved rows were complete before they had a
    // name, run.h5 of a finished run, and the .part file of a killed one, which may be torn.
    // under a name of its own until it is complete: the earlier file may be the .part file
    PartFile next(path.string() + ".part");
    const auto try_with = [&](const auto& fill) {
        buffers_.reset();
        buffers_ = std::make_unique<Buffers>(path, next.path(), header);
        try {
            fill();
        } catch (const Error& error) {
            if (error.code() != ExitCode::bad_input) throw;
            return false;  // missing, too short or damaged: the next source may be better
        }
        return buffers_->written.samples == position.samples &&
               buffers_->written.frames == position.frames &&
               buffers_->written.contacts == position.contacts;
    };
    const bool from_saved = try_with([&] { buffers_->copy_saved_rows(earlier, position); });
    const bool found = from_saved ||
                       try_with([&] { buffers_->copy_rows(earlier / "run.h5", position); }) ||
                       try_with([&] { buffers_->copy_rows(earlier / "run.h5.part", position); });
    begins_late_ = !found;
    if (begins_late_) try_with([] {});  // a file without rows
    buffers_->written.last_orientation = position.last_orientation;
    buffers_->file.flush();

    // the chain of saved rows is already there; in another folder it begins anew with one file
    if (from_saved && same_folder(earlier, path.parent_path())) {
        buffers_->saved = buffers_->written;
    } else {
        buffers_->save_rows();
    }
    next.keep();  // the open file continues under its new name
    buffers_->part_path = path.string() + ".part";
}

RunPosition RunWriter::write_rows() {
    buffers_->write_all();
    return buffers_->written;
}

std::uint64_t RunWriter::waiting_bytes() const {
    std::uint64_t bytes = 0;
    const auto count = [&](const auto& c) { bytes += c.rows.size() * sizeof(c.rows[0]); };
    buffers_->for_history(count);
    buffers_->for_frames(count);
    buffers_->for_contacts(count);
    return bytes;
}

RunPosition RunWriter::save_rows() {
    buffers_->write_all();
    buffers_->save_rows();
    return buffers_->written;
}

}  // namespace ice
