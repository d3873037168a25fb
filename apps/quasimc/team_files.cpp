#include "team_files.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "files/input_files.h"
#include "part_run.h"

namespace {

namespace fs = std::filesystem;

/// File access of the first rank, shared with the others.
///
/// The first rank sends its requests with their answers. Other ranks make the same requests, maybe
/// in another order, and take the answers from there.
class TeamFiles {
  public:
    explicit TeamFiles(quasimc::RunTeam& team) : team_(team) {}

    template <typename Find>
    std::string answer(const std::string& question, const Find& find) {
        if (team_.is_first()) {
            std::string found = find();
            send(question, found);
            return found;
        }
        auto known = answers_.find(question);
        while (known == answers_.end() && !has_ended_) {
            receive();
            known = answers_.find(question);
        }
        if (known == answers_.end()) {
            throw quasimc::InputError(
                {{"MPI", "the first rank has not read a file", question, ""}});
        }
        return known->second;
    }

    /// Ends reading. All ranks call it.
    void end() {
        if (team_.is_first()) {
            send(kEnd, "");
        }
        while (!team_.is_first() && !has_ended_) {
            receive();
        }
        answers_.clear();
    }

  private:
    static constexpr std::string_view kEnd = "end";

    void send(std::string_view question, std::string_view found) {
        std::string bytes(question);
        team_.share_bytes(bytes);
        bytes = found;
        team_.share_bytes(bytes);
    }

    void receive() {
        std::string question, found;
        team_.share_bytes(question);
        team_.share_bytes(found);
        has_ended_ = question == kEnd;
        answers_[question] = std::move(found);
    }

    quasimc::RunTeam& team_;
    std::map<std::string, std::string> answers_;
    bool has_ended_ = false;
};

quasimc::FileAccess access_through(const std::shared_ptr<TeamFiles>& files) {
    const quasimc::FileAccess disk;
    quasimc::FileAccess access;
    access.read = [files, read = disk.read](const fs::path& path) {
        return files->answer("read " + path.string(), [&] { return read(path); });
    };
    access.exists = [files, exists = disk.exists](const fs::path& path) {
        const auto find = [&] { return std::string(exists(path) ? "yes" : ""); };
        return !files->answer("exists " + path.string(), find).empty();
    };
    access.absolute = [files, absolute = disk.absolute](const std::string& path) {
        return fs::path(files->answer("absolute " + path, [&] { return absolute(path).string(); }));
    };
    return access;
}

}  // namespace

quasimc::StoredSweep read_for_team(const RunArguments& arguments, quasimc::RunTeam& team) {
    const auto files = std::make_shared<TeamFiles>(team);
    try {
        quasimc::StoredSweep stored = read_runs(arguments, access_through(files));
        files->end();
        return stored;
    } catch (...) {
        files->end();
        throw;
    }
}
