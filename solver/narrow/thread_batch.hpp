// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace ice {

/// Each call of a finder has its own number, from 1, so that a thread drops the results of older
/// calls.
inline std::uint64_t next_call() {
    static std::atomic<std::uint64_t> calls{0};
    return ++calls;
}

/// Results of this thread in this call; their memory is kept. Stored by thread: lists by pair would
/// all grow to the largest pair's size. @param call  of next_call() @tparam Batch  has forget()
template <class Batch>
Batch& batch_of(std::uint64_t call) {
    thread_local std::uint64_t filled_in = 0;
    thread_local Batch batch;
    if (filled_in != call) batch.forget();
    filled_in = call;
    return batch;
}

}  // namespace ice
