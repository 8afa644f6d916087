// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/parallel.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

using namespace ice;

TEST_CASE("parallel_for calls every item once, for 0 to 1000 items and 1 to 4 threads", "[base]") {
    const std::size_t count = GENERATE(0u, 1u, 15u, 16u, 17u, 1000u);
    const int threads = GENERATE(1, 2, 4);
    const int before = thread_count();
    set_thread_count(threads);
    std::vector<int> calls(count, 0);
    parallel_for(count, 0, [&](std::size_t k) { ++calls[k]; });
    set_thread_count(before);
    CHECK(calls == std::vector<int>(count, 1));
}

TEST_CASE("the result has the same bits for 1, 2 and 4 threads", "[base]") {
    const int before = thread_count();
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        std::vector<double> out(5000);
        parallel_for(out.size(), 100,
                     [&](std::size_t k) { out[k] = std::sqrt(static_cast<double>(k)) / 3.0; });
        results.push_back(out);
    }
    set_thread_count(before);
    CHECK(results[0] == results[1]);
    CHECK(results[0] == results[2]);
}

TEST_CASE("a thread count of 0 changes nothing", "[base]") {
    const int before = thread_count();
    set_thread_count(0);
    CHECK(thread_count() == before);
}

TEST_CASE("of items that throw the first one's exception reaches the caller, with 1 to 4 threads",
          "[base]") {
    const int threads = GENERATE(1, 2, 4);
    const int before = thread_count();
    set_thread_count(threads);
    const auto fail = [](std::size_t k) {
        if (k % 100 == 37) throw std::runtime_error("item " + std::to_string(k));
    };
    CHECK_THROWS_WITH(parallel_for(1000, 0, fail), "item 37");
    CHECK_THROWS_WITH(parallel_tasks(1000, true, fail), "item 37");
    CHECK_THROWS_AS(parallel_for(1000, 0, [](std::size_t) { throw std::bad_alloc(); }),
                    std::bad_alloc);
    // and the next region runs as if nothing had been
    std::vector<int> calls(1000, 0);
    parallel_for(calls.size(), 0, [&](std::size_t k) { ++calls[k]; });
    CHECK(calls == std::vector<int>(1000, 1));
    set_thread_count(before);
}
