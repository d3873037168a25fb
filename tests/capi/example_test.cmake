# Builds the example of a LANGUAGE (c, fortran or r) by its TOOL, against the shared library in the folder LIBRARY, runs
# it, and compares what it prints with docs/guide/libraries.md.

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(examples "${SOURCE}/examples/06-c")
set(link "-L${LIBRARY}" -lquasimc "-Wl,-rpath,${LIBRARY}")

function(run)
    execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE status
                    OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        list(JOIN ARGV " " command)
        message(FATAL_ERROR "failed: ${command}\n${output}${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

if(LANGUAGE STREQUAL "c")
    run("${TOOL}" -std=c11 -Wall -Wextra -Wpedantic -Wstrict-prototypes -Werror "-I${SOURCE}/include"
        "${examples}/leaves.c" ${link} -o leaves)
    run(./leaves)
elseif(LANGUAGE STREQUAL "fortran")
    run("${TOOL}" -std=f2018 -Wall -Wextra -pedantic -Werror "${examples}/leaves.f90" ${link} -o leaves)
    run(./leaves)
else()
    list(JOIN link " " flags)
    file(COPY "${examples}/quasimc_r.c" DESTINATION "${WORK}")
    run("${CMAKE_COMMAND}" -E env "PKG_CPPFLAGS=-I${SOURCE}/include" "PKG_LIBS=${flags}" "${TOOL}" CMD SHLIB quasimc_r.c)
    run(Rscript --vanilla "${examples}/leaves.R" .)
endif()

file(READ "${SOURCE}/docs/guide/libraries.md" page)
string(REGEX MATCH "```text\n(lower leaf:[^`]*)```" block "${page}")
if(NOT output STREQUAL CMAKE_MATCH_1)
    message(FATAL_ERROR "the example printed\n${output}, not\n${CMAKE_MATCH_1}")
endif()
