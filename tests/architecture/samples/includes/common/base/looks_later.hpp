// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/console.hpp"
#include <omp.h>
