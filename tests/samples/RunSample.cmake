# SPDX-License-Identifier: Apache-2.0
# Runs a sample for each value of FOR, which replaces EACH among its arguments, and compares what it draws and prints with what
# is stored: docs/images/samples/*.png and tests/samples/NAME.txt. tests/samples/NAME.in, if it exists, is its standard input.
#   cmake -D NAME=triangle -D PROGRAM=<file> -D "ARGUMENTS=EACH;triangle.png" -D "FOR=vulkan;gles" -D IMGDIFF=<file>
#         -D ROOT=<repository> -D WORK=<scratch folder> -P RunSample.cmake
# With -D STORE=ON the results of the first run are stored instead; look at them before you commit them.
cmake_minimum_required(VERSION 3.25)

set(text_file ${ROOT}/tests/samples/${NAME}.txt)
set(input "")
if(EXISTS ${ROOT}/tests/samples/${NAME}.in)
    set(input INPUT_FILE ${ROOT}/tests/samples/${NAME}.in)
endif()

foreach(each IN LISTS FOR)
    set(folder ${WORK}/${each})
    file(REMOVE_RECURSE ${folder})
    file(MAKE_DIRECTORY ${folder})
    list(TRANSFORM ARGUMENTS REPLACE "^EACH$" ${each} OUTPUT_VARIABLE arguments)
    execute_process(COMMAND ${PROGRAM} ${arguments} ${input} WORKING_DIRECTORY ${folder}
        RESULT_VARIABLE status OUTPUT_VARIABLE printed ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${NAME} for ${each} ended with ${status}\n${printed}${errors}")
    endif()
    file(GLOB pictures RELATIVE ${folder} ${folder}/*.png)
    if(NOT pictures AND NOT EXISTS ${text_file})
        message(FATAL_ERROR "${NAME} for ${each} has drawn nothing")
    endif()
    if(STORE)
        foreach(picture IN LISTS pictures)
            file(COPY ${folder}/${picture} DESTINATION ${ROOT}/docs/images/samples)
        endforeach()
        if(EXISTS ${text_file})
            file(WRITE ${text_file} "${printed}")
        endif()
        return()
    endif()
    foreach(picture IN LISTS pictures)
        execute_process(COMMAND ${IMGDIFF} ${ROOT}/docs/images/samples/${picture} ${folder}/${picture}
            RESULT_VARIABLE status OUTPUT_VARIABLE difference ERROR_VARIABLE difference)
        if(NOT status EQUAL 0)
            message(FATAL_ERROR "${NAME} for ${each} does not draw docs/images/samples/${picture}: ${difference}")
        endif()
    endforeach()
    if(EXISTS ${text_file})
        file(READ ${text_file} expected)
        if(NOT printed STREQUAL expected)
            message(FATAL_ERROR "${NAME} for ${each} prints\n${printed}and not\n${expected}")
        endif()
    endif()
endforeach()
