// SPDX-License-Identifier: GPL-3.0-or-later
// A drafted case, and a drafted field, as text with comments.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/units.hpp"
#include "common/toml/schema.hpp"
#include "solver/case/case_schema.hpp"
#include "solver/draft/draft_case.hpp"

namespace ice {

namespace {

// A line with its comment in a column.
std::string line(const std::string& assignment, const std::string& comment) {
    return fmt::format("{:<30} # {}\n", assignment, comment);
}

// A TOML string.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

}  // namespace

// The text is written, not serialised: a comment beside each number says where it comes from.
std::string draft_text(const Draft& d, const std::string& hull, const std::string& field) {
    std::string out =
        fmt::format("#:schema {0}\n# for editors, made by: icesolve --print-schema > {0}\n",
                    schema_file_name(case_schema()));
    out +=
        "# Drafted by icesolve --new: it runs as it is. Lines marked CHECK are guesses.\n"
        "# icesolve --check CASE prints ship, ice and course in numbers, --explain KEY explains a "
        "key.\n";
    out += fmt::format("title = {}\n", quoted(hull + " in " + field));
    out += "\n[simulation]\ndimension = 3\n";
    out += line(
        fmt::format("duration = {:g}", d.duration),
        fmt::format("s: {:.4g} m of travel, {:.2f} ship lengths", d.speed * d.duration, d.lengths));
    out += line(fmt::format("time_step = {:g}", d.time_step),
                "s: the ship moves a fifth of a sphere's radius in it, or less");
    out += "\n[environment]\n" + line("water_density = 1025.0", "kg/m3: sea water");
    out += fmt::format("\n[hull]\nspheres = {}\n", quoted(hull));
    out += line(fmt::format("draught = {:g}", d.draught),
                d.draught_from_mesh ? "m, CHECK: from the mesh's keel up to its z = 0"
                                    : "m, CHECK: 0.6 of the depth");
    out += line(fmt::format("position = [{:g}, {:g}]", d.x, d.y),
                fmt::format("m: the bow {:.2g} m before the first ice", d.clearance));
    out += line(fmt::format("speed = {:g}", d.speed),
                fmt::format("m/s, CHECK: {:.2g} kn", d.speed / kKnot));
    out += "\n[ice]\n" + line("density = 900.0", "kg/m3, CHECK");
    out += fmt::format("\n[[floes]]\npattern = \"file\"\nfile = {}\n", quoted(field));
    // the sheet is in comments, as the other choice
    out +=
        line("hold = \"never\"", "broken ice; \"until-hull-contact\" where the bow breaks it off");
    out += "# Unbroken ice, which the bow breaks: these tables in the place of [[floes]].\n";
    out += fmt::format(
        "# [level_ice]\n# thickness = {:g}\n# extent = [{:g}, {:g}, {:g}, {:g}]\n"
        "# [bending]\n# model = \"kashtelyan\"\n# flexural_strength = \"500 kPa\"\n",
        d.thickness, d.ice_from, d.ice_to, d.ice_starboard, d.ice_port);
    out += "\n[contact]\n" + line("friction_ship_ice = 0.1", "CHECK: 0.05 new paint, 0.2 old");
    out += line("friction_ice_ice = 0.3", "CHECK");
    out += line("crushing_pressure = \"1 MPa\"", "CHECK: 0.5 to 3 MPa");
    out += "\n[output]\n";
    out += line(fmt::format("average_from = {:g}", d.average_from),
                fmt::format("s: {:.2f} ship lengths in the ice; averages over the last {:.2f}",
                            d.settled_lengths, d.averaged_lengths));
    // 200 frames, but no more than steps
    out += line(fmt::format("frames_every = {:.1g}", std::max(d.time_step, d.duration / 200.0)),
                "s between stored poses");
    return out;
}

std::string draft_field(double length, double breadth) {
    // In ship lengths L and breadths B: ice of L / 100, spheres of a quarter of the thickness,
    // an area of 2.5 L by 3 B, floes of L / 12.
    return fmt::format(
        "#:schema specification.schema.json\n"
        "# for editors, made by: icefield --print-schema > specification.schema.json\n"
        "# Drafted by icesolve --new: broken ice for a ship of {:.3g} x {:.3g} m. CHECK all of "
        "it.\n"
        "pattern = \"voronoi\"\n"
        "[ice]\nthickness = {:.2g}\n"
        "[spheres]\nradius = {:.2g}\nspacing = {:.2g}\n"
        "[area]\nsize = [{:.3g}, {:.3g}]\n"
        "[floes]\nconcentration = 0.8\nmean_size = {:.2g}\n"
        "[edges]\nbreadth = {:.2g}\npiece = {:.2g}\noverhang = [{:.3g}, 0]\n",
        length, breadth, 0.01 * length, 0.0025 * length, 0.0075 * length, kFieldLengths * length,
        3.0 * breadth, length / 12.0, 0.1 * length, 0.3 * length, length);
}

}  // namespace ice
