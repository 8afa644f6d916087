// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/build_contacts.hpp"
#include "postprocess/read/read_run.hpp"
#include "local.hpp"
#include <pybind11/pybind11.h>
