# Script (cmake -P): writes HEADER from VERSION and the commit of SOURCE_DIR.
execute_process(COMMAND git --no-optional-locks -C "${SOURCE_DIR}" describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE git_hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(git_hash "unknown")  # a source archive without history
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[
#pragma once
#define BARCHAN_VERSION "@VERSION@"
#define BARCHAN_GIT_HASH "@git_hash@"
]])
