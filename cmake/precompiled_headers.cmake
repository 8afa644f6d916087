# ice_precompile(TARGET): the headers that most files include, read once for all targets instead of
# once per file, which is two fifths of the processor time of a first build.
# ice_precompile_with(TARGET HEADER...): the same with further headers, read for this target alone.
# CLI11 is not among them: its objects would be compiled again in each file.
#
# A build with tests by hand goes without: it shows every include that a file forgot and the
# precompiled headers hide, and working copies share its objects through ccache, which they cannot
# do where each makes a precompiled header of its own. `./bootstrap.sh test` goes with them.
set(default ON)
if(ICE_TESTS)
  set(default OFF)
endif()
set(ICE_PRECOMPILED_HEADERS AUTO CACHE STRING "Read common headers once: ON, OFF or AUTO")
set_property(CACHE ICE_PRECOMPILED_HEADERS PROPERTY STRINGS ON OFF AUTO)
if(NOT ICE_PRECOMPILED_HEADERS STREQUAL "AUTO")
  set(default ${ICE_PRECOMPILED_HEADERS})
endif()
set(precompile ${default})

if(precompile AND CCACHE)  # which needs to be told that time stamps in headers do not matter
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

set(common_headers
  <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
  <numeric> <optional> <set> <span> <string> <string_view> <vector>
  <fmt/format.h> <Eigen/Geometry>)
if(precompile)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/common_headers.cpp CONTENT "")
  add_library(ice_headers OBJECT ${PROJECT_BINARY_DIR}/generated/common_headers.cpp)
  target_link_libraries(ice_headers PRIVATE ice_flags OpenMP::OpenMP_CXX)
  target_precompile_headers(ice_headers PRIVATE ${common_headers})
  # g++ collects its garbage when it holds 0.5 GB, not 0.1: a tenth less processor time
  target_compile_options(ice_flags INTERFACE
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=500000>>)
endif()

function(ice_precompile target)
  if(precompile)
    target_precompile_headers(${target} REUSE_FROM ice_headers)
  endif()
endfunction()

function(ice_precompile_with target)
  if(precompile)
    target_precompile_headers(${target} PRIVATE ${common_headers} ${ARGN})
  endif()
endfunction()
