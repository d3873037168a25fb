# Installs BUILD under a temporary prefix, builds the STRANGER's projects in C++ and C against it, and the program
# that the PAGE of documentation shows, and runs both.

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

# What users see of the library. Whoever adds to it, adds it here.
set(public capi.h error.h gap_fraction.h lamp_control.h material.h mesh.h quasimc.h result.h result_file.h run.h run_file.h run_spec.h scene.h series.h
           share.h source.h sums.h sun_shade.h version.h)
list(TRANSFORM public PREPEND quasimc/)
file(GLOB_RECURSE installed RELATIVE "${work}/moved/include" "${work}/moved/include/*")
list(SORT installed)
if(NOT installed STREQUAL public)
    message(FATAL_ERROR "installed headers: ${installed}\npublic headers: ${public}")
endif()

# code_block(<language> <text>): the first block of code in that language on the page.
function(code_block language result)
    file(READ "${PAGE}" page)
    string(FIND "${page}" "```${language}\n" begin)
    string(LENGTH "```${language}\n" head)
    math(EXPR begin "${begin} + ${head}")
    string(SUBSTRING "${page}" ${begin} -1 page)
    string(FIND "${page}" "```" end)
    string(SUBSTRING "${page}" 0 ${end} text)
    set(${result} "${text}" PARENT_SCOPE)
endfunction()
code_block(cmake project)
code_block(cpp program)
code_block(text printed)
file(WRITE "${work}/page/CMakeLists.txt" "${project}")
file(WRITE "${work}/page/leaves.cpp" "${program}")

run("${CMAKE_COMMAND}" -S "${STRANGER}" -B "${work}/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${work}/moved" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${work}/build")
run("${work}/build/stranger")
if(NOT output STREQUAL "${VERSION}\n")
    message(FATAL_ERROR "the stranger's program printed '${output}', not ${VERSION}")
endif()

# The shared library, for C alone.
run("${CMAKE_COMMAND}" -S "${STRANGER}_c" -B "${work}/build_c" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${work}/moved" -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${work}/build_c")
run("${work}/build_c/stranger")
if(NOT output STREQUAL "${VERSION}\n")
    message(FATAL_ERROR "the stranger's program in C printed '${output}', not ${VERSION}")
endif()

run("${CMAKE_COMMAND}" -S "${work}/page" -B "${work}/page/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${work}/moved" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
run("${CMAKE_COMMAND}" --build "${work}/page/build")
run("${CMAKE_COMMAND}" -E chdir "${work}/page" "${work}/page/build/leaves")
if(NOT output STREQUAL printed)
    message(FATAL_ERROR "the program of ${PAGE} printed '${output}', not '${printed}'")
endif()

if(EXISTS "${work}/moved/bin/quasimc")
    run("${work}/moved/bin/quasimc" --version)
    if(NOT output MATCHES "${VERSION}")
        message(FATAL_ERROR "the installed program printed '${output}', not ${VERSION}")
    endif()
    run("${work}/moved/bin/MonteCarlo" --version)
    if(NOT output MATCHES "${VERSION}")
        message(FATAL_ERROR "the installed MonteCarlo printed '${output}', not ${VERSION}")
    endif()
endif()
