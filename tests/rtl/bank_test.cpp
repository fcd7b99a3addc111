// SPDX-License-Identifier: Apache-2.0
// The RTL of an Issue Bank with its Packing Unit against logs of strict runs of trained scenes.
#include <systemc>
using sc_core::sc_time_stamp; // headers of Verilator want it where SystemC is in use

#include "Vbank_64.h"
#include "Vbank_64_select.h"
#include "Vbank_streams_select.h"
#include "Vbank_x_64.h"

#include "tests/rtl/bank_bench.hpp"

namespace degs::rtl_test {
namespace {

/// A view of a trained scene, and one of the banks.
struct View {
    const char* scene;
    const char* camera;
    const char* bank;
    const char* select_cycles = "0";
};
std::ostream& operator<<(std::ostream& out, const View& view) {
    return out << view.scene << " " << view.bank;
}

template <class Rtl>
void expect_same(const BankShape& shape, const char* design, const View& view) {
    const std::filesystem::path scene = sim_test::trained_scenes() / view.scene / "scene.ply";
    if (!std::filesystem::exists(scene)) {
        GTEST_SKIP() << "the trained scene " << view.scene << " is not in "
                     << sim_test::trained_scenes() << "; set DEGS_SCENES";
    }
    const sim_test::BlockLog log =
        sim_test::logged({"--scene", scene.string(), "--camera", view.camera, "--width", "810",
                          "--set", std::string("scheduler.select_cycles=") + view.select_cycles},
                         design, view.bank);
    BankBench<Rtl> bench(shape, log);
    const Compared done = bench.run();
    EXPECT_EQ(done.differences, 0U) << done.first;
    EXPECT_EQ(done.segments, log.count("issue"));
    std::cout << done.cycles << " cycles, " << done.tiles << " tiles, " << done.spans
              << " spans and ends of tiles, " << done.segments << " segments, " << done.packets
              << " packets, " << done.tasks << " tasks\n";
}

class Bank64 : public testing::TestWithParam<View> {};

TEST_P(Bank64, DoesInEveryCycleWhatTheModelDoes) {
    expect_same<Vbank_64>({1, 2, 8, 2, 8, 16, 2, 6, 8}, "degs-64", GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bank64,
                         testing::Values(View{"flowers", "2", "bank:0"},
                                         View{"st-peter", "2", "bank:3"},
                                         View{"guitar", "1", "bank:5"}));

class PipelinedBank64 : public testing::TestWithParam<View> {};

TEST_P(PipelinedBank64, DoesInEveryCycleWhatTheModelDoes) {
    expect_same<Vbank_64_select>({1, 2, 8, 2, 8, 16, 2, 6, 8}, "degs-64", GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, PipelinedBank64,
                         testing::Values(View{"flowers", "2", "bank:0", "2"}));

class BankX64 : public testing::TestWithParam<View> {};

TEST_P(BankX64, DoesInEveryCycleWhatTheModelDoes) {
    expect_same<Vbank_x_64>({2, 1, 8, 2, 8, 16, 2, 6, 8}, "degs-x-64", GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, BankX64,
                         testing::Values(View{"flowers", "2", "bank:0"},
                                         View{"st-peter", "2", "bank:3"},
                                         View{"guitar", "1", "bank:1"}));

class PipelinedBankOfStreams : public testing::TestWithParam<View> {};

TEST_P(PipelinedBankOfStreams, DoesInEveryCycleWhatTheModelDoes) {
    expect_same<Vbank_streams_select>({3, 1, 16, 4, 16, 16, 1, 6, 16}, "../tests/rtl/three-streams",
                                      GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, PipelinedBankOfStreams,
                         testing::Values(View{"st-peter", "2", "bank:3", "3"}));

} // namespace
} // namespace degs::rtl_test
