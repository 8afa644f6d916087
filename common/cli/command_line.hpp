// SPDX-License-Identifier: GPL-3.0-or-later
/// The main function of all programs: parse, prepare messages, run, return an exit code.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ice {

/// Options of the program's messages.
struct MessageOptions {
    bool quiet = false;           ///< nothing but errors
    std::string colour = "auto";  ///< "always", "never", or "auto": see Colour
};

/// Gives a program `--version`: its name, version, commit and compiler.
void declare_version(CLI::App& app);

/// Keeps the pages of large arrays that come and go instead of having the kernel clear new ones
/// each time. To be called first in main.
void keep_pages();

/// Parses the command line and runs the program's body. @return the exit code of the program
///
/// A bad command line ends with exit code 2 and the probable correction, --help and --version with
/// 0, exceptions as run_program() says.
/// @param app       all options declared; its name is the program's
/// @param messages  where the app puts --quiet and --color; read after parsing
/// @param to_save_memory  remedy when memory runs out, a clause: "use ..."
/// @param body      is given the words of the command line, joined as a shell takes them
int run_command_line(CLI::App& app, int argc, const char* const* argv,
                     const MessageOptions& messages, const std::string& to_save_memory,
                     const std::function<int(const std::string&)>& body);

}  // namespace ice
