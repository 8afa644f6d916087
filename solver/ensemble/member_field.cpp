// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ensemble/member_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/cli/console.hpp"
#include "common/cli/sibling_program.hpp"
#include "common/formats/field_file.hpp"

namespace ice {

namespace {

namespace fs = std::filesystem;

// icefield appends its overrides to the specification that it stores, a comment each.
constexpr std::string_view kOverride = "# --set ";

std::vector<std::string> icefield_words(const std::string& specification, std::int64_t seed,
                                        const fs::path& spec, const fs::path& out) {
    std::vector<std::string> words{"-q", spec.string(), "-o", out.string()};
    std::istringstream lines(specification);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(kOverride)) continue;
        words.push_back("--set");
        words.push_back(line.substr(kOverride.size()));
    }
    words.insert(words.end(), {"--seed", std::to_string(seed)});
    return words;
}

bool same_floes(const Field& a, const Field& b) {
    return std::equal(a.floes.begin(), a.floes.end(), b.floes.begin(), b.floes.end(),
                      [](const FieldFloe& f, const FieldFloe& g) {
                          return f.shape == g.shape && f.position == g.position &&
                                 f.orientation.coeffs() == g.orientation.coeffs();
                      }) &&
           a.shapes.size() == b.shapes.size() &&
           std::equal(
               a.shapes.begin(), a.shapes.end(), b.shapes.begin(),
               [](const SphereSet& s, const SphereSet& t) { return s.centers == t.centers; });
}

// The new field's file, or "" where there is none to be had.
fs::path make_field_again(const fs::path& file, std::int64_t seed, const fs::path& stem) {
    const Field old = read_field(file);
    if (old.specification.empty()) return {};
    std::error_code ignored;
    fs::create_directories(stem.parent_path(), ignored);
    const fs::path spec = stem.string() + ".toml";
    const fs::path out = fs::absolute(fmt::format("{}-seed-{}.h5", stem.string(), seed));
    write_text_file(spec, old.specification);
    const auto code = run_sibling("icefield", icefield_words(old.specification, seed, spec, out));
    if (code != 0) {
        say_warning(fmt::format(
            "{}: {}; its floes are moved by simulation.jitter instead", file.string(),
            code ? fmt::format("icefield made no other field with seed {} (code {})", seed, *code)
                 : std::string("icefield does not lie beside icesolve")));
        return {};
    }
    if (!same_floes(old, read_field(out)) || seed == old.seed) return out;
    fs::remove(out, ignored);
    return {};
}

}  // namespace

std::vector<std::string> make_member_fields(const Case& parameters, std::int64_t seed,
                                            const fs::path& folder) {
    std::vector<std::string> overrides;
    for (std::size_t k = 0; k < parameters.floes.size(); ++k) {
        const FloeGroup& group = parameters.floes[k];
        if (group.pattern != Pattern::file || group.unbroken_part) continue;
        const fs::path made =
            make_field_again(group.file, seed, folder / fmt::format("group-{}", k + 1));
        if (!made.empty())
            overrides.push_back(fmt::format("floes.{}.file={}", k + 1, made.string()));
    }
    return overrides;
}

}  // namespace ice
