// SPDX-License-Identifier: Apache-2.0
// Accesses that an IOMMU refuses wait for software, which maps their page or gives the frame up.
#include <algorithm>
#include <numeric>

#include "baselines/accelerators.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/driver_device.hpp"
#include "tests/platform/iommu.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

/// How the accelerator reaches its memory.
struct Bus {
    const char* name;
    Timing timing = Timing::Annotated;
    Transport transport = Transport::Lt;
    Pacing pacing = Pacing::Exact;
    unsigned outstanding = 64;
    std::uint64_t burst_bytes = 0;
    BurstEnds ends = BurstEnds::Pieces;
};

const Bus kBuses[] = {
    {"Immediate", Timing::Immediate},
    {"Annotated"},
    {"Blocking", Timing::Blocking},
    {"Ahead", Timing::Annotated, Transport::Lt, Pacing::Annotated},
    {"FullBursts", Timing::Annotated, Transport::Lt, Pacing::Exact, 64, 64, BurstEnds::FullBursts},
    {"FourPhases", Timing::Annotated, Transport::At},
    {"FourPhasesOfBursts", Timing::Annotated, Transport::At, Pacing::Exact, 64, 64,
     BurstEnds::FullBursts},
    {"OneInFlight", Timing::Annotated, Transport::At, Pacing::Exact, 1}};

AcceleratorOptions options_of(const Bus& bus) {
    AcceleratorOptions options;
    options.memory.transport = bus.transport;
    options.memory.pacing = bus.pacing;
    options.memory.outstanding = bus.outstanding;
    options.memory.burst_bytes = bus.burst_bytes;
    options.memory.burst_ends = bus.ends;
    options.memory.boundary_bytes = Iommu::kPage;
    options.memory.faults = RefusedAccess::Stall;
    return options;
}

/// An accelerator whose pages lie in a memory in any order. Of its regions every page exists, and a
/// part of them is mapped.
struct PagedPlatform {
    static constexpr std::uint64_t kPages = 256; ///< of the memory

    PagedPlatform(const std::string& name, const AcceleratorConfig& config, const Bus& bus,
                  unsigned seed)
        : platform(name.c_str(), config, cloud, nullptr, options_of(bus)),
          iommu((name + "_iommu").c_str()), random(seed) {
        platform.mem().bind(iommu.in);
        iommu.timing = bus.timing;
        iommu.allows = [](std::uint64_t address, RequestStream stream) {
            const bool load = stream == RequestStream::SceneLoad;
            const bool geometry = stream == RequestStream::Geometry ||
                                  stream == RequestStream::Means || stream == RequestStream::Shapes;
            return address < kSh          ? load || geometry
                   : address < kWorkspace ? load || stream == RequestStream::Sh
                   : address < kFrame     ? !load && !geometry && stream != RequestStream::Sh &&
                                            stream != RequestStream::FrameBuffer
                                      : stream == RequestStream::FrameBuffer;
        };
        const std::string memory = name + "_memory";
        if (bus.transport == Transport::At) {
            at = std::make_unique<AtMemory>(memory.c_str(), kPages * Iommu::kPage);
            iommu.out.bind(at->in);
        } else {
            lt = std::make_unique<PlainMemory>(memory.c_str(), kPages * Iommu::kPage, bus.timing);
            iommu.out.bind(lt->in);
        }
        map_regions();
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        put(0, geometry);
        put(kSh, sh);
    }
    void map_regions() {
        std::vector<std::uint64_t> free(kPages);
        std::iota(free.begin(), free.end(), 0);
        std::shuffle(free.begin(), free.end(), random);
        const std::uint64_t regions[][2] = {{0, cloud.size() * 44},
                                            {kSh, cloud.size() * 48},
                                            {kWorkspace, kWorkspaceBytes},
                                            {kFrame, camera.pixels() * 4}};
        for (const auto& [begin, bytes] : regions) {
            for (std::uint64_t a = begin; a < begin + bytes; a += Iommu::kPage) {
                iommu.pages[a / Iommu::kPage].physical = free.back();
                iommu.pages[a / Iommu::kPage].mapped = random() % 2 == 0;
                used.insert(free.back());
                free.pop_back();
            }
        }
    }
    std::vector<unsigned char>& bytes() { return at ? at->bytes : lt->bytes; }
    unsigned char& byte(std::uint64_t address) {
        return bytes()[iommu.pages.at(address / Iommu::kPage).physical * Iommu::kPage +
                       address % Iommu::kPage];
    }
    void put(std::uint64_t address, const std::vector<unsigned char>& data) {
        for (std::size_t i = 0; i < data.size(); ++i) {
            byte(address + i) = data[i];
        }
    }
    std::vector<unsigned char> pixels() {
        std::vector<unsigned char> all(camera.pixels() * 4);
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i] = byte(kFrame + i);
        }
        return all;
    }
    /// Nothing was written to pages that belong to nobody.
    void expect_rest_untouched() {
        for (std::uint64_t page = 0; page < kPages; ++page) {
            const auto begin = bytes().begin() + static_cast<std::ptrdiff_t>(page * Iommu::kPage);
            EXPECT_TRUE(used.count(page) != 0 ||
                        std::all_of(begin, begin + Iommu::kPage,
                                    [](unsigned char byte) { return byte == 0xA5; }));
        }
    }
    /// Until a frame has ended, calls `on_fault` for every access that has faulted, and lets it go
    /// out again. Returns the interrupts that ended it.
    std::uint32_t run_frame(Host& host, const std::function<void(const degs_fault&)>& on_fault) {
        const degs_device device = device_of(host);
        program(host, cloud, camera);
        degs_start(&device, DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR | DEGS_IRQ_ENABLE_ABORTED |
                                DEGS_IRQ_ENABLE_FAULT);
        for (;;) {
            const std::uint32_t cause = await_interrupt(host);
            degs_fault fault{};
            while (degs_read_fault(&device, &fault) != 0) {
                EXPECT_EQ(fault.answer, 1U);
                on_fault(fault);
                ++shown;
                degs_resume(&device);
            }
            if ((cause & ~DEGS_IRQ_STATUS_FAULT) != 0) {
                return cause & ~DEGS_IRQ_STATUS_FAULT;
            }
        }
    }
    static std::uint32_t await_interrupt(Host& host) {
        while (!host.irq.read()) {
            sc_core::wait(host.irq.value_changed_event());
        }
        const degs_device device = device_of(host);
        return degs_acknowledge(&device);
    }
    void map(const degs_fault& fault) {
        iommu.pages.at(fault.address / Iommu::kPage).mapped = true;
    }
    void map_all() {
        for (auto& page : iommu.pages) {
            page.second.mapped = true;
        }
    }
    void unmap_all() {
        for (auto& page : iommu.pages) {
            page.second.mapped = false;
        }
    }
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    Platform platform;
    Iommu iommu;
    std::mt19937 random;
    std::set<std::uint64_t> used; ///< pages of the memory
    unsigned shown = 0;           ///< faults that software has seen
    std::unique_ptr<AtMemory> at;
    std::unique_ptr<PlainMemory> lt;
};

