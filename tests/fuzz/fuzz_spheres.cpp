// SPDX-License-Identifier: GPL-3.0-or-later
// A sphere set or an ice field: HDF5 files. What is accepted must be accepted again once written.
#include "common/base/error.hpp"
#include "common/formats/field_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/library_faults.hpp"

using namespace ice;

namespace {

void read(const std::filesystem::path& file, std::string_view bytes,
          const fuzz::InputFolder& folder) {
    if (bytes.find("icesolve-field") != bytes.npos) {
        read_field(file);
        return;
    }
    const SphereSet set = read_spheres(file);
    const std::filesystem::path copy = folder.write("copy.h5", "");
    write_spheres(copy, set, {});
    if (read_spheres(copy).size() != set.size())
        fuzz::report_finding("the sphere set changes when it is written and read again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    int verdict = 0;
    try {
        read(folder.write("input.h5", bytes), bytes, folder);
    } catch (const Error& refusal) {
        verdict = fuzz::verdict(refusal);
    }
    fuzz::check_child_faults();
    return verdict;
}
