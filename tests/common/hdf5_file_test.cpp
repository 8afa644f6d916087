// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/hdf5_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>

#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;
using Mode = Hdf5File::Mode;

TEMPLATE_TEST_CASE("a [2,3] dataset and an appended [5,2] one come back as written", "[formats]",
                   double, float, std::int64_t, std::int32_t, std::uint8_t) {
    const TempFolder folder;
    const std::vector<TestType> values{1, 2, 3, 4, 5, std::numeric_limits<TestType>::max()};
    const std::vector<TestType> rows{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    {
        Hdf5File file(folder / "x.h5", Mode::create);
        file.create_group("/g");
        file.write("/g/whole", values.data(), {2, 3});
        file.write("/empty", std::vector<TestType>{});
        file.create_appendable<TestType>("/grows", {2}, 2);
        file.append("/grows", rows.data(), 3);
        file.append("/grows", rows.data(), 0);
        file.append("/grows", rows.data() + 6, 2);
        file.close();
    }
    const Hdf5File file(folder / "x.h5", Mode::read);
    CHECK(file.shape("/g/whole") == std::vector<std::uint64_t>{2, 3});
    CHECK(file.read<TestType>("/g/whole") == values);
    CHECK(file.read<TestType>("/empty").empty());
    CHECK(file.shape("/grows") == std::vector<std::uint64_t>{5, 2});
    CHECK(file.read<TestType>("/grows") == rows);
}

TEST_CASE("texts of 0, 3 and 100000 characters come back, UTF-8 included", "[formats]") {
    const TempFolder folder;
    const std::string text = GENERATE(std::string(), std::string("abc"), std::string(100000, 'x'),
                                      std::string("Møller, 0.5 m²"));
    {
        Hdf5File file(folder / "x.h5", Mode::create);
        file.write_attribute("/", "text", text);
        file.write_attribute("/", "count", std::int64_t{42});
        file.write_attribute("/", "matrix", {1, 2, 3, 4}, {2, 2});
        file.write_attribute("/", "scalar", {0.5}, {});
    }
    const Hdf5File file(folder / "x.h5", Mode::read);
    CHECK(file.read_text_attribute("/", "text") == text);
    CHECK(file.read_number_attribute("/", "count") == std::vector<double>{42});
    CHECK(file.read_number_attribute("/", "matrix") == std::vector<double>{1, 2, 3, 4});
    CHECK(file.read_number_attribute("/", "scalar") == std::vector<double>{0.5});
    CHECK_FALSE(file.has_attribute("/", "nothing"));
}

TEST_CASE("lists of 0 to 3 texts of different lengths come back", "[formats]") {
    const TempFolder folder;
    const std::vector<std::string> texts =
        GENERATE(std::vector<std::string>{}, std::vector<std::string>{""},
                 std::vector<std::string>{"bow", "", "stern"});
    {
        Hdf5File file(folder / "x.h5", Mode::create);
        file.write_strings("/names", texts);
    }
    CHECK(Hdf5File(folder / "x.h5", Mode::read).read_strings("/names") == texts);
}

TEST_CASE("rows of 0 floes can be appended: [2,0,3]", "[formats]") {
    const TempFolder folder;
    {
        Hdf5File file(folder / "x.h5", Mode::create);
        file.create_appendable<float>("/position", {0, 3}, 20);
        file.append<float>("/position", nullptr, 2);
    }
    const Hdf5File file(folder / "x.h5", Mode::read);
    CHECK(file.shape("/position") == std::vector<std::uint64_t>{2, 0, 3});
    CHECK(file.read<float>("/position").empty());
}

TEST_CASE("rows appended since the last flush do not count in the file on disk", "[formats]") {
    const TempFolder folder;
    const std::vector<double> rows(640, 1.5);
    const auto lengths = [&] {  // as a program finds them that was not told of the open file
        std::filesystem::copy_file(folder / "x.h5", folder / "copy.h5",
                                   std::filesystem::copy_options::overwrite_existing);
        const Hdf5File copy(folder / "copy.h5", Mode::read);
        return std::pair(copy.read<double>("/one").size(), copy.read<double>("/two").size());
    };
    Hdf5File file(folder / "x.h5", Mode::create_growing);
    for (const char* name : {"/one", "/two"}) file.create_appendable<double>(name, {}, 64);
    file.append("/one", rows.data(), 64);
    file.append("/two", rows.data(), 64);
    file.flush();
    CHECK(lengths() == std::pair<std::size_t, std::size_t>(64, 64));
    file.append("/one", rows.data(), 640);
    CHECK(lengths() == std::pair<std::size_t, std::size_t>(64, 64));
    file.append("/two", rows.data(), 640);
    file.flush();
    CHECK(lengths() == std::pair<std::size_t, std::size_t>(704, 704));
}

TEST_CASE("reading what is missing or of another kind names the file and the dataset",
          "[formats]") {
    const TempFolder folder;
    {
        Hdf5File file(folder / "x.h5", Mode::create);
        file.create_group("/group");
        file.write("/numbers", std::vector<double>{1.0});
        file.write_strings("/names", {"bow"});
        file.write_attribute("/", "text", "abc");
    }
    const Hdf5File file(folder / "x.h5", Mode::read);
    const auto text_of = [&](const auto& body) { return error_text(body); };
    CHECK_THAT(text_of([&] { file.read<double>("/no"); }),
               Catch::Contains("x.h5: /no: is missing"));
    CHECK_THAT(text_of([&] { file.read<double>("/no/where"); }), Catch::Contains("is missing"));
    CHECK_THAT(text_of([&] { file.read<double>("/group"); }), Catch::Contains("is not a dataset"));
    CHECK_THAT(text_of([&] { file.read<double>("/names"); }),
               Catch::Contains("/names: cannot be read as numbers"));
    CHECK_THAT(text_of([&] { file.read_strings("/numbers"); }),
               Catch::Contains("/numbers: is not a list of texts"));
    CHECK_THAT(text_of([&] { file.read_text_attribute("/", "no"); }),
               Catch::Contains("/ attribute no: is missing"));
    CHECK_THAT(text_of([&] { file.read_number_attribute("/", "text"); }),
               Catch::Contains("not a number"));
}

TEST_CASE("a folder that does not exist, a missing file and a text file are refused", "[formats]") {
    const TempFolder folder;
    write_bytes(folder / "x.txt", "no HDF5");
    CHECK_THAT(error_text([&] { Hdf5File(folder / "no/x.h5", Mode::create); }),
               Catch::Contains("cannot be created"));
    CHECK_THAT(error_text([&] { Hdf5File(folder / "x.h5", Mode::read); }),
               Catch::Contains("file not found"));
    CHECK_THAT(error_text([&] { Hdf5File(folder / "x.txt", Mode::read); }),
               Catch::Contains("is not an HDF5 file, or is truncated"));
}

TEST_CASE("9 million rows that all equal the chosen value are read back", "[formats]") {
    const TempFolder folder;
    constexpr std::uint64_t kRows = 9'000'000;  // 72 MB of doubles, none of them stored
    {
        Hdf5File file(folder / "x.h5", Mode::create);
        file.write_rows<double>("/radius", nullptr, {kRows}, 0, 0.1);
        file.close();
    }
    CHECK(std::filesystem::file_size(folder / "x.h5") < 100'000);
    const auto values = Hdf5File(folder / "x.h5", Mode::read).read<double>("/radius");
    REQUIRE(values.size() == kRows);
    CHECK(values.front() == 0.1);
    CHECK(values.back() == 0.1);
}
