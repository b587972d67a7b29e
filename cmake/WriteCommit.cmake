# SPDX-License-Identifier: Apache-2.0
# cmake -D ROOT=DIR -D OUTPUT=FILE -P WriteCommit.cmake: a header with the commit that is being built. Run by every build;
# the file is only touched when the commit changes.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${ROOT} describe --always --dirty --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
    set(commit unknown) # not a git checkout
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define FILAMENT_COMMIT \"@commit@\"\n" @ONLY)
