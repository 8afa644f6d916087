// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/mesh_bytes.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace ice {

namespace {

// One list of the fields for both directions, so that they cannot differ: `io` appends or takes.
template <class Io, class Imported>
void each_field(Io& io, Imported& imported) {
    io.array(imported.mesh.vertices);
    io.array(imported.mesh.triangles);
    io.array(imported.mesh.region);
    io.texts(imported.mesh.region_names);
    io.text(imported.frame.format);
    io.value(imported.frame.metres);
    io.value(imported.frame.up);
    io.value(imported.frame.front);
    io.value(imported.frame.left_handed);
}

struct Appender {
    std::string out;

    void raw(const void* from, std::size_t size) {
        out.append(static_cast<const char*>(from), size);
    }
    template <class T>
    void value(const T& x) {
        static_assert(std::is_trivially_copyable_v<T>);
        raw(&x, sizeof x);
    }
    template <class T>
    void array(const T& all) {
        value(all.size());
        raw(all.data(), all.size() * sizeof all[0]);
    }
    void text(const std::string& x) { array(x); }
    void texts(const std::vector<std::string>& all) {
        value(all.size());
        for (const std::string& x : all) text(x);
    }
};

struct Taker {
    std::string_view rest;

    void raw(void* to, std::size_t size) {
        if (size > rest.size()) throw std::runtime_error("a mesh of the child process ends early");
        if (size > 0) std::memcpy(to, rest.data(), size);
        rest.remove_prefix(size);
    }
    template <class T>
    void value(T& x) {
        raw(&x, sizeof x);
    }
    template <class T>
    void array(T& all) {
        std::size_t count = 0;
        value(count);
        // before memory is taken for them
        if (count > rest.size() / sizeof all[0])
            throw std::runtime_error("a mesh of the child process ends early");
        all.resize(count);
        raw(all.data(), count * sizeof all[0]);
    }
    void text(std::string& x) { array(x); }
    void texts(std::vector<std::string>& all) {
        std::size_t count = 0;
        value(count);
        all.clear();
        for (std::size_t k = 0; k < count; ++k) text(all.emplace_back());
    }
};

}  // namespace

std::string to_bytes(const ImportedMesh& imported) {
    Appender io;
    each_field(io, imported);
    return std::move(io.out);
}

ImportedMesh from_bytes(std::string_view bytes) {
    Taker io{bytes};
    ImportedMesh imported;
    each_field(io, imported);
    return imported;
}

}  // namespace ice
