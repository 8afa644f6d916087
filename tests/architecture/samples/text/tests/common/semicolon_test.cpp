// SPDX-License-Identifier: GPL-3.0-or-later
TEST_CASE(
    "one; two", "[common]") {}
