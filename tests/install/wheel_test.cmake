# Makes the wheel of SOURCE with the packages of the system, without an index, installs it into an empty folder, and
# computes the light on a leaf from there.

set(work "${BUILD}/tests/install/wheel")
file(REMOVE_RECURSE "${work}")
file(MAKE_DIRECTORY "${work}")

function(run)
    execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${work}" RESULT_VARIABLE status OUTPUT_VARIABLE output
                    ERROR_VARIABLE errors)
    if(NOT status EQUAL 0)
        list(JOIN ARGV " " command)
        message(FATAL_ERROR "failed: ${command}\n${output}${errors}")
    endif()
endfunction()

execute_process(COMMAND "${PYTHON}" -m pip --version RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(NOT status EQUAL 0)
    message(STATUS "pip is not installed")
    return()
endif()

# Of a copy: setuptools writes beside what it builds.
file(COPY "${SOURCE}/" DESTINATION "${work}/source" PATTERN build EXCLUDE PATTERN .git EXCLUDE PATTERN __pycache__ EXCLUDE)
run("${PYTHON}" -m pip wheel --no-deps --no-build-isolation --no-index --wheel-dir "${work}/wheels" "${work}/source")
file(GLOB wheel "${work}/wheels/quasimc-${VERSION}-*.whl")
run("${PYTHON}" -m pip install --no-deps --no-index --target "${work}/site" "${wheel}")
run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${work}/site" "${PYTHON}" -c "
import quasimc, quasimc.compat.caribu.sky_tools.GenSky
scene = quasimc.Scene('PAR')
scene.add_material('leaf', reflectance=0.08, transmittance=0.06)
scene.add_mesh([[0, 0, 1], [0.1, 0, 1], [0, 0.1, 1]], [[0, 1, 2]], material='leaf')
assert scene.run(quasimc.sky(irradiance_horizontal=400), paths=64)['absorbed_flux']['PAR'].mean[0] > 0
assert quasimc.__version__ == '${VERSION}', quasimc.__version__
assert quasimc.__file__.startswith('${work}/site/'), quasimc.__file__
")
