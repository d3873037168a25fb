#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/notices.h"
#include "coupling/plants/master_messages.h"
#include "coupling/plants/program_connection.h"
#include "coupling/plants/query_graphics.h"
#include "growth/environment.h"

namespace quasimc {

/// An environment program that an environment file (.e) names, as cpfg starts and uses it. SIGPIPE
/// must be ignored.
class EnvironmentProgram final : public PlantEnvironment {
  public:
    /// Starts the program and waits for its first sign. One that can't be started, gives no sign or
    /// refuses is reported, and queries have no answers.
    /// @param format  from read_comm_text()
    /// @param comm_file  path of the environment file, which the program reads too
    /// @param notices  outlives the object
    /// @throws InputError  for what the environment file lacks, and invalid formats
    EnvironmentProgram(
        CommFile format,
        std::string comm_file,
        Notices& notices,
        const ProgramPatience& patience = {});
    /// Orders the program to exit and waits for its end. A bad end is reported.
    ~EnvironmentProgram() override;
    EnvironmentProgram(const EnvironmentProgram&) = delete;
    EnvironmentProgram& operator=(const EnvironmentProgram&) = delete;

    /// Whether the program runs.
    [[nodiscard]] bool is_connected() const { return connection_ != nullptr; }

    /// Sends chunks of queries when they are full. @throws InputError  as answers()
    Drawing* query(const PlantQuery& query) override;
    /// @throws InputError  if the program has ended, or writes something else than answers; also in
    ///         all later calls
    [[nodiscard]] std::vector<PlantAnswer> answers(std::int64_t step) override;

  private:
    void connect(const ProgramPatience& patience);
    /// Does `work` with the connection, which a failure ends for good.
    template <typename Work>
    void guarded(const Work& work);
    void add_pending();
    /// Sends a chunk of queries, and reads the reply.
    void exchange(ChunkPosition position, std::int64_t step);
    void read_reply();
    void trace(std::string_view direction, std::string_view text) const;

    CommFile format_;
    std::string comm_file_;
    Notices& notices_;
    QueryWriter writer_;
    std::unique_ptr<ProgramConnection> connection_;
    std::exception_ptr failure_;
    std::string name_;  // of the program, for messages

    std::string chunk_, pending_;  // pending: the last query, which shapes may follow
    std::size_t chunk_size_ = 0;   // queries in chunk_
    bool is_first_chunk_ = true;
    bool has_graphics_ = false;  // of the pending query
    GraphicsText graphics_{pending_};
    std::vector<std::int64_t> dropped_;  // queries whose answers are dropped
    std::vector<PlantAnswer> answers_;
};

}  // namespace quasimc
