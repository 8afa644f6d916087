// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include "local.hpp"
#include "postprocess/read/read_run.hpp"
#include "solver/narrow/build_contacts.hpp"
