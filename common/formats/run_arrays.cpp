// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/run_arrays.hpp"

#include <algorithm>

namespace ice {

bool is_growing(const std::filesystem::path& path) { return path.extension() == ".part"; }

void RunArrays::check(bool good, const std::string& dataset, const std::string& what) const {
    if (!good)
        throw bad_input(path_.string() + ": " + dataset, what, "run the case again with icesolve");
}

std::vector<Vec3> RunArrays::points(const std::string& name,
                                    std::vector<std::uint64_t> shape) const {
    shape.push_back(3);
    const auto flat = read_as<double>(name, shape);
    std::vector<Vec3> out(flat.size() / 3);
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = Vec3(flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]);
    return out;
}

std::uint64_t RunArrays::rows_of(const std::string& name) const {
    const auto shape = file_.shape(name);
    check(!shape.empty(), name, "is a single value");
    return shape[0];
}

std::uint64_t RunArrays::common_rows(const std::vector<std::string>& names) const {
    std::uint64_t rows = rows_of(names[0]);
    if (growing_)
        for (const std::string& name : names) rows = std::min(rows, rows_of(name));
    return rows;
}

std::uint64_t RunArrays::length(const std::string& name) const {
    const auto shape = file_.shape(name);
    check(shape.size() == 1, name, "is not a list");
    return shape[0];
}

std::vector<std::int64_t> RunArrays::offsets(const std::string& name, std::size_t shapes,
                                             std::uint64_t rows) const {
    auto offset = file_.read<std::int64_t>(name);
    check(offset.size() == shapes + 1 && offset.front() == 0 &&
              offset.back() == static_cast<std::int64_t>(rows),
          name, "does not cover the rows of all shapes");
    for (std::size_t k = 1; k < offset.size(); ++k)
        check(offset[k] >= offset[k - 1], name, "is not in rising order");
    return offset;
}

}  // namespace ice
