// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/state_hash.hpp"
#include "common/base/version.hpp"
#include "common/cli/console.hpp"
#include "solver/live_edge/describe_edge.hpp"
#include "solver/live_edge/edge_record.hpp"
#include "solver/record/divide_hull.hpp"
#include "solver/record/flow_arrows.hpp"
#include "solver/record/residual_impulse.hpp"
#include "solver/scene/tunnelling_speed.hpp"

namespace ice {

namespace {

// The constant part of run.h5: with case, program and shapes a report needs no other file, and the
// run can be made again.
RunHeader make_header(const Case& parameters, const Scene& scene, const std::string& command) {
    RunHeader header;
    header.dimension = scene.dimension;
    header.title = parameters.title;
    header.created_by = std::string("icesolve ") + version();
    header.git_commit = git_commit();
    header.command_line = command;
    header.case_toml = parameters.resolved;
    header.average_from = parameters.average_from;
    for (const Shape& shape : scene.shapes)
        header.shapes.push_back({shape.mesh, shape.center, shape.radius});
    // rows of floes from body 1 on: the ship has its own datasets
    const Bodies& b = scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i) {
        header.body_shape.push_back(b.shape[i]);
        header.body_group.push_back(b.group[i]);
        header.body_mass.push_back(b.mass[i]);
        header.body_inertia.push_back(b.inertia(i).diagonal());
    }
    FlowArrows arrows = flow_arrows(scene);
    header.flow_point = std::move(arrows.point);
    header.flow_velocity = std::move(arrows.velocity);
    header.ship_is_free = parameters.ship.any_free();
    header.tracked.assign(parameters.track.begin(), parameters.track.end());
    return header;
}

// Half the radius of the smallest ice sphere [m]: deeper, and spheres slip past each other. A
// warning's bound; a larger one warns of less.
double worrying_overlap(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < scene.shapes.size(); ++k)
        for (const double radius : scene.shapes[k].radius) smallest = std::min(smallest, radius);
    return 0.5 * smallest;
}

// The solids are checked once in so many steps [-]: an overlap that contacts miss lasts for
// seconds. A check measures all bodies by their meshes. Fewer steps take more time; more steps miss
// short overlaps.
constexpr std::int64_t kCheckEvery = 50;

struct CsvTable {
    std::string name;
    std::string columns;
};

// The tables of a run and their columns: those on breaking and on the ship's motion are there only
// where they can differ from 0, behind the others, whose places stay.
std::vector<CsvTable> csv_tables(const Case& parameters) {
    std::string forces = kForceColumns;
    if (parameters.has_bending()) forces += kBreakingColumn;
    if (parameters.ship.any_free()) forces += std::string(",") + kShipColumns;
    std::vector<CsvTable> tables{{"forces.csv", forces}};
    for (const int id : parameters.track)
        tables.push_back({fmt::format("floe_{}.csv", id), kFloeColumns});
    return tables;
}

// Held wins over behind: a held floe astern does not count as passed.
FloeState state_of(const Scene& scene, std::size_t i) {
    if (scene.bodies.held[i]) return FloeState::held;
    return is_behind(scene, i) ? FloeState::behind : FloeState::moving;
}

}  // namespace

bool is_behind(const Scene& scene, std::size_t floe) {
    return scene.bodies.position[floe].x() <
           scene.bodies.position[kShip].x() + scene.shapes[0].box.min().x();
}

std::uint64_t state_hash(const Scene& scene, const std::vector<Constraint>& constraints) {
    StateHash hash;
    const auto add = [&](const Vec3& v) {
        for (int d = 0; d < 3; ++d) hash.add(v[d]);
    };
    const Bodies& b = scene.bodies;
    // The bodies' state, and the impulses of the step: those on the ship and on held ice show in no
    // momentum.
    for (std::size_t i = 0; i < b.size(); ++i) {
        add(b.position[i]);
        for (const double x : b.orientation[i].coeffs()) hash.add(x);
        add(b.momentum[i]);
        add(b.angular_momentum[i]);
    }
    for (const Constraint& c : constraints) {
        hash.add(c.total_normal());
        add(c.total_tangent());
    }
    return hash.value();
}

