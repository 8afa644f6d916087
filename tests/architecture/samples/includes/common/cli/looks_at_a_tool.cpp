// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/case.hpp"
#include <CLI/CLI.hpp>
