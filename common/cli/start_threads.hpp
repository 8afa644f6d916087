// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace ice {

/// Starts all threads that parallel loops will use (set_thread_count), which then wait for work:
/// OpenMP itself ends a program in the middle of it where a thread cannot start.
///
/// With more than one thread the program may begin anew here, with the same words and
/// OMP_WAIT_POLICY=passive in its environment (start_threads.cpp says why). To be called before
/// anything is read, printed or written.
/// @throws std::system_error when there is no room for the threads
void start_threads();

}  // namespace ice
