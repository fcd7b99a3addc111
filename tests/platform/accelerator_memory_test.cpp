// SPDX-License-Identifier: Apache-2.0
// The memory of the host that a simulation takes does not grow with its frames.
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <new>

#include "base/sanitizers.hpp"
#include "degs/design.hpp"
#include "tests/platform/accelerator_bench.hpp"

// bytes_in_use() counts what is allocated and not given back. Resident bytes would not do: they
// also depend on the allocator, and on the pages of the program that the operating system keeps.
#if DEGS_ADDRESS_SANITIZER
#include <sanitizer/allocator_interface.h>

namespace {
std::uint64_t bytes_in_use() {
    return __sanitizer_get_current_allocated_bytes();
}
} // namespace
#else
#include <malloc.h>

namespace {
std::atomic<std::uint64_t> allocated_bytes{0};
std::uint64_t bytes_in_use() {
    return allocated_bytes;
}

void* counted(void* memory) {
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    allocated_bytes += malloc_usable_size(memory);
    return memory;
}
void give_back(void* memory) noexcept {
    allocated_bytes -= malloc_usable_size(memory);
    std::free(memory);
}
} // namespace

// The forms for arrays, and those without exceptions, call these.
void* operator new(std::size_t size) {
    return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    give_back(memory);
}
#endif

namespace degs::test {
namespace {

/// A shipped design, perhaps changed.
struct KeptDesign {
    std::string name;
    std::vector<std::string> overrides;
    bool given_up = false; ///< some of the frames, by reset and by abort
};

class SmallRunMemory : public ::testing::TestWithParam<KeptDesign> {
protected:
    static constexpr int kFrames = 252, kFirst = 84;
    /// B; blocks of a std::deque come and go, while 168 frames that leave 32 B each are more.
    static constexpr std::uint64_t kMostGrowth = 4096;

    /// From views of one tile to views of many, from all splats to none. They repeat after 84
    /// frames, so that both counts are taken behind the same view.
    static Camera view(int frame) {
        Camera camera = test_camera(8 + 8 * (frame % 7), 8 + 12 * (frame % 4));
        camera.position.x += frame % 28 == 27 ? 100 : 0.5 * (frame % 3);
        return camera;
    }
    void render(Host& host, int frame) {
        program(host, cloud_, view(frame));
        if (GetParam().given_up && frame % 3 == 1) {
            host.write(Register::Control, kControlStart);
            sc_core::wait(sc_core::sc_time(50 * (frame % 17), sc_core::SC_NS));
            host.write(Register::Control, frame % 2 == 0 ? kControlReset : kControlAbort);
            while ((host.read(Register::Status) & (kStatusInReset | kStatusBusy)) != 0) {
            }
            host.write(Register::IrqStatus, kIrqDone | kIrqAborted);
        } else {
            EXPECT_TRUE(host.render());
        }
    }

    GaussianCloud cloud_ = test_cloud(7, 120, 0);
    void expect_stays();
};

void SmallRunMemory::expect_stays() {
    const Design design = load_design(std::string(DEGS_CONFIGS) + "/" + GetParam().name + ".yaml",
                                      GetParam().overrides);
    Platform p("accelerator", design.accelerator(), cloud_);
    const RenderJob& job = p.accelerator.core().job();
    std::uint64_t early = 0, late = 0;
    p.host.script = [&](Host& host) {
        for (int f = 0; f < kFrames; ++f) {
            render(host, f);
            ASSERT_LE(job.frames.size() - job.frames.first(), 2U) << "frame " << f;
            early = f + 1 == kFirst ? bytes_in_use() : early;
        }
        late = bytes_in_use();
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    EXPECT_EQ(job.frames.size(), std::size_t{kFrames});
    EXPECT_EQ(job.tiles.begin()->frame, job.frames.first());
    RecordProperty("early_bytes", std::to_string(early));
    RecordProperty("late_bytes", std::to_string(late));
    EXPECT_GT(early, 0U);
    EXPECT_LE(late, early + kMostGrowth);
}

TEST_P(SmallRunMemory, StaysOverManyFrames) {
    expect_stays();
}

/// The designs of the sizes that the core suite leaves out.
class LongMemory : public SmallRunMemory {};

TEST_P(LongMemory, StaysOverManyFrames) {
    expect_stays();
}

/// Becomes part of the test's name.
void PrintTo(const KeptDesign& design, std::ostream* out) {
    *out << design.name;
}

/// One of each accelerator, and the ways in which frames can leave something behind.
std::vector<KeptDesign> kept_designs() {
    return {{"degs-64", {}},
            {"gbu-64", {}},
            {"gcc-64", {}},
            {"gscore-64", {}},
            {"orange-o1", {}},
            {"degs-1024-streams", {}, true},
            {"degs-64", {}, true},
            {"gbu-256", {}, true},
            {"gcc-256", {}, true},
            {"gscore-256", {}, true},
            {"orange-o4", {}, true},
            {"degs-64", {"binning.keep_lists=true"}},
            {"degs-64",
             {"front.multicast_window=8", "front.fifo_splats=64", "front.cache_bytes=4KiB"}}};
}

std::vector<KeptDesign> other_designs() {
    std::vector<KeptDesign> designs;
    for (const auto& file : std::filesystem::directory_iterator(DEGS_CONFIGS)) {
        const std::string name = file.path().stem().string();
        const auto is_kept = [&name](const KeptDesign& kept) { return kept.name == name; };
        const std::vector<KeptDesign> kept = kept_designs();
        if (file.path().extension() == ".yaml" && std::none_of(kept.begin(), kept.end(), is_kept)) {
            designs.push_back({name, {}});
        }
    }
    std::sort(designs.begin(), designs.end(),
              [](const KeptDesign& a, const KeptDesign& b) { return a.name < b.name; });
    return designs;
}

std::string kept_name(const ::testing::TestParamInfo<KeptDesign>& info) {
    std::string name = info.param.name + (info.param.given_up ? "_given_up" : "");
    for (const std::string& key : info.param.overrides) {
        name += "_" + key.substr(0, key.find('='));
    }
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, SmallRunMemory, ::testing::ValuesIn(kept_designs()), kept_name);
INSTANTIATE_TEST_SUITE_P(Shipped, LongMemory, ::testing::ValuesIn(other_designs()), kept_name);

} // namespace
} // namespace degs::test
