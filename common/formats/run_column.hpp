// SPDX-License-Identifier: GPL-3.0-or-later
/// One growing dataset of run.h5. Used by run_file.cpp only.
#pragma once

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice::run_parts {

// Values that copy() holds at a time [-], 1 MiB of doubles: it bounds the memory, not the result.
// HDF5 takes as much again as the values for the list of their chunks. More need more memory, fewer
// make more calls.
constexpr std::uint64_t kValuesPerCopy = 1 << 17;

/// A dataset that grows and the rows of it that are not on disk yet.
template <class T>
struct Column {
    std::string name;
    std::vector<T> rows;

    template <class Vector>
    void add(const Vector& v) {
        for (Eigen::Index k = 0; k < v.size(); ++k) rows.push_back(static_cast<T>(v[k]));
    }
    void add_value(double value) { rows.push_back(static_cast<T>(value)); }
    void add_all(const std::vector<Vec3>& points) {
        for (const Vec3& p : points) add(p);
    }
    /// Writes the first `count` of `buffered` rows and forgets them.
    void append_to(Hdf5File& file, std::uint64_t count, std::uint64_t buffered) {
        if (count == 0) return;
        file.append(name, rows.data(), count);
        const std::uint64_t values = rows.size() / buffered * count;
        rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(values));
    }
    /// Creates the same dataset in another file, without rows and labels.
    void create_like(const Hdf5File& file, Hdf5File& to, std::uint64_t chunk) const {
        std::vector<std::uint64_t> shape = file.shape(name);
        shape.erase(shape.begin());
        to.create_appendable<T>(name, shape, chunk);
    }
    /// Appends rows [first, first + count) of one file to another, whole chunks at a time.
    /// @throws Error (exit code 2) when the first has fewer, or rows of another shape
    void copy(const Hdf5File& from, std::uint64_t first, std::uint64_t count, Hdf5File& to,
              std::uint64_t chunk) const {
        const std::vector<std::uint64_t> theirs = from.shape(name), ours = to.shape(name);
        if (theirs.empty() || theirs[0] < first + count ||
            !std::equal(ours.begin() + 1, ours.end(), theirs.begin() + 1, theirs.end()))
            throw bad_input(name, "has fewer rows than the checkpoint counted",
                            "this is not the file of that run");
        const std::uint64_t width =
            std::accumulate(ours.begin() + 1, ours.end(), std::uint64_t{1}, std::multiplies<>());
        const std::uint64_t block =
            chunk * std::max<std::uint64_t>(1, kValuesPerCopy / std::max(chunk * width, chunk));
        for (std::uint64_t done = 0; done < count; done += block) {
            const std::uint64_t now = std::min(block, count - done);
            to.append(name, from.read_rows<T>(name, first + done, now).data(), now);
        }
    }
};

}  // namespace ice::run_parts
