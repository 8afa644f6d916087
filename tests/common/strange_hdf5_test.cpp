// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 files that are correct but want more than a file of numbers should: other files, memory.
#include <hdf5.h>

#include <catch2/catch.hpp>

#include "common/formats/field_file.hpp"
#include "common/formats/hdf5_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A file with what `fill` puts into it.
template <class Fill>
void make_file(const std::filesystem::path& path, const Fill& fill) {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    fill(file);
    H5Fclose(file);
}

// A dataset /x of doubles that nothing is written to.
void add_dataset(hid_t file, const std::vector<hsize_t>& shape, hid_t properties) {
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    H5Dclose(H5Dcreate2(file, "x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Sclose(space);
    H5Pclose(properties);
}

std::string refusal(const std::filesystem::path& path) {
    return error_text([&] { Hdf5File(path, Hdf5File::Mode::read).read<double>("/x"); });
}

}  // namespace

TEST_CASE("a dataset that is a link to another file or place is refused", "[formats][security]") {
    const TempFolder folder;
    make_file(folder / "other.h5",
              [](hid_t file) { add_dataset(file, {3}, H5Pcreate(H5P_DATASET_CREATE)); });
    make_file(folder / "external.h5", [](hid_t file) {
        H5Lcreate_external("other.h5", "/x", file, "x", H5P_DEFAULT, H5P_DEFAULT);
    });
    make_file(folder / "soft.h5",
              [](hid_t file) { H5Lcreate_soft("/x/x/x", file, "x", H5P_DEFAULT, H5P_DEFAULT); });
    CHECK(refusal(folder / "other.h5").empty());
    for (const char* name : {"external.h5", "soft.h5"})
        CHECK_THAT(refusal(folder / name), Catch::Contains("/x: is a link to somewhere else"));
}

TEST_CASE("a dataset whose values are in another file is refused", "[formats][security]") {
    const TempFolder folder;
    write_bytes(folder / "secret", std::string(24, 's'));
    make_file(folder / "external.h5", [&](hid_t file) {
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_external(properties, (folder / "secret").c_str(), 0, 24);
        add_dataset(file, {3}, properties);
    });
    make_file(folder / "virtual.h5", [](hid_t file) {
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        const hsize_t three = 3;
        const hid_t space = H5Screate_simple(1, &three, nullptr);
        H5Pset_virtual(properties, space, "other.h5", "/x", space);
        H5Sclose(space);
        add_dataset(file, {3}, properties);
    });
    for (const char* name : {"external.h5", "virtual.h5"})
        CHECK_THAT(refusal(folder / name), Catch::Contains("/x: has its values in another file"));
}

TEST_CASE("a dataset that claims more than its file can hold takes no memory",
          "[formats][security]") {
    const TempFolder folder;
    // 2^62 x 8 values wrap round to none in 64 bits
    for (const std::vector<hsize_t>& shape : {std::vector<hsize_t>{1u << 30},
                                              {hsize_t{1} << 40},
                                              {hsize_t{1} << 31, hsize_t{1} << 33}}) {
        make_file(folder / "large.h5", [&](hid_t file) {
            const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
            const std::vector<hsize_t> chunk(shape.size(), 1);
            H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
            add_dataset(file, shape, properties);
        });
        CHECK_THAT(refusal(folder / "large.h5"),
                   Catch::Contains("/x: claims more values than the file holds"));
    }
}

TEST_CASE("what is read from a file in total is bounded", "[formats][security]") {
    const TempFolder folder;
    {
        Hdf5File file(folder / "x.h5", Hdf5File::Mode::create);
        file.write_rows<double>("/x", nullptr, {10'000'000}, 0, 0.1);  // 80 MB, none of them stored
        file.close();
    }
    const Hdf5File file(folder / "x.h5", Hdf5File::Mode::read);
    file.limit_reading(1);
    CHECK(file.read<double>("/x").size() == 10'000'000);
    CHECK_THAT(error_text([&] { file.read<double>("/x"); }),
               Catch::Contains("claims more values than the file holds"));
}

TEST_CASE("files on which HDF5 crashes or never ends are refused", "[formats][security]") {
    const std::filesystem::path corpus = ICE_SOURCE_DIR "/tests/fuzz/corpus/spheres";
    for (const char* name : {"hdf5-abort", "hdf5-crash", "hdf5-endless"}) {
        CAPTURE(name);
        CHECK_THAT(error_text([&] { read_spheres(corpus / name); }), Catch::Contains(name));
    }
    for (const char* name : {"conforming", "lattice", "section"})
        CHECK(read_spheres(corpus / name).size() > 0);
    CHECK(read_field(corpus / "field").floes.size() > 2);
}