class SmallRunAccessFault : public ::testing::TestWithParam<Bus> {
protected:
    DegsConfig config;
    void run(Host& host, const std::function<void(Host&)>& script) {
        host.script = script;
        sc_core::sc_start();
        EXPECT_TRUE(host.finished);
    }
};

// Each transaction to a page that is not mapped faults once.
TEST_P(SmallRunAccessFault, MappedPagesLetTheFrameGoOn) {
    PagedPlatform paged("paged", config, GetParam(), 21);
    Platform plain("plain", config, paged.cloud);
    plain.host.script = [&](Host& host) {
        program(host, paged.cloud, paged.camera);
        EXPECT_TRUE(host.render());
    };
    std::set<std::pair<std::uint64_t, std::uint32_t>> faults;
    run(paged.platform.host, [&](Host& host) {
        const auto on_fault = [&](const degs_fault& fault) {
            EXPECT_TRUE(faults.insert({fault.address, fault.stream}).second) << fault.address;
            paged.map(fault);
        };
        EXPECT_EQ(paged.run_frame(host, on_fault), DEGS_IRQ_STATUS_DONE);
        EXPECT_EQ(host.read(Register::Status), kStatusDone);
    });
    EXPECT_TRUE(plain.host.finished);
    EXPECT_EQ(paged.pixels(), plain.frame(paged.camera));
    EXPECT_GT(paged.shown, 5U);
    EXPECT_EQ(paged.shown, paged.iommu.refused);
    paged.expect_rest_untouched();
}

// Pages come and go while the frame runs, after a first one without any.
TEST_P(SmallRunAccessFault, PagesMayComeAndGo) {
    PagedPlatform paged("paged", config, GetParam(), 22);
    Platform plain("plain", config, paged.cloud);
    plain.host.script = [&](Host& host) {
        program(host, paged.cloud, paged.camera);
        EXPECT_TRUE(host.render());
    };
    run(paged.platform.host, [&](Host& host) {
        for (int i = 0; i < 2; ++i) {
            paged.unmap_all();
            EXPECT_EQ(paged.run_frame(host,
                                      [&](const degs_fault& fault) {
                                          if (paged.random() % 3 == 0) {
                                              auto page = paged.iommu.pages.begin();
                                              std::advance(page, paged.random() %
                                                                     paged.iommu.pages.size());
                                              page->second.mapped = false;
                                          }
                                          paged.map(fault);
                                      }),
                      DEGS_IRQ_STATUS_DONE);
        }
        EXPECT_EQ(host.read(Register::Frames), 2U);
    });
    EXPECT_EQ(paged.pixels(), plain.frame(paged.camera));
    EXPECT_EQ(paged.shown, paged.iommu.refused);
    paged.expect_rest_untouched();
}

