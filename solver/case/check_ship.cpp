// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/check_ship.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ice {

namespace {

class Checker {
public:
    Checker(const Case& checked, const Values& values, const Complaints& complaints)
        : case_(checked), values_(values), complaints_(complaints) {}

    // Mistakes that a single key does not show: which keys go together, and which need a
    // freedom.
    void check() {
        check_propulsion();
        check_net_thrust();
        check_lines();
        // two statements of one thing, and no rule says which counts
        if (!case_.ship.matrix.empty() && has_added_mass())
            complaints_.add_at("ship.matrix",
                               "ship.matrix and ship.added_mass both give the water that moves "
                               "along; keep one");
        if (case_.dimension != 2) return;
        if (!case_.ship.matrix.empty())
            complaints_.add_at("ship.matrix",
                               "ship.matrix is of a hull in 3D; give a 2D case six numbers as "
                               "ship.added_mass");
        if (case_.ship.computes_added_mass)
            complaints_.add_at("ship.added_mass",
                               "ship.added_mass is computed for hulls in 3D only; give a 2D case "
                               "six numbers, or none");
        // motions out of the plane y = 0
        for (const auto& [freedom, name] :
             {std::pair(sway, "sway"), std::pair(roll, "roll"), std::pair(yaw, "yaw")})
            if (case_.ship.free[freedom])
                complaints_.add_at(
                    "ship.free",
                    fmt::format("ship.free has {}, which leaves the plane y = 0 of a 2D case; it "
                                "may have surge, heave and pitch",
                                name));
    }

private:
    bool has(const char* key) const {
        // a default is given to the values, too
        return values_.contains(key);
    }
    bool has_added_mass() const {
        const auto& shares = case_.ship.added_mass;
        return case_.ship.computes_added_mass ||
               std::any_of(shares.begin(), shares.end(), [](double s) { return s != 0.0; });
    }
    void needs_freedom(const char* key, Freedom freedom, const char* name) const {
        if (case_.ship.free[freedom]) return;
        complaints_.add_at(key, fmt::format("{} acts on a ship that is free in {}: write ship.free "
                                            "= [\"{}\"], or leave it out",
                                            key, name, name));
    }

    // One kind of thrust alone, and only where the ship can follow it.
    void check_propulsion() const {
        std::vector<std::string> given;
        for (const char* key :
             {"propulsion.thrust", "propulsion.thrust_table", "propulsion.bollard_pull",
              "propulsion.power", "propulsion.hold_speed"}) {
            if (!has(key)) continue;
            given.emplace_back(key);
            needs_freedom(key, surge, "surge");
        }
        if (given.size() > 1)
            complaints_.add_at(
                given[1], fmt::format("{} are all given; keep one", fmt::join(given, " and ")));
        if (has("propulsion.resistance_table"))
            needs_freedom("propulsion.resistance_table", surge, "surge");
        if (case_.propulsion.hold_heading) needs_freedom("propulsion.heading", yaw, "yaw");
    }

    // Net thrust T(U) falls to zero at the open-water speed, so it needs that speed; and since
    // it is the thrust that is left over the open-water resistance, a table of that resistance
    // would count twice.
    void check_net_thrust() const {
        const bool pull = has("propulsion.bollard_pull"), power = has("propulsion.power");
        if ((pull || power) && !has("propulsion.open_water_speed"))
            complaints_.add_at(pull ? "propulsion.bollard_pull" : "propulsion.power",
                               "the net thrust needs propulsion.open_water_speed, where it is 0");
        if (power && !has("propulsion.propeller_diameter"))
            complaints_.add_at("propulsion.power",
                               "propulsion.power needs propulsion.propeller_diameter");
        const bool asks = has("propulsion.hold_speed") && has("propulsion.propeller_diameter") &&
                          has("propulsion.open_water_speed");  // for the power that it takes
        if (!pull && !power && !asks && has("propulsion.open_water_speed"))
            complaints_.add_at("propulsion.open_water_speed",
                               "propulsion.open_water_speed is given, but only bollard_pull, power "
                               "and, with propeller_diameter, hold_speed take it");
        if (!pull && !power && !asks && has("propulsion.propeller_diameter"))
            complaints_.add_at("propulsion.propeller_diameter",
                               "propulsion.propeller_diameter is given, but only power, "
                               "bollard_pull and, with open_water_speed, hold_speed take it");
        if (asks && has("propulsion.resistance_table"))
            complaints_.add_at("propulsion.resistance_table",
                               "propulsion.resistance_table is given, but the power of a held "
                               "speed is that of a net thrust; leave it or open_water_speed out");
        if ((pull || power) && has("propulsion.resistance_table"))
            complaints_.add_at("propulsion.resistance_table",
                               "propulsion.resistance_table is given, but net thrust has the "
                               "open-water resistance subtracted already; leave it out");
    }

    void check_lines() const {
        if (case_.tow.stiffness > 0.0 || case_.tow.damping > 0.0)
            needs_freedom("tow.stiffness", surge, "surge");
        // with a tow the table is the carriage's speed
        const bool towed = case_.tow.stiffness > 0.0;
        if (case_.ship.free[surge] && has("hull.speed_table") && !towed)
            complaints_.add_at(
                "hull.speed_table",
                "hull.speed_table is given, but thrust moves a ship that is free in surge; "
                "give hull.speed for the start, or tow it with tow.stiffness");
        // a mooring on a motion that is prescribed would pull in vain
        constexpr const char* kNames[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
        for (std::size_t k = 0; k < kFreedoms; ++k)
            if (!case_.ship.free[k] &&
                (case_.mooring.stiffness[k] != 0.0 || case_.mooring.pretension[k] != 0.0))
                needs_freedom(
                    case_.mooring.stiffness[k] != 0.0 ? "mooring.stiffness" : "mooring.pretension",
                    static_cast<Freedom>(k), kNames[k]);
    }

    const Case& case_;
    const Values& values_;
    const Complaints& complaints_;
};

}  // namespace

void check_ship(const Case& checked, const Values& values, const Complaints& complaints) {
    Checker(checked, values, complaints).check();
}

void take_drift(Case& checked, std::size_t groups, const Values& values,
                const Complaints& complaints) {
    const auto [x, y] = checked.drift_velocity;
    if (x == 0.0 && y == 0.0) return;
    if (checked.dimension == 2 && y != 0.0)
        complaints.add_at("ice.drift_velocity",
                          "ice.drift_velocity leaves the plane y = 0 of a 2D case");
    // unless the case gives a current, the water drifts with the ice: no drag on free floes
    if (const auto given = values.find("flow.current");
        given == values.end() ||
        std::get<std::vector<double>>(given->second) == std::vector<double>{0.0, 0.0})
        checked.current = checked.drift_velocity;
    for (std::size_t g = 0; g < groups; ++g) {
        FloeGroup& group = checked.floes[g];
        // a velocity of its own is not replaced
        if (group.velocity.isZero(0.0)) group.velocity = Vec3(x, y, 0.0);
    }
}

}  // namespace ice
