# Writes HEADER with the commit that SOURCE_DIR holds: a short hash, with "-dirty" if files differ from it, or "unknown".
# Nobody asks git where the sources are not the top of a repository: a tarball may be unpacked inside another one.
set(commit unknown)
execute_process(COMMAND git rev-parse --show-prefix
  WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE prefix RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(failed EQUAL 0 AND prefix STREQUAL "")
  execute_process(COMMAND git --no-optional-locks describe --always --dirty --exclude=*
    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE hash RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed EQUAL 0)
    set(commit ${hash})
  endif()
endif()

set(text "constexpr char commit[] = \"${commit}\";\n")
set(old "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} old)
endif()
if(NOT text STREQUAL old)
  file(WRITE ${HEADER} "${text}")
endif()
