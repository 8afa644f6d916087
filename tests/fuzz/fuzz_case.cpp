// SPDX-License-Identifier: GPL-3.0-or-later
// A case file and one override behind a zero byte. What is accepted must be accepted again in the
// form that the run folder keeps, and give the same.
#include "common/base/error.hpp"
#include "solver/case/read_case.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace ice;

namespace {

const fuzz::InputFolder& folder() {
    static const fuzz::InputFolder made;
    // files that a case may name must exist; what is in them is another target's matter
    static const bool filled = [] {
        for (const char* name : {"hull.h5", "floe.h5", "field.h5", "flow.h5"}) made.write(name, "");
        return true;
    }();
    (void)filled;
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto [text, change] = fuzz::split<2>(data, size);
    Case once;
    try {
        std::vector<std::string> overrides;
        if (!change.empty()) overrides.emplace_back(change);
        once = read_case(folder().write("case.cfg", text), overrides);
    } catch (const Error&) {
        return 0;
    }
    const Case twice = read_case(folder().write("resolved.cfg", once.resolved));
    if (twice.resolved != once.resolved)
        fuzz::report_finding("the resolved case changes when it is read again");
    return 0;
}
