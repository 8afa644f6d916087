// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_exports.hpp"

#include <algorithm>
#include <list>
#include <set>

#include "common/base/error.hpp"
#include "common/formats/rigid_body_file.hpp"
#include "preprocess/write/output_file.hpp"
#include "preprocess/write/write_chrono.hpp"
#include "preprocess/write/write_csv.hpp"
#include "preprocess/write/write_liggghts.hpp"
#include "preprocess/write/write_vtp.hpp"
#include "preprocess/write/write_yade.hpp"

namespace ice {

namespace {

struct Format {
    std::string name;
    std::vector<std::string> endings;
};

const std::vector<Format>& formats_known() {
    static const std::vector<Format> known{{"csv", {".csv"}},
                                           {"vtp", {".vtp"}},
                                           {"yade", {".yade.txt", ".yade.py"}},
                                           {"liggghts", {".liggghts.txt", ".liggghts.in"}},
                                           {"chrono", {".chrono.csv", ".chrono.json"}}};
    return known;
}

const std::vector<std::string>& endings_of(const std::string& name) {
    const auto& known = formats_known();
    return std::find_if(known.begin(), known.end(),
                        [&](const Format& format) { return format.name == name; })
        ->endings;
}

// Files that get their final names together.
class OutputFiles {
public:
    explicit OutputFiles(std::filesystem::path base) : base_(std::move(base)) {}

    // the scripts name the file of spheres beside them
    std::string name(const std::string& ending) const { return base_.filename().string() + ending; }
    void add(const std::string& ending, const std::function<void(const Sink&)>& write) {
        OutputFile& file = files_.emplace_back(base_.string() + ending);
        write([&](std::string_view bytes) { file.write(bytes); });
        file.close();
    }
    void add_text(const std::string& ending, const std::string& text) {
        add(ending, [&](const Sink& sink) { sink(text); });
    }
    // names only now, when all are written: no script without its spheres
    std::vector<std::filesystem::path> keep() {
        std::vector<std::filesystem::path> paths;
        for (OutputFile& file : files_) {
            file.keep();
            paths.push_back(file.path());
        }
        return paths;
    }

private:
    std::filesystem::path base_;
    std::list<OutputFile> files_;  // a list, because a file cannot move
};

// LIGGGHTS allows letters, digits and underscores in an ID.
std::string fix_id(const std::string& name) {
    std::string id = name.substr(0, name.find('.'));
    for (char& c : id)
        if (!(('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9'))) c = '_';
    return id.empty() ? "body" : id;
}

void add_format(OutputFiles& files, const std::string& format, const SphereSet& set,
                const RigidBody& body) {
    // Codes other than csv and vtp need a second file: their sphere lists have no place for mass
    // and inertia.
    const std::vector<std::string>& ending = endings_of(format);
    if (format == "csv") files.add(ending[0], [&](const Sink& sink) { write_csv(set, sink); });
    if (format == "vtp") files.add(ending[0], [&](const Sink& sink) { write_vtp(set, sink); });
    if (format == "yade") {
        files.add(ending[0], [&](const Sink& sink) { write_yade_spheres(set, body, sink); });
        files.add_text(ending[1], yade_text(body, set.radius, files.name(ending[0])));
    }
    if (format == "liggghts") {
        files.add(ending[0], [&](const Sink& sink) { write_liggghts_spheres(set, body, sink); });
        files.add_text(ending[1], liggghts_text(body, set.size(), fix_id(files.name("")),
                                                files.name(ending[0])));
    }
    if (format == "chrono") {
        files.add(ending[0], [&](const Sink& sink) { write_chrono_spheres(set, body, sink); });
        files.add_text(ending[1],
                       rigid_body_text(body, files.name(ending[0]),
                                       "origin at centroid_m, axes turned by the quaternion into "
                                       "those of the mesh",
                                       set.size()));
    }
}

}  // namespace

std::vector<std::string> export_formats() {
    std::vector<std::string> names;
    for (const Format& format : formats_known()) names.push_back(format.name);
    return names;
}

std::vector<std::filesystem::path> export_files(const std::vector<std::string>& formats,
                                                const std::filesystem::path& base) {
    std::vector<std::filesystem::path> files;
    for (const std::string& format : std::set(formats.begin(), formats.end()))
        for (const std::string& ending : endings_of(format))
            files.emplace_back(base.string() + ending);
    return files;
}

bool has_mass(const std::string& format) { return format != "csv" && format != "vtp"; }

void check_exports(const SphereSet& set, const std::vector<std::string>& formats,
                   const std::filesystem::path& base) {
    // All formats are checked before one is written: a refusal leaves no file behind.
    const std::string name = base.filename().string();
    const bool plain = std::none_of(name.begin(), name.end(), [](char c) {
        return c == '"' || c == '\\' || static_cast<unsigned char>(c) < ' ';
    });
    for (const std::string& format : formats) {
        if (set.dimension == 2 && has_mass(format))
            throw bad_input("--export " + format,
                            "describes a rigid body in 3D, and a 2D set has its mass and inertia "
                            "per metre of breadth",
                            "leave out --slice, or export csv or vtp");
        if (has_mass(format) && !plain)
            throw bad_input("--export " + format,
                            "would name the file " + name +
                                " in a script, where quotes, backslashes and control characters "
                                "cannot stand",
                            "give a plain file name by --output");
        if (format == "liggghts" && set.size() < 2)
            throw bad_input("--export liggghts", "needs two spheres or more, and the set has one",
                            "choose a smaller --radius");
    }
}

std::vector<std::filesystem::path> write_exports(const SphereSet& set,
                                                 const std::vector<std::string>& formats,
                                                 double density,
                                                 const std::filesystem::path& base) {
    // one body for all formats: they differ in frame and order of numbers only
    const RigidBody body = rigid_body(set.solid, density);
    OutputFiles files(base);
    std::set<std::string> done;
    for (const std::string& format : formats)
        // a format given twice is written once
        if (done.insert(format).second) add_format(files, format, set, body);
    return files.keep();
}

}  // namespace ice
