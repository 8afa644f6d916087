# The architecture in one place: which folders there are, in data-flow order, and who may use what.
# Read by the check_*.cmake scripts; each takes -DROOT=<repository>.

# A file may include its own folder and the ones before it: of common/ and of its own tool, never of
# another tool. The last entry of a tool is its top folder with the main program.
set(order_common common/base common/toml common/geometry common/math common/formats common/formulas
  common/cli)
set(order_preprocess preprocess/load preprocess/clean preprocess/measure preprocess/repair
  preprocess/slice preprocess/fill preprocess/certify preprocess/field preprocess/write preprocess)
set(order_solver solver/case solver/shape solver/bending solver/level_ice solver/flow solver/water
  solver/scene solver/broad solver/narrow/feature solver/narrow/neighbours
  solver/narrow/manifold solver/narrow solver/contact solver/loads solver/integrate
  solver/ship solver/live_edge solver/record solver/step solver/run solver/draft
  solver/ensemble solver)
set(order_postprocess postprocess/read postprocess/views postprocess/statistics postprocess/report
  postprocess/sweep postprocess/fit postprocess/attain postprocess/sensitivity
  postprocess/paraview postprocess/check postprocess)
set(tools preprocess solver postprocess)

# One tool may look into another here alone: a folder and the header. Level ice is cut and filled
# while the solver runs.
set(bridges "solver/live_edge preprocess/field/fill_prism.hpp"
  "solver/live_edge preprocess/field/make_prism.hpp"
  "solver/live_edge preprocess/field/polygon_checks.hpp"
  "solver/live_edge preprocess/slice/convex_parts.hpp")

# Third-party headers and the files that may include them: pairs of regular expressions. Tests may
# include all of them but those whose home is in tests/: OpenVDB is no dependency of the project,
# only something bench_peers measures where it happens to be installed. So are Box2D, Bullet and
# ODE. fmt and Eigen are allowed everywhere: text and vectors have no folder of their own.
set(quarantine
  "<assimp/"         "^preprocess/load/"
  "<CGAL/"           "^preprocess/(clean|measure|repair|slice|field)/"
  "<toml"            "^(common/toml|postprocess/(check|sweep|sensitivity))/"
  "<(hdf5|H5)"       "^common/formats/"
  "<nlohmann/"       "^(common/(formats|toml)|preprocess/field|postprocess/report)/"
  "<boost/"          "^common/base/uncertainty\\.cpp$"
  "<hwy/"            "(_simd\\.cpp|_lanes-inl\\.hpp)$"
  "<omp\\.h>"        "^common/base/parallel\\.hpp$"
  "<spdlog/"         "^common/cli/"
  "<CLI/"            "^(common/cli/|(preprocess/(spherize|icefield)|\
solver/(icesolve(_options)?|iceflow)|postprocess/icepost(_options)?)\\.[ch]pp$)"
  "<meshoptimizer"   "^(postprocess/views|solver/flow)/"
  "<polyclipping/"   "^(postprocess/views|solver/level_ice)/"
  "<openssl/"        "^(preprocess/load|postprocess/report)/"
  "<pybind11/"       "^python/module/"
  "<(zlib|zconf)\\." "^(preprocess/load|postprocess/(paraview|report))/"
  "<(openvdb|tbb)/"  "^tests/bench/bench_peers\\.cpp$"
  "<box2d/"          "^tests/peers/"
  "<bt[A-Z]"         "^tests/(peers/|bench/icebench_bullet\\.cpp$)"
  "<ode/"            "^tests/bench/icebench_ode\\.cpp$"
  "<(fc3d|Friction|Numerics|NonSmooth|SolverOptions|SparseBlock)"
                     "^tests/siconos/siconos_solver\\.cpp$"
  "<catch2/"         "^tests/")

set(max_columns 100)
set(max_lines 500)
set(max_function 60)
set(many_lines 300) # listed, not refused

# Sources under ROOT relative to it, of the given kinds (hpp cpp py sh), without samples and builds.
function(find_sources out)
  set(found "")
  foreach(kind IN LISTS ARGN)
    foreach(folder IN ITEMS cases cmake common docs examples meshes packaging postprocess
        preprocess python solver tests validation workflow)
      file(GLOB_RECURSE part RELATIVE ${ROOT} ${ROOT}/${folder}/*.${kind})
      list(APPEND found ${part})
    endforeach()
    file(GLOB part RELATIVE ${ROOT} ${ROOT}/*.${kind})
    list(APPEND found ${part})
  endforeach()
  list(FILTER found EXCLUDE REGEX "^tests/architecture/samples/|/node_modules/")
  if(NOT found)
    message(FATAL_ERROR "no sources under ${ROOT}; give -DROOT=<repository>")
  endif()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# The lines of a file as a list. Characters that mean something in a CMake list become "_".
function(read_lines path out)
  file(READ ${ROOT}/${path} text)
  string(REGEX REPLACE "[][;\\]" "_" text "${text}")
  string(REGEX REPLACE "\n$" "" text "${text}")
  string(REPLACE "\n" ";" text "${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

# A fault is printed as one line that begins with "fault:" and makes the script fail at its end.
function(fault text)
  message(NOTICE "fault: ${text}")
  get_property(count GLOBAL PROPERTY faults)
  math(EXPR count "0${count} + 1")
  set_property(GLOBAL PROPERTY faults ${count})
endfunction()

function(finish what)
  get_property(count GLOBAL PROPERTY faults)
  if(count)
    message(FATAL_ERROR "${what}: ${count} faults")
  endif()
  message(STATUS "${what}: no faults")
endfunction()
