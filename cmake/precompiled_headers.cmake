# ice_precompile(TARGET [header]...): the headers that most files include, read once per target
# instead of once per file, which is two fifths of the processor time of a first build.
#
# A build with tests goes without: it shows every include that a file forgot and the precompiled
# headers hide, and working copies share its objects through ccache, which they cannot do where each
# makes a precompiled header of its own.
set(default ON)
if(ICE_TESTS)
  set(default OFF)
endif()
set(ICE_PRECOMPILED_HEADERS AUTO CACHE STRING "Read common headers once per target: ON, OFF or AUTO")
set_property(CACHE ICE_PRECOMPILED_HEADERS PROPERTY STRINGS ON OFF AUTO)
if(NOT ICE_PRECOMPILED_HEADERS STREQUAL "AUTO")
  set(default ${ICE_PRECOMPILED_HEADERS})
endif()
set(precompile ${default})

if(precompile AND CCACHE)  # which needs to be told that time stamps in headers do not matter
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

function(ice_precompile target)
  if(precompile)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
      <numeric> <optional> <set> <span> <string> <string_view> <vector>
      <fmt/format.h> <Eigen/Geometry> ${ARGN})
  endif()
endfunction()
