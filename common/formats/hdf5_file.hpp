// SPDX-License-Identifier: GPL-3.0-or-later
/// HDF5 in terms of std::vector and std::string; the only header through which HDF5 is reached.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace ice {

/// An open HDF5 file; closed by the destructor. Failures throw Error naming file and dataset.
///
/// Element types T: double, float, std::int64_t, std::int32_t, std::uint8_t. Shapes are row-major;
/// the first dimension of an appendable dataset grows. Files use library bounds (earliest, v1.10)
/// so that a file flushed before a crash can be opened. Links, data in other files and filters from
/// plugins are refused: a file speaks for itself alone.
class Hdf5File {
public:
    /// create_growing: for rows that are appended while a program runs, which may be killed; up to
    /// 256 kB larger.
    enum class Mode { read, create, create_growing };
    /// @throws Error (exit code 2): missing or no HDF5 file; (1): it cannot be created
    Hdf5File(const std::filesystem::path& path, Mode mode);
    ~Hdf5File();
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;

    // attributes of an object ("/" for the file)
    void write_attribute(const std::string& object, const std::string& name,
                         const std::string& text);
    void write_attribute(const std::string& object, const std::string& name,
                         const std::vector<double>& values,
                         const std::vector<std::uint64_t>& shape);
    void write_attribute(const std::string& object, const std::string& name, std::int64_t value);
    std::string read_text_attribute(const std::string& object, const std::string& name) const;
    std::vector<double> read_number_attribute(const std::string& object,
                                              const std::string& name) const;
    bool has_attribute(const std::string& object, const std::string& name) const;

    // groups and whole datasets
    void create_group(const std::string& name);
    bool has(const std::string& name) const;
    template <class T>
    void write(const std::string& name, const T* data, const std::vector<std::uint64_t>& shape);
    template <class T>
    void write(const std::string& name, const std::vector<T>& data) {
        write(name, data.data(), {data.size()});
    }
    /// A dataset of `shape` with its first `count` rows written; the others read as `rest`
    /// and take no space.
    template <class T>
    void write_rows(const std::string& name, const T* rows, const std::vector<std::uint64_t>& shape,
                    std::uint64_t count, T rest);
    void write_strings(const std::string& name, const std::vector<std::string>& texts);
    template <class T>
    std::vector<T> read(const std::string& name) const;
    /// Rows [first, first + count) of a dataset. @pre it has them
    template <class T>
    std::vector<T> read_rows(const std::string& name, std::uint64_t first,
                             std::uint64_t count) const;
    std::vector<std::string> read_strings(const std::string& name) const;
    std::vector<std::uint64_t> shape(const std::string& name) const;

    // Datasets that grow along their first dimension; `row_shape` is the shape of one row. Who
    // opens the file meanwhile, or after a kill, finds the rows of the last flush().
    template <class T>
    void create_appendable(const std::string& name, const std::vector<std::uint64_t>& row_shape,
                           std::uint64_t rows_per_chunk);
    template <class T>
    void append(const std::string& name, const T* rows, std::uint64_t count);

    // dimension scales make the file readable for xarray: label every dimension or none
    void make_scale(const std::string& name);
    void attach_scale(const std::string& dataset, unsigned dimension, const std::string& scale);

    /// After flush(), the data so far survive a crash of the program.
    void flush();
    /// Closes now and reports failure (the destructor cannot).
    void close();

    /// From now on no more is read than 128 MiB and `times` the file's size [-]; a dataset that
    /// claims more is refused before memory is taken for it. 2000 unless set: twice the best that
    /// compression can do.
    void limit_reading(std::uint64_t times) const;

private:
    std::string describe(const std::string& object) const;
    void take_from_limit(const std::string& name, std::uint64_t count, std::uint64_t width) const;
    std::int64_t open_dataset(const std::string& name) const;
    std::filesystem::path path_;
    std::int64_t id_ = -1;
    mutable std::uint64_t left_ = std::numeric_limits<std::uint64_t>::max();  // bytes to read
};

}  // namespace ice
