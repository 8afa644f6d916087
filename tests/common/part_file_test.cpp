// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/part_file.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("a failed program leaves neither the part file nor the final one", "[base]") {
    const TempFolder folder;
    try {
        const PartFile part(folder / "x.csv");
        write_bytes(part.path(), "half");
        REQUIRE(folder.file_count() == 1);
        throw std::runtime_error("the disk is full");
    } catch (const std::runtime_error&) {
    }
    CHECK(folder.file_count() == 0);
}

TEST_CASE("a failed program leaves an older result untouched", "[base]") {
    const TempFolder folder;
    write_bytes(folder / "x.csv", "old");
    {
        const PartFile part(folder / "x.csv");
        write_bytes(part.path(), "half");
    }
    CHECK(read_bytes(folder / "x.csv") == "old");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("keep() gives the file its final name and replaces an older one", "[base]") {
    const TempFolder folder;
    write_bytes(folder / "x.csv", "old");
    PartFile part(folder / "x.csv");
    write_bytes(part.path(), "new");
    part.keep();
    CHECK(read_bytes(folder / "x.csv") == "new");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("writing a text into a folder that does not exist is an error naming the file",
          "[base]") {
    const TempFolder folder;
    const std::string text = error_text([&] { write_text_file(folder / "no/x.csv", "1"); });
    CHECK_THAT(text, Catch::Contains("no/x.csv: cannot be written"));
    write_text_file(folder / "x.csv", "1\n");
    CHECK(read_bytes(folder / "x.csv") == "1\n");
}

TEST_CASE("a folder or a device is no place for a file", "[base][errors]") {
    const TempFolder folder;
    CHECK_THAT(error_text([&] { PartFile(folder.path()); }), Catch::Contains(": is a folder\n"));
    CHECK_THAT(error_text([] { PartFile("/dev/null"); }),
               Catch::Contains("/dev/null: exists and is no file: it would be replaced"));
}

TEST_CASE("a program that ends without unwinding removes what is not finished, nothing else",
          "[base]") {
    const TempFolder folder;
    PartFile unfinished(folder / "a.csv"), finished(folder / "b.csv");
    write_bytes(unfinished.path(), "half");
    write_bytes(finished.path(), "whole");
    finished.keep();
    write_bytes(finished.path(), "of somebody else");  // the name is no longer this program's
    { const PartFile gone(folder / "c.csv"); }
    write_bytes(folder / "c.csv.part", "of somebody else");
    remove_part_files();
    CHECK_FALSE(std::filesystem::exists(unfinished.path()));
    CHECK(read_bytes(folder / "b.csv") == "whole");
    CHECK(folder.file_count() == 3);
}

TEST_CASE("a file that cannot be brought to the disk keeps its .part name", "[base]") {
    const TempFolder folder;
    CHECK(bring_to_disk(folder.path()));
    CHECK_FALSE(bring_to_disk(folder / "none"));
    const std::string text = error_text([&] { keep_file(folder / "none.part", folder / "none"); });
    CHECK_THAT(text, Catch::Contains("none: cannot be brought to the disk: No such file"));
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
}
