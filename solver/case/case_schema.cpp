// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/case_schema.hpp"

#include <cmath>

#include "solver/case/ship_schema.hpp"
#include "solver/case/stored_value.hpp"

namespace ice {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
// Least value of a number that has to be above 0, in its SI unit: 0 itself is refused. A larger
// value refuses small models, a smaller one lets rounded zeros pass.
constexpr double kTiny = 1e-9;

// Words of a choice in the order of their enumerators (stored::choice).
using namespace stored;

constexpr std::string_view kPatterns = "grid|brick|single|file";
constexpr std::string_view kHolds = "never|until-hull-contact|until-contact|until-bent|always";
constexpr std::string_view kNormals = "surface|centres";
constexpr std::string_view kBuoyancies = "none|centre|distributed";
constexpr std::string_view kDrags = "none|projected|panel";
constexpr std::string_view kFlows = "none|double-body|file";
constexpr std::string_view kAddedMasses = "none|computed";
constexpr std::string_view kBendings = "wedge|kashtelyan";

using D = Dimension;
using G = FloeGroup;

// Columns of all these tables: path, kind, unit, default ("" for a key that must be given, "-"
// for one that may be missing), least and greatest value, count of numbers, choices,
// description, and the member that takes the value.
std::vector<CaseKey> run_keys() {
    return {
        {"title", Kind::text, D::none, "\"\"", 0, 0, 0, "",
         "Title of the run, shown in every output.",
         [](Case& c, G&, const Value& v) { c.title = text(v); }},
        {"simulation.dimension", Kind::integer, D::none, "3", 2, 3, 0, "",
         "3 for six degrees of freedom, 2 for motion in the x-z plane (per metre of breadth).",
         [](Case& c, G&, const Value& v) { c.dimension = integer(v); }},
        {"simulation.duration", Kind::number, D::time, "", kTiny, 1e6, 0, "", "Simulated time.",
         [](Case& c, G&, const Value& v) { c.duration = number(v); }},
        {"simulation.time_step", Kind::number, D::time, "0.01", 1e-6, 1.0, 0, "",
         "Length of a step; the paper uses 0.005 s in 2D and 0.01 s in 3D.",
         [](Case& c, G&, const Value& v) { c.time_step = number(v); }},
        {"simulation.seed", Kind::integer, D::none, "0", 0, 2e9, 0, "",
         "Seed of the random offsets (simulation.jitter); the members of an ensemble differ in it.",
         [](Case& c, G&, const Value& v) { c.seed = integer(v); }},
        {"simulation.jitter", Kind::number, D::length, "0.0", 0, 1e3, 0, "",
         "Largest random offset of every floe along x and y; each floe also turns, by as much at "
         "its edge. Unbroken ice (hold always) stays.",
         [](Case& c, G&, const Value& v) { c.jitter = number(v); }},
        {"environment.gravity", Kind::number, D::acceleration, "9.81", 0, 100, 0, "",
         "Gravitational acceleration.", [](Case& c, G&, const Value& v) { c.gravity = number(v); }},
        {"environment.water_density", Kind::number, D::density, "1000.0", kTiny, 2000, 0, "",
         "Density of the water.", [](Case& c, G&, const Value& v) { c.water_density = number(v); }},
        // z of the position or the draught, and a speed or a table: read_case.cpp requires one
        // of each
        {"hull.spheres", Kind::path, D::none, "", 0, 0, 0, "",
         "Sphere set of the hull, made by spherize; relative to the case file.",
         [](Case& c, G&, const Value& v) { c.hull_spheres = text(v); }},
        {"hull.position", Kind::place, D::length, "[0.0, 0.0, 0.0]", -1e6, 1e6, 3, "",
         "World position of the hull mesh's origin at t = 0; calm water is z = 0; z left out (two "
         "numbers) where hull.draught is given.",
         [](Case& c, G&, const Value& v) { c.hull_position = place3(v); }},
        {"hull.draught", Kind::number, D::length, "-", 0, 1e3, 0, "",
         "Height of the water above the hull mesh's lowest point, wherever the mesh's origin is; "
         "instead of z in hull.position.",
         [](Case& c, G&, const Value& v) { c.hull_draught = number(v); }},
        {"hull.speed", Kind::number, D::speed, "-", -50, 50, 0, "",
         "Constant speed along +x; give this or hull.speed_table.",
         [](Case& c, G&, const Value& v) {
             c.speed_table = {{0.0, number(v)}};
         }},
        {"hull.speed_table", Kind::pair_list, D::speed, "-", -1e6, 1e6, 0, "",
         "Rows [t, u]: speed u [m/s] at time t [s], linear between rows.",
         [](Case& c, G&, const Value& v) {
             c.speed_table = std::get<std::vector<std::pair<double, double>>>(v);
         }},
        {"ice.density", Kind::number, D::density, "900.0", kTiny, 2000, 0, "",
         "Density of the ice.", [](Case& c, G&, const Value& v) { c.ice_density = number(v); }},
        {"ice.drift_velocity", Kind::vector, D::speed, "[0.0, 0.0]", -50, 50, 2, "",
         "Velocity of all floes at the start along x and y, and of the water unless flow.current "
         "is given: ice that drifts past a moored or towed ship. Held floes keep it.",
         [](Case& c, G&, const Value& v) { c.drift_velocity = vector2(v); }},
    };
}

std::vector<CaseKey> floe_keys() {
    return {
        // A set for the patterns made here, a file for "file", which has shapes, places and
        // edges of its own.
        {"floes.spheres", Kind::path, D::none, "-", 0, 0, 0, "",
         "Sphere set of these floes, made by spherize; relative to the case file.",
         [](Case&, G& g, const Value& v) { g.spheres = text(v); }},
        {"floes.file", Kind::path, D::none, "-", 0, 0, 0, "",
         "Pattern file: the field, made by icefield; its unbroken ice is held always.",
         [](Case&, G& g, const Value& v) { g.file = text(v); }},
        {"floes.pattern", Kind::choice, D::none, "\"grid\"", 0, 0, 0, kPatterns,
         "Arrangement of the floes: rows and columns, columns shifted by half a floe, one floe, or "
         "that of a file.",
         [](Case&, G& g, const Value& v) { g.pattern = choice<Pattern>(v, kPatterns); }},
        {"floes.count", Kind::counts, D::none, "[1, 1]", 1, 1e5, 2, "",
         "Number of floes along x and y.",
         [](Case&, G& g, const Value& v) {
             const auto n = vector2(v);
             g.count = {static_cast<int>(n[0]), static_cast<int>(n[1])};
         }},
        {"floes.origin", Kind::vector, D::length, "[0.0, 0.0]", -1e6, 1e6, 2, "",
         "x of the first row's edge that meets the ship first (its smallest x), y of the field's "
         "centre line; pattern file: moves the field.",
         [](Case&, G& g, const Value& v) { g.origin = vector2(v); }},
        {"floes.gap", Kind::vector, D::length, "[0.0, 0.0]", 0, 1e4, 2, "",
         "Open water between neighbours along x and y.",
         [](Case&, G& g, const Value& v) { g.gap = vector2(v); }},
        {"floes.hold", Kind::choice, D::none, "\"until-hull-contact\"", 0, 0, 0, kHolds,
         "Until when the floes are immovable; the paper holds them until the ship touches them; "
         "until-bent: until its load breaks them ([bending]); pattern file: never unless stated, "
         "and its unbroken ice always.",
         [](Case&, G& g, const Value& v) { g.hold = choice<Hold>(v, kHolds); }},
        // of pattern "single" alone: a floe at any pose, for tests and studies of one body
        {"floes.position", Kind::place, D::length, "-", -1e6, 1e6, 3, "",
         "Pattern single: centre of mass; z left out (two numbers) gives floating equilibrium.",
         [](Case&, G& g, const Value& v) { g.position = place3(v); }},
        {"floes.orientation", Kind::vector, D::none, "[1.0, 0.0, 0.0, 0.0]", -1, 1, 4, "",
         "Pattern single: quaternion w, x, y, z, body to world; normalised.",
         [](Case&, G& g, const Value& v) {
             const auto& q = std::get<std::vector<double>>(v);
             g.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
         }},
        {"floes.velocity", Kind::vector, D::speed, "[0.0, 0.0, 0.0]", -50, 50, 3, "",
         "Pattern single: initial velocity of the centre of mass.",
         [](Case&, G& g, const Value& v) { g.velocity = vector3(v); }},
        {"floes.angular_velocity", Kind::vector, D::angular_speed, "[0.0, 0.0, 0.0]", -50, 50, 3,
         "", "Pattern single: initial angular velocity, world axes.",
         [](Case&, G& g, const Value& v) { g.angular_velocity = vector3(v); }},
    };
}

std::vector<CaseKey> contact_keys() {
    return {
        {"contact.restitution", Kind::number, D::share, "0.3", 0, 1, 0, "",
         "Normal speed after an impact over the speed before it.",
         [](Case& c, G&, const Value& v) { c.contact.restitution = number(v); }},
        {"contact.friction_ship_ice", Kind::number, D::none, "0.1", 0, 10, 0, "",
         "Coulomb's coefficient between hull and floe.",
         [](Case& c, G&, const Value& v) { c.contact.friction_ship_ice = number(v); }},
        {"contact.friction_ice_ice", Kind::number, D::none, "0.3", 0, 10, 0, "",
         "Coulomb's coefficient between floes.",
         [](Case& c, G&, const Value& v) { c.contact.friction_ice_ice = number(v); }},
        {"contact.normal", Kind::choice, D::none, "\"surface\"", 0, 0, 0, kNormals,
         "Contact normal: of the surfaces that spheres represent, or from centre to centre (the "
         "paper).",
         [](Case& c, G&, const Value& v) { c.normal = choice<NormalRule>(v, kNormals); }},
        // (13): p A dt; the default differs in 2D (read_case.cpp), where the paper's ice is
        // rigid
        {"contact.crushing_pressure", Kind::number, D::pressure, "1e6", 0, kInf, 0, "",
         "The normal impulse of a contact is at most this pressure x the section cut x time_step; "
         "ice so crushed is removed. inf: rigid ice, which can jam; the default in 2D (the paper).",
         [](Case& c, G&, const Value& v) { c.contact.crushing_pressure = number(v); }},
        // both stop a solution: the tolerance where it converges, the number where it does not
        {"contact.iterations", Kind::integer, D::none, "30", 1, 100000, 0, "",
         "Upper bound of the contact solver's iterations, its sweeps over all contacts, for a "
         "solution; a step takes a few solutions.",
         [](Case& c, G&, const Value& v) { c.contact.iterations = integer(v); }},
        {"contact.tolerance", Kind::number, D::speed, "1e-4", 0, 10, 0, "",
         "The solver stops when no contact's velocity changes by more than this in an iteration.",
         [](Case& c, G&, const Value& v) { c.contact.tolerance = number(v); }},
    };
}

// Each default is this project's model; the paper's choices are the others (docs/method.md, section
// 1).
std::vector<CaseKey> water_keys() {
    return {
        {"buoyancy.model", Kind::choice, D::none, "\"distributed\"", 0, 0, 0, kBuoyancies,
         "Buoyancy at the centre of gravity (the paper), or with its moment, or none.",
         [](Case& c, G&, const Value& v) { c.buoyancy = choice<BuoyancyModel>(v, kBuoyancies); }},
        {"drag.model", Kind::choice, D::none, "\"panel\"", 0, 0, 0, kDrags,
         "Drag on the projected area (the paper, Eq. 9), on the surface with its moment, or none.",
         [](Case& c, G&, const Value& v) { c.drag = choice<DragModel>(v, kDrags); }},
        {"drag.coefficient", Kind::number, D::none, "1.0", 0, 100, 0, "", "Drag coefficient C_d.",
         [](Case& c, G&, const Value& v) { c.drag_coefficient = number(v); }},
        {"flow.model", Kind::choice, D::none, "\"double-body\"", 0, 0, 0, kFlows,
         "Flow around the hull, for drag: none, double-body (potential flow without waves), or "
         "file (made by iceflow).",
         [](Case& c, G&, const Value& v) { c.flow = choice<FlowModel>(v, kFlows); }},
        {"flow.file", Kind::path, D::none, "-", 0, 0, 0, "",
         "Model file: the flow, made by iceflow; relative to the case file.",
         [](Case& c, G&, const Value& v) { c.flow_file = text(v); }},
        {"flow.current", Kind::vector, D::speed, "[0.0, 0.0]", -50, 50, 2, "",
         "Current of all the water along x and y.",
         [](Case& c, G&, const Value& v) { c.current = vector2(v); }},
        {"flow.pressure", Kind::boolean, D::none, "false", 0, 0, 0, "",
         "The dynamic pressure of the flow around the hull acts on the floes, beside its drag.",
         [](Case& c, G&, const Value& v) { c.flow_pressure = integer(v) != 0; }},
        {"flow.added_mass", Kind::choice, D::none, "\"none\"", 0, 0, 0, kAddedMasses,
         "Added mass of the floes: none, or computed for each shape in deep water, in 3D.",
         [](Case& c, G&, const Value& v) { c.floes_move_water = text(v) == "computed"; }},
    };
}

std::vector<CaseKey> output_keys() {
    return {
        {"output.frames_every", Kind::number, D::time, "0.1", kTiny, 1e6, 0, "",
         "Time between stored poses.",
         [](Case& c, G&, const Value& v) { c.frames_every = number(v); }},
        {"output.history_every", Kind::number, D::time, "0.0", 0, 1e6, 0, "",
         "Time between rows of the histories, forces averaged over it; 0 is every step.",
         [](Case& c, G&, const Value& v) { c.history_every = number(v); }},
        {"output.track", Kind::integer_list, D::none, "[]", 1, 1e9, 0, "",
         "Floes (numbered from 1) with force histories of their own.",
         [](Case& c, G&, const Value& v) {
             for (const double id : std::get<std::vector<double>>(v))
                 c.track.push_back(static_cast<int>(id));
         }},
        {"output.average_from", Kind::number, D::time, "-", 0, 1e6, 0, "",
         "Statistics use times from here on; default a third of the duration.",
         [](Case& c, G&, const Value& v) { c.average_from = number(v); }},
    };
}

std::vector<CaseKey> bending_keys() {
    return {
        // the plate of (28) and (29); factor and table stand beside the formulas
        {"bending.flexural_strength", Kind::number, D::pressure, "5e5", kTiny, 1e9, 0, "",
         "Largest bending stress that ice bears, for [level_ice] and floes with hold until-bent.",
         [](Case& c, G&, const Value& v) { c.bending.flexural_strength = number(v); }},
        {"bending.elastic_modulus", Kind::number, D::pressure, "5e9", 1.0, 1e12, 0, "",
         "Young's modulus of the ice.",
         [](Case& c, G&, const Value& v) { c.bending.elastic_modulus = number(v); }},
        {"bending.poisson_ratio", Kind::number, D::none, "0.3", 0, 0.49, 0, "",
         "Poisson's ratio of the ice.",
         [](Case& c, G&, const Value& v) { c.bending.poisson_ratio = number(v); }},
        {"bending.model", Kind::choice, D::none, "\"wedge\"", 0, 0, 0, kBendings,
         "Breaking load of a piece: of wedges on water (Nevel), or (angle / pi)^2 "
         "flexural_strength "
         "h^2 (Kashtelyan); in 2D of a beam on water, as wedge.",
         [](Case& c, G&, const Value& v) { c.bending.model = choice<BendingModel>(v, kBendings); }},
        {"bending.factor", Kind::number, D::none, "1.0", 0, 100, 0, "",
         "Factor on the breaking load. With wedge, 1 is a dry plate under a static load. With "
         "kashtelyan, models of ships use about 3.1; 1 was chosen by one set of model tests "
         "(docs/validation-measured.md).",
         [](Case& c, G&, const Value& v) { c.bending.factor = number(v); }},
        {"bending.factor_table", Kind::curve, D::none, "-", 0, 100, 0, "",
         "Rows [v, f]: a second factor f at the normal speed v [m/s] of hull and ice, linear "
         "between rows.",
         [](Case& c, G&, const Value& v) {
             c.bending.factor_table = std::get<std::vector<std::pair<double, double>>>(v);
         }},
        {"bending.opening_angle", Kind::number, D::angle, "-", 1e-3, 3.1415926535897932, 0, "",
         "Opening angle of every piece as a wedge; default from its outline, that of the sector "
         "with its area and depth.",
         [](Case& c, G&, const Value& v) { c.bending.opening_angle = number(v); }},
        {"bending.load_length", Kind::number, D::length, "0.0", 0, 1e3, 0, "",
         "Model wedge: distance from the edge over which the load is spread.",
         [](Case& c, G&, const Value& v) { c.bending.load_length = number(v); }},
    };
}

std::vector<CaseKey> level_ice_keys() {
    return {
        {"level_ice.thickness", Kind::number, D::length, "0.0", 0, 100, 0, "",
         "Thickness of a sheet that the ship breaks into pieces, in place of floes; 0 is none.",
         [](Case& c, G&, const Value& v) { c.level_ice.thickness = number(v); }},
        {"level_ice.extent", Kind::vector, D::length, "[0.0, 0.0, 0.0, 0.0]", -1e5, 1e5, 4, "",
         "Smallest and largest x, smallest and largest y of the sheet; in 2D y is not used.",
         [](Case& c, G&, const Value& v) {
             const auto& x = std::get<std::vector<double>>(v);
             c.level_ice.extent = {x[0], x[1], x[2], x[3]};
         }},
        {"level_ice.spacing", Kind::number, D::length, "-", 1e-3, 100, 0, "",
         "Distance of the pieces' contact spheres on their surface; default 0.7 thicknesses. Their "
         "radius is a quarter of the thickness, in 2D no more than the spacing.",
         [](Case& c, G&, const Value& v) { c.level_ice.spacing = number(v); }},
        {"level_ice.gap", Kind::number, D::length, "0.05", 0, 10, 0, "",
         "Breadth of a crack: open water between pieces.",
         [](Case& c, G&, const Value& v) { c.level_ice.gap = number(v); }},
        {"level_ice.seed", Kind::integer, D::none, "0", 0, 2e9, 0, "",
         "Seed of the pieces' random sizes; simulation.seed changes them, too.",
         [](Case& c, G&, const Value& v) { c.level_ice.seed = integer(v); }},
        // (30): R = C_l l (1 + C_v v_n) (1 + scatter u)
        {"level_ice.length_factor", Kind::number, D::none, "0.32", 1e-3, 10, 0, "",
         "Radius of the cracks over the ice's characteristic length; in 2D a beam's length takes "
         "its place.",
         [](Case& c, G&, const Value& v) { c.level_ice.length_factor = number(v); }},
        {"level_ice.speed_factor", Kind::number, D::none, "-0.144", -10, 10, 0, "",
         "Relative change of that radius with the speed along the hull's normal [s/m]; in 3D.",
         [](Case& c, G&, const Value& v) { c.level_ice.speed_factor = number(v); }},
        {"level_ice.scatter", Kind::number, D::share, "0.2", 0, 0.9, 0, "",
         "Largest random deviation of that radius, in 2D of the length, as a share of it.",
         [](Case& c, G&, const Value& v) { c.level_ice.scatter = number(v); }},
    };
}

}  // namespace

const std::vector<CaseKey>& case_keys() {
    // in the order in which the resolved case prints them
    static const std::vector<CaseKey> keys = [] {
        std::vector<CaseKey> all = run_keys();
        for (const auto& part : {ship_keys(), floe_keys(), level_ice_keys(), bending_keys(),
                                 contact_keys(), water_keys(), output_keys()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return keys;
}

const Schema& case_schema() {
    static const Schema schema = [] {
        Schema out{
            {},         "floes", "icesolve", "icesolve case", {{"hull.speed", "hull.speed_table"}},
            "level_ice"};
        for (const CaseKey& key : case_keys()) out.keys.push_back(key);
        out.elsewhere["floes.pattern"] =
            "icefield makes others: pattern = \"file\", file = \"field.h5\"";
        return out;
    }();
    return schema;
}

}  // namespace ice
