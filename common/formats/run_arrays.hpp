// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Whether a run is still being written, or a kill left it so: its file ends in ".part". More rows
/// of one array than of the next may have been written then.
bool is_growing(const std::filesystem::path& path);

/// Arrays of a run file, their shapes checked as they are read. Of a growing file the rows count
/// that all arrays have.
/// @throws bad_input that names file and dataset
class RunArrays {
public:
    explicit RunArrays(const std::filesystem::path& path)
        : path_(path), file_(path, Hdf5File::Mode::read), growing_(is_growing(path)) {}

    const Hdf5File& file() const { return file_; }
    bool growing() const { return growing_; }

    /// Throws unless @p good: "FILE: DATASET: WHAT".
    void check(bool good, const std::string& dataset, const std::string& what) const;

    /// Values of a dataset whose shape must be @p shape.
    template <class T>
    std::vector<T> read_as(const std::string& name, const std::vector<std::uint64_t>& shape) const {
        std::vector<std::uint64_t> whole = file_.shape(name);
        if (growing_ && !whole.empty() && !shape.empty() && whole[0] > shape[0]) {
            whole[0] = shape[0];
            check(whole == shape, name, "has another shape than the arrays beside it");
            return shape[0] == 0 ? std::vector<T>() : file_.read_rows<T>(name, 0, shape[0]);
        }
        check(whole == shape, name, "has another shape than the arrays beside it");
        return file_.read<T>(name);
    }

    /// An array of shape [.., 3] as points.
    std::vector<Vec3> points(const std::string& name, std::vector<std::uint64_t> shape) const;

    /// Count of rows of an array that is no single value.
    std::uint64_t rows_of(const std::string& name) const;

    /// Rows of the first array; of a growing file the rows that all have.
    std::uint64_t common_rows(const std::vector<std::string>& names) const;

    /// Count of the entries of a list.
    std::uint64_t length(const std::string& name) const;

    /// Where each of @p shapes shapes begins in an array of @p rows rows: 0 <= o[0] <= o[1] ... =
    /// rows.
    std::vector<std::int64_t> offsets(const std::string& name, std::size_t shapes,
                                      std::uint64_t rows) const;

private:
    std::filesystem::path path_;
    Hdf5File file_;
    bool growing_;
};

}  // namespace ice
