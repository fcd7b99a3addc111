// SPDX-License-Identifier: Apache-2.0
// Random sequences of frames on one accelerator: each ends as it does alone on a fresh one, and
// shows what a closed job of the same design draws. Nothing of a frame reaches the next one.
#include <algorithm>
#include <tuple>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "degs/design.hpp"
#include "tests/platform/reset_platform.hpp"
#include "tests/platform/views_bench.hpp"
#include "tests/random/dice.hpp"

namespace degs::test {
namespace {

using trials::Dice;

/// What happens to a frame.
enum class Fate {
    Drawn,
    BadSize,
    BadCamera,
    BadWindow,
    Misaligned,
    SmallWorkspace,
    LoadError,
    BusError,
    SceneChanged,
    Aborted,
    Reset,
    HeldInReset
};

/// All that a host says of a frame, and what happens meanwhile.
struct Deed {
    GaussianCloud cloud;
    std::vector<RequestedView> views; ///< one or several in a table, or that of the registers
    bool in_table = false;
    glm::ivec2 origin{0}; ///< as the registers say it
    FrameFormat format = FrameFormat::Rgba8;
    std::uint64_t workspace = kWorkspace, frame = kFrame;
    Fate fate = Fate::Drawn;
    double stop_ns = 0;        ///< from the start
    bool writes_window = true; ///< else registers have it from their reset

