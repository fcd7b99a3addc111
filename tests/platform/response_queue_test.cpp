// SPDX-License-Identifier: Apache-2.0
// degs::Accelerator before a bridge as gem5's, which keeps the payloads whose END_RESP it is sent,
// and degs::ResponseQueue, which does not send it any.
#include "examples/platforms/response_queue.hpp"

#include <functional>
#include <memory>
#include <string>

#include <gmock/gmock.h>

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/gem5_bridge.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

using ::testing::ElementsAre;

/// What docs/platforms.md says of gem5.
Accelerator::Options for_gem5(Transport transport = Transport::At) {
    Accelerator::Options options;
    options.memory.transport = transport;
    options.memory.burst_bytes = Gem5Bridge::kLine;
    return options;
}

enum class Reach { Direct, Queued };

/// A platform whose memory is behind a Gem5Bridge.
struct Gem5Platform : Platform {
    Gem5Platform(const std::string& name, const GaussianCloud& cloud, Reach reach,
                 const Accelerator::Options& options = for_gem5())
        : Platform(name.c_str(), DegsConfig(), cloud, nullptr, options),
          bridge((name + "_bridge").c_str(), kMemoryBytes) {
        if (reach == Reach::Queued) {
            queue = std::make_unique<ResponseQueue<>>((name + "_queue").c_str());
            mem().bind(queue->in);
            queue->out.bind(bridge.in);
        } else {
            mem().bind(bridge.in);
        }
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), bridge.bytes.begin());
        std::copy(sh.begin(), sh.end(), bridge.bytes.begin() + kSh);
    }
    std::vector<unsigned char> pixels(const Camera& camera) const {
        const auto begin = bridge.bytes.begin() + kFrame;
        return {begin, begin + camera.width * camera.height * 4};
    }
    Gem5Bridge bridge;
    std::unique_ptr<ResponseQueue<>> queue;
    std::vector<std::uint64_t> cycles;       ///< of each frame
    std::vector<std::uint64_t> transactions; ///< up to the end of each frame
    std::vector<std::size_t> payloads;       ///< up to the end of each frame
};

class SmallRunGem5Bridge : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    DegsConfig config;

    void render(Gem5Platform& p, int frames) {
        p.host.script = [this, &p, frames](Host& host) {
            program(host, cloud, camera);
            for (int frame = 0; frame < frames; ++frame) {
                EXPECT_TRUE(host.render());
                p.cycles.push_back(host.read_pair(Register::Cycles));
                p.transactions.push_back(p.bridge.requests);
                p.payloads.push_back(p.bridge.payloads.size());
            }
        };
    }
};

// Nothing but memory is lost: each transaction of the pool stays with the bridge, and a new one
// takes its place.
TEST_F(SmallRunGem5Bridge, KeepsEveryPayloadThatEndsByEndResp) {
    Gem5Platform p("p", cloud, Reach::Direct);
    render(p, 2);
    const Closed closed("closed", config, cloud, camera);
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    EXPECT_EQ(p.pixels(camera), closed.pixels());
    EXPECT_EQ(p.monitor.broken(), std::set<Rule>{Rule::References});
    EXPECT_EQ(p.bridge.kept, p.bridge.requests);
    EXPECT_EQ(p.payloads.front(), p.transactions.front());
    EXPECT_EQ(p.payloads.back(), p.transactions.back());
    EXPECT_GT(p.transactions.front(), 1000U);
    EXPECT_EQ(p.cycles.front(), p.cycles.back());
}

TEST_F(SmallRunGem5Bridge, KeepsNothingBehindAQueueOfResponses) {
    Gem5Platform direct("direct", cloud, Reach::Direct);
    Gem5Platform queued("queued", cloud, Reach::Queued);
    render(direct, 2);
    render(queued, 2);
    const Closed closed("closed", config, cloud, camera);
    sc_core::sc_start();
    ASSERT_TRUE(direct.host.finished && queued.host.finished);
    EXPECT_EQ(queued.pixels(camera), closed.pixels());
    EXPECT_EQ(queued.monitor.violations(), std::vector<std::string>{});
    EXPECT_EQ(queued.bridge.kept, 0U);
    EXPECT_EQ(queued.cycles, direct.cycles);
    EXPECT_EQ(queued.transactions, direct.transactions);
    EXPECT_EQ(queued.payloads.front(), queued.payloads.back());
    EXPECT_LT(queued.payloads.back(), queued.transactions.front() / 2);
}

