// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/recognise_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace ice {

namespace {

// A kind of TOML file, known by tables and keys that only it has at the top.
struct FileKind {
    std::string_view title, what, remedy;
    std::array<std::string_view, 3> signs;
};

constexpr std::array kKinds{
    FileKind{"icesolve case",
             "a case for icesolve",
             "icesolve FILE runs it",
             {"simulation", "hull", "contact"}},
    FileKind{"icefield specification",
             "the specification of an ice field for icefield",
             "icefield FILE -o field.h5 makes the field; a case names it: [[floes]], pattern = "
             "\"file\", file = \"field.h5\"",
             {"pattern", "edges", "area"}},
    FileKind{"expected numbers",
             "a list of expected numbers for icepost",
             "icepost check RUN FILE compares a run with it",
             {"expect", "expect", "expect"}},
};

constexpr std::string_view kMeshes[] = {".obj", ".stl",  ".ply", ".off", ".dae",
                                        ".fbx", ".gltf", ".glb", ".gz"};

// The formats that HDF5 files of the project state in an attribute.
struct Format {
    std::string_view name, what, remedy;
};

constexpr std::array kFormats{
    Format{"icesolve-spheres", "a sphere set, made by spherize",
           "a case names it: [hull] or [[floes]], spheres = \"FILE\""},
    Format{"icesolve-field", "an ice field, made by icefield",
           "a case names it: [[floes]], pattern = \"file\", file = \"FILE\""},
    Format{"icesolve-flow", "a flow around a hull, made by iceflow",
           "a case names it: [flow], model = \"file\", file = \"FILE\""},
    Format{"icesolve-result", "the result of a run", "icepost report shows the run's folder"},
    Format{"icesolve-pieces", "the pieces of a run in level ice",
           "icepost report shows the run's folder"},
    Format{"icesolve-checkpoint", "a checkpoint of a run",
           "icesolve CASE.cfg --restart FILE goes on from it"},
    Format{"", "an HDF5 file", "give a text file; icepost reads the run folder of a run.h5"},
};

// File names that a message lists [-]: more hide the advice among names.
constexpr std::size_t kMostNames = 5;

std::string with_name(std::string_view remedy, const std::filesystem::path& file) {
    std::string text(remedy);
    if (const auto at = text.find("FILE"); at != std::string::npos)
        text.replace(at, 4, file.string());
    return text;
}

std::string lower_extension(const std::filesystem::path& file) {
    std::string end = file.extension().string();
    for (char& c : end) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return end;
}

}  // namespace

std::optional<Recognised> recognise_file(const std::filesystem::path& file, std::string_view text) {
    // the first bytes of every HDF5 file; the format's name is an attribute
    if (text.starts_with("\x89HDF\r\n\x1a\n"))
        // the last entry has no name, so that it fits any other HDF5 file
        for (const Format& format : kFormats)
            if (text.find(format.name) != std::string_view::npos)
                return Recognised{std::string(format.what), with_name(format.remedy, file)};
    // by the name alone: a mesh's content has no mark that all formats share
    if (std::count(std::begin(kMeshes), std::end(kMeshes), lower_extension(file)) > 0)
        return Recognised{"a mesh", with_name("make a sphere set of it: spherize FILE; a case "
                                              "names that, and icesolve runs the case",
                                              file)};
    // byte-order marks
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        return Recognised{"text in UTF-16", "save it as UTF-8"};
    return std::nullopt;
}

std::optional<Recognised> recognise_format(const std::filesystem::path& file,
                                           std::string_view format) {
    if (format.empty()) return std::nullopt;  // the last entry fits any file
    for (const Format& known : kFormats)
        if (known.name == format)
            return Recognised{std::string(known.what), with_name(known.remedy, file)};
    return std::nullopt;
}

std::optional<Recognised> recognise_tables(const std::filesystem::path& file,
                                           const std::vector<std::string>& names,
                                           std::string_view wanted) {
    const auto shows = [&](const FileKind& kind) {
        return std::any_of(kind.signs.begin(), kind.signs.end(), [&](std::string_view sign) {
            return std::find(names.begin(), names.end(), sign) != names.end();
        });
    };
    // the first kind that shows a sign, unless the wanted kind shows one, too
    const FileKind* found = nullptr;
    for (const FileKind& kind : kKinds) {
        if (!shows(kind)) continue;
        // it has a sign of the wanted kind: a mistake in it is reported as such
        if (kind.title == wanted) return std::nullopt;
        if (found == nullptr) found = &kind;
    }
    if (found == nullptr) return std::nullopt;
    return Recognised{std::string(found->what), with_name(found->remedy, file)};
}

std::string look_into_folder(const std::filesystem::path& folder, std::string_view ending) {
    // A folder that cannot be listed gives the plain advice: this text is part of another error.
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == ending)
            found.push_back((folder / entry.path().filename()).string());
    if (found.empty()) return "give a file";
    std::sort(found.begin(), found.end());
    if (found.size() == 1) return fmt::format("give the file: {}", found.front());
    const std::size_t shown = std::min(found.size(), kMostNames);
    return fmt::format("give one of its files: {}{}",
                       fmt::join(found.begin(), found.begin() + static_cast<long>(shown), ", "),
                       shown < found.size() ? ", ..." : "");
}

}  // namespace ice