// At a stop of either kind, while the scene is loaded and while the frame is drawn; the frame after
// it is whole.
TEST_P(SmallRunAccessFault, AStopEndsTheWait) {
    PagedPlatform paged("paged", config, GetParam(), 23);
    Platform plain("plain", config, paged.cloud);
    plain.host.script = [&](Host& host) {
        program(host, paged.cloud, paged.camera);
        EXPECT_TRUE(host.render());
    };
    run(paged.platform.host, [&](Host& host) {
        const degs_device device = device_of(host);
        for (const bool drawing : {false, true}) {
            for (const bool reset : {false, true}) {
                paged.unmap_all();
                for (auto& [number, page] : paged.iommu.pages) {
                    page.mapped = drawing && number * Iommu::kPage < kWorkspace;
                }
                program(host, paged.cloud, paged.camera);
                degs_start(&device, DEGS_IRQ_ENABLE_ABORTED | DEGS_IRQ_ENABLE_FAULT);
                EXPECT_EQ(paged.await_interrupt(host), DEGS_IRQ_STATUS_FAULT);
                sc_core::wait(sc_core::sc_time(500, sc_core::SC_NS)); // more of them
                degs_fault fault{};
                EXPECT_EQ(degs_read_fault(&device, &fault), 1);
                EXPECT_EQ(fault.address < kWorkspace, !drawing);
                EXPECT_EQ(fault.stream == DEGS_FAULT_STREAM_SCENE_LOAD, !drawing);
                EXPECT_EQ(degs_busy(&device), 1);
                const unsigned before = paged.iommu.refused;
                if (reset) {
                    EXPECT_EQ(degs_reset(&device, 1'000'000), DEGS_ERROR_CODE_NONE);
                    EXPECT_EQ(host.read(Register::Status), 0U);
                    EXPECT_EQ(host.read_pair(Register::FaultAddress), 0U);
                } else {
                    host.write(Register::Control, kControlAbort | kControlResume);
                    EXPECT_EQ(degs_read_fault(&device, &fault), 0);
                    EXPECT_EQ(paged.await_interrupt(host), DEGS_IRQ_STATUS_ABORTED);
                    EXPECT_EQ(host.read(Register::Status), kStatusAborted);
                }
                degs_resume(&device); // of nothing
                EXPECT_EQ(paged.iommu.refused, before);
                EXPECT_EQ(degs_read_fault(&device, &fault), 0);
            }
        }
        paged.map_all();
        EXPECT_EQ(paged.run_frame(host, [&](const degs_fault&) { ADD_FAILURE(); }),
                  DEGS_IRQ_STATUS_DONE);
        EXPECT_EQ(host.read_pair(Register::FaultAddress), 0U);
    });
    EXPECT_EQ(paged.pixels(), plain.frame(paged.camera));
    paged.expect_rest_untouched();
}

INSTANTIATE_TEST_SUITE_P(On, SmallRunAccessFault, ::testing::ValuesIn(kBuses),
                         [](const ::testing::TestParamInfo<Bus>& bus) { return bus.param.name; });

class SmallRunAccessFaultOf : public ::testing::TestWithParam<const char*> {};

// Every accelerator, in both transports.
TEST_P(SmallRunAccessFaultOf, LeavesTheImageOfAPlainMemory) {
    std::unique_ptr<AcceleratorConfig> config;
    for (const AcceleratorKind& each : accelerator_kinds()) {
        config = each.name == std::string(GetParam()) ? each.make() : std::move(config);
    }
    PagedPlatform lt("lt", *config, kBuses[1], 24);
    PagedPlatform at("at", *config, kBuses[5], 25);
    Platform plain("plain", *config, lt.cloud);
    plain.host.script = [&](Host& host) {
        program(host, lt.cloud, lt.camera);
        EXPECT_TRUE(host.render());
    };
    for (PagedPlatform* paged : {&lt, &at}) {
        paged->platform.host.script = [paged](Host& host) {
            EXPECT_EQ(paged->run_frame(host, [&](const degs_fault& fault) { paged->map(fault); }),
                      DEGS_IRQ_STATUS_DONE);
        };
    }
    sc_core::sc_start();
    for (PagedPlatform* paged : {&lt, &at}) {
        EXPECT_TRUE(paged->platform.host.finished);
        EXPECT_EQ(paged->pixels(), plain.frame(paged->camera));
        EXPECT_GT(paged->shown, 2U);
        paged->expect_rest_untouched();
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SmallRunAccessFaultOf,
                         ::testing::Values("gscore", "gbu", "gcc", "orange"),
                         [](const ::testing::TestParamInfo<const char*>& kind) {
                             return kind.param;
                         });

} // namespace
} // namespace degs::test
