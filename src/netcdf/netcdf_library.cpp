#include "netcdf/netcdf_library.h"

#include <string>

#include <dlfcn.h>

#include "quasimc/error.h"

namespace quasimc {
namespace {

[[noreturn]] void refuse_library() {
    const char* why = ::dlerror();  // NOLINT(concurrency-mt-unsafe): per thread on Linux
    throw InputError(
        {{"NetCDF", "can't be written", why == nullptr ? "its library has another version" : why,
          "install the netCDF library for C (Debian and Ubuntu: libnetcdf-dev), or write CSV or "
          "JSON"}});
}

template <typename Function>
void find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    if (function == nullptr) {
        refuse_library();
    }
}

NetcdfLibrary load_library() {
    void* const library = ::dlopen(QUASIMC_NETCDF_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        refuse_library();
    }
    NetcdfLibrary nc{};
    find(library, "nc_strerror", nc.strerror);
    find(library, "nc_create", nc.create);
    find(library, "nc_abort", nc.abort);
    find(library, "nc_close", nc.close);
    find(library, "nc_def_dim", nc.def_dim);
    find(library, "nc_def_var", nc.def_var);
    find(library, "nc_def_var_fill", nc.def_var_fill);
    find(library, "nc_def_var_chunking", nc.def_var_chunking);
    find(library, "nc_def_var_deflate", nc.def_var_deflate);
    find(library, "nc_put_att_text", nc.put_att_text);
    find(library, "nc_put_vara_double", nc.put_vara_double);
    find(library, "nc_put_var_double", nc.put_var_double);
    find(library, "nc_put_var_longlong", nc.put_var_longlong);
    find(library, "nc_put_var_string", nc.put_var_string);
    return nc;
}

}  // namespace

const NetcdfLibrary& netcdf_library() {
    static const NetcdfLibrary kLibrary = load_library();
    return kLibrary;
}

}  // namespace quasimc
