// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/command_line.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/base/error.hpp"
#include "common/base/nearest_name.hpp"
#include "common/base/version.hpp"
#include "common/cli/console.hpp"

namespace ice {

void declare_version(CLI::App& app) {
    app.set_version_flag("--version", fmt::format("{} {} ({}, {})", app.get_name(), version(),
                                                  git_commit(), compiler()));
}

void keep_pages() {
    // 1 GiB: larger than any array of a usual run. Below the threshold free memory stays with the
    // program, so that its peak use does not fall; above it the kernel clears each page again.
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

namespace {

// the command that was given, or the program itself: "icepost report"
const CLI::App& given_command(const CLI::App& app) {
    const auto commands = app.get_subcommands();
    return commands.empty() ? app : *commands.front();
}

std::string full_name(const CLI::App& app) {
    const CLI::App& command = given_command(app);
    return &command == &app ? app.get_name() : app.get_name() + " " + command.get_name();
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* part : {&app, &given_command(app)})
        for (const CLI::Option* option : part->get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::string join_words(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

// CLI11's complaint in the form of the project's other errors: the fault, then the remedy
Error usage_error(const CLI::App& app, const CLI::ParseError& error) {
    // In this order: a wrong command hides all else, a word that nobody took hides its value, and
    // the remaining complaints of CLI11 are reworded.
    const std::string help = full_name(app) + " --help lists its options";
    const std::vector<std::string> left = app.remaining(true);
    const std::vector<std::string> commands = command_names(app);
    // A missing or misspelt command first: CLI11 would complain about the arguments behind it.
    if (!commands.empty() && app.get_subcommands().empty()) {
        if (left.empty() || left.front().starts_with('-'))
            return bad_input("", "no command given", "give one of " + join_words(commands));
        const std::string near = nearest_name(left.front(), commands);
        return bad_input("", fmt::format("there is no command '{}'", left.front()),
                         near.empty() ? "give one of " + join_words(commands)
                                      : fmt::format("did you mean '{}'?", near));
    }
    // Words that CLI11 did not take: an unknown option with its value, or an argument too many.
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !left.empty()) {
        const auto option = std::find_if(left.begin(), left.end(), [](const std::string& word) {
            return word.starts_with('-');
        });
        if (option == left.end())
            return bad_input("", fmt::format("one argument too many: {}", join_words(left)), help);
        const std::string near =
            nearest_name(option->substr(0, option->find('=')), option_names(app));
        return bad_input("", fmt::format("there is no option '{}'", *option),
                         near.empty() ? help : fmt::format("did you mean '{}'?", near));
    }
    // CLI11 has no error codes for these, only its own English.
    std::string text = error.what();
    if (const auto end = text.rfind(" is required"); end != std::string::npos)
        text = fmt::format("no {} given", text.substr(0, end));
    else if (const auto colon = text.find(": "); text.ends_with(" missing"))
        text = text.substr(0, colon) + " needs a value";
    else if (const auto list = text.find(" not in {"); list != std::string::npos)
        text =
            text.substr(0, list) + " is none of " + text.substr(list + 9, text.size() - list - 10);
    return bad_input("", text, help);
}

}  // namespace

int run_command_line(CLI::App& app, int argc, const char* const* argv,
                     const MessageOptions& messages, const std::string& to_save_memory,
                     const std::function<int(const std::string&)>& body) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // the options that choose colour and silence were not read
        start_messages(Colour::automatic, false);
        if (error.get_exit_code() == 0)  // help and version
            return run_program(app.get_name(), [&] { return app.exit(error); });
        return run_program(app.get_name(), [&]() -> int { throw usage_error(app, error); });
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
