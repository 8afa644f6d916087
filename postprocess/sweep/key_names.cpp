// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/key_names.hpp"

#include <fmt/format.h>

namespace ice::sweep {

namespace {

struct KeyName {
    std::string name, unit;
};

KeyName find_name(const std::string& key) {
    // Names for the axes of charts. A key that is not here names itself: a sweep may vary any key.
    static const std::map<std::string, KeyName> kNames{
        {kSpeedKey, {"speed", "m/s"}},
        {"simulation.time_step", {"time step", "s"}},
        {"simulation.duration", {"duration", "s"}},
        {"simulation.dimension", {"dimension", ""}},
        {"ice.density", {"ice density", "kg/m\u00b3"}},
        {"environment.water_density", {"water density", "kg/m\u00b3"}},
        {"contact.friction_ship_ice", {"friction ship-ice", ""}},
        {"contact.friction_ice_ice", {"friction ice-ice", ""}},
        {"contact.crushing_pressure", {"crushing pressure", "Pa"}},
        {"contact.restitution", {"restitution", ""}},
        {"contact.normal", {"normals", ""}},
        {"hull.mesh", {"hull", ""}},
        {"hull.spheres", {"hull", ""}},
        {"floes.mesh", {"floes", ""}},
        {"floes.spheres", {"floes", ""}},
        {"field.specification", {"ice field", ""}},
        {"field.ice.thickness", {"ice thickness", "m"}},
        {"field.floes.size", {"size of pieces", "m"}},
        {"field.floes.mean_size", {"mean size of floes", "m"}},
        {"field.floes.concentration", {"concentration", ""}}};
    const auto found = kNames.find(key);
    return found == kNames.end() ? KeyName{key, ""} : found->second;
}

}  // namespace

std::string axis_title(const std::string& key) {
    const KeyName name = find_name(key);
    return name.unit.empty() ? name.name : name.name + " [" + name.unit + "]";
}

std::string short_text(const Setting& setting) {
    if (setting.text.empty()) return "-";
    // six digits: a speed of 6 kn is stored as 3.086666666666667 m/s
    if (setting.number) return fmt::format("{:.6g}", *setting.number);
    // Of a path only the file's name: sets of one study mostly lie in one folder. Without a slash
    // rfind gives npos, and npos + 1 is 0: the whole text.
    return setting.text.substr(setting.text.rfind('/') + 1);
}

std::string name_value(const std::string& key, const Setting& setting, bool whole) {
    const KeyName name = find_name(key);
    // a text like "2 kn" has its own unit
    const bool bare = name.unit.empty() || !setting.number;
    return name.name + " " + (whole ? setting.text : short_text(setting)) +
           (bare ? "" : " " + name.unit);
}

}  // namespace ice::sweep