// A bridge that is mended runs with the queue and without.
TEST_F(SmallRunGem5Bridge, MayGiveTheReferenceBack) {
    Gem5Platform direct("direct", cloud, Reach::Direct);
    Gem5Platform queued("queued", cloud, Reach::Queued);
    direct.bridge.gives_back = queued.bridge.gives_back = true;
    render(direct, 1);
    render(queued, 1);
    sc_core::sc_start();
    ASSERT_TRUE(direct.host.finished && queued.host.finished);
    EXPECT_EQ(direct.pixels(camera), queued.pixels(camera));
    EXPECT_EQ(direct.monitor.violations(), std::vector<std::string>{});
    EXPECT_EQ(queued.monitor.violations(), std::vector<std::string>{});
    EXPECT_EQ(direct.payloads, queued.payloads);
}

// The bridge waits for END_RESP of an annotated response, and for nothing with the queue.
TEST_F(SmallRunGem5Bridge, AnnotatesItsResponses) {
    Gem5Platform direct("direct", cloud, Reach::Direct);
    Gem5Platform queued("queued", cloud, Reach::Queued);
    direct.bridge.response_delay = queued.bridge.response_delay =
        sc_core::sc_time(7, sc_core::SC_NS);
    render(direct, 1);
    render(queued, 1);
    sc_core::sc_start();
    ASSERT_TRUE(direct.host.finished && queued.host.finished);
    EXPECT_EQ(direct.pixels(camera), queued.pixels(camera));
    EXPECT_EQ(queued.monitor.violations(), std::vector<std::string>{});
    EXPECT_LT(queued.cycles.front(), direct.cycles.front());
}

TEST_F(SmallRunGem5Bridge, ServesAnAtomicModeByLt) {
    Gem5Platform p("p", cloud, Reach::Direct, for_gem5(Transport::Lt));
    render(p, 1);
    const Closed closed("closed", config, cloud, camera);
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    EXPECT_EQ(p.pixels(camera), closed.pixels());
    EXPECT_EQ(p.bridge.requests, 0U);
}

TEST_F(SmallRunGem5Bridge, RefusesByteEnablesAndAddresses) {
    Accelerator::Options full_bursts = for_gem5();
    full_bursts.memory.burst_ends = BurstEnds::FullBursts;
    Gem5Platform enables("enables", cloud, Reach::Queued, full_bursts);
    Gem5Platform address("address", cloud, Reach::Queued);
    address.bridge.refused_from = kFrame + 4000;
    const auto fails_with = [&](std::uint32_t answer) {
        return [this, answer](Host& host) {
            program(host, cloud, camera);
            EXPECT_FALSE(host.render());
            EXPECT_EQ(host.error(), AcceleratorError::BusError);
            EXPECT_EQ(host.read(Register::ErrorDetail), answer);
        };
    };
    enables.host.script = fails_with(4);
    address.host.script = fails_with(2);
    sc_core::sc_start();
    EXPECT_TRUE(enables.host.finished && address.host.finished);
    EXPECT_EQ(address.monitor.violations(), std::vector<std::string>{});
}

