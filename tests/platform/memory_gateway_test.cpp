// SPDX-License-Identifier: Apache-2.0
// The memory of a platform as an accelerator sees it.
#include <tuple>

#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/at_memory.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

/// Two streams whose names say nothing, on a memory that holds bytes of 0xA5.
class SmallRunMemoryGateway : public ::testing::Test {
protected:
    Timebase time;
    PlainMemory memory{"memory", 4096, Timing::Annotated};
    MemoryPort first{"first", time}, second{"second", time};
    MemoryGateway gateway{"gateway"};
    std::vector<std::uint64_t> seen; ///< addresses that the observer was called with

    void run(const std::function<void(Process&)>& body) {
        gateway.out.bind(memory.in);
        gateway.observe_scene(
            [this](std::uint64_t address, const unsigned char* data, std::uint64_t) {
                seen.push_back(address);
                EXPECT_EQ(data[0], 0xA5);
            });
        gateway.connect({{&first, {"records", StreamData::Scene, ""}},
                         {&second, {"geometry", StreamData::Own, ""}}});
        Script script("script", [&] {
            Process process(time);
            body(process);
        });
        sc_core::sc_start();
    }
};

TEST_F(SmallRunMemoryGateway, OnlyStreamsThatCarryTheSceneAreObserved) {
    run([this](Process& process) {
        first.read(process, 64, 32);
        second.read(process, 128, 32);
        second.write(process, 256, 32);
    });
    EXPECT_EQ(seen, (std::vector<std::uint64_t>{64}));
}

/// Answers the accesses with these errors in turn, then with none.
struct FailingMemory : sc_core::sc_module {
    tlm_utils::simple_target_socket<FailingMemory> in;
    std::vector<tlm::tlm_response_status> answers;
    explicit FailingMemory(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in") {
        in.register_b_transport(this, &FailingMemory::transport);
    }
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& /*delay*/) {
        payload.set_response_status(answers.empty() ? tlm::TLM_OK_RESPONSE : answers.front());
        answers.erase(answers.begin(), answers.begin() + (answers.empty() ? 0 : 1));
    }
};

TEST(SmallRunMemoryGatewayErrors, TheFirstIsKept) {
    const Timebase time;
    FailingMemory memory("memory");
    MemoryPort port("port", time);
    MemoryGateway gateway("gateway");
    gateway.out.bind(memory.in);
    gateway.connect({{&port, {"records", StreamData::Own, ""}}});
    const Script script("script", [&] {
        Process process(time);
        const auto read = [&](const std::vector<tlm::tlm_response_status>& answers) {
            memory.answers = answers;
            for (std::size_t i = 0; i < 3; ++i) {
                port.read(process, 0, 32);
            }
        };
        using Status = tlm::tlm_response_status;
        read({Status::TLM_GENERIC_ERROR_RESPONSE, Status::TLM_ADDRESS_ERROR_RESPONSE});
        EXPECT_EQ(gateway.errors(), 2U);
        EXPECT_EQ(gateway.first_error(), Status::TLM_GENERIC_ERROR_RESPONSE);
        gateway.clear_errors();
        EXPECT_EQ(gateway.errors(), 0U);
        read({Status::TLM_OK_RESPONSE, Status::TLM_BURST_ERROR_RESPONSE});
        EXPECT_EQ(gateway.errors(), 1U);
        EXPECT_EQ(gateway.first_error(), Status::TLM_BURST_ERROR_RESPONSE);
    });
    sc_core::sc_start();
}

/// What reaches a target, in order.
struct Seen {
    std::uint64_t address = 0;
    unsigned int bytes = 0;
    bool extended = false; ///< with the extension that the target should not need
    friend bool operator==(const Seen& a, const Seen& b) {
        return std::tie(a.address, a.bytes, a.extended) == std::tie(b.address, b.bytes, b.extended);
    }
};

