// SPDX-License-Identifier: GPL-3.0-or-later
// A flow around a hull: an HDF5 file. What is accepted can be written and read again.
#include "common/base/error.hpp"
#include "common/formats/flow_file.hpp"
#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/library_faults.hpp"

using namespace ice;

namespace {

void read(const std::filesystem::path& file, const fuzz::InputFolder& folder) {
    const FlowTable table = read_flow(file);
    const std::filesystem::path copy = folder.write("copy.h5", "");
    write_flow(copy, table);
    const FlowTable again = read_flow(copy);
    if (again.velocity != table.velocity || again.nodes != table.nodes)
        fuzz::report_finding("the flow changes when it is written and read again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFolder folder;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    int verdict = 0;
    try {
        read(folder.write("input.h5", bytes), folder);
    } catch (const Error& refusal) {
        verdict = fuzz::verdict(refusal);
    }
    fuzz::check_child_faults();
    return verdict;
}
