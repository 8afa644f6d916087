// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/csv_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <system_error>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"

namespace ice {

namespace {

std::filesystem::path part_of(const std::filesystem::path& path) { return path.string() + ".part"; }

// "" when the file is shorter
std::string first_bytes(const std::filesystem::path& path, std::int64_t count) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || count < 0 || size < static_cast<std::uintmax_t>(count)) return "";
    std::string text(static_cast<std::size_t>(count), '\0');
    std::ifstream(path, std::ios::binary).read(text.data(), count);
    return text;
}

void append(std::vector<double>& row, const Vec3& v) {
    row.insert(row.end(), {v.x(), v.y(), v.z()});
}

}  // namespace

const char* const kForceColumns =
    "time_s,contact_fx_N,contact_fy_N,contact_fz_N,friction_fx_N,friction_fy_N,friction_fz_N,"
    "contacts,moving_floes,max_overlap_m,kinetic_energy_J";

const char* const kBreakingColumn = ",breaking_fx_N";
const char* const kShipColumns =
    "ship_x_m,ship_u,ship_z_m,ship_roll,ship_pitch,ship_yaw,thrust_N,tow_fx_N";

const char* const kFloeColumns =
    "time_s,x_m,y_m,z_m,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,contact_fx_N,contact_fy_N,contact_fz_N,"
    "friction_fx_N,friction_fy_N,friction_fz_N,ice_fx_N,ice_fy_N,ice_fz_N";

std::string CsvFile::whole_header(const std::string& columns, int dimension) {
    if (dimension != 2) return columns;
    std::string header = columns;
    std::istringstream names(columns);
    std::size_t column = 0;
    for (std::string name; std::getline(names, name, ','); ++column) {
        // a section's forces and energies are per metre of breadth: the same value under a name
        // that says it
        if (!name.ends_with("_N") && !name.ends_with("_J")) continue;
        header += "," + name + "_per_m";
        per_metre_.push_back(column);
    }
    return header;
}

CsvFile::CsvFile(std::filesystem::path path, const std::string& columns, int dimension)
    : path_(std::move(path)) {
    open("wb");
    waiting_ = whole_header(columns, dimension) + '\n';
}

CsvFile::CsvFile(std::filesystem::path path, const std::string& columns, int dimension,
                 const std::filesystem::path& earlier, std::int64_t bytes)
    : path_(std::move(path)) {
    const std::string header = whole_header(columns, dimension);
    // the rows up to the checkpoint, from the unfinished file or, if that is missing, the
    // finished one
    std::string text = first_bytes(part_of(earlier), bytes);
    if (text.empty()) text = first_bytes(earlier, bytes);
    // rows that were lost: the file begins anew, and the caller warns
    begins_late_ = !text.starts_with(header + "\n");
    if (begins_late_) text = header + "\n";
    write_text_file(part_of(path_), text);
    open("ab");
    bytes_ = static_cast<std::int64_t>(text.size());
}

void CsvFile::open(const char* mode) {
    out_.reset(std::fopen(part_of(path_).c_str(), mode));
    if (!out_)
        throw run_failed(path_.string(), "cannot be written",
                         "check that the folder is writable and the disk is not full");
    // unbuffered: `bytes_` bytes are in the file, so a checkpoint can name the place
    std::setvbuf(out_.get(), nullptr, _IONBF, 0);
}

// As much as the disk takes; true when that was all.
bool CsvFile::write_waiting() {
    const std::size_t taken = std::fwrite(waiting_.data(), 1, waiting_.size(), out_.get());
    waiting_.erase(0, taken);
    bytes_ += static_cast<std::int64_t>(taken);
    return waiting_.empty();
}

std::int64_t CsvFile::flush() {
    if (!write_waiting())
        throw run_failed(path_.string(), "cannot be written", "check that the disk is not full");
    bring_to_disk(part_of(path_));
    return bytes_;
}

void CsvFile::add(const std::vector<double>& row) {
    // Written at a time [bytes]: fewer write more often, more lose more rows to a kill.
    constexpr std::size_t kEnough = 8192;
    // nine digits give every float back; run.h5 has the doubles
    std::string line;
    for (const double value : row) line += fmt::format("{}{:.9g}", line.empty() ? "" : ",", value);
    for (const std::size_t column : per_metre_) line += fmt::format(",{:.9g}", row[column]);
    waiting_ += line + '\n';
    if (waiting_.size() >= kEnough) write_waiting();
}

void CsvFile::finish() {
    // renamed last: a file without .part is whole
    if (!write_waiting() || std::fclose(out_.release()) != 0)
        throw run_failed(path_.string(), "cannot be completed", "check that the disk is not full");
    keep_file(part_of(path_), path_);
}

// In the order of the columns above; docs/contract.md, section 5, fixes it.
std::vector<double> csv_row(const HistoryRow& row, bool breaking, bool ship) {
    std::vector<double> out{row.time};
    append(out, row.contact_force);
    append(out, row.friction_force);
    out.insert(out.end(), {row.contacts, row.moving_floes, row.max_overlap, row.kinetic_energy});
    if (breaking) out.push_back(row.breaking_x);
    if (!ship) return out;
    out.insert(out.end(), {row.ship_position.x(), row.ship_velocity.x(), row.ship_position.z()});
    append(out, row.ship_angles);
    out.insert(out.end(), {row.thrust, row.tow_force.x()});
    return out;
}

std::vector<double> csv_row(const TrackRow& row) {
    std::vector<double> out{row.time};
    append(out, row.position);
    const auto& q = row.orientation;
    out.insert(out.end(), {q.w(), q.x(), q.y(), q.z()});
    for (const Vec3& v :
         {row.velocity, row.angular_velocity, row.contact_force, row.friction_force, row.ice_force})
        append(out, v);
    return out;
}

}  // namespace ice
