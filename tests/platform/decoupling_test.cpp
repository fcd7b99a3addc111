// SPDX-License-Identifier: Apache-2.0
// What accesses that are annotated ahead of the kernel change in the time of a frame, on memories
// that serve in the order of the calls or of the dates: prints a table of docs/accelerator.md.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <tlm_utils/tlm_quantumkeeper.h>

#include "degs/date_sorter.hpp"
#include "dram/lpddr5.hpp"
#include "modules/degs/config.hpp"
#include "scene/scene.hpp"
#include "tests/dram/fixture.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/busy_memory.hpp"

namespace degs::test {
namespace {

constexpr std::uint64_t kPictureSh = 4U << 20U, kPictureWorkspace = 16U << 20U;
constexpr std::uint64_t kPictureFrame = 56U << 20U, kPictureMemory = 64U << 20U;

/// A processor that reads 64 B every 100 ns of its own time while a frame is rendered. It waits for
/// each line, or runs ahead of the kernel by up to a quantum.
class Processor : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<Processor> out;
    sc_core::sc_event begin;
    bool decoupled = false, rendering = false;

    explicit Processor(const sc_core::sc_module_name& name) : sc_core::sc_module(name), out("out") {
        DEGS_HAS_PROCESS(Processor);
        SC_THREAD(run);
    }

private:
    void run() {
        for (;;) {
            sc_core::wait(begin);
            keeper_.reset();
            while (rendering) {
                keeper_.inc(sc_core::sc_time(100, sc_core::SC_NS));
                synchronize();
                read_line();
                synchronize();
            }
        }
    }
    void synchronize() {
        if (!decoupled || keeper_.need_sync()) {
            keeper_.sync();
        }
    }
    void read_line() {
        std::array<unsigned char, 64> line{};
        tlm::tlm_generic_payload payload;
        payload.set_command(tlm::TLM_READ_COMMAND);
        payload.set_address(0);
        payload.set_data_ptr(line.data());
        payload.set_data_length(line.size());
        payload.set_streaming_width(line.size());
        sc_core::sc_time ahead = keeper_.get_local_time();
        out->b_transport(payload, ahead);
        keeper_.set(ahead);
    }
    tlm_utils::tlm_quantumkeeper keeper_;
};

struct Picture {
    GaussianCloud cloud;
    Camera camera;
};

/// In which order a memory serves.
enum class Order { Calls, Dates };

/// An accelerator and a processor that share a memory, perhaps behind a sorter, for many frames.
class SharedMemory {
public:
    SharedMemory(const std::string& name, Pacing pacing, Order order, bool sorted)
        : platform_(name.c_str(), DegsConfig(), {}, nullptr, paced(pacing)),
          processor_((name + "_processor").c_str()) {
        if (sorted) {
            sorter_ = std::make_unique<DateSorter<>>((name + "_sorter").c_str(), 2);
        }
        const std::size_t sockets = sorted ? 1 : 2;
        if (order == Order::Calls) {
            busy_ = std::make_unique<BusyMemory>((name + "_busy").c_str(), kPictureMemory, sockets);
            connect(busy_->in);
        } else {
            dram_ = std::make_unique<dram::Lpddr5>(
                (name + "_dram").c_str(), lpddr5_config("lpddr5-6400x256"), time_, sockets);
            connect(dram_->in);
        }
        platform_.host.script = [this](Host& host) {
            for (;;) {
                sc_core::wait(turn_);
                render(host);
                sc_core::sc_pause();
            }
        };
    }
    /// Cycles of a frame.
    double cycles(const Picture& picture, bool decoupled) {
        picture_ = &picture;
        processor_.decoupled = decoupled;
        turn_.notify(sc_core::SC_ZERO_TIME);
        sc_core::sc_start();
        sc_core::sc_start(sc_core::sc_time(20, sc_core::SC_MS)); // all that was annotated is over
        return cycles_;
    }

private:
    static Accelerator::Options paced(Pacing pacing) {
        Accelerator::Options options;
        options.memory.pacing = pacing;
        return options;
    }
    template <class Sockets>
    void connect(Sockets& memory) {
        if (sorter_) {
            platform_.mem().bind(sorter_->in[0]);
            processor_.out.bind(sorter_->in[1]);
            sorter_->out.bind(memory[0]);
        } else {
            platform_.mem().bind(memory[0]);
            processor_.out.bind(memory[1]);
        }
    }
    void put(std::uint64_t address, std::vector<unsigned char>& data) {
        tlm::tlm_generic_payload payload;
        payload.set_command(tlm::TLM_WRITE_COMMAND);
        payload.set_address(address);
        payload.set_data_ptr(data.data());
        payload.set_data_length(static_cast<unsigned>(data.size()));
        EXPECT_EQ(platform_.accelerator.mem->transport_dbg(payload), data.size());
    }
    void render(Host& host) {
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(picture_->cloud, geometry, sh);
        ASSERT_LE(kPictureSh + sh.size(), kPictureWorkspace);
        put(0, geometry);
        put(kPictureSh, sh);
        program(host, picture_->cloud, picture_->camera, kPictureFrame);
        host.write_pair(Register::Sh, kPictureSh);
        host.write_pair(Register::Workspace, kPictureWorkspace);
        host.write_pair(Register::WorkspaceBytes, kPictureFrame - kPictureWorkspace);
        processor_.rendering = true;
        processor_.begin.notify(sc_core::SC_ZERO_TIME);
        EXPECT_TRUE(host.render()) << "error " << host.read(Register::ErrorCode);
        processor_.rendering = false;
        cycles_ = static_cast<double>(host.read_pair(Register::Cycles));
    }
    const Timebase time_;
    Platform platform_;
    Processor processor_;
    std::unique_ptr<DateSorter<>> sorter_;
    std::unique_ptr<BusyMemory> busy_; // one of these
    std::unique_ptr<dram::Lpddr5> dram_;
    sc_core::sc_event turn_;
    const Picture* picture_ = nullptr;
    double cycles_ = 0;
};

/// Five frames that anybody can make. Their width decides how long they take, and the number of
/// splats how much of their time the memory is busy.
std::vector<Picture> five_pictures(int width, const std::string& gaussians) {
    std::vector<Picture> all;
    for (const auto& [profile, camera] : std::vector<std::pair<std::string, int>>{
             {"object", 1}, {"outdoor", 0}, {"uniform", 0}, {"landscape", 0}, {"garden", 0}}) {
        const Scene scene = load_scene("synthetic:" + profile + ",gaussians=" + gaussians);
        all.push_back({scene.cloud, select_camera(scene, camera).scaled_to_width(width)});
    }
    return all;
}

/// How the accelerator and, if it is decoupled, the processor run ahead of the kernel.
struct Style {
    std::string name;
    Pacing pacing;
    int quantum_ns;
};
const std::vector<Style> kAhead = {{"`Exact`", Pacing::Exact, 10000},
                                   {"`Quantum`", Pacing::Quantum, 100},
                                   {"`Quantum`", Pacing::Quantum, 1000},
                                   {"`Quantum`", Pacing::Quantum, 10000},
                                   {"`Annotated`", Pacing::Annotated, 10000}};

void set_quantum(int quantum_ns) {
    tlm::tlm_global_quantum::instance().set(sc_core::sc_time(quantum_ns, sc_core::SC_NS));
}

/// Cycles of several frames, each over those of `Exact` with the same memory and without a quantum.
struct Range {
    double least = 1e9, most = 0;
    double host = 0; ///< seconds of the host's processor
};

/// The platforms of every pacing on one memory, with the sorter and without.
class Platforms {
public:
    Platforms(Order order, const std::vector<Picture>& pictures) : pictures_(pictures) {
        set_quantum(1); // so that no platform warns of a missing one
        for (const bool sorted : {false, true}) {
            for (const Pacing pacing : {Pacing::Exact, Pacing::Quantum, Pacing::Annotated}) {
                of_[{sorted, pacing}] = std::make_unique<SharedMemory>(
                    std::string(order == Order::Calls ? "calls" : "dates") +
                        (sorted ? "_sorted_" : "_") + std::to_string(static_cast<int>(pacing)),
                    pacing, order, sorted);
            }
        }
    }
    /// Comes before measure(), when the simulation has begun.
    void measure_exact() {
        set_quantum(0);
        for (const Picture& picture : pictures_) {
            exact_.push_back(of_.at({false, Pacing::Exact})->cycles(picture, false));
            EXPECT_GT(exact_.back(), 1000);
        }
    }
    /// With a processor that waits, one that is decoupled, or one after the other.
    Range measure(bool sorted, const Style& style, const std::vector<bool>& decoupled) {
        set_quantum(style.quantum_ns);
        Range range;
        const std::clock_t begin = std::clock();
        for (const bool ahead : decoupled) {
            for (std::size_t i = 0; i < pictures_.size(); ++i) {
                const double ratio =
                    of_.at({sorted, style.pacing})->cycles(pictures_[i], ahead) / exact_[i];
                range.least = std::min(range.least, ratio);
                range.most = std::max(range.most, ratio);
            }
        }
        range.host = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        return range;
    }

private:
    const std::vector<Picture>& pictures_;
    std::map<std::pair<bool, Pacing>, std::unique_ptr<SharedMemory>> of_;
    std::vector<double> exact_;
};

void expect_exact(const Range& range, const Style& style) {
    EXPECT_GT(range.least, 0.98) << style.name << " " << style.quantum_ns;
    EXPECT_LT(range.most, 1.02) << style.name << " " << style.quantum_ns;
}

TEST(DecouplingOfSmallFrames, ChangesLittleBehindASorter) {
    const std::vector<Picture> pictures = five_pictures(160, "2000");
    Platforms platforms(Order::Calls, pictures);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    platforms.measure_exact();
    for (const Style& style : kAhead) {
        expect_exact(platforms.measure(true, style, {false, true}), style);
    }
    // What the sorter is for.
    EXPECT_GT(platforms.measure(false, kAhead.front(), {true}).least, 2);
}

void print(const Range& range) {
    std::printf(" | %.2f to %.2f", range.least, range.most);
}

// Takes a minute; docs/accelerator.md names the command.
TEST(DecouplingTable, DISABLED_OfFiveFrames) {
    const std::vector<Picture> pictures = five_pictures(320, "20000");
    Platforms calls(Order::Calls, pictures);
    Platforms dates(Order::Dates, pictures);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    calls.measure_exact();
    dates.measure_exact();
    const Style exact{"`Exact`", Pacing::Exact, 0};
    std::vector<Style> styles = kAhead;
    styles.insert(styles.begin(), exact);
    const double host = calls.measure(false, exact, {false}).host;
    for (const Style& style : styles) {
        std::printf("| %s | %d", style.name.c_str(), style.quantum_ns);
        const Range waits = calls.measure(false, style, {false});
        print(waits);
        print(calls.measure(false, style, {true}));
        print(dates.measure(false, style, {false, true}));
        const Range sorted = calls.measure(true, style, {false});
        const Range both = calls.measure(true, style, {false, true});
        print(both);
        expect_exact(both, style);
        print(dates.measure(true, style, {false, true}));
        std::printf(" | %.2f | %.2f |\n", waits.host / host, sorted.host / host);
    }
}

} // namespace
} // namespace degs::test
