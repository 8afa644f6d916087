// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/refuse_other_format.hpp"

#include "common/base/error.hpp"
#include "common/toml/recognise_input.hpp"

namespace ice {

void refuse_other_format(const std::filesystem::path& path, const Hdf5File& file,
                         const std::string& wanted, const std::string& kind) {
    if (!file.has_attribute("/", "format")) return;
    const std::string format = file.read_text_attribute("/", "format");
    if (format == wanted) return;
    if (const auto other = recognise_format(path, format))
        throw bad_input(path.string(), "is " + other->what + ", not " + kind, other->remedy);
}

}  // namespace ice
