// Replays a corpus through a fuzzed reader in an ordinary build: no libFuzzer, no random input.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "readers.h"

namespace {

std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

int replay(const quasimc::fuzz::FuzzedReader& reader, const std::filesystem::path& corpus) {
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        reader.read(read_bytes(entry.path()));
        ++count;
    }
    std::printf("%d inputs replayed\n", count);
    return count > 0 ? 0 : 1;  // an empty corpus tests nothing
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s READER CORPUS_FOLDER\n", argv[0]);
        return 2;
    }
    try {
        return replay(quasimc::fuzz::find_reader(argv[1]), argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
