// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/ship_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/toml/input_file.hpp"

namespace ice {

namespace {

// Largest number in a file, in its SI unit: no ship has so much, so more is a mistake. A larger
// value lets mistakes pass.
constexpr double kMost = 1e18;

const Schema& matrix_schema() {
    const auto row = [](std::string_view path) {
        return Key{path, Kind::vector, Dimension::none,
                   "-",  -kMost,       kMost,
                   6,    "",           "Of surge, sway, heave, roll, pitch, yaw; SI units."};
    };
    // both tables as one list of keys: the reader of case files then finds units, lengths and slips
    static const Schema kSchema{{{"about", Kind::vector, Dimension::length, "-", -1e4, 1e4, 3, "",
                                  "The point of the moments, in the axes of the hull's mesh."},
                                 row("added_mass.surge"),
                                 row("added_mass.sway"),
                                 row("added_mass.heave"),
                                 row("added_mass.roll"),
                                 row("added_mass.pitch"),
                                 row("added_mass.yaw"),
                                 row("damping.surge"),
                                 row("damping.sway"),
                                 row("damping.heave"),
                                 row("damping.roll"),
                                 row("damping.pitch"),
                                 row("damping.yaw")},
                                "",
                                "icesolve",
                                "added mass and damping",
                                {}};
    return kSchema;
}

// The matrices of a file from its values.
class Builder {
public:
    Builder(const std::filesystem::path& file, const Values& values, Mistakes& mistakes)
        : file_(file), values_(values), mistakes_(mistakes) {}

    ShipMatrix build() {
        ShipMatrix out;
        if (const std::vector<double>* about = needed("about"))
            out.about = Vec3((*about)[0], (*about)[1], (*about)[2]);
        out.added = matrix("added_mass");
        if (has_damping()) out.damping = matrix("damping");
        return out;
    }

private:
    static constexpr const char* kRows[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

    bool has_damping() const {
        return std::any_of(values_.begin(), values_.end(),
                           [](const auto& v) { return v.first.starts_with("damping."); });
    }
    const std::vector<double>* needed(const std::string& key) {
        const auto found = values_.find(key);
        if (found != values_.end()) return &std::get<std::vector<double>>(found->second);
        complain(fmt::format("required key '{}' is missing", key));
        return nullptr;
    }
    // The symmetric part of a table's rows.
    Mat6 matrix(const char* table) {
        Mat6 out = Mat6::Zero();
        // rows that are missing are named one by one, and count as zero until then
        for (int i = 0; i < 6; ++i)
            if (const auto* row = needed(fmt::format("{}.{}", table, kRows[i])))
                for (int j = 0; j < 6; ++j) out(i, j) = (*row)[static_cast<std::size_t>(j)];
        if (out.diagonal().minCoeff() < 0.0)
            complain(fmt::format("[{}] has a number below 0 on its diagonal", table));
        // a radiation program's rounding leaves it not quite symmetric; without symmetry the
        // matrix would have no energy
        return 0.5 * (out + out.transpose());
    }
    void complain(const std::string& what) {
        mistakes_.add(fmt::format("{}: error: {}", file_.string(), what));
    }

    const std::filesystem::path& file_;
    const Values& values_;
    Mistakes& mistakes_;
};

ShipMatrix read_once(const std::filesystem::path& file) {
    Mistakes mistakes;
    std::size_t groups = 0;
    const std::string text = read_input_text(file, "file of added mass", ".toml");
    const Values values = read_toml(text, file.string(), matrix_schema(), mistakes, groups);
    ShipMatrix out;
    if (mistakes.texts.empty()) out = Builder(file, values, mistakes).build();
    throw_mistakes(mistakes, file, "examples/ship_matrix.py writes such a file");
    return out;
}

}  // namespace

ShipMatrix read_ship_matrix(const std::filesystem::path& file) {
    rehearse_input(file, [&] { read_once(file); });
    return read_once(file);
}

Mat6 moved(const Mat6& matrix, const Vec3& arm) {
    // The velocity of the old point is T times that of the new one, T = [1, [arm x]; 0, 1];
    // equal energy gives M' = T^T M T (section 13).
    Mat6 to_old = Mat6::Identity();
    for (int k = 0; k < 3; ++k) to_old.block<3, 1>(0, 3 + k) = arm.cross(Vec3::Unit(k));
    return to_old.transpose() * matrix * to_old;
}

double largest_coupling(const Mat6& matrix) {
    double most = 0.0;
    // a motion without mass of its own, in a 2D problem, has no share
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < i; ++j)
            if (const double both = std::sqrt(matrix(i, i) * matrix(j, j)); both > 0.0)
                most = std::max(most, std::abs(matrix(i, j)) / both);
    return most;
}

}  // namespace ice
