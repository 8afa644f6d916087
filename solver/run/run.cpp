// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"
#include "common/base/parallel.hpp"
#include "common/base/part_file.hpp"
#include "common/base/timer.hpp"
#include "common/base/version.hpp"
#include "solver/record/measure_particulars.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/warn_of_open_end.hpp"
#include "solver/run/check_sheet.hpp"
#include "solver/run/disk_room.hpp"
#include "solver/run/make_water.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "solver/run/run_folder.hpp"
#include "solver/scene/build_scene.hpp"
#include "solver/scene/set_added_mass.hpp"

namespace ice {

namespace {

// References alone: a recorder sees the world after a step and keeps none of it.
StepView view_of(const World& w) {
    return {w.scene,
            w.contacts,
            w.constraints,
            w.ledger,
            w.time,
            w.impacts.converged && w.rest.converged,
            w.ship.is_free() ? &w.ship : nullptr,
            w.edge.has_sheet() ? &w.edge : nullptr};
}

// A body farther away than this [m] is a fault: no course is so long. Larger lets a run that fails
// go on for longer.
constexpr double kFarAway = 1e7;

// A not-a-number spreads to every body that it touches: the run stops in the step that made it, and
// names it. The comparison is written so that a not-a-number fails it.
void check_finite(const World& w) {
    const Bodies& b = w.scene.bodies;
    for (const std::int32_t i : b.moving)  // held ones are as the case gave them
        if (!(b.position[i].norm() < kFarAway) || !b.velocity[i].allFinite())
            throw run_failed(fmt::format("step {}, floe {}", w.steps, i),
                             "its position is no longer a number, or is beyond any sea",
                             "use a smaller simulation.time_step");
}

// A step that must balance; the summary keeps the worst of each kind.
void verified_step(World& w, Summary& summary) {
    begin_step(w);  // momenta are compared between bodies of one shape
    const Momenta before = momenta_of(w);
    step(w);
    const Imbalance found = require_balance(before, w);
    const auto keep = [&](const char* key, double value) {
        double& worst = summary.imbalance[key];
        worst = std::max(worst, value);
    };
    keep("floe_momentum", found.linear);
    keep("floe_angular_momentum", found.angular);
    keep("ship_and_floes", found.together);
    if (w.ship.is_free()) keep("ship", found.ship);
}

// The summary's part on the program and its run. Wall times differ between equal runs; all other
// values are the same.
void fill_run(const World& w, double wall_seconds, Summary& s) {
    const Case& p = w.parameters;
    s.title = p.title;
    s.dimension = p.dimension;
    s.steps = w.steps;
    s.simulated_s = w.time;
    s.wall_s = wall_seconds;
    s.threads = thread_count();
    s.simd = instruction_set();
    s.case_file = p.file.string();
    for (std::size_t k = 0; k < kStageNames.size(); ++k)
        s.stage_seconds[kStageNames[k]] = w.stage_seconds[k];
}

void write_summary(const World& w, const RunOptions& options, double wall_seconds,
                   Recorder& recorder, Summary& summary) {
    // before the summary is completed: means over ship lengths need the travel
    fill_particulars(w.scene, w.parameters, w.time, summary, recorder.travel(view_of(w)));
    recorder.finish(view_of(w), summary);  // its warnings use the travel
    if (auto warning = warn_of_open_end(w.scene, w.parameters, summary.travel.distance))
        summary.warnings.push_back(*warning);
    if (auto warning = warn_of_whole_ice(w)) summary.warnings.push_back(*warning);
    fill_run(w, wall_seconds, summary);
    write_text_file(options.folder / "summary.json", summary_text(summary));
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw run_failed(folder.string(), "cannot be created: " + error.message(),
                         "choose another folder");
}

// A run under way: what run() and its parts share.
struct Job {
    World& world;
    const RunOptions& options;
    std::int64_t steps;  // of the whole run
    Recorder recorder;
    RunProgress progress = {};
    Summary summary = {};
    double wall_before = 0.0;  // of the programs that worked on the run before
    Timer timer = {};
    std::int64_t saved_step = -1;  // of the last checkpoint
    double saved_at = 0.0;         // [s] on the timer
    DiskRoom room{options.folder};

