// SPDX-License-Identifier: GPL-3.0-or-later
/// Which program made an output: every file the tools write carries these three.
#pragma once

namespace ice {

const char* version();     ///< release, "0.1.0"
const char* git_commit();  ///< commit the build came from, "-dirty" appended when it had changes
const char* compiler();    ///< name and version, "GNU 12.2.0"

}  // namespace ice
