#pragma once

#include <netcdf.h>

namespace quasimc {

/// The functions of the netCDF library in use. The library is loaded at the first call, as few runs
/// write NetCDF and loading it with its dependencies takes longer than starting the program.
struct NetcdfLibrary {
    decltype(&nc_strerror) strerror;
    decltype(&nc_create) create;
    decltype(&nc_abort) abort;
    decltype(&nc_close) close;
    decltype(&nc_def_dim) def_dim;
    decltype(&nc_def_var) def_var;
    decltype(&nc_def_var_fill) def_var_fill;
    decltype(&nc_def_var_chunking) def_var_chunking;
    decltype(&nc_def_var_deflate) def_var_deflate;
    decltype(&nc_put_att_text) put_att_text;
    decltype(&nc_put_vara_double) put_vara_double;
    decltype(&nc_put_var_double) put_var_double;
    decltype(&nc_put_var_longlong) put_var_longlong;
    decltype(&nc_put_var_string) put_var_string;
};

/// @throws InputError  if it is not installed
[[nodiscard]] const NetcdfLibrary& netcdf_library();

}  // namespace quasimc
