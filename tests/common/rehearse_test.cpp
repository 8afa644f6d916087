// SPDX-License-Identifier: GPL-3.0-or-later
// Reading that crashes, never ends or fills the memory is an error with a name, not the program's
// end.
#include "common/base/rehearse.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <new>
#include <stdexcept>

#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// Sanitizers have memory of their own, which no bound can be set on.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kBoundedMemory = false;
#elif defined(__has_feature)
constexpr bool kBoundedMemory =
    !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kBoundedMemory = true;
#endif

std::string refusal(const std::function<void()>& read, ReadBounds bounds = {}) {
    return error_text([&] { rehearse("hull.x", bounds, read); });
}

}  // namespace

TEST_CASE("reading that crashes is refused with the file's name", "[base][errors]") {
    CHECK_THAT(refusal([] { std::raise(SIGKILL); }), Catch::Contains("hull.x"));
    CHECK_THAT(refusal([] { std::raise(SIGSEGV); }),
               Catch::StartsWith("hull.x: crashes the library that reads it (signal 11)"));
    CHECK_THAT(refusal([] { std::abort(); }), Catch::Contains("(signal 6)"));
    CHECK_THAT(refusal([] { _exit(7); }), Catch::Contains("give up"));
}

TEST_CASE("reading that never ends is refused after its processor time", "[base][errors]") {
    ReadBounds bounds;
    bounds.seconds = 1.0;
    const auto endless = [] {
        for (volatile bool on = true; on;) {
        }
    };
    CHECK_THAT(refusal(endless, bounds),
               Catch::Contains("takes more than 1 s of processor time to read"));
}

TEST_CASE("reading that takes more memory than its bound is refused", "[base][errors]") {
    ReadBounds bounds;
    bounds.bytes = 100'000'000;
    const auto greedy = [](std::size_t bytes) {
        return [bytes] {
            const std::string filled(bytes, 'x');
            if (filled.back() != 'x') std::abort();
        };
    };
    CHECK(refusal(greedy(50'000'000), bounds).empty());
    if (kBoundedMemory)
        CHECK_THAT(refusal(greedy(200'000'000), bounds),
                   Catch::Contains("takes more than 100 MB of memory to read"));
    CHECK_THAT(refusal([] { throw std::bad_alloc(); }), Catch::Contains("MB of memory"));
}

TEST_CASE("an Error of reading comes through as it is, and what reading changes is lost",
          "[base]") {
    int number = 1;
    CHECK(refusal([&] { number = 2; }).empty());
    CHECK(number == 1);
    const Error thrown = run_failed("a", std::string(200'000, 'b'), "c");  // more than a pipe holds
    try {
        rehearse("hull.x", {}, [&] { throw thrown; });
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(std::string(error.what()) == thrown.what());
        CHECK(error.code() == ExitCode::failed);
    }
    // a fault of the program's own shows where a debugger finds it: in the caller
    CHECK(refusal([] { throw std::runtime_error("no"); }).empty());
}

TEST_CASE("a child process hands over what it read, byte for byte", "[base]") {
    std::string all(300'000, '\0');  // more than a pipe holds
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<char>(k * k >> 4);
    CHECK(read_in_child("hull.x", {}, [&] { return all; }) == all);
    CHECK(read_in_child("hull.x", {}, [] { return std::string(); }).empty());
    // nothing reads again in the caller, so a fault of the program's own comes through
    CHECK_THROWS_WITH(
        read_in_child("hull.x", {}, []() -> std::string { throw std::runtime_error("no"); }), "no");
}

TEST_CASE("memory that a library asks for in vain is refused even where it catches that",
          "[base][errors]") {
    ReadBounds bounds;
    bounds.bytes = 100'000'000;
    const auto swallow = [] {
        try {
            const std::string filled(200'000'000, 'x');
            if (filled.back() != 'x') std::abort();
        } catch (const std::bad_alloc&) {
            throw bad_input("a", "cannot be read", "c");
        }
    };
    if (kBoundedMemory)
        CHECK_THAT(refusal(swallow, bounds), Catch::Contains("takes more than 100 MB of memory"));
}

TEST_CASE("a rehearsal writes into no file", "[base][security]") {
    const TempFolder folder;
    const auto write = [&] { write_bytes(folder / "x", "text"); };
    CHECK_THAT(refusal(write), Catch::Contains("signal 25"));  // SIGXFSZ, file too large
    CHECK(read_bytes(folder / "x").empty());
}

TEST_CASE("the bounds grow with the file", "[base]") {
    CHECK(ReadBounds::for_size(0).seconds == 10.0);
    CHECK(ReadBounds::for_size(0).bytes == std::uint64_t{1} << 30);
    CHECK(ReadBounds::for_size(1'000'000).bytes == (std::uint64_t{1} << 30) + 64'000'000);
}
