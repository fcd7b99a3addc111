// SPDX-License-Identifier: Apache-2.0
// Blocking accesses on memories that know the four phases only.
#include <functional>
#include <memory>
#include <string>

#include <tlm_utils/simple_initiator_socket.h>

#include "platform/at_requester.hpp"
#include "tests/tlm/at_memory.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

using Payload = tlm::tlm_generic_payload;
using Piece = AtRequester::Piece;

/// Threads that share one requester; thread i has rank i.
class Threads : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<Threads> out;
    AtRequester requester;

    Threads(const sc_core::sc_module_name& name, unsigned outstanding, unsigned per_rank = ~0U)
        : sc_core::sc_module(name), out("out"),
          requester("requester", out, AtRequester::Limits{outstanding, per_rank}) {
        out.register_nb_transport_bw(this, &Threads::backward);
    }
    void start(const std::function<void()>& body) {
        const std::string script_name = "script_" + std::to_string(scripts_.size());
        scripts_.push_back(std::make_unique<Script>(script_name.c_str(), body));
    }
    /// Date of the answer in ns.
    double access(unsigned rank, bool write, const std::vector<Piece>& pieces,
                  std::vector<unsigned char>& data, double delay_ns = 0) {
        Payload payload;
        payload.set_command(write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
        payload.set_address(pieces.front().address);
        payload.set_data_ptr(data.data());
        payload.set_data_length(static_cast<unsigned>(data.size()));
        sc_core::sc_time delay(delay_ns, sc_core::SC_NS);
        requester.transport(rank, payload, pieces, delay);
        status = payload.get_response_status();
        return (sc_core::sc_time_stamp() + delay) / sc_core::sc_time(1, sc_core::SC_NS);
    }
    tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;

private:
    tlm::tlm_sync_enum backward(Payload& payload, tlm::tlm_phase& phase, sc_core::sc_time& delay) {
        return requester.backward(payload, phase, delay);
    }
    std::vector<std::unique_ptr<Script>> scripts_;
};

class SmallRunAtRequester : public ::testing::Test {
protected:
    static constexpr std::size_t kBytes = 4096;
    AtMemory memory{"memory", kBytes};

    /// `count` threads write 16 B each to a place of their own, from date 100 on, all at once;
    /// returns the dates of their answers.
    std::vector<double> write_at_once(unsigned count, unsigned outstanding) {
        Threads threads("threads", outstanding);
        threads.out.bind(memory.in);
        std::vector<double> dates(count, 0);
        for (unsigned i = 0; i < count; ++i) {
            threads.start([&, i] {
                std::vector<unsigned char> data(16, static_cast<unsigned char>(i));
                dates[i] = threads.access(i, true, {{16 * i, 0, 16}}, data, 100);
            });
        }
        sc_core::sc_start();
        for (std::size_t at = 0; at < 16 * count; ++at) {
            EXPECT_EQ(memory.bytes[at], at / 16);
        }
        EXPECT_EQ(memory.under_way, 0U);
        EXPECT_EQ(threads.requester.most_under_way(), memory.most_under_way);
        return dates;
    }
};

class SmallRunAtEnding : public SmallRunAtRequester,
                         public ::testing::WithParamInterface<Ending> {};

