#include "io/commit_record.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "io/descriptor.h"
#include "io/file_identity.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRecordPrefix = ".quasimc.commit.";
constexpr std::string_view kRecordHead = "QuasiMC commit 1", kRecordEnd = "end";

fs::path absolute_of(const fs::path& path) {
    std::error_code error;
    return fs::absolute(followed(path), error).lexically_normal();
}

/// By what a file is known again; of what is not there "none".
std::string state_of(const fs::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        return "none";
    }
    return fmt::format(
        "{} {} {} {} {}", status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
        status.st_mtim.tv_nsec);
}

/// Fields end with a zero, which no path has.
std::string text_of(std::span<const PendingName> names) {
    std::string text(kRecordHead);
    text += '\0';
    for (const PendingName& name : names) {
        const fs::path target = absolute_of(name.target);
        for (const std::string& field :
             {absolute_of(name.temporary).string(), target.string(), state_of(target)}) {
            text += field;
            text += '\0';
        }
    }
    text += kRecordEnd;
    return text + '\0';
}

bool write_record(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor, text.data(), text.size());
        if (count <= 0) {
            return false;
        }
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

void sync_folder_of_record(const fs::path& folder) {
    const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.is_open()) {
        static_cast<void>(::fsync(opened.number()));
    }
}

/// A name and the state of its target before.
struct RecordedName : PendingName {
    std::string before;
};

/// What a record says; empty if it is none.
std::vector<RecordedName> names_in(std::string_view text) {
    std::vector<std::string> fields;
    for (std::size_t end = text.find('\0'); end != std::string_view::npos; end = text.find('\0')) {
        fields.emplace_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    std::vector<RecordedName> names;
    if (fields.size() % 3 != 2 || fields.front() != kRecordHead || fields.back() != kRecordEnd) {
        return names;
    }
    for (std::size_t i = 1; i + 3 < fields.size(); i += 3) {
        names.push_back({{fields[i], fields[i + 1]}, fields[i + 2]});
    }
    return names;
}

std::string read_record(int descriptor) {
    std::string text;
    std::array<char, 4096> piece{};
    for (ssize_t count = 1; count > 0;) {
        count = ::read(descriptor, piece.data(), piece.size());
        text.append(piece.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
    return text;
}

/// Gives the files of a record their names, unless something else has them by now.
void finish(const std::vector<RecordedName>& names) {
    for (const RecordedName& name : names) {
        const bool is_hidden = name.temporary.filename().string().starts_with(".quasimc.");
        if (!is_hidden || state_of(name.temporary) == "none") {
            continue;
        }
        if (state_of(name.target) == name.before) {
            ::rename(name.temporary.c_str(), name.target.c_str());
        } else {
            ::unlink(name.temporary.c_str());
        }
        sync_folder_of_record(name.target.parent_path());
    }
}

/// Finishes a record if it names one of the targets and its program is gone.
void finish_record(const fs::path& path, const std::set<fs::path>& targets) {
    const Descriptor record(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    if (record.is_open() && ::flock(record.number(), LOCK_EX | LOCK_NB) == 0) {
        const std::vector<RecordedName> names = names_in(read_record(record.number()));
        if (std::any_of(names.begin(), names.end(), [&](const RecordedName& name) {
                return targets.contains(name.target);
            })) {
            finish(names);
            ::unlink(path.c_str());
        }
    }
}

}  // namespace

CommitRecord::CommitRecord(std::span<const PendingName> names) {
    if (names.size() < 2) {
        return;  // a single name is given at once
    }
    const fs::path folder = absolute_of(names.back().target).parent_path();
    std::string hidden = (folder / ".quasimc.XXXXXX").string();
    descriptor_ = ::mkostemp(hidden.data(), O_CLOEXEC);
    if (descriptor_ < 0) {
        return;
    }
    path_ = hidden;
    // Locked and whole before it has the name by which it is found.
    const fs::path found =
        folder / fmt::format("{}{}", kRecordPrefix, hidden.substr(hidden.size() - 6));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 && write_record(descriptor_, text_of(names)) &&
        ::fsync(descriptor_) == 0 && ::rename(path_.c_str(), found.c_str()) == 0) {
        path_ = found;
        sync_folder_of_record(folder);
    }
}

CommitRecord::~CommitRecord() {
    if (!path_.empty()) {
        ::unlink(path_.c_str());
    }
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

void finish_commits(const std::vector<fs::path>& outputs) {
    std::set<fs::path> targets, folders;
    for (const fs::path& output : outputs) {
        if (output != "-") {
            targets.insert(absolute_of(output));
            folders.insert(absolute_of(output).parent_path());
        }
    }
    for (const fs::path& folder : folders) {
        std::error_code error;
        std::vector<fs::path> records;
        for (fs::directory_iterator at(folder, error), end; !error && at != end;
             at.increment(error)) {
            if (at->path().filename().string().starts_with(kRecordPrefix)) {
                records.push_back(at->path());
            }
        }
        for (const fs::path& record : records) {
            finish_record(record, targets);
        }
    }
}

}  // namespace quasimc
