// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/split_sweep.hpp"

#include "common/base/assert.hpp"
#include "postprocess/sweep/choose_axes.hpp"

namespace ice::sweep {

namespace {

// 0: unknown
int dimension_of_run(const SweepRun& run) {
    if (run.summary) return run.summary->dimension;
    const std::string text = run.text("simulation.dimension");
    return text == "2" ? 2 : text == "3" ? 3 : 0;
}

}  // namespace

int dimension_of(const Sweep& sweep) {
    ICE_ASSERT(split_sweep(sweep).size() <= 1);
    for (const SweepRun& run : sweep.runs)
        if (const int dimension = dimension_of_run(run)) return dimension;
    return 3;
}

std::vector<Sweep> split_sweep(const Sweep& sweep) {
    std::vector<Sweep> parts;
    for (const int dimension : {3, 2}) {
        Sweep part = sweep;
        std::erase_if(part.runs,
                      [&](const SweepRun& run) { return dimension_of_run(run) != dimension; });
        if (!part.runs.empty()) parts.push_back(std::move(part));
    }
    if (parts.size() < 2) return {sweep};
    // runs that failed before they had a dimension are listed with the first part
    for (const SweepRun& run : sweep.runs)
        if (dimension_of_run(run) == 0) parts.front().runs.push_back(run);
    parts.back().warnings.clear();
    for (Sweep& part : parts) choose_axes(part, part.planned);
    return parts;
}

}  // namespace ice::sweep
