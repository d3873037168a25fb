# Finds the netCDF library for C, which is loaded when it is needed: makes the target QuasimcNetcdf::headers, and
# sets QuasimcNetcdf_SONAME to the name by which it is loaded.

find_path(QuasimcNetcdf_INCLUDE_DIR netcdf.h)
find_library(QuasimcNetcdf_LIBRARY netcdf)
mark_as_advanced(QuasimcNetcdf_INCLUDE_DIR QuasimcNetcdf_LIBRARY)

# libnetcdf.so is a link to libnetcdf.so.19, or to libnetcdf.so.19.1.0, of which libnetcdf.so.19 is the name.
if(QuasimcNetcdf_LIBRARY)
    get_filename_component(quasimc_netcdf_file "${QuasimcNetcdf_LIBRARY}" REALPATH)
    get_filename_component(quasimc_netcdf_file "${quasimc_netcdf_file}" NAME)
    string(REGEX MATCH "^libnetcdf(\\.so\\.[0-9]+|\\.so$|.*\\.dylib$)" QuasimcNetcdf_SONAME "${quasimc_netcdf_file}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
    QuasimcNetcdf
    REQUIRED_VARS QuasimcNetcdf_LIBRARY QuasimcNetcdf_INCLUDE_DIR QuasimcNetcdf_SONAME
    REASON_FAILURE_MESSAGE "results are not written as NetCDF (Debian and Ubuntu: libnetcdf-dev)")

if(QuasimcNetcdf_FOUND AND NOT TARGET QuasimcNetcdf::headers)
    add_library(QuasimcNetcdf::headers INTERFACE IMPORTED)
    set_target_properties(QuasimcNetcdf::headers PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                                                            "${QuasimcNetcdf_INCLUDE_DIR}")
endif()