    int pixel_bytes() const { return format == FrameFormat::Rgba8 ? 4 : 8; }
    const Camera& camera() const { return views.front().camera; }
};

/// What a host, and whoever looks into memory, sees of a frame at its end.
struct Outcome {
    std::vector<std::uint32_t> words; ///< STATUS, ERROR_CODE, ERROR_DETAIL, IRQ_STATUS, new frames
    std::vector<std::uint64_t> counters; ///< workspace, fragments, cycles of loading, dropped
    std::vector<std::uint64_t> traffic;  ///< cycles, bytes read and written, cycles of views
    std::vector<SeenView> views;         ///< but for their cycles
    std::vector<unsigned char> pixels;   ///< and all memory behind them
};

Outcome outcome_of(Host& host, ResetPlatform& p, std::uint32_t frames_before) {
    Outcome seen;
    for (const Register word :
         {Register::Status, Register::ErrorCode, Register::ErrorDetail, Register::IrqStatus}) {
        seen.words.push_back(host.read(word));
    }
    seen.words.push_back(host.read(Register::Frames) - frames_before);
    for (const Register pair :
         {Register::WorkspaceNeeded, Register::Fragments, Register::LoadCycles}) {
        seen.counters.push_back(host.read_pair(pair));
    }
    seen.counters.push_back(host.read(Register::Dropped));
    for (const Register pair : {Register::Cycles, Register::BytesRead, Register::BytesWritten}) {
        seen.traffic.push_back(host.read_pair(pair));
    }
    seen.views = seen_views(host);
    for (SeenView& view : seen.views) {
        seen.traffic.push_back(std::exchange(view.cycles, 0));
    }
    seen.pixels.assign(p.bytes().begin() + kFrame, p.bytes().end());
    return seen;
}

void put(const Deed& deed, ResetPlatform& p) {
    std::vector<unsigned char> geometry;
    std::vector<unsigned char> sh;
    encode_scene(deed.cloud, geometry, sh);
    std::fill(p.bytes().begin(), p.bytes().end(), ResetPlatform::kErased);
    std::copy(geometry.begin(), geometry.end(), p.bytes().begin());
    std::copy(sh.begin(), sh.end(), p.bytes().begin() + kSh);
    std::uint64_t& refused = p.at ? p.at->refused_from : p.memory->refused_from;
    refused = deed.fate == Fate::LoadError  ? 64
              : deed.fate == Fate::BusError ? deed.frame + 128
                                            : ~std::uint64_t{0};
    if (p.memory) {
        const std::uint64_t first = p.memory->accesses + 1;
        p.memory->on_access = [&p, first,
                               changes = deed.fate == Fate::SceneChanged](std::uint64_t access) {
            p.memory->bytes[100] ^= changes && access == first ? 1 : 0;
        };
    }
}

/// The views of a frame, with what is wrong about one of them.
std::vector<RequestedView> views_of(const Deed& deed) {
    std::vector<RequestedView> views = deed.views;
    switch (deed.fate) {
    case Fate::BadSize:
        views.back().camera.height = 0;
        break;
    case Fate::BadCamera:
        views.back().camera.fy = -1;
        break;
    case Fate::BadWindow:
        views.back().camera.shift.x = 1e7;
        break;
    case Fate::Misaligned:
        views.back().frame_buffer += 4;
        break;
    default:
        break;
    }
    return views;
}

void describe(const Deed& deed, Host& host, ResetPlatform& p) {
    const std::vector<RequestedView> views = views_of(deed);
    const Camera& camera = views.front().camera;
    program(host, deed.cloud, camera, views.front().frame_buffer);
    host.write_pair(Register::Workspace, deed.workspace);
    host.write_pair(Register::WorkspaceBytes,
                    deed.fate == Fate::SmallWorkspace ? 64 : kFrame - deed.workspace);
    host.write(Register::Format, static_cast<std::uint32_t>(deed.format));
    host.write_pair(Register::Views, kTable);
    host.write(Register::ViewCount, deed.in_table ? static_cast<std::uint32_t>(views.size()) : 0);
    if (deed.in_table) {
        const std::vector<unsigned char> table = table_of(views);
        std::copy(table.begin(), table.end(), p.bytes().begin() + kTable);
    }
    if (deed.writes_window || deed.fate == Fate::BadWindow) {
        host.write_double(Register::ShiftX, camera.shift.x);
        host.write_double(Register::ShiftY, camera.shift.y);
        host.write(Register::OriginX, static_cast<std::uint32_t>(deed.origin.x));
        host.write(Register::OriginY, static_cast<std::uint32_t>(deed.origin.y));
    }
}

void stop(Host& host, ResetPlatform& p, const Deed& deed) {
    sc_core::wait(sc_core::sc_time(deed.stop_ns, sc_core::SC_NS));
    if (deed.fate == Fate::HeldInReset) {
        p.reset_n.write(false);
        sc_core::wait(sc_core::sc_time(3, sc_core::SC_NS));
        p.reset_n.write(true);
    } else {
        host.write(Register::Control, deed.fate == Fate::Aborted ? kControlAbort : kControlReset);
    }
}

Outcome perform(const Deed& deed, Host& host, ResetPlatform& p) {
    put(deed, p);
    describe(deed, host, p);
    host.write(Register::IrqStatus, kIrqDone | kIrqError | kIrqAborted);
    const bool resets = deed.fate == Fate::Reset || deed.fate == Fate::HeldInReset;
    const std::uint32_t before = resets ? 0 : host.read(Register::Frames);
    host.write(Register::Control, kControlClearError | kControlStart);
    if (resets || deed.fate == Fate::Aborted) {
        stop(host, p, deed);
    }
    while ((host.read(Register::Status) & (kStatusBusy | kStatusInReset)) != 0) {
        sc_core::wait(sc_core::sc_time(100, sc_core::SC_NS));
    }
    return outcome_of(host, p, before);
}

Camera view_of(Dice& dice) {
    Camera camera = test_camera(1 + dice.below(44), 1 + dice.below(36));
    camera.fx = dice.uniform(20, 60);
    camera.fy = dice.uniform(20, 60);
    camera.position = {dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5), dice.uniform(-1, 1)};
    return camera;
}

LensCoefficients draw_lens(Dice& dice) {
    LensCoefficients lens;
    lens.kind = dice.chance(0.5) ? LensCoefficients::Kind::OpenCv : LensCoefficients::Kind::Fisheye;
    lens.radial = {dice.uniform(-0.1, 0.1), dice.uniform(-0.02, 0.02), 0, 0};
    return lens;
}

/// Up to three views: eyes, windows, lenses and foveation in any mixture.
std::vector<RequestedView> draw_views(Dice& dice, bool bends) {
    std::vector<RequestedView> views;
    const int count = 1 + dice.below(3);
    while (static_cast<int>(views.size()) < count) {
        Camera camera = view_of(dice);
        if (!views.empty() && dice.chance(0.6)) {
            camera = eyes_of(views.front().camera, 0.5).back();
        }
        if (dice.chance(0.3)) {
            const int x = dice.below(camera.width), y = dice.below(camera.height);
            camera = camera.cropped({x, y, camera.width - 1, camera.height - 1});
        }
        if (bends && dice.chance(0.5)) {
            camera.lens = Lens(draw_lens(dice));
        }
        views.push_back({camera});
        if (dice.chance(0.5)) {
            const double fovea = dice.log_uniform(1, 30);
            views.back().foveation =
                Foveation{{dice.uniform(0, 1), dice.uniform(0, 1)}, fovea, 1.7 * fovea};
        }
    }
    return views;
}

Deed draw_deed(Dice& dice, bool may_change, bool bends) {
    static const std::vector<double> shifts{0, 0, -5, 5, 0.5, -17.25, 40};
    static const std::vector<int> origins{0, 0, 3, 16, 37};
    Deed deed;
    deed.cloud =
        test_cloud(static_cast<unsigned>(dice.below(1000)), 20 + dice.below(60), dice.below(4));
    deed.views.push_back({view_of(dice)});
    Camera& camera = deed.views.front().camera;
    if (dice.chance(0.2)) {
        deed.cloud.opacities[5] = 2; // is dropped
    }
    if (dice.chance(0.7)) {
        const glm::dvec2 shift(dice.one_of(shifts), dice.one_of(shifts));
        EXPECT_TRUE(camera.set_principal_point(camera.principal_point() + shift));
        deed.origin = {dice.one_of(origins), dice.one_of(origins)};
        camera.origin = glm::max(camera.origin, deed.origin);
    }
    deed.format = dice.chance(0.3) ? FrameFormat::Rgba16F : FrameFormat::Rgba8;
    deed.workspace += 64 * dice.below(3);
    deed.frame += 64 * dice.below(3);
    if (dice.chance(0.4)) {
        deed.fate = static_cast<Fate>(dice.below(static_cast<int>(Fate::HeldInReset) + 1));
        deed.fate = deed.fate == Fate::SceneChanged && !may_change ? Fate::Drawn : deed.fate;
    }
    deed.stop_ns = dice.log_uniform(1, 4000);
    deed.in_table = dice.chance(0.6);
    if (deed.in_table) {
        deed.views = draw_views(dice, bends);
    }
    place(deed.views, deed.pixel_bytes(), deed.frame);
    return deed;
}

/// A frame after a reset finds the window that is the whole image, and need not write it.
std::vector<Deed> draw_deeds(Dice& dice, int count, bool may_change, bool bends) {
    std::vector<Deed> deeds;
    for (int i = 0; i < count; ++i) {
        deeds.push_back(i > 1 && dice.chance(0.3) ? deeds[dice.below(i)]
                                                  : draw_deed(dice, may_change, bends));
        const bool reset =
            i > 0 && (deeds[i - 1].fate == Fate::Reset || deeds[i - 1].fate == Fate::HeldInReset);
        deeds[i].writes_window = !(reset && deeds[i].camera().is_centred());
    }
    return deeds;
}

/// Pixels as the frame buffer has them.
std::vector<unsigned char> stored(const Image& image, FrameFormat format) {
    if (format == FrameFormat::Rgba8) {
        return rgba8(image);
    }
    std::vector<unsigned char> bytes;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const std::uint16_t half =
                glm::packHalf1x16(c < 3 ? image.rgb[3 * i + c] : 1.0F - image.transmittance[i]);
            bytes.push_back(half & 0xFFU);
            bytes.push_back(static_cast<unsigned char>(half >> 8U));
        }
    }
    return bytes;
}