Recorder::Recorder(const Case& parameters, const Scene& scene)
    : parameters_(parameters),
      dt_(parameters.time_step),
      statistics_({scene.shapes[0].region_names, parameters.average_from,
                   parameters.contact.is_rigid(), worrying_overlap(scene),
                   tunnelling_speed(scene, parameters.time_step), parameters.has_bending()}),
      panel_loads_(
          divide_hull(scene.shapes[0], panel_size(scene), -scene.bodies.position[kShip].z()),
          scene.shapes[0].region_names, parameters.average_from, parameters.time_step),
      track_of_(scene.bodies.size(), -1),
      tracked_(parameters.track.size()),
      row_regions_(scene.shapes[0].region_names.size()),
      tracked_sum_(parameters.track.size()),
      frame_impulse_(scene.bodies.size(), Vec3::Zero()) {
    for (std::size_t k = 0; k < parameters.track.size(); ++k) {
        const auto floe = static_cast<std::size_t>(parameters.track[k]);  // < 0: beyond all
        if (floe == 0 || floe >= track_of_.size() || track_of_[floe] >= 0)
            throw bad_input("output.track",
                            fmt::format("names floe {}, which does not exist or is named before",
                                        parameters.track[k]),
                            "floes are numbered from 1; name each once");
        track_of_[floe] = static_cast<std::int32_t>(k);
    }
}

void Recorder::open(const std::filesystem::path& folder, const std::string& command_line,
                    const Scene& scene) {
    folder_ = folder;
    run_.emplace(folder / "run.h5", make_header(parameters_, scene, command_line));
    for (const CsvTable& table : csv_tables(parameters_))
        csv_files_.emplace_back(folder / table.name, table.columns, parameters_.dimension);
    // the first frame is the start, before any force
    const std::vector<Contact> no_contacts;
    const std::vector<Constraint> no_constraints;
    add_frame({scene, no_contacts, no_constraints, {}, 0.0, true});
}

// Files whose earlier rows are lost begin at the checkpoint, each by itself: others keep theirs.
std::vector<std::string> Recorder::resume(const std::filesystem::path& folder,
                                          const std::string& command_line, const Scene& scene,
                                          const std::filesystem::path& earlier,
                                          const RecordPosition& position) {
    std::vector<std::string> late;
    folder_ = folder;
    run_.emplace(folder / "run.h5", make_header(parameters_, scene, command_line), earlier,
                 position.run);
    if (run_->begins_late()) late.push_back("run.h5");
    const auto tables = csv_tables(parameters_);
    for (std::size_t k = 0; k < tables.size(); ++k) {
        const auto& [name, columns] = tables[k];
        csv_files_.emplace_back(folder / name, columns, parameters_.dimension, earlier / name,
                                position.csv_bytes.at(k));
        if (csv_files_.back().begins_late()) late.push_back(name);
    }
    return late;
}

RecordPosition Recorder::save_rows() { return position_of(run_->save_rows()); }
RecordPosition Recorder::write_rows() { return position_of(run_->write_rows()); }

RecordPosition Recorder::position_of(RunPosition run) {
    RecordPosition position{std::move(run), {}};
    for (CsvFile& file : csv_files_) position.csv_bytes.push_back(file.flush());
    return position;
}

void Recorder::add(const StepView& view) {
    // a step that converged leaves no more than the tolerance: only the others are measured
    const StepRecord record = measure_step(view.scene, view.contacts, view.constraints, dt_);
    const std::optional<double> residual =
        view.converged ? std::nullopt
                       : std::optional(residual_impulse(view.scene.bodies, view.constraints, dt_));
    statistics_.add(record, view.time, dt_, residual);
    if (is_check_due(view.time))
        statistics_.add_check(measure_overlaps(view.scene, view.contacts), record, view.time);
    panel_loads_.add(view.contacts, view.constraints, view.time);
    measure_floe_forces(view.constraints, dt_, track_of_, tracked_);
    // A frame stores the ship's force on the floe, the record the floe's impulse on the ship.
    for (const RegionImpulse& r : record.regions) frame_impulse_[r.floe] -= r.impulse;
    hull_contacts_.add(view.scene.bodies, view.contacts, view.constraints);
    if (view.ship != nullptr) add_ship(view);
    add_history(view, record);
    // half a step of tolerance: times are multiples of dt up to rounding
    if (view.time + 0.5 * dt_ >= static_cast<double>(frames_) * parameters_.frames_every)
        add_frame(view);
}

