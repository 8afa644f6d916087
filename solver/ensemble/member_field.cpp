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
        // the same --set again, and the member's seed last: the later one counts
        if (!line.starts_with(kOverride)) continue;
        words.push_back("--set");
        words.push_back(line.substr(kOverride.size()));
    }
    words.insert(words.end(), {"--seed", std::to_string(seed)});
    return words;
}

// Are shapes and poses the same? A grid without random parts ignores the seed.
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

constexpr int kNoProgram = -1;

std::string reason(int code) {
    return code == kNoProgram ? std::string("icefield does not lie beside icesolve")
                              : fmt::format("icefield ended with code {}", code);
}

}  // namespace

MemberFields::MemberFields(const Case& parameters, std::int64_t first, const fs::path& folder) {
    for (std::size_t k = 0; k < parameters.floes.size(); ++k) {
        // unbroken parts come from the same file as their group
        const FloeGroup& of_case = parameters.floes[k];
        if (of_case.pattern != Pattern::file || of_case.unbroken_part) continue;
        const Group group{k + 1, of_case.file, folder / fmt::format("group-{}", k + 1),
                          read_field(of_case.file).specification};
        if (!group.specification.empty() && changes_with_seed(group, first))
            groups_.push_back(group);
    }
}

fs::path MemberFields::file_of(const Group& group, std::int64_t seed) const {
    return fs::absolute(fmt::format("{}-seed-{}.h5", group.stem.string(), seed));
}

// @return 0, or icefield's exit code
int MemberFields::make(const Group& group, std::int64_t seed) {
    const fs::path out = file_of(group, seed), spec = group.stem.string() + ".toml";
    // made already for changes_with_seed()
    if (made_.contains(out)) return 0;
    std::error_code ignored;
    fs::create_directories(group.stem.parent_path(), ignored);
    write_text_file(spec, group.specification);
    const int code = run_sibling("icefield", icefield_words(group.specification, seed, spec, out))
                         .value_or(kNoProgram);
    if (code == 0) made_.insert(out);
    return code;
}

bool MemberFields::changes_with_seed(const Group& group, std::int64_t first) {
    // Two seeds are tried out: whether a specification has anything random is known to icefield
    // alone. The fields are those of the first two members, so nothing is made in vain.
    for (const std::int64_t seed : {first, first + 1}) {
        const int code = make(group, seed);
        if (code == 0) continue;
        if (!interrupted())
            say_warning(
                fmt::format("{}: no field was made with seed {}: {}; all members have the "
                            "same field, its floes moved by simulation.jitter",
                            group.file.string(), seed, reason(code)));
        return false;
    }
    // Two seeds with the same floes: the seed changes nothing, and jitter must make the difference.
    // Compared as fields, not as files, which hold seed and command.
    const fs::path one = file_of(group, first), other = file_of(group, first + 1);
    if (!same_floes(read_field(one), read_field(other))) return true;
    std::error_code ignored;
    for (const fs::path& made : {one, other}) fs::remove(made, ignored);
    return false;
}

std::vector<std::string> MemberFields::overrides(std::int64_t seed) {
    std::vector<std::string> out;
    for (const Group& group : groups_) {
        const int code = make(group, seed);
        if (interrupted()) return {};
        if (code != 0)
            throw run_failed(
                group.file.string(),
                fmt::format("gave no field for the member with seed {}: {}", seed, reason(code)),
                "choose seeds from another number on: --set simulation.seed=100");
        out.push_back(fmt::format("floes.{}.file={}", group.number, file_of(group, seed).string()));
    }
    return out;
}

}  // namespace ice