std::vector<Outcome> in_turn(ResetPlatform& p, const std::vector<Deed>& deeds) {
    std::vector<Outcome> outcomes;
    p.host.script = [&](Host& host) {
        for (const Deed& deed : deeds) {
            outcomes.push_back(perform(deed, host, p));
        }
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
    return outcomes;
}

struct Drawn {
    std::unique_ptr<AcceleratorConfig> config;
    Bus bus = Bus::Annotated;
    bool has_debug = true;
    Accelerator::Options options;
    bool bends = false; ///< draws lenses
};

Drawn draw_accelerator(Dice& dice, const std::vector<std::string>& designs, bool keeps_lists) {
    Drawn drawn;
    const std::string name = dice.one_of(designs);
    const bool gcc = name.rfind("gcc", 0) == 0;
    std::vector<std::string> keys;
    if (keeps_lists) {
        keys.emplace_back("binning.keep_lists=true");
    }
    drawn.bends = dice.chance(0.3);
    if (drawn.bends) {
        keys.emplace_back("pipeline.rules.projection=unscented");
    }
    if (dice.chance(0.4)) {
        keys.emplace_back(gcc                ? "grouping.shared_by_views=nothing"
                          : dice.chance(0.5) ? "projection.shared_by_views=nothing"
                                             : "projection.shared_by_views=colour");
    }
    drawn.config =
        load_design(std::string(DEGS_CONFIGS) + "/" + name + ".yaml", keys).accelerator().clone();
    drawn.bus = static_cast<Bus>(dice.below(3));
    drawn.options = options_of(drawn.bus, dice.chance(0.2) ? Fidelity::Strict : Fidelity::Exact);
    drawn.has_debug = dice.chance(0.5);
    drawn.options.antialiased = dice.chance(0.3);
    if (drawn.bus != Bus::FourPhases && dice.chance(0.4)) {
        drawn.options.memory.burst_bytes = 64;
        drawn.options.memory.burst_ends =
            dice.chance(0.5) ? BurstEnds::FullBursts : BurstEnds::Pieces;
    }
    return drawn;
}

/// Lists that are kept spare time and bytes.
void expect_same(const Outcome& is, const Outcome& alone, bool keeps_lists) {
    EXPECT_EQ(is.words, alone.words);
    EXPECT_EQ(is.counters, alone.counters);
    if (!keeps_lists) {
        EXPECT_EQ(is.traffic, alone.traffic);
    }
    EXPECT_TRUE(is.views == alone.views);
    EXPECT_TRUE(is.pixels == alone.pixels);
}

/// All memory from kFrame on is that of the closed job; pixels of a hole are nobody's.
void expect_drawn(const Outcome& seen, const Deed& deed, const ClosedViews& closed) {
    ASSERT_EQ(seen.views.size(), closed.drawn.size());
    const std::vector<unsigned char>& memory = closed.memory.bytes;
    EXPECT_TRUE(std::equal(seen.pixels.begin(), seen.pixels.end(), memory.begin() + kFrame));
    for (std::size_t v = 0; v < closed.drawn.size(); ++v) {
        const DrawnView& view = closed.drawn[v];
        if (view.level.camera.hole.empty()) {
            const std::vector<unsigned char> image = stored(closed.image(v), deed.format);
            EXPECT_TRUE(std::equal(image.begin(), image.end(),
                                   memory.begin() + static_cast<std::ptrdiff_t>(view.address)))
                << "view " << v;
        }
    }
}

struct Family {
    const char* name;
    std::vector<std::string> designs;
    bool keeps_lists = false;
};
using SequenceCase = std::tuple<Family, int>;

class SmallRunSequence : public ::testing::TestWithParam<SequenceCase> {};

TEST_P(SmallRunSequence, EachFrameIsThatOfAFreshAccelerator) {
    constexpr int kFrames = 9;
    const auto& [family, draw] = GetParam();
    Dice dice(53, draw);
    const Drawn drawn = draw_accelerator(dice, family.designs, family.keeps_lists);
    const std::vector<Deed> deeds =
        draw_deeds(dice, kFrames, drawn.bus != Bus::FourPhases, drawn.bends);
    const auto make = [&](const std::string& name) {
        return std::make_unique<ResetPlatform>(name, *drawn.config, deeds.front().cloud, drawn.bus,
                                               drawn.options, drawn.has_debug);
    };
    std::vector<std::unique_ptr<ResetPlatform>> fresh;
    std::vector<std::unique_ptr<ClosedViews>> closed;
    std::vector<Outcome> expected(kFrames);
    const std::unique_ptr<AcceleratorConfig> floats = drawn.config->clone();
    floats->read_floats();
    for (int i = 0; i < kFrames; ++i) {
        fresh.push_back(make("fresh" + std::to_string(i)));
        ResetPlatform& alone = *fresh.back();
        alone.host.script = [&, i](Host& host) { expected[i] = perform(deeds[i], host, alone); };
        GaussianCloud sound = deeds[i].cloud;
        sanitize(sound);
        closed.push_back(std::make_unique<ClosedViews>(
            ("closed" + std::to_string(i)).c_str(), *floats, sound, deeds[i].views,
            deeds[i].pixel_bytes(), drawn.options.antialiased));
    }
    const auto together = make("p");
    const std::vector<Outcome> seen = in_turn(*together, deeds);
    ASSERT_EQ(seen.size(), deeds.size());
    for (int i = 0; i < kFrames; ++i) {
        SCOPED_TRACE("frame " + std::to_string(i) + ", fate " +
                     std::to_string(static_cast<int>(deeds[i].fate)));
        expect_same(seen[i], expected[i], family.keeps_lists);
        if (deeds[i].fate == Fate::Drawn) {
            EXPECT_EQ(seen[i].words.front(), kStatusDone);
            expect_drawn(seen[i], deeds[i], *closed[i]);
        }
    }
}

const Family kFamilies[] = {{"degs", {"degs-16", "degs-64", "degs-64-tuned", "degs-x-64"}},
                            {"keeping", {"degs-16", "degs-64"}, true},
                            {"gscore", {"gscore-16", "gscore-64"}},
                            {"gbu", {"gbu-16", "gbu-64"}},
                            {"gcc", {"gcc-16", "gcc-64"}},
                            {"orange", {"orange-o1", "orange-o2", "orange-o3", "orange-o4"}}};

INSTANTIATE_TEST_SUITE_P(Drawn, SmallRunSequence,
                         ::testing::Combine(::testing::ValuesIn(kFamilies), ::testing::Range(0, 3)),
                         [](const ::testing::TestParamInfo<SequenceCase>& which) {
                             return std::string(std::get<0>(which.param).name) + "_" +
                                    std::to_string(std::get<1>(which.param));
                         });

} // namespace
} // namespace degs::test
