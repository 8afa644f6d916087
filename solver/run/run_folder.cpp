// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <functional>
#include <string_view>
#include <vector>

#include "common/base/error.hpp"

namespace ice {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLogName = "run.log";
constexpr std::string_view kPart = ".part";

// "floe_12.csv" is prefix, number, suffix; "-" may join numbers.
bool is_numbered(std::string_view name, std::string_view prefix, std::string_view suffix) {
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
    name.remove_prefix(prefix.size());
    if (name.size() <= suffix.size()) return false;
    name.remove_suffix(suffix.size());
    return name.find_first_not_of("0123456789-") == std::string_view::npos;
}

// Files that state the result of a whole run: out of date as soon as the run is resumed.
bool is_result(std::string_view name) {
    constexpr std::array<std::string_view, 4> names{"summary.json", "report.html", "run.h5",
                                                    "forces.csv"};
    return std::find(names.begin(), names.end(), name) != names.end() ||
           is_numbered(name, "floe_", ".csv");
}

// All that icesolve writes into a run folder, the report that it orders from icepost included.
// Nothing else is ever removed: users keep notes and pictures beside a run.
bool is_of_a_run(std::string_view name) {
    if (name.ends_with(kPart)) name.remove_suffix(kPart.size());
    return is_result(name) || name == "case.resolved.cfg" || name == kLogName ||
           name == kCheckpointName || is_numbered(name, "checkpoint-rows-", ".h5");
}

// Names first, then removal: a directory that changes while it is read may skip entries.
void remove_where(const fs::path& folder, const std::function<bool(const std::string&)>& is_meant) {
    std::error_code ignored;
    std::vector<fs::path> meant;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (is_meant(entry.path().filename().string())) meant.push_back(entry.path());
    for (const fs::path& path : meant) fs::remove(path, ignored);
}

// The content of a folder, sorted, without the empty run.log that claiming it leaves.
std::vector<std::string> names_in(const fs::path& folder) {
    std::error_code error, ignored;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name != kLogName || fs::file_size(entry.path(), ignored) != 0) names.push_back(name);
    }
    if (error)
        throw run_failed(folder.string(), "cannot be read: " + error.message(),
                         "choose another folder with --out");
    std::sort(names.begin(), names.end());
    return names;
}

[[noreturn]] void refuse_locked(const fs::path& folder) {
    throw bad_input(folder.string(), "another icesolve is writing this run",
                    "wait until it has ended, or choose another folder with --out");
}

// A single run beside an ensemble's members would replace their summary.json alone.
void refuse_ensemble(const fs::path& folder) {
    for (const std::string& name : names_in(folder))
        if (is_member_folder(folder / name))
            throw bad_input(folder.string(), "holds an ensemble: " + name,
                            "choose another folder with --out, or go on with it: --seeds N");
}

// The error lists the files in the folder and every remedy: resume, replace, another folder.
void refuse_taken(const fs::path& folder, const FolderCommands& commands) {
    const std::vector<std::string> names = names_in(folder);
    if (names.empty()) return;
    const bool is_run = std::any_of(names.begin(), names.end(), is_of_a_run);
    std::string remedy = "choose another folder with --out";
    if (fs::exists(folder / kCheckpointName) && !commands.go_on.empty())
        remedy += "; go on with that run with\n    " + commands.go_on;
    if (!commands.replace.empty())
        remedy +=
            fmt::format("\n  or {} with\n    {}",
                        is_run ? "replace that run" : "write beside what is there, which stays,",
                        commands.replace);
    const std::size_t others = names.size() - 1;
    throw bad_input(folder.string(),
                    fmt::format("{}: {}{}", is_run ? "holds a run already" : "is not empty",
                                names[0], others > 0 ? fmt::format(" and {} more", others) : ""),
                    remedy);
}

// The lock, or -1 where the file system has none.
int lock_file(const fs::path& folder) {
    const fs::path log = folder / kLogName;
    const int file = ::open(log.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
        throw run_failed(log.string(), std::string("cannot be written: ") + std::strerror(errno),
                         "check that the folder is writable and the disk is not full, or choose "
                         "another with --out");
    // the lock ends with the program, however that ends
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    const bool is_locked = errno == EWOULDBLOCK;
    ::close(file);
    if (is_locked) refuse_locked(folder);
    return -1;
}

}  // namespace

RunFolder::RunFolder(fs::path folder, Existing existing, const FolderCommands& commands)
    : path_(std::move(folder)) {
    std::error_code error;
    if (fs::exists(path_, error) && !fs::is_directory(path_, error))
        throw run_failed(path_.string(), "is a file, no folder",
                         "choose another folder with --out");
    fs::create_directories(path_, error);
    if (error)
        throw run_failed(path_.string(), "cannot be created: " + error.message(),
                         "choose another folder with --out");
    if (existing != Existing::go_on) refuse_ensemble(path_);
    // twice: a folder of somebody else gets no run.log, and two programs may come at once
    std::error_code ignored;
    if (existing == Existing::refuse && !fs::exists(path_ / kLogName, ignored))
        refuse_taken(path_, commands);
    lock_ = lock_file(path_);
    try {
        if (existing == Existing::refuse) refuse_taken(path_, commands);
    } catch (...) {
        ::close(lock_);
        throw;
    }
    if (existing == Existing::replace) remove_run(path_);
}

RunFolder::~RunFolder() {
    if (lock_ >= 0) ::close(lock_);
}

fs::path default_run_folder(const fs::path& case_file) {
    fs::path name = case_file.stem();
    // of a case called "case" the folder says more
    const fs::path folder = fs::absolute(case_file).lexically_normal().parent_path().filename();
    if (name == "case" && !folder.empty()) name = folder;
    return fs::path("results") / name;
}

// By files that an ensemble's own folder never has: it has a summary.json and a run.log, too.
bool holds_single_run(const fs::path& folder) {
    constexpr std::array<const char*, 4> names{"run.h5", "run.h5.part", "case.resolved.cfg",
                                               kCheckpointName};
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return fs::exists(folder / name); });
}

bool is_member_folder(const fs::path& path) {
    return is_numbered(path.filename().string(), "seed-", "") && fs::is_directory(path);
}

void remove_run(const fs::path& folder) {
    remove_where(folder,
                 [](const std::string& name) { return is_of_a_run(name) && name != kLogName; });
}

void remove_results(const fs::path& folder) { remove_where(folder, is_result); }

void remove_parts(const fs::path& folder) {
    remove_where(
        folder, [](const std::string& name) { return name.ends_with(kPart) && is_of_a_run(name); });
}

}  // namespace ice
