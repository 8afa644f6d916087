// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/draft/new_case.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/cli/console.hpp"
#include "common/cli/output_files.hpp"
#include "common/cli/sibling_program.hpp"
#include "common/formats/hexagonal_layer.hpp"
#include "common/formats/spheres_file.hpp"
#include "common/formats/summary_file.hpp"
#include "common/toml/recognise_input.hpp"
#include "solver/draft/draft_case.hpp"

namespace ice {

namespace {

namespace fs = std::filesystem;

// Spheres on a hull, about [-]. More resolve finer ice and take longer to search; the user may make
// another set.
constexpr double kSpheres = 12000.0;
// Their distance in radii [-]: below 1.73 they cover the surface without gaps. Larger makes larger
// spheres, which resolve edges less well.
constexpr double kSpacing = 1.4;

void refuse_existing(const fs::path& file, const std::string& remedy) {
    if (fs::exists(file)) throw bad_input(file.string(), "exists already", remedy);
}

void require_file(const fs::path& file, const std::string& what) {
    if (!fs::is_regular_file(file))
        throw bad_input(file.string(), what + " not found", "check the path");
}

// A specification in the hull's place, or a mesh in the field's.
void refuse_swapped(const NewCase& wish) {
    const bool hull = wish.hull.extension() == ".toml";
    const bool field = !wish.field.empty() && recognise_file(wish.field, "");
    if (!hull && !field) return;
    const fs::path& wrong = hull ? wish.hull : wish.field;
    throw bad_input(wrong.string(),
                    hull ? "is a text, no hull: the hull comes first, then the field"
                         : "is a mesh, no field: the hull comes first, then the field",
                    "icesolve --new HULL [FIELD]");
}

void require_program(const std::string& name) {
    if (!has_sibling(name))
        throw run_failed("--new", name + " does not lie beside icesolve",
                         "build it (./bootstrap.sh build), or make its file yourself");
}

void run_program_beside(const std::string& name, const std::vector<std::string>& words) {
    // exit code 2 is a fault of the user's file, which the program has named already
    const auto code = run_sibling(name, words);
    if (!code) throw run_failed("--new", "cannot start " + name, "make its file yourself");
    if (*code == 2) throw bad_input("--new", name + " refused its input", "see above");
    if (*code != 0)
        throw run_failed("--new", fmt::format("{} ended with code {}", name, *code), "see above");
}

// The mesh as spheres that some 12000 of cover it: the area decides.
fs::path make_spheres(const fs::path& mesh, const std::vector<std::string>& options,
                      const fs::path& folder) {
    fs::path out = folder / (mesh.stem().string() + ".spheres.h5");
    refuse_existing(out, "give it in place of the mesh, or remove it");
    const fs::path report = folder / (mesh.stem().string() + ".json.part");
    const auto spherize = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {mesh.string(), "-q"});
        words.insert(words.end(), options.begin(), options.end());
        run_program_beside("spherize", words);
    };
    // first the area alone: the spacing follows from it
    spherize({"--check", "--json", report.string()});
    const double area = read_json_numbers(report).at("area_m2");
    fs::remove(report);
    const double spacing =
        std::stod(fmt::format("{:.2g}", std::sqrt(kHexagonal * area / kSpheres)));
    spherize({"-r", fmt::format("{:.2g}", spacing / kSpacing), "-s", fmt::format("{:g}", spacing),
              "--mode", "surface", "-o", out.string()});
    say(fmt::format("wrote {}", out.string()));
    return out;
}

fs::path make_field_file(const fs::path& specification, const fs::path& folder) {
    fs::path out = folder / (specification.stem().string() + ".h5");
    refuse_existing(out, "give it in place of the specification, or remove it");
    run_program_beside("icefield", {specification.string(), "-q", "-o", out.string()});
    say(fmt::format("wrote {}", out.string()));
    return out;
}

// By the hull's box: length and breadth set the size of field and floes.
fs::path make_specification(const fs::path& hull, const fs::path& folder) {
    fs::path out = folder / "ice.toml";
    refuse_existing(out, "give it behind the hull, or remove it");
    Eigen::AlignedBox3d box;
    for (const Vec3& v : read_spheres(hull).mesh.vertices) box.extend(v);
    write_text_file(out, draft_field(box.sizes().x(), box.sizes().y()));
    say(fmt::format("wrote {}", out.string()));
    return out;
}

// A file as a case in `folder` names it.
std::string seen_from(const fs::path& folder, const fs::path& file) {
    return fs::absolute(file).lexically_normal().lexically_relative(folder).string();
}

// A mean over less than a ship length has not seen the ship's whole side pass. Before one length in
// the ice floes do not lie along all of it, and the resistance still rises. A little less than one:
// the field's ends are not used to the last metre.
void warn_of_short_field(const Draft& draft) {
    if (draft.averaged_lengths >= 0.95 && draft.settled_lengths >= 0.95) return;
    say_warning(fmt::format(
        "the field is short: forces are averaged over {:.2f} ship lengths, from {:.2f} in the ice "
        "on; area.size of {:.3g} m along x makes both one or more",
        draft.averaged_lengths, draft.settled_lengths, kFieldLengths * draft.length));
}

}  // namespace

fs::path write_new_case(const NewCase& wish) {
    require_file(wish.hull, "hull");
    if (!wish.field.empty()) require_file(wish.field, "field");
    refuse_swapped(wish);
    const bool is_set = wish.hull.extension() == ".h5";
    if (is_set && !wish.mesh_options.empty())
        throw bad_input(wish.mesh_options[0],
                        "says how to read a mesh, but " + wish.hull.string() + " is a sphere set",
                        "leave it out, or give the mesh");
    // "hull.spheres.h5" becomes "hull.cfg"
    std::string stem = wish.hull.stem().string();
    if (stem.ends_with(".spheres")) stem.resize(stem.size() - sizeof(".spheres") + 1);
    fs::path out = wish.out.empty() ? fs::path(stem + ".cfg") : wish.out;
    refuse_existing(out, "give another name with -o, or remove it");
    OutputFiles().add("-o", out);
    const fs::path folder = fs::absolute(out).lexically_normal().parent_path();

    // before the first file is made
    if (!is_set) require_program("spherize");
    if (wish.field.empty() || wish.field.extension() == ".toml") require_program("icefield");
    const fs::path hull = is_set ? wish.hull : make_spheres(wish.hull, wish.mesh_options, folder);
    fs::path field = wish.field.empty() ? make_specification(hull, folder) : wish.field;
    if (field.extension() == ".toml") field = make_field_file(field, folder);
    const Draft draft = draft_case(hull, field);
    write_text_file(out, draft_text(draft, seen_from(folder, hull), seen_from(folder, field)));
    warn_of_short_field(draft);
    return out;
}

}  // namespace ice
