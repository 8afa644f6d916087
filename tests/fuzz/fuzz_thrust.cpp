// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of thrust, or a ship's coefficients where the text names their table. An accepted curve is
// finite at every speed; accepted coefficients are the same when they are written and read again.
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/formulas/coefficients_file.hpp"
#include "postprocess/attain/read_thrusts.hpp"
#include "tests/fuzz/input_folder.hpp"

using namespace ice;

namespace {

void read_curves(const std::filesystem::path& file) {
    for (const attain::Thrust& thrust : attain::read_thrusts(file))
        for (const double speed : {0.0, 0.5, std::min(thrust.fastest(), 100.0)})
            if (!std::isfinite(thrust.at(speed))) fuzz::report_finding("a thrust is no number");
}

void read_ship(const std::filesystem::path& file, const fuzz::InputFolder& folder) {
    const SpencerCoefficients once = read_coefficients(file);
    CoefficientIntervals known;  // else the file leaves the breaking part out
    known.breaking = 0.0;
    const auto again =
        read_coefficients(folder.write("again.toml", coefficients_text(once, known, "")));
    if (again.name != once.name || again.buoyancy != once.buoyancy ||
        again.clearing != once.clearing || again.breaking != once.breaking)
        fuzz::report_finding("coefficients change when they are written and read again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const auto file = folder.write("input.toml", text);
        if (text.find("[spencer]") != std::string_view::npos)
            read_ship(file, folder);
        else
            read_curves(file);
    } catch (const Error&) {
        return 0;
    }
    return 0;
}
