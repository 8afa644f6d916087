// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/sealed_file.hpp"

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"
#include "common/formats/seal.hpp"

namespace ice {

namespace {
constexpr const char* kSealed = "sealed";
}  // namespace

void write_sealed(const std::filesystem::path& path, const std::function<void(Hdf5File&)>& fill) {
    // The attribute first, inside the hashed bytes: a file whose seal was cut off is still known as
    // one that must have a seal.
    PartFile part(path);
    Hdf5File file(part.path(), Hdf5File::Mode::create);
    file.write_attribute("/", kSealed, std::int64_t{1});
    fill(file);
    file.close();
    add_seal(part.path());
    part.keep();
}

void refuse_changed(const std::filesystem::path& path, const Hdf5File& file,
                    const std::string& maker) {
    if (!file.has_attribute("/", kSealed) || has_right_seal(path)) return;
    throw bad_input(path.string(), "is damaged, or was changed after " + maker + " wrote it",
                    "make it again with " + maker + ", or delete its attribute `sealed`");
}

}  // namespace ice
