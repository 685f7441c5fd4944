# Builds all test programs before the tests start.
#
# deal.II's run_test.cmake marks a running test of its own program by the file interrupt_guard.cc, which it moves to
# interrupt_guard.cc_bck when the test has ended; one that lies there at the start means an interrupted test, to be built
# and run again. The guard is one of the program's sources: put it back while we build, and away again for run_test.cmake.
file(GLOB guards ${BUILD_DIR}/tests/*/*/interrupt_guard.cc)
foreach(guard ${guards})
  file(REMOVE ${guard} ${guard}_bck)
endforeach()

file(GLOB backups ${BUILD_DIR}/tests/*/*/interrupt_guard.cc_bck)
foreach(backup ${backups})
  string(REGEX REPLACE "_bck$" "" guard ${backup})
  file(RENAME ${backup} ${guard})
endforeach()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD_DIR} --target test_programs RESULT_VARIABLE result)

file(GLOB guards ${BUILD_DIR}/tests/*/*/interrupt_guard.cc)
foreach(guard ${guards})
  file(RENAME ${guard} ${guard}_bck)
endforeach()

if(NOT result EQUAL 0)
  message(FATAL_ERROR "The test programs do not compile.")
endif()
