// SPDX-License-Identifier: GPL-3.0-or-later
// ICE_TEST_SIMD=scalar runs all tests of a program on that instruction set: each test case begins
// with it. A test that changes it goes back to the best of the machine, for its own rest only.
#define CATCH_CONFIG_EXTERNAL_INTERFACES  // listeners
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string_view>

#include "common/base/instruction_set.hpp"

namespace ice::test {

namespace {

std::string_view wanted() {
    const char* name = std::getenv("ICE_TEST_SIMD");
    return name == nullptr ? "" : name;
}

struct InstructionSetOfRun : Catch::TestEventListenerBase {
    using TestEventListenerBase::TestEventListenerBase;
    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        TestEventListenerBase::testCaseStarting(info);
        if (!wanted().empty()) set_instruction_set(wanted());
    }
};

CATCH_REGISTER_LISTENER(InstructionSetOfRun)

}  // namespace

TEST_CASE("a run has the instruction set that ICE_TEST_SIMD names", "[simd]") {
    if (!wanted().empty()) CHECK(instruction_set() == wanted());
}

}  // namespace ice::test
