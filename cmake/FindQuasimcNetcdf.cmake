# Finds the netCDF library for C and makes the target QuasimcNetcdf::netcdf. Its own CMake files, where
# there are any, link all that it was made with as well.

find_path(QuasimcNetcdf_INCLUDE_DIR netcdf.h)
find_library(QuasimcNetcdf_LIBRARY netcdf)
mark_as_advanced(QuasimcNetcdf_INCLUDE_DIR QuasimcNetcdf_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
    QuasimcNetcdf
    REQUIRED_VARS QuasimcNetcdf_LIBRARY QuasimcNetcdf_INCLUDE_DIR
    REASON_FAILURE_MESSAGE "results are not written as NetCDF (Debian and Ubuntu: libnetcdf-dev)")

if(QuasimcNetcdf_FOUND AND NOT TARGET QuasimcNetcdf::netcdf)
    add_library(QuasimcNetcdf::netcdf INTERFACE IMPORTED)
    set_target_properties(
        QuasimcNetcdf::netcdf
        PROPERTIES INTERFACE_LINK_LIBRARIES "${QuasimcNetcdf_LIBRARY}"
                   INTERFACE_INCLUDE_DIRECTORIES "${QuasimcNetcdf_INCLUDE_DIR}")
endif()
