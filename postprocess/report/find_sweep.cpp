// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/find_sweep.hpp"

namespace ice::report {

std::string find_sweep(const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    std::error_code ignored;  // a folder that cannot be read has no sweep
    // one or two folders up: a run of a sweep lies in the sweep's folder or in its folder "runs"
    for (const char* up : {"..", "../.."}) {
        const fs::path above = folder / up;
        for (const char* sign : {"sweep.html", "runs.toml"})
            if (fs::exists(above / sign, ignored)) return std::string(up) + "/sweep.html";
    }
    return "";
}

}  // namespace ice::report
