# Makes the Debian packages of BUILD, unpacks them into an empty folder, and uses what is there: the program, the shared
# library from C, the Python package.

set(work "${BUILD}/tests/install/debian")
file(REMOVE_RECURSE "${work}")
file(MAKE_DIRECTORY "${work}/root")
set(usr "${work}/root/usr")

function(run)
    execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${work}" RESULT_VARIABLE status OUTPUT_VARIABLE output
                    ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        list(JOIN ARGV " " command)
        message(FATAL_ERROR "failed: ${command}\n${output}${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

run("${CMAKE_CPACK_COMMAND}" -G DEB --config "${BUILD}/CPackConfig.cmake" -B "${work}/packages")
file(GLOB packages "${work}/packages/*.deb")
set(names "")
foreach(package IN LISTS packages)
    run(dpkg-deb --field "${package}" Package Version)
    string(REGEX MATCH "Package: ([^\n]*)\nVersion: ${VERSION}\n" matched "${output}")
    set(name "${CMAKE_MATCH_1}")
    list(APPEND names "${name}")
    if(NETCDF AND name STREQUAL quasimc)
        run(dpkg-deb --field "${package}" Recommends)
        if(NOT output MATCHES "^libnetcdf[0-9]+\n")
            message(FATAL_ERROR "quasimc recommends '${output}', not the library that it loads")
        endif()
    endif()
    run(dpkg-deb --extract "${package}" "${work}/root")
    if(NOT EXISTS "${usr}/share/doc/${name}/copyright")
        message(FATAL_ERROR "${package} has no file of copyright")
    endif()
endforeach()
set(expected libquasimc-dev libquasimc2)
if(PROGRAM)
    list(APPEND expected quasimc)
endif()
if(PYTHON)
    list(APPEND expected python3-quasimc)
endif()
list(SORT names)
list(SORT expected)
if(NOT names STREQUAL expected)
    message(FATAL_ERROR "packages: ${names}, not ${expected}, of version ${VERSION}")
endif()

if(PROGRAM)
    run("${usr}/bin/quasimc" --version)
    if(NOT output MATCHES "${VERSION}")
        message(FATAL_ERROR "the program printed '${output}', not ${VERSION}")
    endif()
    file(COPY "${SOURCE}/examples/01-leaves" DESTINATION "${work}")
    run("${usr}/bin/quasimc" run -q --paths 64 01-leaves/leaves.toml)
    if(NOT EXISTS "${work}/01-leaves/leaves.csv")
        message(FATAL_ERROR "the program wrote no table")
    endif()
endif()

run("${COMPILER}" -x c++ -std=c++20 "-I${usr}/include" -include quasimc/quasimc.h -fsyntax-only
    "${SOURCE}/tests/install/stranger/main.cpp")
if(CC)
    run("${CC}" "-I${usr}/include" "${SOURCE}/examples/06-c/leaves.c" "-L${usr}/lib" -lquasimc
        "-Wl,-rpath,${usr}/lib" -o leaves)
    run(./leaves)
    if(NOT output MATCHES "lower leaf: [0-9.]+ W")
        message(FATAL_ERROR "the program in C printed '${output}'")
    endif()
endif()

if(PYTHON)
    set(script "import quasimc, quasimc.compat.caribu as caribu
scene = quasimc.Scene('PAR')
scene.add_material('leaf', reflectance=0.08, transmittance=0.06)
scene.add_mesh([[0, 0, 1], [0.1, 0, 1], [0, 0.1, 1]], [[0, 1, 2]], material='leaf')
light = scene.run(quasimc.sky(irradiance_horizontal=400), paths=64)['absorbed_flux']['PAR']
assert light.values[0] > 0
assert quasimc.__version__ == '${VERSION}', quasimc.__version__
assert quasimc.__file__.startswith('${usr}/'), quasimc.__file__
")
    run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${usr}/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 "${PYTHON}" -c
        "${script}")
endif()
