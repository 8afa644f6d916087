# ice_precompile(TARGET [header]...): the headers that most files include, read once per target
# instead of once per file, which is two fifths of the processor time of a first build.
#
# Two builds make a header of their own where ccache cannot tell that they are the same, so that
# working copies would no longer share objects: a build with tests and with ccache goes without.
# It also shows every include that a file forgot and the precompiled headers hide.
set(default ON)
if(CCACHE AND ICE_TESTS)
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
