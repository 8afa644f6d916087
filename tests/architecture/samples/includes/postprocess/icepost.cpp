// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/check/check_run.hpp"
#include <nlohmann/json.hpp>
#include <zlib.h>
#include <catch2/catch.hpp>
