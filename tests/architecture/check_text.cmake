# Every source names its licence in the first line (after #!), no work is left behind in words, and
# ctest can run every test by its name.
#   cmake -DROOT=<repository> -P tests/architecture/check_text.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/rules.cmake)

find_sources(sources hpp cpp cpp.in py sh js mjs)
foreach(source IN LISTS sources)
  # ctest would take such a name for two tests, neither of which exists, and call both passed
  file(READ ${ROOT}/${source} text)
  if(text MATCHES "TEST_CASE\\([ \n]*\"[^\"]*;")
    fault("${source} has a test with a semicolon in its name")
  endif()
  read_lines(${source} lines)
  list(POP_FRONT lines first)
  if(first MATCHES "^#!")
    list(POP_FRONT lines first)
  endif()
  if(NOT first MATCHES "^(//|#) SPDX-License-Identifier: GPL-3\\.0-or-later$")
    fault("${source} does not begin with its SPDX line")
  endif()

  foreach(line IN LISTS lines)
    if(line MATCHES "(TODO|FIXME|XXX|HACK)")
      set(word ${CMAKE_MATCH_1})
      if(NOT line MATCHES "${word}\\(#[0-9]+\\)")
        fault("${source} says ${word} without an issue, as in ${word}(#12)")
      endif()
    endif()
  endforeach()
endforeach()
finish("text")
