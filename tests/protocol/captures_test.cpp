#include "captures.h"

#include <csignal>

#include "coupling/protocol/trailing_values.h"
#include "session_fixture.h"

namespace quasimc::test {
namespace {

/// A recorded session, its simulator, and its transport.
struct Recorded {
    std::string name;
    Transport transport;
    Client client;
    bool has_values;  ///< it has enough rays to compare its values
};

void PrintTo(const Recorded& recorded, std::ostream* out) {
    *out << recorded.name;
}

Capture read(const Recorded& recorded) {
    if (recorded.transport == Transport::files) {
        return read_file_capture(recorded.name + ".files.txt");
    }
    const std::string from = recorded.name + ".pipes.from";
    return read_pipe_capture(
        recorded.name + ".pipes.to", recorded.name == "cpfg_tiny" ? from + ".full" : from);
}

class Captures : public SessionTest,
                 public ::testing::WithParamInterface<std::tuple<Recorded, Transport>> {};

/// The original's answers to single chunks are between the messages; the last one answers the order
/// to exit.
TEST_P(Captures, AreAnsweredInTheSameForm) {
    const auto& [recorded, transport] = GetParam();
    const Capture capture = read(recorded);
    folder_.write("comm.e", comm_text(transport));
    folder_.write(
        "light.qmc",
        "number of rays: 65536\nreturn type: D\nleaf material (top): 0.1 10 0.1 10 1\nverbose: 0\n"
        "location: 51 -114\nlight source: 0 -1 0 1\nmaterial: 0.1 10 0.1 10 1\n");
    const auto master = make_master(transport, recorded.client, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    std::string ours, theirs;
    for (const std::string& message : capture.messages) {
        master->send(message);
        ours += master->read_all_chunks();
    }
    master->await_last_sign();
    EXPECT_EQ(master->process().wait(), (Ending{false, 0})) << folder_.read("err");
    for (const std::string& reply : capture.replies) {
        theirs += reply;
    }
    if (transport == recorded.transport) {
        EXPECT_EQ(structure_of(ours), structure_of(theirs));
    } else {
        EXPECT_EQ(without_controls(structure_of(ours)), without_controls(structure_of(theirs)));
    }
    constexpr double kNoise = 0.03;  // of the original's few rays
    for (const auto& [id, value] : values_of(recorded.has_values ? theirs : "")) {
        EXPECT_NEAR(values_of(ours)[id], value, kNoise) << id;
    }
    master->clean_up();
}

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    Captures,
    ::testing::Combine(
        ::testing::Values(
            Recorded{"cpfg_tiny", Transport::pipes, Client::cpfg, true},
            Recorded{"cpfg_poly", Transport::pipes, Client::cpfg, true},
            Recorded{"cpfg_many", Transport::pipes, Client::cpfg, false},
            Recorded{"cpfg_tiny", Transport::files, Client::cpfg, true},
            Recorded{"lpfg_tiny", Transport::files, Client::lpfg, true},
            Recorded{"lpfg_quirks", Transport::files, Client::lpfg, false}),
        ::testing::Values(
            Transport::pipes, Transport::files, Transport::memory, Transport::sockets)),
    [](const auto& test) {
        const Recorded& recorded = std::get<0>(test.param);
        const Transport transport = std::get<1>(test.param);
        return recorded.name + "_" + name_of(recorded.transport) + "_over_" + name_of(transport);
    });

/// The values that lpfg adds after parameters change neither material nor size nor weather.
TEST(ValuesBehindParameters, AreNotTakenForParameters) {
    const Capture capture = read_file_capture("lpfg_quirks.files.txt");
    Notices silent([](const std::string&) {});
    MessageParser parser(read_comm_text(comm_text(Transport::files), "comm.e", silent));
    Pass pass;
    static_cast<void>(parser.parse(capture.messages.front(), pass));
    TrailingValues().remove(pass, parser.style());
    const std::map<std::string, std::size_t> expected{{"J", 1}, {"S", 2},  {"P", 3}, {"S2", 2},
                                                      {"N", 0}, {"EB", 0}, {"", 0}};
    for (const Query& query : pass.queries) {
        EXPECT_EQ(pass.parameters_of(query).size(), expected.at(query.organ)) << query.organ;
    }
}

TEST(CapturesThemselves, TellDifferentFormsApart) {
    EXPECT_EQ(structure_of("0 E(0.5,1e-05,,)\nControl: 5\n"), "0 E(#,#,,)\nControl: 5\n");
    EXPECT_NE(structure_of("0 E(0.5,,)\n"), structure_of("0 E(0.5,)\n"));
    EXPECT_NE(structure_of("0 E(0.5)\nControl: 5\n"), structure_of("0 E(0.5)\nControl: 4\n"));
}

}  // namespace
}  // namespace quasimc::test
