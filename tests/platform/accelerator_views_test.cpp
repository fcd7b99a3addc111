// SPDX-License-Identifier: Apache-2.0
// Frames of several views on a platform: eyes, lenses and foveation are those of the same job
// without a platform on the same memory, to the byte and to the cycle.
#include <tuple>

#include "degs/design.hpp"
#include "tests/platform/views_bench.hpp"

namespace degs::test {
namespace {

/// What a frame is made of.
enum class Scenario { One, Eyes, Foveated, FoveatedEyes, Windows, Lenses };

Camera window_of(const Camera& camera, const PixelBox& part) {
    return camera.cropped(part);
}

LensCoefficients barrel() {
    LensCoefficients lens;
    lens.kind = LensCoefficients::Kind::OpenCv;
    lens.radial = {-0.12, 0.02, 0, 0};
    lens.tangential = {0.002, -0.001};
    return lens;
}

LensCoefficients fisheye() {
    LensCoefficients lens;
    lens.kind = LensCoefficients::Kind::Fisheye;
    lens.radial = {0.03, -0.004, 0.001, 0};
    return lens;
}

std::vector<RequestedView> views_in(Scenario scenario) {
    const Camera camera = test_camera(61, 47);
    const Foveation gaze{{0.4, 0.55}, 9, 21};
    std::vector<RequestedView> views;
    const auto add = [&views](const Camera& seen, const std::optional<Foveation>& foveation = {}) {
        views.push_back({seen, foveation});
    };
    std::vector<Camera> eyes = eyes_of(camera, 0.4);
    switch (scenario) {
    case Scenario::One:
        add(camera);
        break;
    case Scenario::Eyes:
        add(eyes[0]);
        add(eyes[1]);
        break;
    case Scenario::Foveated: // so large that the middle of the rim is hidden
        add(test_camera(200, 150), Foveation{{0.4, 0.55}, 9, 30});
        break;
    case Scenario::FoveatedEyes:
        add(eyes[0], gaze);
        add(eyes[1], Foveation{{0.6, 0.5}, 12, 12});
        break;
    case Scenario::Windows:
        add(window_of(camera, {3, 5, 40, 30}));
        add(eyes[1], Foveation{{1, 0}, 90, 90}); // all of it is its fovea
        add(window_of(eyes[0], {17, 0, 60, 46}));
        break;
    case Scenario::Lenses:
        eyes[0].lens = Lens(barrel());
        eyes[1].lens = Lens(fisheye());
        add(eyes[0]);
        add(eyes[1], gaze);
        break;
    }
    place(views);
    return views;
}

degs::Design design_for(const std::string& name, std::vector<std::string> keys, Scenario scenario) {
    if (scenario == Scenario::Lenses) {
        keys.emplace_back("pipeline.rules.projection=unscented");
    }
    return load_design(std::string(DEGS_CONFIGS) + "/" + name + ".yaml", keys);
}

using ViewsCase = std::tuple<std::tuple<const char*, const char*>, Scenario>;

class SmallRunPlatformViews : public ::testing::TestWithParam<ViewsCase> {};

TEST_P(SmallRunPlatformViews, AreThoseOfARunOnTheSameMemory) {
    const auto& [shared, scenario] = GetParam();
    const auto& [name, key] = shared;
    const std::vector<std::string> keys =
        *key == 0 ? std::vector<std::string>() : std::vector<std::string>{key};
    const degs::Design design = design_for(name, keys, scenario);
    const std::unique_ptr<AcceleratorConfig> floats = design.accelerator().clone();
    floats->read_floats();
    const GaussianCloud cloud = test_cloud(3, 130);
    const std::vector<RequestedView> views = views_in(scenario);
    ClosedViews closed("closed", *floats, cloud, views);
    Platform p("p", design.accelerator(), cloud);
    const std::vector<unsigned char> table = table_of(views);
    std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
    std::vector<SeenView> seen;
    std::uint64_t cycles = 0, fragments = 0;
    int hidden = 0;
    p.host.script = [&](Host& host) {
        program_views(host, cloud, views.size());
        EXPECT_TRUE(host.render()) << static_cast<int>(host.error());
        seen = seen_views(host);
        cycles = host.read_pair(Register::Cycles);
        fragments = host.read_pair(Register::Fragments);
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    ASSERT_EQ(seen.size(), closed.drawn.size());
    for (std::size_t v = 0; v < seen.size(); ++v) {
        SCOPED_TRACE("view " + std::to_string(v));
        const FoveatedLevel& level = closed.drawn[v].level;
        if (TileGrid(level.camera, floats->tile_size_px()).hidden().empty()) {
            EXPECT_EQ(p.frame(level.camera, seen[v].address), rgba8(closed.image(v)));
        } else {
            ++hidden;
        }
        EXPECT_EQ(seen[v].cycles, closed.finished[v]);
        EXPECT_EQ(seen[v].fragments, closed.fragments(v));
        EXPECT_EQ(static_cast<int>(seen[v].scale), level.scale);
        fragments -= seen[v].fragments;
    }
    EXPECT_EQ(cycles, closed.finished.back());
    EXPECT_EQ(fragments, 0U);
    EXPECT_EQ(hidden > 0, scenario == Scenario::Foveated && floats->tile_size_px() <= 32);
    const bool alike = closed.memory.bytes.size() == p.memory->bytes.size();
    EXPECT_TRUE(alike && std::equal(closed.memory.bytes.begin() + kFrame, closed.memory.bytes.end(),
                                    p.memory->bytes.begin() + kFrame));
}

std::string views_case_name(const ::testing::TestParamInfo<ViewsCase>& info) {
    constexpr const char* kScenarios[] = {"One",          "Eyes",    "Foveated",
                                          "FoveatedEyes", "Windows", "Lenses"};
    const auto& [shared, scenario] = info.param;
    const std::string key = std::get<1>(shared);
    std::string name = std::string(std::get<0>(shared)) + "_" +
                       (key.empty() ? "" : key.substr(key.find('=') + 1) + "_") +
                       kScenarios[static_cast<int>(scenario)];
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

constexpr std::tuple<const char*, const char*> kShared[] = {
    {"degs-64", ""},
    {"degs-64", "projection.shared_by_views=nothing"},
    {"degs-64", "projection.shared_by_views=geometry"},
    {"degs-64", "projection.shared_by_views=colour"},
    {"gscore-64", ""},
    {"gscore-64", "projection.shared_by_views=nothing"},
    {"gbu-64", ""},
    {"gcc-64", ""},
    {"gcc-64", "grouping.shared_by_views=nothing"},
    {"orange-o1", ""}};

INSTANTIATE_TEST_SUITE_P(All, SmallRunPlatformViews,
                         ::testing::Combine(::testing::ValuesIn(kShared),
                                            ::testing::Values(Scenario::One, Scenario::Eyes,
                                                              Scenario::Foveated,
                                                              Scenario::FoveatedEyes,
                                                              Scenario::Windows, Scenario::Lenses)),
                         views_case_name);

// Without sharing, the third frame waits until the first has ended.
TEST(SmallRunPlatformViewsInTurn, ThatShareNothingAreFramesInFlight) {
    std::vector<std::uint64_t> cycles;
    std::vector<std::unique_ptr<Platform>> platforms;
    std::vector<std::unique_ptr<ClosedViews>> closed;
    const std::vector<RequestedView> views = views_in(Scenario::Windows);
    const GaussianCloud cloud = test_cloud();
    for (const char* limit : {"1", "3"}) {
        const degs::Design design = design_for(
            "gscore-64",
            {"projection.shared_by_views=nothing", std::string("frames_in_flight=") + limit},
            Scenario::Windows);
        const std::unique_ptr<AcceleratorConfig> floats = design.accelerator().clone();
        floats->read_floats();
        const std::string name = std::string("p") + limit;
        closed.push_back(
            std::make_unique<ClosedViews>(("closed" + name).c_str(), *floats, cloud, views));
        platforms.push_back(std::make_unique<Platform>(name.c_str(), design.accelerator(), cloud));
        Platform& p = *platforms.back();
        const std::vector<unsigned char> table = table_of(views);
        std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
        p.host.script = [&, i = platforms.size() - 1](Host& host) {
            program_views(host, cloud, views.size());
            for (int frame = 0; frame < 2; ++frame) {
                EXPECT_TRUE(host.render());
                EXPECT_EQ(host.read_pair(Register::Cycles), closed[i]->finished.back());
            }
        };
    }
    sc_core::sc_start();
    EXPECT_TRUE(platforms[0]->host.finished && platforms[1]->host.finished);
    EXPECT_GT(closed[0]->finished.back(), closed[1]->finished.back());
}

// The registers describe one view again; what they tell of a view that is not there is 0.
TEST(SmallRunPlatformViewsInTurn, RegistersTellOfTheViewThatIsSelected) {
    const GaussianCloud cloud = test_cloud();
    const std::vector<RequestedView> views = views_in(Scenario::FoveatedEyes);
    Platform p("p", load_design(std::string(DEGS_CONFIGS) + "/degs-16.yaml").accelerator(), cloud);
    const std::vector<unsigned char> table = table_of(views);
    std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
    p.host.script = [&](Host& host) {
        EXPECT_EQ(host.read(Register::ViewsDrawn), 0U);
        program_views(host, cloud, views.size());
        EXPECT_TRUE(host.render());
        const std::vector<SeenView> seen = seen_views(host);
        ASSERT_EQ(seen.size(), 5U); // 3 levels, and 2 where both angles are one
        const std::vector<FoveatedLevel> left = views[0].levels();
        std::uint64_t address = views[0].frame_buffer;
        for (std::size_t v = 0; v < 3; ++v) {
            const Camera& camera = left[v].camera;
            const auto side = [&](std::size_t i) { return static_cast<int>(seen[v].sides[i]); };
            EXPECT_EQ(seen[v].entry, 0U);
            EXPECT_EQ(seen[v].scale, 1U << v);
            EXPECT_EQ(seen[v].address, address);
            EXPECT_EQ(side(0), camera.width);
            EXPECT_EQ(side(1), camera.height);
            EXPECT_EQ(glm::ivec2(side(2), side(3)), left[v].first);
            EXPECT_EQ(side(4), left[v].shown.x0);
            EXPECT_EQ(side(5), left[v].shown.y0);
            EXPECT_EQ(side(6), left[v].shown.width());
            EXPECT_EQ(side(7), left[v].shown.height());
            address += (4 * camera.pixels() + 63) / 64 * 64;
        }
        EXPECT_EQ(seen[3].entry, 1U);
        EXPECT_EQ(seen[3].scale, 1U);
        EXPECT_EQ(seen[4].scale, 4U);
        host.write(Register::View, 5);
        EXPECT_EQ(host.read(Register::ViewScale), 0U);
        EXPECT_EQ(host.read_pair(Register::ViewCycles), 0U);
        EXPECT_EQ(host.read(Register::ViewWidth), 0U);
        host.write(Register::ViewCount, 0);
        host.write(Register::View, 0);
        program(host, cloud, test_camera());
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::ViewsDrawn), 1U);
        EXPECT_EQ(host.read(Register::ViewWidth), 96U);
        EXPECT_EQ(host.read_pair(Register::ViewAddress), kFrame);
        EXPECT_EQ(host.read_pair(Register::ViewCycles), host.read_pair(Register::Cycles));
        EXPECT_EQ(host.read_pair(Register::ViewFragments), host.read_pair(Register::Fragments));
        host.write(Register::Control, kControlReset);
        EXPECT_EQ(host.read(Register::ViewsDrawn), 0U);
        EXPECT_EQ(host.read(Register::ViewWidth), 0U);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

// A memory without debug transport answers the table, too, in LOAD_CYCLES: 2 entries are a piece.
TEST(SmallRunPlatformViewsInTurn, TheTableIsReadAsTheSceneIs) {
    const GaussianCloud cloud = test_cloud();
    const std::vector<RequestedView> views = views_in(Scenario::Eyes);
    const degs::Design design = load_design(std::string(DEGS_CONFIGS) + "/degs-16.yaml");
    Platform p("p", design.accelerator(), cloud, Timing::Annotated, false);
    const std::vector<unsigned char> table = table_of(views);
    std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
    p.host.script = [&](Host& host) {
        program_views(host, cloud, views.size());
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read_pair(Register::LoadCycles), 50U * (1 + 2 + 2));
        EXPECT_EQ(host.read(Register::ViewsDrawn), 2U);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

// Lists of each view stay for the next frame, unless that has another number of views.
TEST(SmallRunPlatformViewsInTurn, ListsAreKeptForAsManyViews) {
    const GaussianCloud cloud = test_cloud();
    const std::vector<RequestedView> views = views_in(Scenario::Eyes);
    const degs::Design design =
        load_design(std::string(DEGS_CONFIGS) + "/gscore-64.yaml", {"binning.keep_lists=true"});
    Platform p("p", design.accelerator(), cloud);
    const std::vector<unsigned char> table = table_of(views);
    std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
    std::vector<std::uint64_t> bytes;
    p.host.script = [&](Host& host) {
        program_views(host, cloud, 2);
        for (const std::uint32_t count : {2, 2, 1, 1, 2, 2}) {
            host.write(Register::ViewCount, count);
            EXPECT_TRUE(host.render());
            bytes.push_back(host.read_pair(Register::BytesWritten));
        }
    };
    sc_core::sc_start();
    ASSERT_EQ(bytes.size(), 6U);
    EXPECT_LT(bytes[1], bytes[0]);
    EXPECT_LT(bytes[3], bytes[2]);
    EXPECT_EQ(bytes[4], bytes[0]);
    EXPECT_EQ(bytes[5], bytes[1]);
}

/// Something wrong in the table or in the registers that name it.
struct Mistake {
    const char* what;
    AcceleratorError error;
    std::uint32_t detail;
    std::function<void(std::vector<RequestedView>&)> in_views{};
    std::function<void(Host&)> in_registers{};
    std::function<void(std::vector<unsigned char>&)> in_table{};
};

std::uint32_t place_of(Register which) {
    return static_cast<std::uint32_t>(which);
}

std::vector<Mistake> mistakes() {
    using E = AcceleratorError;
    using F = ViewField;
    using Views = std::vector<RequestedView>;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto with_lens = [](const LensCoefficients& lens) {
        return [lens](Views& views) { views[1].camera.lens = Lens(lens); };
    };
    LensCoefficients endless = barrel(), stray = fisheye();
    endless.radial[1] = kNone;
    stray.tangential[0] = 1;
    const auto with_gaze = [](const Foveation& gaze) {
        return [gaze](Views& views) { views[1].foveation = gaze; };
    };
    const auto registers = [](Register which, std::uint64_t value) {
        return [which, value](Host& host) { host.write_pair(which, value); };
    };
    return {
        {"65 views",
         E::BadViewCount,
         place_of(Register::ViewCount),
         {},
         [](Host& host) { host.write(Register::ViewCount, 65); }},
        {"2^32 - 1 views",
         E::BadViewCount,
         place_of(Register::ViewCount),
         {},
         [](Host& host) { host.write(Register::ViewCount, ~0U); }},
        {"a table at an odd address",
         E::Misaligned,
         place_of(Register::Views),
         {},
         registers(Register::Views, kTable + 4)},
        {"a table in the workspace",
         E::Overlap,
         place_of(Register::Views),
         {},
         registers(Register::Views, kWorkspace + 0x40)},
        {"a table beyond the last address",
         E::Overlap,
         place_of(Register::Views),
         {},
         registers(Register::Views, 0 - std::uint64_t{64})},
        {"a table outside of memory", E::LoadError, 1, {}, registers(Register::Views, 0x100000)},
        {"a frame buffer in the scene", E::Overlap, detail_of_view(1, F::FrameBuffer),
         [](Views& views) { views[1].frame_buffer = kSh; }},
        {"a frame buffer in the table", E::Overlap, detail_of_view(0, F::FrameBuffer),
         [](Views& views) { views[0].frame_buffer = kTable; }},
        {"two views in one frame buffer", E::Overlap, detail_of_view(1, F::FrameBuffer),
         [](Views& views) { views[1].frame_buffer = views[0].frame_buffer; }},
        {"levels that reach into the next view", E::Overlap, detail_of_view(1, F::FrameBuffer),
         [](Views& views) {
             views[0].foveation = Foveation{{0.5, 0.5}, 30, 31};
         }},
        {"an odd frame buffer", E::Misaligned, detail_of_view(1, F::FrameBuffer),
         [](Views& views) { views[1].frame_buffer += 4; }},
        {"no width", E::BadSize, detail_of_view(0, F::Width),
         [](Views& views) { views[0].camera.width = 0; }},
        {"too many rows", E::BadSize, detail_of_view(1, F::Height),
         [](Views& views) { views[1].camera.height = 65537; }},
        {"too many pixels together", E::BadSize, detail_of_view(1, F::Height),
         [](Views& views) {
             views[0].camera.width = views[0].camera.height = 8000;
             views[1].camera.width = views[1].camera.height = 8000;
         }},
        {"a focal length of NaN", E::BadCamera, detail_of_view(1, F::FocalX),
         [](Views& views) { views[1].camera.fx = kNone; }},
        {"a place of NaN", E::BadCamera, detail_of_view(0, F::Position),
         [](Views& views) { views[0].camera.position.y = kNone; }},
        {"axes that are no rotation", E::BadCamera, detail_of_view(0, F::Axes),
         [](Views& views) { views[0].camera.camera_to_world[2][2] = 0.5; }},
        {"a shift of NaN", E::BadCamera, detail_of_view(1, F::ShiftX),
         [](Views& views) { views[1].camera.shift.y = kNone; }},
        {"an image far out of its raster", E::BadCamera, detail_of_view(1, F::OriginX),
         [](Views& views) { views[1].camera.origin.x = 1 << 21; }},
        {"a lens of a fourth kind",
         E::BadCamera,
         detail_of_view(1, F::Lens),
         {},
         {},
         [](std::vector<unsigned char>& table) { table[kViewBytes + 0x98] = 3; }},
        {"a pinhole with coefficients",
         E::BadCamera,
         detail_of_view(0, F::Lens),
         {},
         {},
         [](std::vector<unsigned char>& table) { table[0xA7] = 0x3F; }},
        {"a coefficient of NaN", E::BadCamera, detail_of_view(1, F::Lens), with_lens(endless)},
        {"a fisheye with p1", E::BadCamera, detail_of_view(1, F::Lens), with_lens(stray)},
        {"a lens that the projection cannot draw", E::BadCamera, detail_of_view(1, F::Lens),
         with_lens(barrel())},
        {"a gaze beside the image", E::BadFoveation, detail_of_view(1, F::GazeX),
         with_gaze({{1.01, 0.5}, 10, 20})},
        {"a gaze of NaN", E::BadFoveation, detail_of_view(1, F::GazeY),
         with_gaze({{0.5, kNone}, 10, 20})},
        {"a fovea of NaN", E::BadFoveation, detail_of_view(1, F::Fovea),
         with_gaze({{0.5, 0.5}, kNone, 20})},
        {"a negative fovea", E::BadFoveation, detail_of_view(1, F::Fovea),
         with_gaze({{0.5, 0.5}, -1, 20})},
        {"a periphery within the fovea", E::BadFoveation, detail_of_view(1, F::Periphery),
         with_gaze({{0.5, 0.5}, 20, 10})},
        {"a periphery behind the head", E::BadFoveation, detail_of_view(1, F::Periphery),
         with_gaze({{0.5, 0.5}, 20, 90.5})},
    };
}

TEST(SmallRunPlatformViewsInTurn, MistakesOfTheTableEndTheFrameWithTheirPlace) {
    const GaussianCloud cloud = test_cloud();
    const std::vector<RequestedView> sound = views_in(Scenario::Eyes);
    Platform p("p", load_design(std::string(DEGS_CONFIGS) + "/degs-16.yaml").accelerator(), cloud);
    p.host.script = [&](Host& host) {
        for (const Mistake& mistake : mistakes()) {
            SCOPED_TRACE(mistake.what);
            std::vector<RequestedView> views = sound;
            if (mistake.in_views) {
                mistake.in_views(views);
            }
            std::vector<unsigned char> table = table_of(views);
            if (mistake.in_table) {
                mistake.in_table(table);
            }
            std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
            program_views(host, cloud, views.size());
            if (mistake.in_registers) {
                mistake.in_registers(host);
            }
            EXPECT_FALSE(host.render());
            EXPECT_EQ(host.error(), mistake.error) << static_cast<int>(host.error());
            EXPECT_EQ(host.read(Register::ErrorDetail), mistake.detail);
            EXPECT_EQ(host.read_pair(Register::Cycles), 0U);
            EXPECT_EQ(host.read_pair(Register::BytesRead), 0U);
        }
        const std::vector<unsigned char> table = table_of(sound);
        std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
        program_views(host, cloud, sound.size());
        EXPECT_TRUE(host.render());
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

} // namespace
} // namespace degs::test
