# quasimc_settings: how our own code is compiled and linked.  Never exported to users.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

# Checked here and not by users of the library: the compiler, the cache, where programs land.
if(PROJECT_IS_TOP_LEVEL)
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
    find_program(QUASIMC_CCACHE ccache)
    mark_as_advanced(QUASIMC_CCACHE)
    if(QUASIMC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
        set(CMAKE_CXX_COMPILER_LAUNCHER "${QUASIMC_CCACHE}")
    endif()
endif()

add_library(quasimc_settings INTERFACE)
target_compile_features(quasimc_settings INTERFACE cxx_std_20)

# No -march, no -ffast-math, no contraction: one binary gives the same bits on every machine of
# its kind, and a sum means the sum that is written.
target_compile_options(
    quasimc_settings
    INTERFACE -Wall
              -Wextra
              -Wpedantic
              -Wshadow
              -Wconversion
              -Wno-sign-conversion
              -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
    target_compile_options(quasimc_settings INTERFACE -Wno-restrict)  # false: gcc bug 105651
endif()
if(QUASIMC_WERROR)
    target_compile_options(quasimc_settings INTERFACE -Werror)
endif()

if(QUASIMC_SANITIZE)
    target_compile_options(quasimc_settings INTERFACE -fsanitize=${QUASIMC_SANITIZE}
                                                      -fno-omit-frame-pointer
                                                      -fno-sanitize-recover=all)
    target_link_options(quasimc_settings INTERFACE -fsanitize=${QUASIMC_SANITIZE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # Instrumented code confuses these two analyses of GCC; the plain builds keep them.
        target_compile_options(quasimc_settings INTERFACE -Wno-maybe-uninitialized
                                                          -Wno-stringop-overflow)
    endif()
endif()

if(QUASIMC_COVERAGE)
    target_compile_options(quasimc_settings INTERFACE --coverage -fprofile-update=atomic)
    target_link_options(quasimc_settings INTERFACE --coverage)
endif()

if(QUASIMC_BUILD_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        message(FATAL_ERROR "QUASIMC_BUILD_FUZZ needs clang++ (libFuzzer); "
                            "use the preset asan, or -DCMAKE_CXX_COMPILER=clang++")
    endif()
    target_link_options(quasimc_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()

# The optimization of COLD modules (QuasimcModule.cmake).
set(QUASIMC_COLD_OPTIMIZATION $<$<CONFIG:Release>:-O1>)

# quasimc_unity(<target> modules|tests): compiles the target's sources joined into a few files, if
# QUASIMC_UNITY says so of its kind.  Most of the time of a compiler goes into headers, which are
# then read once; and names that clash in a joined file are two things of one name.
set(QUASIMC_UNITY "none" CACHE STRING "What is compiled in joined files: none, tests or all")
set_property(CACHE QUASIMC_UNITY PROPERTY STRINGS none tests all)
function(quasimc_unity target kind)
    if(QUASIMC_UNITY STREQUAL "all" OR (QUASIMC_UNITY STREQUAL "tests" AND kind STREQUAL "tests"))
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
        if(kind STREQUAL "tests")
            # A local name may be that of a constant in another file.
            target_compile_options(${target} PRIVATE -Wno-shadow)
        endif()
    endif()
endfunction()
