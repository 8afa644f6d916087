// SPDX-License-Identifier: GPL-3.0-or-later
// A sphere set or an ice field: HDF5 files. What is accepted must be accepted again once written.
#include "common/base/error.hpp"
#include "common/formats/field_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/library_faults.hpp"

using namespace ice;

namespace {

template <class Read>
bool accepted(const Read& read) {
    try {
        read();
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::filesystem::path file = folder.write("input.h5", bytes);
    SphereSet set;
    const bool spheres = accepted([&] { set = read_spheres(file); });
    if (!spheres) (void)accepted([&] { read_field(file); });
    fuzz::check_child_faults();
    if (!spheres) return 0;
    const std::filesystem::path copy = folder.write("copy.h5", "");
    write_spheres(copy, set, {});
    if (read_spheres(copy).size() != set.size())
        fuzz::report_finding("the sphere set changes when it is written and read again");
    return 0;
}
