#include "netcdf/netcdf_writer.h"
#include "quasimc/error.h"

namespace quasimc {

class NetcdfWriter::State {};

bool has_netcdf() {
    return false;
}

NetcdfWriter::NetcdfWriter(
    const RunFile& /*run*/, TextSink /*sink*/, std::string_view /*program_version*/) {
    throw InputError(
        {{"NetCDF", "this program can't write it", "it was built without the netCDF library",
          "install libnetcdf-dev and build it again"}});
}

NetcdfWriter::~NetcdfWriter() = default;

void NetcdfWriter::add_moment(std::size_t /*time_step*/, const Result& /*result*/) {}

void NetcdfWriter::add_day(std::size_t /*day*/, const SeriesSum& /*sum*/) {}

void NetcdfWriter::next_run(const RunFile& /*run*/) {}

void NetcdfWriter::finish() {}

}  // namespace quasimc