/// Answers at once; byte a of the memory is a / 16.
struct RecordingMemory : sc_core::sc_module {
    tlm_utils::simple_target_socket<RecordingMemory> in;
    std::vector<Seen> seen;
    explicit RecordingMemory(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in") {
        in.register_b_transport(this, &RecordingMemory::transport);
    }
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& /*delay*/) {
        seen.push_back({payload.get_address(), payload.get_data_length(),
                        payload.get_extension<Scattered>() != nullptr});
        for (unsigned int i = 0; i < payload.get_data_length() && payload.is_read(); ++i) {
            payload.get_data_ptr()[i] = ((payload.get_address() + i) / 16) & 0xFFU;
        }
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
    }
};

// Ordinary transactions at the addresses of the records; AT cuts them into bursts here.
TEST(SmallRunMemoryGatewayScattered, SendsOneOrdinaryTransactionPerRun) {
    const Timebase time;
    RecordingMemory lt_memory("lt_memory");
    AtMemory at_memory("at_memory", 4096);
    for (std::size_t i = 0; i < at_memory.bytes.size(); ++i) {
        at_memory.bytes[i] = i / 16 & 0xFFU;
    }
    MemoryGateway::Options four_phases;
    four_phases.transport = Transport::At;
    four_phases.burst_bytes = 32;
    MemoryGateway lt("lt", MemoryGateway::Options());
    MemoryGateway at("at", four_phases);
    MemoryPort lt_port("lt_port", time);
    MemoryPort at_port("at_port", time);
    lt.out.bind(lt_memory.in);
    at.out.bind(at_memory.in);
    std::vector<std::vector<std::uint64_t>> observed(2);
    MemoryGateway* const gateways[] = {&lt, &at};
    MemoryPort* const ports[] = {&lt_port, &at_port};
    for (std::size_t g = 0; g < 2; ++g) {
        gateways[g]->observe_scene(
            [&observed, g](std::uint64_t address, const unsigned char* data, std::uint64_t bytes) {
                observed[g].push_back(address);
                EXPECT_EQ(data[0], address / 16);
                EXPECT_EQ(data[bytes - 1], (address + bytes - 1) / 16);
            });
        gateways[g]->connect({{ports[g], {"sh", StreamData::Scene, ""}}});
    }
    const std::vector<std::uint32_t> numbers{40, 3, 7};
    ScatteredRecords records;
    records.base = 64;
    records.stride = records.bytes = 48; // 1984 to 2032, 208 to 256, 400 to 448
    records.numbers = numbers.data();
    records.count = numbers.size();
    const Script script("script", [&] {
        for (MemoryPort* port : ports) {
            Process process(time);
            port->read(process, records);
            port->write(process, 64, records);
        }
    });
    sc_core::sc_start();
    const std::vector<Seen> once{{1984, 48, false}, {208, 48, false}, {400, 48, false}};
    std::vector<Seen> expected = once;
    expected.insert(expected.end(), once.begin(), once.end());
    EXPECT_EQ(lt_memory.seen, expected);
    EXPECT_EQ(at_memory.requests, 12U) << "48 B are a burst of 32 B and 16 B, read and written";
    EXPECT_EQ(observed[0], (std::vector<std::uint64_t>{1984, 208, 400}));
    EXPECT_EQ(observed[1], (std::vector<std::uint64_t>{1984, 2016, 208, 224, 400, 416}));
    for (std::size_t g = 0; g < 2; ++g) {
        EXPECT_EQ(gateways[g]->total().bytes_read, 144U);
        EXPECT_EQ(gateways[g]->total().reads, 1U);
        EXPECT_EQ(gateways[g]->total().bytes_written, 144U);
    }
}

TEST_F(SmallRunMemoryGateway, CountsByInitiatorAndSaysThatItKnowsNoMore) {
    run([this](Process& process) {
        first.read(process, 64, 32);
        first.read(process, 96, 16);
        second.write(process, 256, 8);
    });
    EXPECT_EQ(gateway.traffic(0).reads, 2U);
    EXPECT_EQ(gateway.traffic(0).bytes_read, 48U);
    EXPECT_EQ(gateway.traffic(1).bytes_written, 8U);
    EXPECT_EQ(gateway.total().writes, 1U);
    EXPECT_EQ(gateway.peak_gb_per_s(), 0);
    ASSERT_EQ(gateway.explain().size(), 1U);
    EXPECT_NE(gateway.explain().front().find("belongs to the platform"), std::string::npos);
}

} // namespace
} // namespace degs::test
