// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/checkpoint_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <type_traits>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/base/version.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/seal.hpp"

namespace ice {

namespace {

constexpr const char* kCheckpointFormat = "icesolve-checkpoint";

// Version of the format; 1 more when a field changes its meaning or its name. A reader refuses all
// others.
constexpr std::int64_t kFormatVersion = 2;
constexpr const char* kStartAnew = "restart from another checkpoint, or run the case anew";

// How a T is stored: as `width` values of type Base.
template <class T>
struct Flat {
    using Base = T;
    static constexpr std::uint64_t width = 1;
    static void put(const T& value, Base* out) { *out = value; }
    static T take(const Base* in) { return *in; }
};
template <>
struct Flat<std::uint64_t> {
    // The file's integers are signed: the bits are kept, not the number.
    using Base = std::int64_t;
    static constexpr std::uint64_t width = 1;
    static void put(std::uint64_t value, Base* out) { *out = std::bit_cast<Base>(value); }
    static std::uint64_t take(const Base* in) { return std::bit_cast<std::uint64_t>(*in); }
};
template <>
struct Flat<Vec3> {
    using Base = double;
    static constexpr std::uint64_t width = 3;
    static void put(const Vec3& v, Base* out) { std::copy(v.data(), v.data() + 3, out); }
    static Vec3 take(const Base* in) { return {in[0], in[1], in[2]}; }
};
template <>
struct Flat<Eigen::Quaterniond> {
    using Base = double;
    static constexpr std::uint64_t width = 4;
    static void put(const Eigen::Quaterniond& q, Base* out) {
        // w first, as in all files of the project; Eigen stores it last.
        out[0] = q.w();
        out[1] = q.x();
        out[2] = q.y();
        out[3] = q.z();
    }
    static Eigen::Quaterniond take(const Base* in) { return {in[0], in[1], in[2], in[3]}; }
};

// Checked before HDF5 reads the file, because HDF5 trusts its input.
void check_seal(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw bad_input(path.string(), "checkpoint not found", "check the path");
    if (!has_right_seal(path))
        throw bad_input(path.string(), "is not a checkpoint of icesolve, or is damaged",
                        kStartAnew);
}

}  // namespace

struct CheckpointFile::Parts {
    std::filesystem::path path;
    std::string created_by;
    std::unique_ptr<PartFile> part;  // null when reading
    std::unique_ptr<Hdf5File> file;

    void create();
    void open();
};

void CheckpointFile::Parts::create() {
    created_by = fmt::format("icesolve {} ({})", version(), git_commit());
    part = std::make_unique<PartFile>(path);
    file = std::make_unique<Hdf5File>(part->path(), Hdf5File::Mode::create);
    file->write_attribute("/", "format", std::string(kCheckpointFormat));
    file->write_attribute("/", "format_version", kFormatVersion);
    file->write_attribute("/", "created_by", created_by);
}

void CheckpointFile::Parts::open() {
    // The order is from the cheapest test to the most particular: bytes, kind of file, version.
    check_seal(path);
    file = std::make_unique<Hdf5File>(path, Hdf5File::Mode::read);
    if (!file->has_attribute("/", "format") ||
        file->read_text_attribute("/", "format") != kCheckpointFormat)
        throw bad_input(path.string(), "is not a checkpoint of icesolve", kStartAnew);
    created_by = file->read_text_attribute("/", "created_by");
    // other versions hold other fields: a wrong guess would continue with wrong numbers
    const double format_version = file->read_number_attribute("/", "format_version")[0];
    if (format_version != kFormatVersion)
        throw bad_input(path.string(),
                        fmt::format("has format_version {:g}, written by {}; this program knows {}",
                                    format_version, created_by, kFormatVersion),
                        "restart with the version that wrote it");
}

CheckpointFile::CheckpointFile(const std::filesystem::path& path, Direction direction)
    : parts_(std::make_unique<Parts>()) {
    parts_->path = path;
    if (direction == Direction::write)
        parts_->create();
    else
        parts_->open();
}

CheckpointFile::~CheckpointFile() = default;
CheckpointFile::CheckpointFile(CheckpointFile&&) noexcept = default;

bool CheckpointFile::reading() const { return parts_->part == nullptr; }
const std::string& CheckpointFile::created_by() const { return parts_->created_by; }

template <class T>
void CheckpointFile::carry(const std::string& name, std::vector<T>& values) {
    using Base = typename Flat<T>::Base;
    constexpr std::uint64_t width = Flat<T>::width;
    Hdf5File& file = *parts_->file;
    if (!reading()) {
        // HDF5 has numbers only: vectors and matrices go as rows of them
        std::vector<Base> flat(width * values.size());
        for (std::size_t k = 0; k < values.size(); ++k)
            Flat<T>::put(values[k], flat.data() + width * k);
        std::vector<std::uint64_t> shape{values.size()};
        if (width > 1) shape.push_back(width);
        file.write(name, flat.data(), shape);
        return;
    }
    // A field that is missing is never a default: the run would go on with other numbers than
    // before.
    if (!file.has(name))
        throw bad_input(parts_->path.string(),
                        fmt::format("has no field {}: it was written by {}", name, created_by()),
                        "restart with the version that wrote it");
    const std::vector<Base> flat = file.read<Base>(name);
    if (flat.size() % width != 0) wrong_length(name, flat.size(), width);
    values.clear();
    for (std::size_t k = 0; k < flat.size(); k += width)
        values.push_back(Flat<T>::take(flat.data() + k));
}

void CheckpointFile::carry(const std::string& name, std::string& text) {
    if (reading())
        text = parts_->file->read_text_attribute("/", name);
    else
        parts_->file->write_attribute("/", name, text);
}

void CheckpointFile::finish() {
    if (reading()) return;
    // The seal covers the closed file, and the name is given last: a program that is killed at any
    // point leaves the old checkpoint or a complete new one.
    parts_->file->close();
    add_seal(parts_->part->path());
    parts_->part->keep();
}

void CheckpointFile::wrong_length(const std::string& name, std::size_t got,
                                  std::size_t wanted) const {
    throw bad_input(parts_->path.string(),
                    fmt::format("field {} has {} values where {} belong: it was written by {}",
                                name, got, wanted, created_by()),
                    kStartAnew);
}

template void CheckpointFile::carry(const std::string&, std::vector<double>&);
template void CheckpointFile::carry(const std::string&, std::vector<std::int64_t>&);
template void CheckpointFile::carry(const std::string&, std::vector<std::int32_t>&);
template void CheckpointFile::carry(const std::string&, std::vector<std::uint64_t>&);
template void CheckpointFile::carry(const std::string&, std::vector<std::uint8_t>&);
template void CheckpointFile::carry(const std::string&, std::vector<Vec3>&);
template void CheckpointFile::carry(const std::string&, std::vector<Eigen::Quaterniond>&);

}  // namespace ice
