// SPDX-License-Identifier: Apache-2.0
// The waveform that Accelerator::trace() writes, read back.
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

using Changes = std::vector<std::pair<std::uint64_t, std::uint64_t>>; // time in ps, value

/// Changes per variable, by its name in its scope, of a value change dump in units of 1 ps.
std::map<std::string, Changes> read_vcd(const std::string& path) {
    std::ifstream file(path);
    std::map<std::string, std::string> names; // by identifier
    std::map<std::string, Changes> changes;
    std::uint64_t time = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        if (first == "$var") {
            std::string type, bits, identifier, name;
            words >> type >> bits >> identifier >> name;
            names[identifier] = name;
        } else if (first[0] == '#') {
            time = std::stoull(first.substr(1));
        } else if (first[0] == 'b') {
            std::string identifier;
            words >> identifier;
            changes[names[identifier]].emplace_back(time, std::stoull(first.substr(1), nullptr, 2));
        } else if (first[0] == '0' || first[0] == '1') {
            changes[names[first.substr(1)]].emplace_back(time, first[0] - '0');
        }
    }
    return changes;
}

TEST(SmallRunTrace, ShowsAFrameAnAbortAndAReset) {
    const GaussianCloud cloud = test_cloud();
    Platform p("p", DegsConfig(), cloud);
    const std::string path = ::testing::TempDir() + "accelerator_trace_test";
    sc_core::sc_trace_file* const file = sc_core::sc_create_vcd_trace_file(path.c_str());
    file->set_time_unit(1, sc_core::SC_PS);
    p.accelerator.trace(file);
    std::uint64_t cycles = 0;
    Changes dates; // of the starts and of the ends of the busy times
    const auto now = [] { return sc_core::sc_time_stamp().value(); };
    p.host.script = [&](Host& host) {
        program(host, cloud, test_camera());
        host.write(Register::IrqEnable, kIrqDone | kIrqAborted);
        const std::uint64_t start = now();
        host.write(Register::Control, kControlStart);
        sc_core::wait(p.irq.posedge_event());
        dates.emplace_back(start, now());
        cycles = host.read_pair(Register::Cycles);
        host.write(Register::IrqStatus, kIrqDone);
        const std::uint64_t second = now();
        host.write(Register::Control, kControlStart);
        sc_core::wait(sc_core::sc_time(300, sc_core::SC_NS));
        host.write(Register::Control, kControlAbort);
        sc_core::wait(p.irq.posedge_event());
        dates.emplace_back(second, now());
        sc_core::wait(sc_core::sc_time(5, sc_core::SC_NS));
        host.write(Register::Control, kControlReset);
        sc_core::wait(sc_core::sc_time(100, sc_core::SC_NS));
    };
    sc_core::sc_start();
    sc_core::sc_close_vcd_trace_file(file);
    ASSERT_TRUE(p.host.finished);
    std::map<std::string, Changes> vcd = read_vcd(path + ".vcd");
    ASSERT_EQ(std::remove((path + ".vcd").c_str()), 0);
    const Changes busy{{0, 0},
                       {dates[0].first, 1},
                       {dates[0].second, 0},
                       {dates[1].first, 1},
                       {dates[1].second, 0}};
    EXPECT_EQ(vcd["busy"], busy);
    ASSERT_EQ(vcd["irq"].size(), 5U);
    EXPECT_EQ(vcd["irq"][1], (Changes::value_type{dates[0].second, 1}));
    EXPECT_EQ(vcd["irq"][3], (Changes::value_type{dates[1].second, 1}));
    ASSERT_EQ(vcd["in_reset"].size(), 3U);
    EXPECT_EQ(vcd["in_reset"][1].first, vcd["irq"][4].first); // the reset clears it
    std::vector<std::uint64_t> statuses;
    for (const auto& change : vcd["status"]) {
        statuses.push_back(change.second);
    }
    EXPECT_EQ(statuses, (std::vector<std::uint64_t>{0, kStatusBusy, kStatusDone, kStatusBusy,
                                                    kStatusAborted, kStatusInReset, 0}));
    const Changes frames{{0, 0}, {dates[0].second, 1}, {vcd["in_reset"][1].first, 0}};
    EXPECT_EQ(vcd["frames"], frames);
    ASSERT_EQ(vcd["cycles"].size(), 3U); // 0, the frame, 0 again
    EXPECT_EQ(vcd["cycles"][1], (Changes::value_type{dates[0].second, cycles}));
}

} // namespace
} // namespace degs::test
