# A check that cannot fail proves nothing: run it on a sample that breaks its rules.
#   cmake -DCHECK=<script> -DSAMPLE=<folder> -DWORK=<folder to write> -P check_rejects.cmake
# The faults it reports must be exactly the lines of SAMPLE/expected.txt, in any order.
cmake_minimum_required(VERSION 3.25)

# a copy, in which one file gets 501 lines, and functions of another one 60 and 61 with signature
# and closing brace: too long by one, and too dull to keep
file(REMOVE_RECURSE ${WORK})
file(COPY ${SAMPLE}/ DESTINATION ${WORK})
if(EXISTS ${WORK}/solver/step/too_long.cpp)
  string(REPEAT "// one more line\n" 500 rest)
  file(APPEND ${WORK}/solver/step/too_long.cpp "${rest}")
  file(READ ${WORK}/solver/step/long_functions.cpp text)
  string(REPEAT "  // one more line\n" 58 rest)
  string(REPLACE "  // 58 more lines\n" "${rest}" text "${text}")
  file(WRITE ${WORK}/solver/step/long_functions.cpp "${text}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECK}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
string(REGEX MATCHALL "fault: [^\n]*" got "${output}")
list(TRANSFORM got REPLACE "^fault: " "")
file(STRINGS ${SAMPLE}/expected.txt expected)
list(SORT got)
list(SORT expected)
if(status EQUAL 0)
  message(FATAL_ERROR "${CHECK} accepts ${SAMPLE}")
elseif(NOT got STREQUAL expected)
  list(JOIN got "\n  " got)
  list(JOIN expected "\n  " expected)
  message(FATAL_ERROR "expected faults\n  ${expected}\ngot\n  ${got}\nall output\n${output}")
endif()
list(LENGTH expected count)
message(STATUS "rejected as expected, with ${count} faults")
