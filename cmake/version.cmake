# Version and commit, compiled into one source file and so into every output.
find_package(Git QUIET)
set(ICE_GIT_COMMIT "unknown")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE ICE_GIT_COMMIT
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT ICE_GIT_COMMIT)  # sources without a repository
    set(ICE_GIT_COMMIT "unknown")
  endif()
  # a commit or a checkout makes CMake run again, so that the name stays right
  if(EXISTS ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
      ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
  endif()
endif()
configure_file(${PROJECT_SOURCE_DIR}/common/base/version.cpp.in
  ${PROJECT_BINARY_DIR}/generated/version.cpp @ONLY)