// Under the rule "centres" bodies are sets of spheres. These leave out the edges of the solids, so
// overlaps of solids would be no fault there.
bool Recorder::is_check_due(double time) const {
    return parameters_.normal == NormalRule::surface && std::llround(time / dt_) % kCheckEvery == 0;
}

// The ship's pose is that at the end of a row. Thrust and lines' forces are sums; flush_history()
// turns them into means.
void Recorder::add_ship(const StepView& view) {
    const FreeShip& ship = *view.ship;
    ship_statistics_.add(ship, view.scene, parameters_, view.time);
    row_.ship_angles = ship.angles();
    row_.ship_orientation = view.scene.bodies.orientation[kShip];
    row_.ship_velocity = view.scene.bodies.velocity[kShip];
    row_.thrust += ship.loads().thrust;
    row_.tow_force += ship.loads().tow.force + ship.loads().mooring.force;
}

void Recorder::add_history(const StepView& view, const StepRecord& record) {
    ++row_steps_;
    // Forces are means over the row, so that the sum of rows times their time is the impulse of the
    // run, however rare the rows are.
    row_.contact_force += record.contact_force;
    row_.friction_force += record.friction_force;
    row_.breaking_x += record.breaking_x;
    row_.moment += record.moment;
    row_.contacts += record.contacts;
    // number, overlap and energy are not averaged: the last ones, and the largest
    row_.moving_floes = record.moving_floes;
    row_.max_overlap = std::max(row_.max_overlap, record.max_overlap);
    row_.kinetic_energy = record.kinetic_energy;
    for (const RegionImpulse& r : record.regions) {
        RegionForce& sum = row_regions_[static_cast<std::size_t>(r.region)];
        sum.contact += r.impulse - r.friction;
        sum.friction += r.friction;
    }
    for (std::size_t k = 0; k < tracked_sum_.size(); ++k) {
        tracked_sum_[k].contact += tracked_[k].contact;
        tracked_sum_[k].friction += tracked_[k].friction;
        tracked_sum_[k].ice += tracked_[k].ice;
    }
    // Rows are due at multiples of history_every, counted and not summed up: no drift by rounding.
    // Half a step tolerates the rounding of the time itself.
    const double due = static_cast<double>(rows_ + 1) * parameters_.history_every;
    if (view.time + 0.5 * dt_ >= due) flush_history(view);
}

void Recorder::flush_history(const StepView& view) {
    if (row_steps_ == 0) return;
    // sums over the row's steps become means; impulses on regions become forces
    const double share = 1.0 / row_steps_;
    row_.time = view.time;
    row_.contact_force *= share;
    row_.friction_force *= share;
    row_.breaking_x *= share;
    row_.moment *= share;
    row_.contacts *= share;
    row_.thrust *= share;
    row_.tow_force *= share;
    row_.ship_position = view.scene.bodies.position[kShip];
    for (RegionForce& sum : row_regions_) {
        sum.contact *= share / dt_;
        sum.friction *= share / dt_;
    }
    run_->add(row_, row_regions_);
    std::fill(row_regions_.begin(), row_regions_.end(), RegionForce{});
    csv_files_[0].add(csv_row(row_, parameters_.has_bending(), parameters_.ship.any_free()));

    // tracked floes: forces as means, poses at the end of the row
    std::vector<TrackRow> tracks(tracked_sum_.size());
    const Bodies& b = view.scene.bodies;
    for (std::size_t k = 0; k < tracks.size(); ++k) {
        const auto i = static_cast<std::size_t>(parameters_.track[k]);
        tracks[k] = {view.time,
                     b.position[i],
                     b.orientation[i],
                     b.velocity[i],
                     b.angular_velocity[i],
                     share * tracked_sum_[k].contact,
                     share * tracked_sum_[k].friction,
                     share * tracked_sum_[k].ice};
        csv_files_[k + 1].add(csv_row(tracks[k]));
        tracked_sum_[k] = {};
    }
    run_->add_tracked(tracks);
    row_ = {};
    row_steps_ = 0;
    ++rows_;
}

