# ice_unite(TARGET [APART source...]): with ICE_UNITED_SOURCES=ON a folder's small sources compile
# together, some 30 kB at a time: headers are read, and what they instantiate is compiled, once for
# several files; of tests likewise. Alone remain kernels (SIMD twins include themselves), sources of
# other folders, and APART: sources that import a whole namespace, whose class has members of types
# of its own, or that listen to Catch. Names in anonymous namespaces must differ within a folder;
# the compiler says where they do not.
#
# `./bootstrap.sh` switches it on for all its commands, so that its tests see what its users
# compile. Off in a build by hand: a change costs one file there, ccache shares it, and the compiler
# shows missing includes. 174 s for the demo's programs on two cores without ccache.
option(ICE_UNITED_SOURCES
  "Compile small sources of a folder together (needs precompiled headers)" OFF)
set(most_bytes 30000)

function(ice_unite target)
  if(NOT precompile OR NOT ICE_UNITED_SOURCES)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "APART")
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "(_simd|_reference)\\.cpp$|^/|^\\.\\./")
  list(REMOVE_ITEM sources ${arg_APART})
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    if(NOT DEFINED number_${folder})
      set(number_${folder} 1)
      set(bytes_${folder} 0)
    endif()
    file(SIZE ${CMAKE_CURRENT_SOURCE_DIR}/${source} bytes)
    math(EXPR bytes_${folder} "${bytes_${folder}} + ${bytes}")
    if(bytes_${folder} GREATER most_bytes)
      math(EXPR number_${folder} "${number_${folder}} + 1")
      set(bytes_${folder} ${bytes})
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${number_${folder}})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
