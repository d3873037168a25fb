#include "netcdf/netcdf_file.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>

#include <unistd.h>

#include "netcdf/netcdf_library.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

[[noreturn]] void fail_netcdf(const std::string& why) {
    throw InputError({{"NetCDF", "can't be written", why, ""}});
}

void check_netcdf(int status) {
    if (status != NC_NOERR) {
        fail_netcdf(netcdf_library().strerror(status));
    }
}

nc_type type_of(NetcdfType type) {
    return type == NetcdfType::real      ? NC_DOUBLE
           : type == NetcdfType::integer ? NC_INT64
                                         : NC_STRING;
}

void put_attributes(int file, int variable, const NetcdfAttributes& attributes) {
    for (const auto& [name, text] : attributes) {
        check_netcdf(
            netcdf_library().put_att_text(file, variable, name.c_str(), text.size(), text.data()));
    }
}

}  // namespace

NetcdfFile::NetcdfFile() {
    const NetcdfLibrary& library = netcdf_library();  // may throw, so before the file is created
    std::string path = (std::filesystem::temp_directory_path() / "quasimc-XXXXXX").string();
    const int descriptor = ::mkstemp(path.data());
    if (descriptor < 0) {
        fail_netcdf(std::generic_category().message(errno));
    }
    bytes_.reset(::fdopen(descriptor, "rb"));
    // The library opens the file by its name, which is then removed.
    const int status = library.create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_);
    ::unlink(path.c_str());
    check_netcdf(status);
    is_open_ = true;
}

NetcdfFile::~NetcdfFile() {
    if (is_open_) {
        netcdf_library().abort(id_);
    }
}

int NetcdfFile::add_dimension(const std::string& name, std::size_t size) {
    int dimension = 0;
    check_netcdf(netcdf_library().def_dim(id_, name.c_str(), size, &dimension));
    return dimension;
}

int NetcdfFile::add_variable(
    const std::string& name,
    NetcdfType type,
    const std::vector<int>& dimensions,
    const NetcdfAttributes& attributes,
    const std::optional<std::vector<std::size_t>>& chunk) {
    constexpr int kFastest = 1;
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    int variable = 0;
    check_netcdf(netcdf_library().def_var(
        id_, name.c_str(), type_of(type), static_cast<int>(dimensions.size()), dimensions.data(),
        &variable));
    if (chunk) {
        check_netcdf(netcdf_library().def_var_fill(id_, variable, NC_FILL, &kNaN));
    }
    if (chunk && !chunk->empty()) {
        check_netcdf(netcdf_library().def_var_chunking(id_, variable, NC_CHUNKED, chunk->data()));
        check_netcdf(netcdf_library().def_var_deflate(id_, variable, 1, 1, kFastest));
    }
    put_attributes(id_, variable, attributes);
    return variable;
}

void NetcdfFile::add_attributes(const NetcdfAttributes& attributes) {
    put_attributes(id_, NC_GLOBAL, attributes);
}

void NetcdfFile::put(int variable, const NetcdfBlock& block, std::span<const double> values) {
    check_netcdf(netcdf_library().put_vara_double(
        id_, variable, block.start.data(), block.count.data(), values.data()));
}

void NetcdfFile::put(int variable, std::span<const double> values) {
    check_netcdf(netcdf_library().put_var_double(id_, variable, values.data()));
}

void NetcdfFile::put(int variable, std::span<const std::int64_t> values) {
    static_assert(sizeof(long long) == sizeof(std::int64_t));
    const std::vector<long long> same(values.begin(), values.end());
    check_netcdf(netcdf_library().put_var_longlong(id_, variable, same.data()));
}

void NetcdfFile::put(int variable, const std::vector<std::string>& values) {
    std::vector<const char*> texts;
    texts.reserve(values.size());
    for (const std::string& value : values) {
        texts.push_back(value.c_str());
    }
    check_netcdf(netcdf_library().put_var_string(id_, variable, texts.data()));
}

void NetcdfFile::close() {
    is_open_ = false;
    check_netcdf(netcdf_library().close(id_));
}

void NetcdfFile::copy_to(const TextSink& sink) {
    close();
    std::array<char, 1 << 16> piece{};
    while (const std::size_t size = std::fread(piece.data(), 1, piece.size(), bytes_.get())) {
        sink({piece.data(), size});
    }
    if (std::ferror(bytes_.get()) != 0) {
        fail_netcdf("its temporary file can't be read");
    }
}

}  // namespace quasimc
