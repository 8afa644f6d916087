// SPDX-License-Identifier: GPL-3.0-or-later
/// OpenMP behind a few functions; no other file includes or uses it.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

#include "common/base/assert.hpp"

namespace ice {

/// Number of threads used by parallel_for from now on; 0 leaves OpenMP's own choice.
inline void set_thread_count(int threads) {
    omp_set_dynamic(0);
    if (threads > 0) omp_set_num_threads(threads);
}

/// Threads of the next parallel region, at least 1.
inline int thread_count() { return omp_get_max_threads(); }

/// One T for each thread, such as its results or its work memory. They last until this object ends,
/// and the calling thread may read all of them between parallel regions.
template <class T>
class PerThread {
public:
    /// Makes room for the threads of the next parallel region. The T that are there stay.
    void prepare() {
        const auto threads = static_cast<std::size_t>(thread_count());
        if (slots_.size() < threads) slots_.resize(threads);
    }
    /// The calling thread's. @pre prepare() since the last set_thread_count()
    T& own() {
        const auto thread = static_cast<std::size_t>(omp_get_thread_num());
        ICE_ASSERT(thread < slots_.size());
        return slots_[thread].value;
    }
    /// Calls visit(T&) for every thread's.
    template <class Visit>
    void for_each(const Visit& visit) {
        for (Slot& slot : slots_) visit(slot.value);
    }

private:
    // a cache line of its own [bytes]: threads that write side by side would else wait for each
    // other
    struct alignas(64) Slot {
        T value;
    };
    std::vector<Slot> slots_;
};

/// Takes exceptions out of a parallel region, which none may leave by itself: of those thrown the
/// one with the lowest index, so that the caller sees the same whatever the number of threads.
class FirstException {
public:
    template <class Body>
    void call(const Body& body, std::size_t k) noexcept {
        try {
            body(k);
        } catch (...) {
            const std::lock_guard<std::mutex> lock(mutex_);
            if (thrown_ && index_ <= k) return;
            thrown_ = std::current_exception();
            index_ = k;
        }
    }
    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

private:
    std::mutex mutex_;
    std::exception_ptr thrown_;
    std::size_t index_ = 0;
};

/// Calls body(k) for k in [0, count), in chunks shared among the threads.
///
/// body(k) may write only the data of k: then the result has the same bits for any thread
/// count. Below `serial_below` items it runs on the calling thread, because waking threads costs
/// more than the work (about 5 us).
/// @throws the exception of body, of several items that of the first of them; others may have run
template <class Body>
void parallel_for(std::size_t count, std::size_t serial_below, const Body& body) {
    if (count < serial_below || omp_get_max_threads() == 1) {
        for (std::size_t k = 0; k < count; ++k) body(k);
        return;
    }
    // several pieces for each thread, as items may differ, but not so many that handing out counts
    const int piece = static_cast<int>(
        std::clamp<std::size_t>(count / (64 * std::size_t(omp_get_max_threads())), 4, 256));
    FirstException first;
#pragma omp parallel for schedule(dynamic, piece)
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(count); ++k)
        first.call(body, static_cast<std::size_t>(k));
    first.rethrow();
}

/// Calls body(k) for k in [0, count) for few, long tasks, handed out one by one; on the calling
/// thread where all of them together are not `worth` waking the others. The same rules.
template <class Body>
void parallel_tasks(std::size_t count, bool worth, const Body& body) {
    if (!worth || count < 2 || omp_get_max_threads() == 1) {
        for (std::size_t k = 0; k < count; ++k) body(k);
        return;
    }
    FirstException first;
#pragma omp parallel for schedule(dynamic, 1)
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(count); ++k)
        first.call(body, static_cast<std::size_t>(k));
    first.rethrow();
}

}  // namespace ice
