// SPDX-License-Identifier: GPL-3.0-or-later
/// The command line of icepost: its declaration and its values.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "common/cli/command_line.hpp"
#include "postprocess/report/write_report.hpp"

namespace ice {

/// The values given; RUN and DIR share `run`.
struct PostOptions {
    /// Files and folders as given; empty: not given.
    std::filesystem::path run, out, expected, junit, svg, coefficients, thrust, csv_file;
    /// Each `every`th frame is written for ParaView; frames of the report's playback at most.
    /// Counts.
    std::size_t every = 1, frames = report::kReportFrames;
    double time = 0.0;                                                    ///< of the view [s]
    double flexural_strength = std::numeric_limits<double>::quiet_NaN();  ///< [Pa]; NaN: the case's
    std::string from = "below", name;  ///< view (parse_view()); the ship's name of a fit
    std::vector<std::string> runs;     ///< folders to compare
    bool points_only = false, csv = false, markdown = false;
    MessageOptions messages;
};

/// The subcommands, in the order of the help.
struct PostCommands {
    CLI::App *report, *view, *plot, *table, *sweep, *fit, *hv, *sensitivity, *paraview, *check;
};

/// Declares subcommands and options; their values go into `options`.
PostCommands declare_post(CLI::App& app, PostOptions& options);

}  // namespace ice
