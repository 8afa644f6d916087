// SPDX-License-Identifier: GPL-3.0-or-later
/// Messages, exit codes and Ctrl-C, the same for all programs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace ice {

/// Colour of messages on stderr. `automatic`: on a terminal, unless NO_COLOR is set.
enum class Colour { automatic, always, never };

/// True when stderr is a terminal that redraws, i.e. no pipe, file, CI log (variable CI) or
/// terminal without colours and cursor (TERM=dumb, as in editors).
bool stderr_is_terminal();
/// Columns of the terminal behind stderr: its own word, else the variable COLUMNS, else 80.
int terminal_width();

/// Prepares messages: stderr with optional colour, nothing but errors when quiet.
void start_messages(Colour colour, bool quiet);
/// Also writes every message to a file from now on, behind its content when `append` is true.
/// @throws Error (exit code 1) if it cannot.
void log_to_file(const std::filesystem::path& path, bool append = false);
void say(const std::string& text);          ///< information
void say_warning(const std::string& text);  ///< something the user should know

/// Writes data to stdout. A reader that has closed (a pager, head) is no failure: the program
/// continues and the rest is dropped.
/// @throws Error (exit code 1) when it cannot be written for another reason
void write_data(const std::string& text);

/// Runs a program's body and turns exceptions into one message and the contract's exit code.
/// @param to_save_memory  remedy when there is not enough: "use ..."
int run_program(const std::string& name, const std::function<int()>& body,
                const std::string& to_save_memory = "use a smaller case");

/// From now on Ctrl-C and SIGTERM only set a flag; a second one, half a second later or more, ends
/// the program at once (130).
void catch_interrupts();
/// True from the first caught signal on.
bool interrupted();
/// A caught interrupt is passed on to this process; one that ends the program kills it.
/// @param program  that this one waits for; 0: none
void pass_interrupts_to(int program);

/// The words of the command line joined, quoted where a shell needs it.
std::string command_line(int argc, const char* const* argv);
/// The program as the user typed it, for commands to copy; run_command_line() sets it.
std::string typed_program();
/// To be called once, before typed_program(). @param word  argv[0]: referred to, not copied
void set_typed_program(const char* word);
/// A word of a command line, quoted where a shell needs it.
std::string shell_word(const std::string& word);

}  // namespace ice
