#include "parallel/part_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "parallel/part_difference.h"
#include "parallel/run_head.h"
#include "resultio/read_result.h"

namespace quasimc {
namespace {

constexpr std::string_view kFirstLine = "QuasiMC part, format 2\n";
constexpr std::uint64_t kMaxParts = 1'000'000;
/// Index that marks the end.
constexpr std::uint64_t kEnd = std::numeric_limits<std::uint64_t>::max();

Fault missing_part(std::uint64_t part, std::uint64_t parts) {
    return {"PART", fmt::format("part {} of {} is missing", part, parts), "", "add its file"};
}

}  // namespace

PartNumber read_part_number(const std::string& text, const std::string& where) {
    PartNumber number;
    const char* end = text.data() + text.size();
    const auto [slash, wrong] = std::from_chars(text.data(), end, number.part);
    bool is_read = wrong == std::errc() && slash != end && *slash == '/';
    if (is_read) {
        const auto [last, bad] = std::from_chars(slash + 1, end, number.parts);
        is_read = bad == std::errc() && last == end;
    }
    if (!is_read || number.part < 1 || number.part > number.parts || number.parts > kMaxParts) {
        throw InputError(
            {{where, fmt::format("'{}' is not a part of a run", text),
              fmt::format("write K/N for part K of N, 1 <= K <= N <= {}", kMaxParts),
              "3/16 is the third of sixteen"}});
    }
    return number;
}

PartWriter::PartWriter(const RunFile& run, const PartNumber& number, TextSink sink)
    : sink_(std::move(sink)) {
    write(std::string(kFirstLine) + number_bytes(number.part) + number_bytes(number.parts));
    const std::string head = head_of_run(run);
    write(number_bytes(head.size()));
    write(head);
    write_digest();
}

void PartWriter::write(const std::string& bytes) {
    digest_.add(bytes);
    sink_(bytes);
}

void PartWriter::add(std::size_t time_step, const Sums& sums) {
    const std::string bytes = save_sums(sums);
    write(number_bytes(time_step) + number_bytes(bytes.size()));
    write(bytes);
    write_digest();
}

void PartWriter::finish() {
    write(number_bytes(kEnd));
    write_digest();
}

PartReader::PartReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
    std::error_code error;
    bytes_ = std::filesystem::file_size(path_, error);
    if (!file_ || error) {
        refuse("can't be read", error ? error.message() : "it can't be opened");
    }
    std::string line(kFirstLine.size(), '\0');
    file_.read(line.data(), static_cast<std::streamsize>(line.size()));
    if (!file_ || line != kFirstLine) {
        refuse("is not a part of a run", "it must be a file written by `quasimc run --part`");
    }
    digest_.add(line);
    const std::string numbers = read_bytes(2 * sizeof(std::uint64_t));
    std::memcpy(&number_.part, numbers.data(), sizeof number_.part);
    std::memcpy(&number_.parts, numbers.data() + sizeof number_.part, sizeof number_.parts);
    if (number_.part < 1 || number_.part > number_.parts || number_.parts > kMaxParts) {
        refuse("is damaged", "its part number is impossible");
    }
    head_ = read_block();
    check_digest();
}

void PartReader::check_digest() {
    const std::string expected = digest_.hex();
    if (read_bytes(expected.size()) != expected) {
        refuse("is damaged", "its checksum is wrong");
    }
}

void PartReader::refuse(const std::string& problem, const std::string& why) const {
    throw InputError({{path_, problem, why, ""}});
}

std::string PartReader::read_bytes(std::uint64_t count) {
    if (count > bytes_) {
        refuse("is cut off or damaged", "its length is wrong");
    }
    std::string bytes(count, '\0');
    file_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (!file_) {
        refuse("is cut off", "the run that wrote it may not have ended yet");
    }
    digest_.add(bytes);
    return bytes;
}

std::uint64_t PartReader::read_number() {
    std::uint64_t number = 0;
    const std::string bytes = read_bytes(sizeof number);
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

std::string PartReader::read_block() {
    return read_bytes(read_number());
}

Sums PartReader::next(std::size_t time_step) {
    if (read_number() != time_step) {
        refuse("is damaged or belongs to another run", "it has the sums of other time steps");
    }
    const std::string block = read_block();
    check_digest();
    try {
        return load_sums(block);
    } catch (const std::invalid_argument& error) {
        refuse("is damaged", error.what());
    }
}

void PartReader::expect_end() {
    if (read_number() != kEnd) {
        refuse("is damaged or belongs to another run", "it has more time steps than the run");
    }
    check_digest();
    if (file_.peek() != std::ifstream::traits_type::eof()) {
        refuse("is damaged", "it has extra bytes at its end");
    }
}

PartFiles::PartFiles(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        parts_.emplace_back(path);
    }
    std::stable_sort(parts_.begin(), parts_.end(), [](const PartReader& a, const PartReader& b) {
        return a.number().part < b.number().part;
    });
    check_complete();
}

void PartFiles::check_complete() const {
    Faults faults;
    const std::uint64_t count = parts_.front().number().parts;
    std::uint64_t expected = 1;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const PartReader& part = parts_[i];
        const PartNumber& number = part.number();
        const std::string difference = difference_of_runs(parts_.front().head(), part.head());
        if (number.parts != count) {
            faults.add(
                {part.path(), fmt::format("is one of {} parts", number.parts),
                 fmt::format("{} is one of {}", parts_.front().path(), count), ""});
        } else if (!difference.empty()) {
            faults.add(
                {part.path(), "belongs to another run than " + parts_.front().path(), difference,
                 ""});
        } else if (number.part < expected) {
            faults.add(
                {part.path(), fmt::format("part {} of {} is given twice", number.part, count),
                 "its paths would count twice", "remove one of them"});
        }
        for (; expected < number.part; ++expected) {
            faults.add(missing_part(expected, count));
        }
        expected = std::max(expected, number.part + 1);
    }
    for (; expected <= count; ++expected) {
        faults.add(missing_part(expected, count));
    }
    faults.throw_if_any();
}

StoredSweep PartFiles::read_runs() const {
    const std::string& path = parts_.front().path();
    return read_result_text(
        parts_.front().head(), path, std::filesystem::absolute(path).parent_path());
}

Sums PartFiles::next(std::size_t time_step) {
    Sums sums = parts_.front().next(time_step);
    for (std::size_t i = 1; i < parts_.size(); ++i) {
        try {
            sums.add_share(parts_[i].next(time_step));
        } catch (const std::invalid_argument& error) {
            throw InputError(
                {{parts_[i].path(), "does not fit " + parts_.front().path(), error.what(), ""}});
        }
    }
    return sums;
}

void PartFiles::expect_end() {
    for (PartReader& part : parts_) {
        part.expect_end();
    }
}

std::vector<InputFile> PartFiles::inputs() const {
    std::vector<InputFile> inputs;
    for (const PartReader& part : parts_) {
        inputs.push_back({part.path(), part.path(), "", 0, false});
    }
    return inputs;
}

}  // namespace quasimc
