// SPDX-License-Identifier: GPL-3.0-or-later
// A step asks for no memory once it has met as much before.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>
#include <random>

#include "common/base/parallel.hpp"
#include "solver/scene/build_scene.hpp"
#include "solver/step/step.hpp"
#include "tests/support/make_worlds.hpp"

namespace {

std::atomic<long> allocations{0};

void* allocate(std::size_t size, std::size_t alignment) {
    ++allocations;
    void* memory = nullptr;
    if (posix_memalign(&memory, alignment, size) != 0) throw std::bad_alloc();
    return memory;
}

}  // namespace

// every `new` of this test program is counted
void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

using namespace ice;

TEST_CASE("a step that has seen as much before allocates nothing", "[step][allocation]") {
    const NormalRule rule = GENERATE(NormalRule::centres, NormalRule::surface);
    Case p = test::empty_space(0.01);
    p.normal = rule;
    p.contact.crushing_pressure = GENERATE(1e5, std::numeric_limits<double>::infinity());
    World w = test::plate_world(p, Vec3(4, 2, 0.6), 0.1, 0.15, -0.3);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int k = 0; k < 40; ++k) {
        const Vec3 at(3.0 * unit(random), 2.0 * unit(random), 1.0 * unit(random));
        const Quaternion q(unit(random), unit(random), unit(random), unit(random));
        const std::size_t floe = add_floe(w.scene, box, 900.0, at, q.normalized(), 0, k % 4 == 0);
        if (!w.scene.bodies.held[floe])
            w.scene.bodies.momentum[floe] = 50.0 * Vec3(unit(random), unit(random), unit(random));
    }
    set_thread_count(1);  // which thread takes which pair is not the same twice
    const World start = w;
    std::size_t contacts = 0;
    long before = 0;
    // the first rounds find out how much memory is needed; pairs are within
    // their clearance in other steps then
    for (int round = 0; round < 10; ++round) {
        w.scene = start.scene;
        before = allocations;
        contacts = 0;
        for (int k = 0; k < 60; ++k) {
            step(w);
            contacts += w.contacts.size();
        }
    }
    CHECK(contacts > 1000);
    CHECK(allocations - before == 0);
}
