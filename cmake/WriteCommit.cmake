# SPDX-License-Identifier: Apache-2.0
# cmake -D ROOT=DIR -D OUTPUT=FILE -P WriteCommit.cmake: writes a header with the commit that is being built. Runs in every
# build; the file changes only if the commit does.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${ROOT} describe --always --dirty --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
    set(commit unknown) # not a git checkout
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define FILAMENT_COMMIT \"@commit@\"\n" @ONLY)
