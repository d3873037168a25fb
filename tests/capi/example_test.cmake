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
    # The package, of a copy, for R compiles beside the sources; with an installed library.
    file(COPY "${SOURCE}/r" DESTINATION "${WORK}")
    file(COPY "${SOURCE}/include" DESTINATION "${WORK}/prefix")
    file(CREATE_LINK "${LIBRARY}" "${WORK}/prefix/lib" SYMBOLIC)
    file(MAKE_DIRECTORY "${WORK}/library")
    set(environment "${CMAKE_COMMAND}" -E env "QUASIMC_PREFIX=${WORK}/prefix" "R_LIBS=${WORK}/library")
    run(${environment} "${TOOL}" CMD INSTALL --no-docs "--library=${WORK}/library" r)
    run(${environment} Rscript --vanilla "${SOURCE}/r/tests/light.R")
    run(${environment} Rscript --vanilla "${examples}/leaves.R")
endif()

file(READ "${SOURCE}/docs/guide/libraries.md" page)
string(REGEX MATCH "```text\n(lower leaf:[^`]*)```" block "${page}")
if(NOT output STREQUAL CMAKE_MATCH_1)
    message(FATAL_ERROR "the example printed\n${output}, not\n${CMAKE_MATCH_1}")
endif()
