// SPDX-License-Identifier: GPL-3.0-or-later
#include <hwy/highway.h>
#include <toml++/toml.h>
#include <spdlog/spdlog.h>
