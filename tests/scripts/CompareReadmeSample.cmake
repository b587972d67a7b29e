# SPDX-License-Identifier: Apache-2.0
# The program in README.md is samples/hello/main.cpp, character for character.
#   cmake -D ROOT=<repository> -P CompareReadmeSample.cmake
cmake_minimum_required(VERSION 3.25)
file(READ ${ROOT}/README.md readme)
file(READ ${ROOT}/samples/hello/main.cpp sample)
string(FIND "${readme}" "```cpp\n${sample}```" place)
if(place EQUAL -1)
    message(FATAL_ERROR "README.md differs from samples/hello/main.cpp: copy the file into its ```cpp block")
endif()
