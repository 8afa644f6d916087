// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/write/write_spheres.hpp"
#include "solver/step/step.hpp"
#include <CLI/CLI.hpp>
