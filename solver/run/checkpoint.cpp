// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/checkpoint.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/state_hash.hpp"

namespace ice {

namespace {

using Direction = CheckpointFile::Direction;

// The identity of a checkpoint's run.
struct Identity {
    std::string resolved;               // the case, every key
    std::vector<std::uint64_t> shapes;  // hash of the hull's shape, then of each group's floes
};

std::uint64_t hash_of(const Shape& shape) {
    StateHash hash;
    const auto add = [&](const std::vector<Vec3>& points) {
        hash.add(std::uint64_t{points.size()});
        for (const Vec3& p : points)
            for (int d = 0; d < 3; ++d) hash.add(p[d]);
    };
    // All that the solver reads of a shape is hashed: a sphere set made anew with other options
    // must not continue a run, though its file has the same name.
    add(shape.center);
    add(shape.normal);
    add(shape.mesh.vertices);
    for (const auto* list : {&shape.radius, &shape.area, &shape.spread_cos, &shape.spread_sin})
        for (const double value : *list) hash.add(value);
    for (const NormalCone& faces : shape.cone) {
        hash.add(static_cast<std::uint64_t>(faces.count));
        hash.add(faces.apex_distance);
        for (const Vec3& n : faces.normal)
            for (int d = 0; d < 3; ++d) hash.add(n[d]);
    }
    for (const std::int32_t region : shape.region.of_spheres())
        hash.add(static_cast<std::uint64_t>(region));
    for (const std::string& name : shape.region_names)
        for (const char c : name + '\n') hash.add(static_cast<std::uint64_t>(c));
    for (const auto& triangle : shape.mesh.triangles)
        for (const std::int32_t corner : triangle) hash.add(static_cast<std::uint64_t>(corner));
    return hash.value();
}

// Data that must be equal at checkpoint and restart. Names of files may change, their content not.
Identity identity_of(const World& w) {
    const Bodies& b = w.scene.bodies;
    std::vector<std::uint64_t> of_row;
    for (const Shape& shape : w.scene.shapes) of_row.push_back(hash_of(shape));
    // the floes of a field have shapes of their own
    std::vector<StateHash> of_group(w.parameters.floes.size());
    for (std::size_t i = 1; i < b.size(); ++i)
        if (!w.edge.has_slot(i))  // whose shapes are state
            of_group[static_cast<std::size_t>(b.group[i])].add(
                of_row[static_cast<std::size_t>(b.shape[i])]);
    Identity identity{w.parameters.resolved, {of_row[0]}};
    for (const StateHash& hash : of_group) identity.shapes.push_back(hash.value());
    return identity;
}

void carry(CheckpointFile& file, Identity& identity) {
    file.carry("case", identity.resolved);
    file.carry("shapes", identity.shapes);
}

// Keys of a resolved case with their values as text; groups of floes counted from 1. Keys
// that may change are left out: the duration, and the sphere files' names, whose content counts.
std::map<std::string, std::string> keys_of(const std::string& resolved) {
    std::map<std::string, std::string> keys;
    std::string table;
    int group = 0;
    std::istringstream lines(resolved);
    for (std::string line; std::getline(lines, line);) {
        if (line == "[[floes]]") {
            table = fmt::format("floes.{}.", ++group);
        } else if (line.starts_with("[")) {
            table = line.substr(1, line.size() - 2) + ".";
        } else if (const auto equals = line.find(" = "); equals != std::string::npos) {
            const std::string name = line.substr(0, equals);
            // `spheres` of any table: the content of the files is compared by its hash
            if (name == "spheres" || table + name == "simulation.duration") continue;
            keys[table + name] = line.substr(equals + 3);
        }
    }
    return keys;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
    throw bad_input(path.string(), what,
                    "a resumed run keeps its case, only simulation.duration may change: give the "
                    "checkpoint's value with --set, or run the case anew without --restart");
}

// The part with another shape than at the checkpoint: the hull, k = 0, or the k-th group of floes.
std::string other_shapes(const Case& parameters, std::size_t k) {
    constexpr auto other_set = "spheres: the file holds another sphere set than at the checkpoint";
    if (k == 0) return fmt::format("hull.{}", other_set);
    if (parameters.floes[k - 1].pattern == Pattern::file)
        return fmt::format("floes.{}.file: the field holds other floes than at the checkpoint", k);
    return fmt::format("floes.{}.{}", k, other_set);
}

void check_case(const std::filesystem::path& path, const Identity& then, const Identity& now,
                const Case& parameters) {
    const auto old_keys = keys_of(then.resolved), new_keys = keys_of(now.resolved);
    const auto text = [](const auto& keys, const std::string& name) {
        const auto found = keys.find(name);
        return found == keys.end() ? std::string("not given") : found->second;
    };
    // All differences at once: a user mends the command line in one go.
    auto all = old_keys;
    all.insert(new_keys.begin(), new_keys.end());
    std::string differences;
    std::vector<std::string> changed;
    for (const auto& [name, unused] : all) {
        if (text(old_keys, name) == text(new_keys, name)) continue;
        changed.push_back(name);
        differences += fmt::format("\n  {}: {} in the checkpoint, {} in the case", name,
                                   text(old_keys, name), text(new_keys, name));
    }
    // The default of this key follows from the one key that may change.
    const std::string follows = "output.average_from";
    if (changed == std::vector{follows} && parameters.average_from == parameters.duration / 3.0)
        throw bad_input(path.string(), "is of another case:" + differences,
                        fmt::format("{0} is a third of simulation.duration unless it is given: "
                                    "add --set {0}={1}",
                                    follows, text(old_keys, follows)));
    if (!differences.empty()) refuse(path, "is of another case:" + differences);
    for (std::size_t k = 0; k < std::min(then.shapes.size(), now.shapes.size()); ++k)
        if (then.shapes[k] != now.shapes[k]) refuse(path, other_shapes(parameters, k));
}

// A seal does not prove the numbers: a faulty program may have sealed NaN.
void check_numbers(const std::filesystem::path& path, const Bodies& b) {
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!b.position[i].allFinite() || !b.orientation[i].coeffs().allFinite() ||
            !b.momentum[i].allFinite() || !b.angular_momentum[i].allFinite())
            throw bad_input(path.string(),
                            fmt::format("holds a NaN or infinity for {}",
                                        i == kShip ? "the ship" : fmt::format("floe {}", i)),
                            "restart from an earlier checkpoint, or run the case anew");
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, World& world, Recorder& recorder,
                      RunProgress& progress, SavedRows rows) {
    // Rows before state: the checkpoint names places in files that must hold them by then.
    Identity identity = identity_of(world);
    RecordPosition position =
        rows == SavedRows::beside ? recorder.save_rows() : recorder.write_rows();
    {
        CheckpointFile file(path, Direction::write);
        carry(file, identity);
        carry(file, world);
        recorder.carry(file);
        carry(file, position);
        carry(file, progress);
        file.finish();
    }
    // A checkpoint copies all columns and then frees the copies, which lie between data that the
    // run keeps. The system gets their pages back here, because keep_pages() would hold them.
    // Without this a long run needs new pages for each checkpoint: other data fill part of the old
    // ones.
    malloc_trim(0);
}

SavedRun read_checkpoint(const std::filesystem::path& path, World& world) {
    // The case first: nothing of another run may reach the world.
    CheckpointFile file(path, Direction::read);
    Identity then, now = identity_of(world);
    carry(file, then);
    check_case(path, then, now, world.parameters);
    world.ship.begin(world.parameters, world.scene);

    SavedRun saved{Recorder(world.parameters, world.scene),
                   {},
                   {},
                   std::filesystem::absolute(path).parent_path(),
                   file.created_by()};
    carry(file, world);
    if (world.edge.has_sheet()) world.edge.restore(world.scene, world.parameters);
    saved.recorder.carry(file);
    carry(file, saved.position);
    carry(file, saved.progress);
    Bodies& b = world.scene.bodies;
    check_numbers(path, b);
    // Velocities and matrices are functions of the state and not stored: computed by the same code,
    // they have the same bits.
    for (std::size_t i = 0; i < b.size(); ++i) update_derived(b, i);
    list_moving(b);
    if (world.time > world.parameters.duration + 0.5 * world.parameters.time_step)
        throw bad_input("simulation.duration",
                        fmt::format("{:g} s end before the checkpoint, which is at {:g} s",
                                    world.parameters.duration, world.time),
                        "give a longer duration, or an earlier checkpoint");
    return saved;
}

}  // namespace ice
