// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "common/base/instruction_set.hpp"

namespace ice::test {

/// Calls check() on every instruction set that this machine has, then goes back to the best.
template <class Check>
void on_every_instruction_set(const Check& check) {
    int checked = 0;
    for (const char* name : {"scalar", "sse4", "avx2", "avx512"}) {
        try {
            set_instruction_set(name);
        } catch (const Error&) {
            continue;  // not on this machine
        }
        CAPTURE(name);
        check();
        ++checked;
    }
    set_instruction_set("auto");
    REQUIRE(checked > 0);
}

}  // namespace ice::test