TEST_P(SmallRunAtEnding, ReadsWhatWasWrittenAfterTheLatency) {
    memory.ending = GetParam();
    Threads threads("threads", 4);
    threads.out.bind(memory.in);
    threads.start([&] {
        std::vector<unsigned char> out(64);
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = static_cast<unsigned char>(3 * i);
        }
        std::vector<unsigned char> back(64, 0);
        const std::vector<Piece> pieces{{256, 0, 24}, {1024, 24, 40}};
        double date = 7;
        for (int round = 0; round < 7; ++round) {
            EXPECT_DOUBLE_EQ(threads.access(0, true, {pieces[0]}, out, round == 0 ? 7 : 0),
                             date + 50);
            EXPECT_DOUBLE_EQ(threads.access(0, true, {pieces[1]}, out), date + 100);
            EXPECT_DOUBLE_EQ(threads.access(0, false, {pieces[0]}, back), date + 150);
            EXPECT_DOUBLE_EQ(threads.access(0, false, {pieces[1]}, back), date + 200);
            EXPECT_EQ(back, out);
            EXPECT_EQ(memory.bytes[256 + 23], out[23]);
            EXPECT_EQ(memory.bytes[1024], out[24]);
            date += 200;
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(memory.requests, 28U);
    EXPECT_EQ(memory.under_way, 0U);
}

TEST_P(SmallRunAtEnding, RefusalsReachWhoAskedAndNobodyElse) {
    memory.ending = GetParam();
    memory.refused_from = 128;
    Threads threads("threads", 8);
    threads.out.bind(memory.in);
    std::vector<tlm::tlm_response_status> answers;
    threads.start([&] {
        std::vector<unsigned char> data(32);
        for (const std::vector<Piece>& pieces :
             {std::vector<Piece>{{0, 0, 32}}, {{200, 0, 32}}, {{0, 0, 16}, {300, 16, 16}}}) {
            threads.access(0, false, pieces, data);
            answers.push_back(threads.status);
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(answers, (std::vector<tlm::tlm_response_status>{tlm::TLM_OK_RESPONSE,
                                                              tlm::TLM_ADDRESS_ERROR_RESPONSE,
                                                              tlm::TLM_ADDRESS_ERROR_RESPONSE}));
}

INSTANTIATE_TEST_SUITE_P(All, SmallRunAtEnding,
                         ::testing::Values(Ending::Four, Ending::RequestAtOnce, Ending::NoEndReq,
                                           Ending::AnswerAtOnce, Ending::Completed, Ending::Mixed),
                         ending_name);

TEST_F(SmallRunAtRequester, UnlimitedBandwidthAnswersAllAtOnce) {
    EXPECT_EQ(write_at_once(10, 16), std::vector<double>(10, 150));
    EXPECT_EQ(memory.most_under_way, 10U);
}

TEST_F(SmallRunAtRequester, NoMoreAreUnderWayThanAllowedAndTheLowerRanksGoFirst) {
    EXPECT_EQ(write_at_once(7, 3), (std::vector<double>{150, 150, 150, 200, 200, 200, 250}));
    EXPECT_EQ(memory.most_under_way, 3U);
}

TEST_F(SmallRunAtRequester, TheRequestPhaseOfOneHoldsBackTheNext) {
    memory.accept = sc_core::sc_time(5, sc_core::SC_NS);
    EXPECT_EQ(write_at_once(4, 16), (std::vector<double>{150, 155, 160, 165}));
}

TEST_F(SmallRunAtRequester, AnAnnotatedEndOfTheRequestHoldsBackTheNext) {
    memory.accept = sc_core::sc_time(5, sc_core::SC_NS);
    memory.ending = Ending::RequestAtOnce;
    EXPECT_EQ(write_at_once(4, 16), (std::vector<double>{150, 155, 160, 165}));
}

TEST_F(SmallRunAtRequester, AnAnswerEndsTheRequestWhereThereIsNoEndReq) {
    memory.ending = Ending::NoEndReq;
    EXPECT_EQ(write_at_once(4, 16), (std::vector<double>{150, 200, 250, 300}));
    EXPECT_EQ(memory.most_under_way, 1U);
}

TEST_F(SmallRunAtRequester, PiecesOfAnAccessAreUnderWayTogether) {
    Threads threads("threads", 3);
    threads.out.bind(memory.in);
    threads.start([&] {
        std::vector<unsigned char> data(64, 9);
        const std::vector<Piece> pieces{{0, 0, 16}, {64, 16, 16}, {128, 32, 16}, {192, 48, 16}};
        EXPECT_DOUBLE_EQ(threads.access(0, true, pieces, data), 100); // three, then one
    });
    sc_core::sc_start();
    EXPECT_EQ(memory.bytes[192 + 15], 9);
    EXPECT_EQ(memory.most_under_way, 3U);
}

TEST_F(SmallRunAtRequester, ARankAtItsLimitDoesNotHoldBackOthers) {
    Threads threads("threads", 16, 2);
    threads.out.bind(memory.in);
    std::vector<double> dates(2, 0);
    for (unsigned rank = 0; rank < 2; ++rank) {
        threads.start([&, rank] {
            std::vector<unsigned char> data(64, 9);
            const std::vector<Piece> pieces{{0, 0, 16}, {64, 16, 16}, {128, 32, 16}, {192, 48, 16}};
            dates[rank] = threads.access(rank, true, pieces, data);
        });
    }
    sc_core::sc_start();
    EXPECT_EQ(dates, (std::vector<double>{100, 100})); // two at a time each
    EXPECT_EQ(memory.most_under_way, 4U);
}

// The bytes are those of the call: who writes may use its buffer again at once.
TEST_F(SmallRunAtRequester, AnAccessThatNobodyWaitsForIsAnsweredLater) {
    Threads threads("threads", 8);
    threads.out.bind(memory.in);
    std::vector<double> dates;
    threads.start([&] {
        std::vector<unsigned char> data(16);
        for (unsigned char value = 0; value < 4; ++value) {
            std::fill(data.begin(), data.end(), value);
            Payload payload;
            payload.set_command(tlm::TLM_WRITE_COMMAND);
            payload.set_data_ptr(data.data());
            payload.set_data_length(16);
            threads.requester.start(
                0, payload, {{16U * value, 0, 16}},
                [&dates](tlm::tlm_response_status status, const unsigned char* /*data*/) {
                    EXPECT_EQ(status, tlm::TLM_OK_RESPONSE);
                    dates.push_back(sc_core::sc_time_stamp() / sc_core::sc_time(1, sc_core::SC_NS));
                });
        }
        EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::SC_ZERO_TIME);
    });
    sc_core::sc_start();
    EXPECT_EQ(dates, std::vector<double>(4, 50));
    EXPECT_EQ(memory.most_under_way, 4U);
    for (std::size_t at = 0; at < 64; ++at) {
        EXPECT_EQ(memory.bytes[at], at / 16);
    }
}

TEST_F(SmallRunAtRequester, NothingOutstandingIsRefused) {
    EXPECT_THROW(Threads("threads", 0), std::invalid_argument);
    EXPECT_THROW(Threads("others", 1, 0), std::invalid_argument);
}

} // namespace
} // namespace degs::test
