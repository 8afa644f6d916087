# Third-party libraries, all from Debian packages. Each is used behind one folder; the comment names
# it and tests/architecture/check_includes.cmake holds the project to it.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

find_package(Eigen3 3.4 CONFIG REQUIRED)         # everywhere: small vectors and matrices
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)     # common/base/parallel.hpp
set(HDF5_PREFER_PARALLEL FALSE)
find_package(HDF5 REQUIRED COMPONENTS C HL)      # common/formats; HL: dimension scales
find_package(nlohmann_json 3.11 CONFIG REQUIRED) # common/formats, toml, preprocess/field
find_package(fmt 9 CONFIG REQUIRED)              # everywhere: text
find_package(spdlog 1.10 CONFIG REQUIRED)        # common/cli
find_package(CLI11 2.1 CONFIG REQUIRED)          # common/cli and the five programs
find_package(assimp 5.2 CONFIG REQUIRED)         # preprocess/load
find_package(OpenSSL REQUIRED COMPONENTS Crypto) # preprocess/load: SHA-256
find_package(CGAL 5.5 CONFIG REQUIRED)           # preprocess/clean, repair, slice, field
find_package(Boost 1.74 REQUIRED)                # common/base/uncertainty: Student
find_package(ZLIB REQUIRED)                      # preprocess/load, postprocess/paraview
find_package(meshoptimizer 0.18 CONFIG REQUIRED) # postprocess/views, solver/flow: large hulls
find_library(POLYCLIPPING polyclipping REQUIRED) # level_ice, views; has no CMake configuration
find_package(tomlplusplus 3.3 CONFIG REQUIRED)   # common/toml, parts of postprocess
find_package(HWY 1.0 CONFIG REQUIRED)            # *_simd.cpp