void Recorder::add_frame(const StepView& view) {
    const Bodies& b = view.scene.bodies;
    RunFrame frame;
    frame.time = view.time;
    frame.ship_position = b.position[kShip];
    frame.ship_orientation = b.orientation[kShip];
    // A frame's force is the mean since the last frame, so that short peaks between frames are not
    // lost.
    const double span = view.time - last_frame_;
    for (std::size_t i = 1; i < b.size(); ++i) {
        frame.position.push_back(b.position[i]);
        frame.orientation.push_back(b.orientation[i]);
        frame.velocity.push_back(b.velocity[i]);
        frame.angular_velocity.push_back(b.angular_velocity[i]);
        frame.contact_force.push_back(span > 0.0 ? Vec3(frame_impulse_[i] / span) : Vec3::Zero());
        frame.state.push_back(state_of(view.scene, i));
    }
    frame.hull_contacts = hull_contacts_.take(span);
    run_->add(frame);
    std::fill(frame_impulse_.begin(), frame_impulse_.end(), Vec3::Zero());
    last_frame_ = view.time;
    ++frames_;
}

std::optional<FreeTravel> Recorder::travel(const StepView& view) const {
    if (view.ship == nullptr) return std::nullopt;
    return ship_statistics_.travel(*view.ship, view.scene, parameters_);
}

void Recorder::finish(const StepView& view, Summary& summary) {
    // the last row and frame, however short: a run may end between two of them
    flush_history(view);
    if (view.time > last_frame_) add_frame(view);
    run_->finish(panel_loads_.panels());
    if (view.edge != nullptr) {
        write_pieces(folder_ / kPiecesName, record_edge(*view.edge));
        say(describe_edge(*view.edge));
        summary.cracks = measure_cracks(*view.edge);
    }
    for (CsvFile& file : csv_files_) file.finish();
    fill_energy(view.ledger, potential_energy(view.scene, parameters_), summary);
    if (view.ship != nullptr) ship_statistics_.fill(*view.ship, view.scene, parameters_, summary);
    statistics_.fill(summary);  // after the energies: its warnings use them
    panel_loads_.fill(summary);
    // row 0 is for parts without a name; a mesh with names mostly has no such parts
    const auto& names = view.scene.shapes[0].region_names;
    if (names.size() > 1 && summary.regions.at(names[0]).hits == 0) summary.regions.erase(names[0]);
    summary.state_hash = state_hash(view.scene, view.constraints);
    const Bodies& b = view.scene.bodies;
    summary.floes_total = static_cast<std::int64_t>(b.size()) - 1;
    if (view.edge != nullptr) {  // slots are no floes: pieces are
        summary.floes_total =
            static_cast<std::int64_t>(view.edge->first_body()) - 1 + view.edge->broken();
        summary.floes_moved = summary.floes_behind = view.edge->retired();
    }
    for (std::size_t i = 1; i < b.size(); ++i) {
        const bool of_sheet = view.edge != nullptr && view.edge->has_slot(i) && b.held[i];
        summary.floes_moved += b.held[i] ? 0 : 1;
        summary.floes_behind += is_behind(view.scene, i) && !of_sheet ? 1 : 0;
        summary.ice_spheres += static_cast<std::int64_t>(
            view.scene.shapes[static_cast<std::size_t>(b.shape[i])].sphere_count);
    }
    summary.hull_spheres = static_cast<std::int64_t>(view.scene.shapes[0].sphere_count);
}

}  // namespace ice