    double wall_seconds() const { return wall_before + timer.seconds(); }
};

void start(Job& job) {
    job.recorder.open(job.options.folder, job.options.command_line, job.world.scene);
    job.progress.warnings = job.options.start_warnings;
}

// The part of the averaged time that is over: 0 before the averages begin, 1 at the end. It is the
// share of the mean that another program may have computed.
double averaged_share(const World& w) {
    const Case& p = w.parameters;
    return std::clamp((w.time - p.average_from) / (p.duration - p.average_from), 0.0, 1.0);
}

// Continues from a checkpoint: progress and rows of before count as this run's own.
void go_on(Job& job, const SavedRun& saved) {
    const RunOptions& o = job.options;
    job.progress = saved.progress;
    job.wall_before = saved.progress.wall_seconds;
    const auto warn = [&](const std::string& text) {
        job.progress.warnings.push_back({text, false});
    };
    for (const std::string& name : job.recorder.resume(o.folder, o.command_line, job.world.scene,
                                                       saved.folder, saved.position))
        warn(fmt::format(
            "the rows of {} before t = {:g} s were not found in {}: the file begins there; the "
            "statistics are of the whole run",
            name, job.world.time, saved.folder.string()));
    // the continued files are named .part now; the finished ones of before are out of date
    remove_results(o.folder);
    const std::string here = fmt::format("icesolve {} ({})", version(), git_commit());
    if (saved.created_by != here)
        job.progress.warnings.push_back(
            judged(fmt::format("the run was begun with {} and is resumed with {}: the "
                               "result may differ in the last digits from a run of either "
                               "version alone",
                               saved.created_by, here),
                   averaged_share(job.world)));
}

void save(Job& job, SavedRows rows = SavedRows::beside) {
    // state and files are saved already
    if (job.saved_step == job.world.steps) return;
    job.progress.wall_seconds = job.wall_seconds();
    write_checkpoint(job.options.folder / kCheckpointName, job.world, job.recorder, job.progress,
                     rows);
    job.saved_step = job.world.steps;
    job.saved_at = job.timer.seconds();
}

// Ends the run while its files can still be completed; it resumes from here when there is room.
void stop_for_room(Job& job) {
    job.summary.status = "failed";
    job.summary.warnings.push_back(
        {fmt::format("the disk is almost full: the run stopped at t = {:g} of {:g} s",
                     job.world.time, job.world.parameters.duration),
         true});
    job.room.release();
    save(job, SavedRows::in_run_file);
}

// False when the rows of run.h5 and the checkpoint no longer fit; the older checkpoint is whole.
// @throws Error when they cannot be written for another reason, which it names
bool could_save(Job& job) {
    if (job.room.is_short(job.recorder, job.world, true)) return false;
    try {
        save(job);
        job.room.saved();
        return true;
    } catch (const Error&) {
        // somebody else may have taken the room meanwhile, but not the reserve
        if (job.room.is_used_up() || job.room.is_short(job.recorder, job.world, true)) return false;
        throw;
    }
}

// Checkpoints are due in the step nearest to a multiple of checkpoint_every, and in the last one;
// without it after some minutes of work, which a kill would otherwise lose.
bool is_due(const Job& job) {
    const double every = job.options.checkpoint_every, dt = job.world.parameters.time_step;
    if (every <= 0.0)
        return job.world.steps < job.steps &&
               job.timer.seconds() - job.saved_at > job.options.checkpoint_wall_seconds;
    if (job.world.steps == job.steps) return true;
    const double now = job.world.time + 0.5 * dt;  // times are multiples of dt up to rounding
    return std::floor(now / every) > std::floor((now - dt) / every);
}

void advance(Job& job) {
    World& w = job.world;
    while (w.steps < job.steps) {
        // room is checked before the step: its output must fit
        if (job.room.is_short(job.recorder, w)) return stop_for_room(job);
        if (job.options.verify)
            verified_step(w, job.summary);
        else
            step(w);
        check_finite(w);
        job.recorder.add(view_of(w));
        if (is_due(job) && !could_save(job)) return stop_for_room(job);
        const double done = static_cast<double>(w.steps) / static_cast<double>(job.steps);
        // an interruption in the last step comes too late to be one
        if (!job.options.keep_going(done, w) && w.steps < job.steps) {
            save(job);
            job.summary.status = "interrupted";
            return;
        }
    }
}

}  // namespace

World build_world(const Case& parameters) {
    // Ice before water: level ice lies around the hull, and the spacing of the flow's table follows
    // from the thinnest floe.
    World world;
    world.parameters = parameters;
    world.scene = build_scene(world.parameters);
    if (parameters.has_level_ice()) world.edge.begin(world.scene, world.parameters);
    world.scene.water = make_water(parameters, world.scene);
    if (parameters.floes_move_water) set_added_mass(world.scene, world.parameters);
    world.ship.begin(parameters, world.scene);
    return world;
}

Summary run(World& world, const RunOptions& options) {
    const Case& p = world.parameters;
    world.ship.begin(p, world.scene);
    create_folder(options.folder);
    std::string command = options.command_line;
    std::replace(command.begin(), command.end(), '\n', ' ');  // it is part of a comment
    write_text_file(
        options.folder / "case.resolved.cfg",
        fmt::format("# icesolve {} ({})\n# {}\n{}", version(), git_commit(), command, p.resolved));
    // duration / dt rounded: a last fraction of a step is not simulated, and said below
    const auto steps = static_cast<std::int64_t>(std::llround(p.duration / p.time_step));

    Job job{
        world, options, steps,
        options.saved != nullptr ? std::move(options.saved->recorder) : Recorder(p, world.scene)};
    Summary& summary = job.summary;
    summary.command_line = options.command_line;
    if (std::abs(static_cast<double>(steps) * p.time_step - p.duration) > 1e-9 * p.duration)
        summary.warnings.push_back(
            {fmt::format("simulation.duration is not a whole number of steps: {:g} s are simulated",
                         static_cast<double>(steps) * p.time_step),
             false});
    // files are opened before the first step: a folder that cannot be written costs no run
    if (options.saved != nullptr)
        go_on(job, *options.saved);
    else
        start(job);
    if (world.edge.has_sheet()) world.edge.keep_gone_in(options.folder);
    summary.warnings.insert(summary.warnings.end(), job.progress.warnings.begin(),
                            job.progress.warnings.end());
    summary.warnings.insert(summary.warnings.end(), options.course_warnings.begin(),
                            options.course_warnings.end());
    try {
        advance(job);
        write_summary(world, options, job.wall_seconds(), job.recorder, summary);
    } catch (const Error& error) {
        // the results up to here are kept where they can be written, and say that the run failed
        job.room.release();
        summary.status = "failed";
        summary.warnings.push_back({error.what(), true});
        try {
            write_summary(world, options, job.wall_seconds(), job.recorder, summary);
        } catch (const Error&) {  // the .part files stay: icepost reads their whole rows
        }
        throw;
    }
    remove_parts(options.folder);  // of a program that was killed here before
    const bool is_whole = world.steps == steps && summary.status == "completed";
    if (is_whole && options.checkpoint_every <= 0.0 && job.saved_step >= 0)
        std::filesystem::remove(options.folder /
                                kCheckpointName);  // an autosave, of no use after the end
    return summary;
}

}  // namespace ice
