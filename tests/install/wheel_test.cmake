# The source package, a wheel made of it, and the tests of the Python package in an empty environment with current
# packages: tools/wheels.py. Without the Python index, it is left out.

execute_process(
    COMMAND "${PYTHON}" -m pip download --quiet --no-deps --dest "${BUILD}/tests/install/index" scikit-build-core
    RESULT_VARIABLE status
    OUTPUT_QUIET ERROR_QUIET)
if(NOT status EQUAL 0)
    message(STATUS "pip or the Python index is missing")
    return()
endif()
execute_process(COMMAND "${PYTHON}" "${SOURCE}/tools/wheels.py" "${PYTHON}" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "tools/wheels.py failed")
endif()
