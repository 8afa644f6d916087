// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/attain/read_thrusts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "common/toml/input_file.hpp"

namespace ice::attain {

namespace {

// Bounds of the file's numbers [N, W, m, m/s], far beyond any ship: they only refuse signs and
// powers of ten that are surely wrong. A wider range lets such numbers pass.
constexpr double kMost = 1e12;
constexpr double kLeast = 1e-9;

const Schema& thrust_schema() {
    // Forces and powers are plain numbers in SI; only speeds and lengths may have a unit in the
    // file.
    const auto number = [](std::string_view path, Dimension dimension, std::string_view doc) {
        return Key{path, Kind::number, dimension, "-", kLeast, kMost, 0, "", doc};
    };
    static const Schema kSchema{
        {{"thrust.name", Kind::text, Dimension::none, "-", 0, 0, 0, "", "Of the curve."},
         number("thrust.constant", Dimension::none, "The same thrust at all speeds [N]."),
         number("thrust.bollard_pull", Dimension::none, "Thrust at rest [N]."),
         number("thrust.open_water_speed", Dimension::speed, "Speed without ice."),
         number("thrust.power", Dimension::none, "Delivered power of all propellers [W]."),
         number("thrust.propeller_diameter", Dimension::length, "Of one propeller."),
         {"thrust.propellers", Kind::integer, Dimension::none, "1", 1, 3, 0, "", "Their number."},
         {"thrust.table", Kind::pair_list, Dimension::none, "-", 0.0, kMost, 0, "",
          "Speed [m/s] and thrust [N], speeds rising."}},
        "thrust",
        "icepost",
        "thrust curves",
        {}};
    return kSchema;
}

// One [[thrust]] from its values.
class Builder {
public:
    Builder(const std::filesystem::path& file, const Values& values, std::size_t number,
            Mistakes& mistakes)
        : file_(file), values_(values), number_(number), mistakes_(mistakes) {}

    Thrust build() {
        Thrust out;
        out.name = fmt::format("thrust {}", number_ + 1);
        if (const Value* name = find("name")) out.name = std::get<std::string>(*name);
        // The kinds exclude each other: of two the reader would have to guess which one counts.
        const int kinds = (find("constant") ? 1 : 0) + (find("bollard_pull") ? 1 : 0) +
                          (find("power") ? 1 : 0) + (find("table") ? 1 : 0);
        if (kinds != 1) {
            complain("give one of constant, bollard_pull, power and table");
            return out;
        }
        if (const Value* table = find("table")) {
            out.table = std::get<std::vector<std::pair<double, double>>>(*table);
            const auto falls = [](const auto& a, const auto& b) { return b.first <= a.first; };
            if (out.table.empty() ||
                std::adjacent_find(out.table.begin(), out.table.end(), falls) != out.table.end())
                complain("table needs rows with rising speeds");
        } else if (find("constant")) {
            // a constant thrust is a bollard pull without an open-water speed
            out.bollard_pull = number("constant");
        } else {
            if (!find("open_water_speed")) complain("open_water_speed is missing");
            // any number, since the mistake is reported
            out.open_water_speed = find("open_water_speed") ? number("open_water_speed") : 1.0;
            out.bollard_pull = find("bollard_pull") ? number("bollard_pull") : pull_of_power();
        }
        return out;
    }

private:
    const Value* find(const char* key) const {
        const auto found = values_.find(fmt::format("thrust.{}.{}", number_, key));
        return found == values_.end() ? nullptr : &found->second;
    }
    double number(const char* key) const { return std::get<double>(*find(key)); }

    double pull_of_power() {
        if (!find("propeller_diameter")) {
            complain("power needs propeller_diameter");
            return 0.0;
        }
        const Value* count = find("propellers");
        return bollard_pull(number("power"), number("propeller_diameter"),
                            count ? static_cast<int>(std::get<std::int64_t>(*count)) : 1);
    }

    void complain(const std::string& what) {
        mistakes_.add(
            fmt::format("{}: error: [[thrust]] {}: {}", file_.string(), number_ + 1, what));
    }

    const std::filesystem::path& file_;
    const Values& values_;
    std::size_t number_;
    Mistakes& mistakes_;
};

std::vector<Thrust> read_once(const std::filesystem::path& file) {
    Mistakes mistakes;
    std::size_t count = 0;
    const std::string text = read_input_text(file, "file of thrust curves", ".toml");
    const Values values = read_toml(text, file.string(), thrust_schema(), mistakes, count);
    const bool sound = mistakes.texts.empty();  // else keys may be missing that were given
    std::vector<Thrust> out;
    for (std::size_t k = 0; sound && k < count; ++k)
        out.push_back(Builder(file, values, k, mistakes).build());
    if (sound && count == 0) mistakes.add(file.string() + ": error: has no [[thrust]]");
    throw_mistakes(mistakes, file,
                   "write [[thrust]] with bollard_pull = N and open_water_speed = \"16 kn\"");
    return out;
}

}  // namespace

double Thrust::at(double speed) const {
    if (!table.empty()) {
        // No row is extended beyond its end: a line through the last two rows may reach a thrust
        // below 0.
        if (speed <= table.front().first) return table.front().second;
        // linear between rows, constant before and behind them
        for (std::size_t k = 1; k < table.size(); ++k) {
            const auto& [u0, t0] = table[k - 1];
            const auto& [u1, t1] = table[k];
            if (speed <= u1) return t0 + (t1 - t0) * (speed - u0) / (u1 - u0);
        }
        return table.back().second;
    }
    if (open_water_speed == 0.0) return bollard_pull;
    // (S2) of docs/method.md, section 13
    const double share = speed / open_water_speed;
    return bollard_pull * (1.0 - share / 3.0 - 2.0 / 3.0 * share * share);
}

// Where a search for the attained speed ends: the thrust is 0 at the open-water speed, and a table
// ends with its last row.
double Thrust::fastest() const {
    if (!table.empty()) return table.back().first;
    return open_water_speed > 0.0 ? open_water_speed : std::numeric_limits<double>::infinity();
}

double bollard_pull(double power, double diameter, int propellers) {
    ICE_ASSERT(propellers >= 1 && propellers <= 3);
    // T_B = K (P D)^(2/3) in kN, kW, m: K = 0.78, 0.98, 1.12 kN / (kW m)^(2/3) for one, two, three
    // screws (text below (S2) of docs/method.md). K comes from an open program; another text has
    // 0.728 for one screw. The bollard pull is proportional to K.
    constexpr std::array<double, 3> kFactor{0.78, 0.98, 1.12};
    const double factor = kFactor[static_cast<std::size_t>(propellers - 1)];
    return 1e3 * factor * std::pow(1e-3 * power * diameter, 2.0 / 3.0);
}

std::vector<Thrust> read_thrusts(const std::filesystem::path& file) {
    rehearse_input(file, [&] { read_once(file); });
    return read_once(file);
}

}  // namespace ice::attain
