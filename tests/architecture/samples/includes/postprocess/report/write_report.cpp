// SPDX-License-Identifier: GPL-3.0-or-later
#include <zlib.h>
#include "postprocess/icepost.hpp"