/// An initiator of two reads, which ends a response in any of the ways that TLM-2.0 allows.
class TwoReads : public sc_core::sc_module,
                 public tlm::tlm_bw_transport_if<>,
                 private tlm::tlm_mm_interface {
public:
    using Payload = tlm::tlm_generic_payload;
    enum class End { Later, InTheCall, Completed, Updated };
    tlm::tlm_initiator_socket<> out;
    End end = End::Later;
    std::vector<double> dates; ///< of the responses, ns
    int freed = 0;
    std::vector<sc_dt::uint64> lost; ///< memory that may no longer be accessed directly

    explicit TwoReads(const sc_core::sc_module_name& name) : sc_core::sc_module(name), out("out") {
        out.bind(*this);
    }
    void run() {
        for (Payload& payload : reads_) {
            payload.set_mm(this);
            payload.acquire();
            payload.set_command(tlm::TLM_READ_COMMAND);
            payload.set_data_ptr(data_);
            payload.set_data_length(sizeof data_);
            payload.set_streaming_width(sizeof data_);
            tlm::tlm_phase phase = tlm::BEGIN_REQ;
            send(payload, phase);
            sc_core::wait(accepted_);
        }
        for (int ended = 0; ended < 2; ++ended) {
            if (end == End::Later) {
                sc_core::wait(answered_);
                sc_core::wait(kAnswer);
                tlm::tlm_phase phase = tlm::END_RESP;
                EXPECT_EQ(send(*last_, phase), tlm::TLM_COMPLETED);
                last_->release();
            }
        }
    }

private:
    tlm::tlm_sync_enum send(Payload& payload, tlm::tlm_phase& phase) {
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        return out->nb_transport_fw(payload, phase, delay);
    }
    tlm::tlm_sync_enum nb_transport_bw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        if (phase == tlm::END_REQ) {
            accepted_.notify(delay);
            return tlm::TLM_ACCEPTED;
        }
        EXPECT_EQ(phase, tlm::BEGIN_RESP);
        EXPECT_EQ(payload.get_response_status(), tlm::TLM_OK_RESPONSE);
        dates.push_back(sc_core::sc_time_stamp() / sc_core::sc_time(1, sc_core::SC_NS));
        last_ = &payload;
        if (end == End::Later) {
            answered_.notify(sc_core::SC_ZERO_TIME);
            return tlm::TLM_ACCEPTED;
        }
        phase = tlm::END_RESP;
        if (end == End::InTheCall) {
            EXPECT_EQ(send(payload, phase), tlm::TLM_COMPLETED);
        }
        payload.release();
        delay = kAnswer;
        return end == End::InTheCall   ? tlm::TLM_ACCEPTED
               : end == End::Completed ? tlm::TLM_COMPLETED
                                       : tlm::TLM_UPDATED;
    }
    void invalidate_direct_mem_ptr(sc_dt::uint64 first, sc_dt::uint64 last) override {
        lost = {first, last};
    }
    void free(Payload* /*payload*/) override { ++freed; }

    const sc_core::sc_time kAnswer{20, sc_core::SC_NS};
    Payload reads_[2];
    unsigned char data_[4] = {};
    Payload* last_ = nullptr;
    sc_core::sc_event accepted_, answered_;
};

class SmallRunResponseQueue : public ::testing::TestWithParam<TwoReads::End> {};

// The reads are asked at 0 and answered after 50 ns, the second one when the first has ended.
TEST_P(SmallRunResponseQueue, GivesOneResponseAtATime) {
    Gem5Bridge bridge("bridge", 64);
    ResponseQueue<> queue("queue");
    TwoReads reads("reads");
    reads.end = GetParam();
    reads.out.bind(queue.in);
    queue.out.bind(bridge.in);
    const Script script("script", [&] { reads.run(); });
    sc_core::sc_start();
    const bool at_once = reads.end == TwoReads::End::InTheCall;
    EXPECT_THAT(reads.dates, ElementsAre(50, at_once ? 50 : 70));
    EXPECT_EQ(reads.freed, 2);
    EXPECT_EQ(bridge.kept, 0U);
}

std::string end_name(const ::testing::TestParamInfo<TwoReads::End>& end) {
    constexpr const char* kNames[] = {"Later", "InTheCall", "Completed", "Updated"};
    return kNames[static_cast<std::size_t>(end.param)];
}

INSTANTIATE_TEST_SUITE_P(Ended, SmallRunResponseQueue,
                         ::testing::Values(TwoReads::End::Later, TwoReads::End::InTheCall,
                                           TwoReads::End::Completed, TwoReads::End::Updated),
                         end_name);

TEST(SmallRunResponseQueueOf, PassesDirectMemoryAccessOn) {
    Gem5Bridge bridge("bridge", 64);
    ResponseQueue<> queue("queue");
    TwoReads reads("reads");
    reads.out.bind(queue.in);
    queue.out.bind(bridge.in);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    bridge.in->invalidate_direct_mem_ptr(16, 31);
    EXPECT_THAT(reads.lost, ElementsAre(16, 31));
    tlm::tlm_generic_payload payload;
    tlm::tlm_dmi dmi;
    EXPECT_FALSE(reads.out->get_direct_mem_ptr(payload, dmi));
}

} // namespace
} // namespace degs::test
