# ice_flags: what every target of the project is compiled with.
#
# -ffp-contract=off: without it g++ fuses a*b + c where the machine can, so that results would
# differ between instruction sets. CGAL's own -frounding-math stays with the targets that link CGAL.
# -fPIC -fvisibility=hidden: the same libraries serve the programs and the Python module; hidden
# names are inlined and called as in a program.
add_library(ice_flags INTERFACE)
# Programs that use the installed libraries choose their own warnings.
set(own_options -ffp-contract=off -fPIC -fvisibility=hidden -Wall -Wextra -Wpedantic -Wshadow
  -Wconversion -Wno-sign-conversion $<$<CXX_COMPILER_ID:Clang>:-Wno-missing-braces>
  $<$<BOOL:${ICE_WARNINGS_AS_ERRORS}>:-Werror>)
target_compile_options(ice_flags INTERFACE "$<BUILD_INTERFACE:${own_options}>")
target_compile_features(ice_flags INTERFACE cxx_std_20)
target_include_directories(ice_flags INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/icesolve>)
target_link_libraries(ice_flags INTERFACE Eigen3::Eigen fmt::fmt)

# Header-only third parties reach us as system headers: their warnings are not ours.
foreach(library IN ITEMS Eigen3::Eigen fmt::fmt spdlog::spdlog CLI11::CLI11
    nlohmann_json::nlohmann_json)
  if(TARGET ${library})
    get_target_property(folders ${library} INTERFACE_INCLUDE_DIRECTORIES)
    if(folders)
      set_target_properties(${library} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${folders}")
    endif()
  endif()
endforeach()

# ice_kernels(TARGET): its SIMD kernels are compiled for AVX-512, AVX2, SSE4 and one number at a
# time (common/base/instruction_set.hpp); Highway's further set, SSSE3, is that of processors before
# 2008.
function(ice_kernels target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "_simd\\.cpp$")
  set_source_files_properties(${sources} PROPERTIES
    COMPILE_DEFINITIONS HWY_DISABLED_TARGETS=HWY_SSSE3)
endfunction()
