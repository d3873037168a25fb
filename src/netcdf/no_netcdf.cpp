#include "netcdf/netcdf_writer.h"
#include "quasimc/error.h"

namespace quasimc {

bool has_netcdf() {
    return false;
}

std::unique_ptr<OutputWriter> make_netcdf_writer(
    const RunFile& /*run*/, TextSink /*sink*/, std::string_view /*program_version*/) {
    throw InputError(
        {{"NetCDF", "this program can't write NetCDF", "it was built without the netCDF library",
          "install libnetcdf-dev and build it again"}});
}

}  // namespace quasimc
