# Installs BUILD under a temporary prefix, builds the STRANGER's project against it and runs it.

set(work "${BUILD}/tests/install/work")
file(REMOVE_RECURSE "${work}")

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
                    ERROR_VARIABLE output)
    if(NOT status EQUAL 0)
        list(JOIN ARGV " " command)
        message(FATAL_ERROR "failed: ${command}\n${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --config "${CONFIG}" --prefix "${work}/prefix")

# The package must not lean on the place it was built from.
file(MAKE_DIRECTORY "${work}")
file(RENAME "${work}/prefix" "${work}/moved")

run("${CMAKE_COMMAND}" -S "${STRANGER}" -B "${work}/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${work}/moved" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${work}/build")
run("${work}/build/stranger")
if(NOT output STREQUAL "${VERSION}\n")
    message(FATAL_ERROR "the stranger's program printed '${output}', not ${VERSION}")
endif()

if(EXISTS "${work}/moved/bin/quasimc")
    run("${work}/moved/bin/quasimc" --version)
    if(NOT output MATCHES "${VERSION}")
        message(FATAL_ERROR "the installed program printed '${output}', not ${VERSION}")
    endif()
endif()
