// SPDX-License-Identifier: GPL-3.0-or-later
/// `checkpoint.h5`: named fields of a program's state, exact to the bit, in one direction or the
/// other.
///
/// Layout: one dataset per field (a single value is a list of one; points [N,3], quaternions [N,4]
/// as w, x, y, z), texts as attributes of "/". The last 16 characters of the file are the hash of
/// all before them (base/state_hash.hpp), hexadecimal; HDF5 readers do not mind them.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A checkpoint while it is written or read. Both directions take the same calls, so that one list
/// of fields serves both: carry() writes its argument, or sets it.
///
/// Field types T: double, std::int64_t, std::int32_t, std::uint64_t, std::uint8_t, Vec3,
/// Eigen::Quaterniond.
class CheckpointFile {
public:
    enum class Direction { write, read };

    /// Write: nothing is at `path` before finish(); an older checkpoint stays whole until then.
    ///
    /// @throws Error, read: exit code 2, when the file is missing, truncated, damaged, not a
    ///         checkpoint or of a newer format; write: exit code 1, when it cannot be created.
    CheckpointFile(const std::filesystem::path& path, Direction direction);
    ~CheckpointFile();
    CheckpointFile(CheckpointFile&&) noexcept;

    /// The direction: carry() sets its arguments.
    bool reading() const;
    /// The program that wrote the file, with version and commit.
    const std::string& created_by() const;

    /// A list; reading sets its length. @throws Error (exit code 2) when the file has no such field
    template <class T>
    void carry(const std::string& name, std::vector<T>& values);
    /// A list whose length both sides know, e.g. one entry per body.
    /// @throws Error (exit code 2) when the file's has another length
    template <class T>
    void carry_each(const std::string& name, std::vector<T>& values) {
        const std::size_t length = values.size();
        carry(name, values);
        if (values.size() != length) wrong_length(name, values.size(), length);
    }
    /// A single value.
    template <class T>
    void carry(const std::string& name, T& value) {
        std::vector<T> one{value};
        carry_each(name, one);
        value = one.front();
    }
    void carry(const std::string& name, std::string& text);
    /// A value that may be missing: a list of none or one.
    template <class T>
    void carry(const std::string& name, std::optional<T>& value) {
        std::vector<T> values;
        if (value) values.push_back(*value);
        carry(name, values);
        if (values.size() > 1) wrong_length(name, values.size(), 1);
        value = values.empty() ? std::nullopt : std::optional<T>(values.front());
    }
    /// One member of every row of a table; reading the first member sets the number of rows.
    template <class Row, class T>
    void column(const std::string& name, std::vector<Row>& rows, T Row::*member) {
        std::vector<T> values(rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k) values[k] = rows[k].*member;
        carry(name, values);
        if (rows.empty()) rows.resize(values.size());
        if (rows.size() != values.size()) wrong_length(name, values.size(), rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*member = values[k];
    }

    /// Write: seals the file and gives it its name. Read: nothing.
    /// @throws Error (exit code 1) when the disk is full
    void finish();

private:
    [[noreturn]] void wrong_length(const std::string& name, std::size_t got,
                                   std::size_t wanted) const;

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace ice
