#include "netcdf/netcdf_writer.h"
#include "resultio/output_input.h"

namespace quasimc {

std::unique_ptr<OutputWriter> make_netcdf(const OutputInput& input) {
    return make_netcdf_writer(input.run, input.sink);
}

}  // namespace quasimc
