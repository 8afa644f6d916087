// SPDX-License-Identifier: GPL-3.0-or-later
/// Common parts of Hdf5File's two sources; for hdf5_*.cpp alone, because it shows HDF5's types.
#pragma once

#include <hdf5.h>
#include <sys/mman.h>

#include <cstdint>
#include <new>
#include <vector>

namespace ice::detail {

/// HDF5 does not survive that memory runs out: it writes beyond the memory it got. So the memory
/// for a file's caches must be there before large calls. @throws std::bad_alloc
inline void require_memory() {
    // [bytes] six MiB: the library's caches of chunks and metadata for a few datasets. Less lets
    // HDF5 crash where memory is nearly out; more refuses small machines.
    constexpr std::size_t kEnough = 6 << 20;
    // Not from the heap: smaller blocks would cut up its rest, and each call would enlarge it.
    void* const block =
        mmap(nullptr, kEnough, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (block == MAP_FAILED) throw std::bad_alloc();
    munmap(block, kEnough);
}

/// Closes an HDF5 handle when the scope ends.
class Handle {
public:
    Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), closer_(closer) {}
    ~Handle() {
        if (id_ >= 0) closer_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

    /// Closes now. @return whether the data that waited for it were written
    bool close() {
        const hid_t id = id_;
        id_ = -1;
        return closer_(id) >= 0;
    }

private:
    hid_t id_;
    herr_t (*closer_)(hid_t);
};

inline std::vector<hsize_t> to_hsize(const std::vector<std::uint64_t>& shape) {
    return {shape.begin(), shape.end()};
}

}  // namespace ice::detail
