// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/command_line.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>

#include "common/base/error.hpp"
#include "common/base/version.hpp"
#include "common/cli/console.hpp"

namespace ice {

void declare_version(CLI::App& app) {
    app.set_version_flag("--version", fmt::format("{} {} ({}, {})", app.get_name(), version(),
                                                  git_commit(), compiler()));
}

void keep_pages() {
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

int run_command_line(CLI::App& app, int argc, const char* const* argv,
                     const MessageOptions& messages, const std::string& to_save_memory,
                     const std::function<int(const std::string&)>& body) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // CLI11's own codes start at 100; help and version end with 0
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
    }
    set_typed_program(argv[0]);
    const Colour colour = messages.colour == "always"  ? Colour::always
                          : messages.colour == "never" ? Colour::never
                                                       : Colour::automatic;
    start_messages(colour, messages.quiet);
    return run_program(
        app.get_name(), [&] { return body(command_line(argc, argv)); }, to_save_memory);
}

}  // namespace ice
