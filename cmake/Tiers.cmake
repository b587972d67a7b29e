# SPDX-License-Identifier: Apache-2.0
# Two tiers: `ctest` by itself runs everything; `ctest -C fast -L fast`, which is ./check, runs what tests/tiers/fast.json lists. The
# target `fast_tests` builds what that needs. scripts/choose_tiers writes the list from measured data.
#   tests        run whole
#   cases        parts of test programs: <program>_fast runs these cases. ctest by itself does not run them twice.
#   conformance  cases of filament-conformance that together notice each defect that it injects
# Tests that need nothing that is built have the label `tree`.
set(fast_file ${CMAKE_CURRENT_SOURCE_DIR}/tiers/fast.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${fast_file})
file(READ ${fast_file} fast_json)
add_custom_target(fast_tests)

# Programs of tests that are not called <test>_tests.
set(FILAMENT_PROGRAMS_document_tables filament-tables)
set(FILAMENT_PROGRAMS_documents_code matc)
set(FILAMENT_PROGRAMS_exports filament_core)
set(FILAMENT_PROGRAMS_showcase filament-render)
set(FILAMENT_PROGRAMS_tools_numerics filament-numerics)
set(FILAMENT_PROGRAMS_tools_numerics_names_what_it_does_not_know filament-numerics)
set(FILAMENT_PROGRAMS_threading_bench_quick threading_bench)

# The elements of the array at a path of the list.
function(filament_fast_list result)
    set(found "")
    string(JSON count ERROR_VARIABLE error LENGTH "${fast_json}" ${ARGN})
    if(error)
        message(FATAL_ERROR "${fast_file}: ${error}")
    endif()
    if(count GREATER 0)
        math(EXPR last "${count} - 1")
        foreach(index RANGE ${last})
            string(JSON entry GET "${fast_json}" ${ARGN} ${index})
            list(APPEND found "${entry}")
        endforeach()
    endif()
    set(${result} "${found}" PARENT_SCOPE)
endfunction()

filament_fast_list(fast_names tests)
foreach(name IN LISTS fast_names)
    if(NOT TEST ${name})
        continue() # scripts/test_table finds names that no build has
    endif()
    set(labels fast)
    if(DEFINED FILAMENT_PROGRAMS_${name})
        add_dependencies(fast_tests ${FILAMENT_PROGRAMS_${name}})
    elseif(TARGET ${name}_tests)
        add_dependencies(fast_tests ${name}_tests)
    else()
        list(APPEND labels tree)
    endif()
    set_property(TEST ${name} APPEND PROPERTY LABELS ${labels})
endforeach()

# Much of it is the first time, when pipelines are compiled.
set(fast_timeout 1800)
if(FILAMENT_SANITIZE)
    set(fast_timeout 7200)
endif()

string(JSON fast_count LENGTH "${fast_json}" cases)
if(fast_count GREATER 0)
    math(EXPR last "${fast_count} - 1")
    foreach(index RANGE ${last})
        string(JSON name MEMBER "${fast_json}" cases ${index})
        if(TARGET ${name}_tests)
            filament_fast_list(cases cases ${name})
            list(JOIN cases ":" filter)
            add_test(NAME ${name}_fast COMMAND ${name}_tests --gtest_filter=${filter} CONFIGURATIONS fast)
            set_tests_properties(${name}_fast PROPERTIES LABELS fast ENVIRONMENT ${FILAMENT_DEVICE_ENVIRONMENT}
                TIMEOUT ${fast_timeout})
            add_dependencies(fast_tests ${name}_tests)
        endif()
    endforeach()
endif()

filament_fast_list(cases conformance)
if(cases)
    set(compared --threads off)
    if(FILAMENT_SANITIZE STREQUAL thread) # draws with several numbers of workers instead of defects
        set(compared --threads on --mutations off)
    endif()
    add_test(NAME conformance_fast COMMAND filament-conformance ${compared} --cases ${cases}
        --out ${CMAKE_BINARY_DIR}/conformance-fast CONFIGURATIONS fast)
    set_tests_properties(conformance_fast PROPERTIES LABELS "gpu;fast" ENVIRONMENT ${FILAMENT_DEVICE_ENVIRONMENT}
        COST 100 TIMEOUT ${fast_timeout})
    add_dependencies(fast_tests filament-conformance)
endif()

# What runs under the thread sanitizer, `ctest -C fast -L threads` and the target `thread_tests`: programs that start threads
# of this engine, and storms that were written for it. The others of the fast tier have one thread, or those of Mesa.
add_custom_target(thread_tests)
set(thread_tests backend_create backend_layers backend_stream base faults filament_core_passes_devices
    filament_core_prepare framegraph jobsystem)
set_property(TEST ${thread_tests} APPEND PROPERTY LABELS threads)
list(TRANSFORM thread_tests APPEND _tests)
add_dependencies(thread_tests ${thread_tests})
if(cases)
    set_property(TEST conformance_fast APPEND PROPERTY LABELS threads)
    add_dependencies(thread_tests filament-conformance)
endif()
