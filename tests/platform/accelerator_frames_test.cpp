// SPDX-License-Identifier: Apache-2.0
// Whether the cycles of a frame depend on what was rendered before it.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>

#include "degs/design.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/busy_memory.hpp"

namespace degs::test {
namespace {

/// What happens between two frames.
enum class Between { Nothing, Reset, AnotherView };

/// A memory with a queue, which answers in another order of dates if one access moves.
struct QueuePlatform : Platform {
    QueuePlatform(const AcceleratorConfig& config, const GaussianCloud& cloud)
        : Platform("accelerator", config, cloud, nullptr), queue("queue", kMemoryBytes, 1) {
        mem().bind(queue.in[0]);
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), queue.bytes.begin());
        std::copy(sh.begin(), sh.end(), queue.bytes.begin() + kSh);
    }
    BusyMemory queue;
};

/// A shipped design, or one with ports of SRAM, of which one access depends on another.
struct Changed {
    std::string name;
    std::vector<std::string> overrides;
    bool keeps_lists() const {
        return overrides == std::vector<std::string>{"binning.keep_lists=true"};
    }
};
using Case = std::tuple<Changed, Between>;

class SmallRunFrames : public ::testing::TestWithParam<Case> {};

TEST_P(SmallRunFrames, TakeTheSameCyclesWhateverCameBefore) {
    const auto& [changed, between] = GetParam();
    constexpr int kFrames = 6;
    const GaussianCloud cloud = test_cloud();
    const Camera camera = test_camera();
    const Design design =
        load_design(std::string(DEGS_CONFIGS) + "/" + changed.name + ".yaml", changed.overrides);
    QueuePlatform p(design.accelerator(), cloud);
    std::vector<std::uint64_t> cycles;
    p.host.script = [&, what = between](Host& host) {
        for (int f = 0; f < kFrames; ++f) {
            if (f > 0 && what == Between::Reset) {
                host.write(Register::Control, kControlReset);
                while ((host.read(Register::Status) & kStatusInReset) != 0) {
                }
            } else if (f > 0 && what == Between::AnotherView) {
                Camera narrow = camera;
                narrow.width = 8 * f;
                program(host, cloud, narrow);
                EXPECT_TRUE(host.render());
            }
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles.push_back(host.read_pair(Register::Cycles));
        }
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    if (changed.keeps_lists() && between == Between::Nothing) {
        EXPECT_THAT(std::vector(cycles.begin() + 1, cycles.end()),
                    ::testing::Each(::testing::Lt(cycles.front())));
    } else {
        EXPECT_THAT(cycles, ::testing::Each(cycles.front()));
    }
}

std::vector<Changed> designs() {
    std::vector<Changed> names;
    for (const auto& file : std::filesystem::directory_iterator(DEGS_CONFIGS)) {
        if (file.path().extension() == ".yaml") {
            names.push_back({file.path().stem().string(), {}});
        }
    }
    std::sort(names.begin(), names.end(),
              [](const Changed& a, const Changed& b) { return a.name < b.name; });
    for (const char* name : {"degs-64", "degs-64-tuned", "degs-x-64"}) {
        names.push_back({name,
                         {"feature_buffer.ports=1", "pixel_buffer.ports=2",
                          "gaussian_buffer.ports=1", "packing.ports=1", "span_buffer.ports=1"}});
    }
    // It takes less time for a frame if the one before has left lists, unless there was a reset.
    names.push_back({"degs-64", {"binning.keep_lists=true"}});
    return names;
}

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
    constexpr const char* kBetween[] = {"", "_AfterReset", "_AfterOtherViews"};
    const Changed& changed = std::get<0>(info.param);
    std::string name = changed.name +
                       (changed.overrides.empty() ? ""
                        : changed.keeps_lists()   ? "_keeping"
                                                  : "_ports") +
                       kBetween[static_cast<int>(std::get<1>(info.param))];
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, SmallRunFrames,
                         ::testing::Combine(::testing::ValuesIn(designs()),
                                            ::testing::Values(Between::Nothing, Between::Reset,
                                                              Between::AnotherView)),
                         case_name);

} // namespace
} // namespace degs::test
