# Finds toml++, whose packages differ: a shared library with CMake files (Debian), or headers
# alone.  Makes the target QuasimcTomlplusplus::tomlplusplus.

find_package(tomlplusplus CONFIG QUIET)
if(TARGET tomlplusplus::tomlplusplus)
    set(QuasimcTomlplusplus_LIBRARY tomlplusplus::tomlplusplus)
else()
    find_path(QuasimcTomlplusplus_INCLUDE_DIR toml++/toml.h)
    mark_as_advanced(QuasimcTomlplusplus_INCLUDE_DIR)
    set(QuasimcTomlplusplus_LIBRARY "${QuasimcTomlplusplus_INCLUDE_DIR}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
    QuasimcTomlplusplus
    REQUIRED_VARS QuasimcTomlplusplus_LIBRARY
    REASON_FAILURE_MESSAGE "toml++ is needed (Debian and Ubuntu: libtomlplusplus-dev)")

if(QuasimcTomlplusplus_FOUND AND NOT TARGET QuasimcTomlplusplus::tomlplusplus)
    add_library(QuasimcTomlplusplus::tomlplusplus INTERFACE IMPORTED)
    if(TARGET tomlplusplus::tomlplusplus)
        set_target_properties(QuasimcTomlplusplus::tomlplusplus
                              PROPERTIES INTERFACE_LINK_LIBRARIES tomlplusplus::tomlplusplus)
    else()
        set_target_properties(
            QuasimcTomlplusplus::tomlplusplus
            PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${QuasimcTomlplusplus_INCLUDE_DIR}")
    endif()
endif()
