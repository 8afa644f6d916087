// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formulas/coefficients_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/toml/input_file.hpp"
#include "common/toml/toml_text.hpp"

namespace ice {

namespace {

// No part of the resistance pushes the ship, so that no coefficient of a force is below 0. Largest
// size of a coefficient [-]; Jeong's are 0.5 to 2.7. Larger ones are forces in other
// units. It moves only the range that a file is refused by.
constexpr double kMost = 1e3;

Key number_key(std::string_view path, std::string_view default_text, double low, double high,
               std::string_view doc) {
    return {path, Kind::number, Dimension::none, default_text, low, high, 0, "", doc};
}

const Schema& coefficients_schema() {
    static const Schema kSchema{
        {{"spencer.name", Kind::text, Dimension::none, "-", 0, 0, 0, "", "Of the ship."},
         number_key("spencer.c_b", "", 0.0, kMost, "C_B, of buoyancy."),
         number_key("spencer.c_c", "", 0.0, kMost, "C_C, of clearing."),
         // below 2: at rest Fr^-a V^2 must vanish (spencer.cpp)
         number_key("spencer.exponent", "", -kMost, 2.0, "a, of the Froude number."),
         number_key("spencer.c_br", "-", 0.0, kMost, "C_BR, of breaking."),
         number_key("spencer.breaking_exponent", "-", -kMost, 2.0, "b, of the strength number."),
         number_key("uncertainty.c_b", "-", 0.0, INFINITY, "95 % half width."),
         number_key("uncertainty.c_c", "-", 0.0, INFINITY, "95 % half width."),
         number_key("uncertainty.exponent", "-", 0.0, INFINITY, "95 % half width."),
         number_key("uncertainty.c_br", "-", 0.0, INFINITY, "95 % half width."),
         number_key("uncertainty.breaking_exponent", "-", 0.0, INFINITY, "95 % half width.")},
        "",
        "icepost",
        "coefficients",
        {}};
    return kSchema;
}

SpencerCoefficients read_once(const std::filesystem::path& file) {
    Mistakes mistakes;
    std::size_t unused = 0;
    const std::string text = read_input_text(file, "coefficients file", ".toml");
    const Values values = read_toml(text, file.string(), coefficients_schema(), mistakes, unused);
    SpencerCoefficients out;
    out.own = true;
    out.name = file.stem().string();
    // A required key is missing only where the file was otherwise understood: one mistake, one
    // message.
    const auto take = [&](const char* key, double& to) {
        if (const auto found = values.find(key); found != values.end())
            to = std::get<double>(found->second);
        else if (coefficients_schema().find(key)->default_text.empty() &&
                 !mistakes.bad_keys.contains(key) && (mistakes.texts.empty() || !values.empty()))
            mistakes.add(fmt::format("{}: error: required key '{}' is missing ({})", file.string(),
                                     key, coefficients_schema().find(key)->doc));
    };
    take("spencer.c_b", out.buoyancy);
    take("spencer.c_c", out.clearing);
    take("spencer.exponent", out.clearing_exponent);
    take("spencer.c_br", out.breaking);
    take("spencer.breaking_exponent", out.breaking_exponent);
    if (const auto name = values.find("spencer.name"); name != values.end())
        out.name = std::get<std::string>(name->second);
    throw_mistakes(mistakes, file,
                   "write [spencer] with c_b, c_c and exponent, or let icepost fit");
    return out;
}

}  // namespace

SpencerCoefficients read_coefficients(const std::filesystem::path& file) {
    // First in a child process (rehearse.hpp): a strange file may crash the parser or never let it
    // end.
    rehearse_input(file, [&] { read_once(file); });
    return read_once(file);
}

std::string coefficients_text(const SpencerCoefficients& c, const CoefficientIntervals& i,
                              const std::string& origin) {
    // The origin has the user's paths in it: a line break in one would end the comment and leave
    // text that is no TOML.
    std::string comment = origin;
    for (char& letter : comment)
        if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
    const Key name = coefficients_schema().keys.front();
    std::string out = fmt::format(
        "# Component formula, R_B = c_b (rho_w - rho_i) g h B T, R_C = c_c Fr_h^-exponent rho_i B "
        "h V^2.\n# {}\n[spencer]\nname = {}\nc_b = {}\nc_c = {}\nexponent = {}\n",
        comment, toml_text(Value(c.name), name), c.buoyancy, c.clearing, c.clearing_exponent);
    // Without level ice the fit has no breaking part: Jeong's default is not written as the ship's
    // own.
    if (c.own && std::isfinite(i.breaking))
        out += fmt::format("c_br = {}\nbreaking_exponent = {}\n", c.breaking, c.breaking_exponent);
    out += "\n[uncertainty]              # half widths of 95 % intervals\n";
    const auto add = [&](const char* key, double value) {
        if (std::isfinite(value)) out += fmt::format("{} = {}\n", key, value);
    };
    add("c_b", i.buoyancy);
    add("c_c", i.clearing);
    add("exponent", i.clearing_exponent);
    add("c_br", i.breaking);
    add("breaking_exponent", i.breaking_exponent);
    return out;
}

}  // namespace ice
