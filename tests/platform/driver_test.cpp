// SPDX-License-Identifier: Apache-2.0
// The driver in C: its header against the model, and a frame through its two functions.
#include "degs/request_info.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/driver_device.hpp"
#include "tests/platform/views_bench.hpp"

namespace degs::test {
namespace {

struct Offset {
    std::uint32_t in_header;
    Register in_model;
};

TEST(Driver, OffsetsOfItsHeaderAreThoseOfTheModel) {
    using R = Register;
    const std::vector<Offset> offsets{
        {DEGS_REG_ID, R::Id},
        {DEGS_REG_VERSION, R::Version},
        {DEGS_REG_CONTROL, R::Control},
        {DEGS_REG_STATUS, R::Status},
        {DEGS_REG_IRQ_ENABLE, R::IrqEnable},
        {DEGS_REG_IRQ_STATUS, R::IrqStatus},
        {DEGS_REG_ERROR_CODE, R::ErrorCode},
        {DEGS_REG_ERROR_DETAIL, R::ErrorDetail},
        {DEGS_REG_GEOMETRY, R::Geometry},
        {DEGS_REG_SH, R::Sh},
        {DEGS_REG_COUNT, R::Count},
        {DEGS_REG_SH_DEGREE, R::ShDegree},
        {DEGS_REG_WORKSPACE, R::Workspace},
        {DEGS_REG_WORKSPACE_BYTES, R::WorkspaceBytes},
        {DEGS_REG_FRAME_BUFFER, R::FrameBuffer},
        {DEGS_REG_FORMAT, R::Format},
        {DEGS_REG_WIDTH, R::Width},
        {DEGS_REG_HEIGHT, R::Height},
        {DEGS_REG_FOCAL_X, R::FocalX},
        {DEGS_REG_FOCAL_Y, R::FocalY},
        {DEGS_REG_AXES, R::Axes},
        {DEGS_REG_POSITION, R::Position},
        {DEGS_REG_SHIFT_X, R::ShiftX},
        {DEGS_REG_SHIFT_Y, R::ShiftY},
        {DEGS_REG_ORIGIN_X, R::OriginX},
        {DEGS_REG_ORIGIN_Y, R::OriginY},
        {DEGS_REG_CYCLES, R::Cycles},
        {DEGS_REG_LOAD_CYCLES, R::LoadCycles},
        {DEGS_REG_BYTES_READ, R::BytesRead},
        {DEGS_REG_BYTES_WRITTEN, R::BytesWritten},
        {DEGS_REG_FRAGMENTS, R::Fragments},
        {DEGS_REG_WORKSPACE_NEEDED, R::WorkspaceNeeded},
        {DEGS_REG_FRAMES, R::Frames},
        {DEGS_REG_DROPPED, R::Dropped},
        {DEGS_REG_FRAME_ENERGY, R::FrameEnergy},
        {DEGS_REG_VIEW_COUNT, R::ViewCount},
        {DEGS_REG_VIEW, R::View},
        {DEGS_REG_VIEWS, R::Views},
        {DEGS_REG_VIEWS_DRAWN, R::ViewsDrawn},
        {DEGS_REG_VIEW_SCALE, R::ViewScale},
        {DEGS_REG_VIEW_ADDRESS, R::ViewAddress},
        {DEGS_REG_VIEW_CYCLES, R::ViewCycles},
        {DEGS_REG_VIEW_FRAGMENTS, R::ViewFragments},
        {DEGS_REG_VIEW_WIDTH, R::ViewWidth},
        {DEGS_REG_VIEW_HEIGHT, R::ViewHeight},
        {DEGS_REG_VIEW_X, R::ViewX},
        {DEGS_REG_VIEW_Y, R::ViewY},
        {DEGS_REG_FAULT_ADDRESS, R::FaultAddress},
        {DEGS_REG_FAULT_STREAM, R::FaultStream},
        {DEGS_REG_FAULT_ANSWER, R::FaultAnswer},
        {DEGS_REG_IDLE_ENERGY, R::IdleEnergy},
        {DEGS_REG_POWER, R::Power},
        {DEGS_REG_VIEW_SHOWN, R::ViewShown},
        {DEGS_REG_VIEW_ENTRY, R::ViewEntry},
    };
    ASSERT_EQ(offsets.size(), register_map().size());
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        EXPECT_EQ(offsets[i].in_model, register_map()[i].offset) << register_map()[i].name;
        EXPECT_EQ(offsets[i].in_header, static_cast<std::uint32_t>(offsets[i].in_model))
            << register_map()[i].name;
    }
    EXPECT_EQ(DEGS_REGISTER_BYTES, kRegisterBytes);
    EXPECT_EQ(DEGS_BASE_ALIGNMENT, kBaseAlignment);
    EXPECT_EQ(DEGS_CONTROL_START, kControlStart);
    EXPECT_EQ(DEGS_CONTROL_CLEAR_ERROR, kControlClearError);
    EXPECT_EQ(DEGS_CONTROL_ABORT, kControlAbort);
    EXPECT_EQ(DEGS_STATUS_BUSY, kStatusBusy);
    EXPECT_EQ(DEGS_STATUS_DONE, kStatusDone);
    EXPECT_EQ(DEGS_IRQ_STATUS_ERROR, kIrqError);
    EXPECT_EQ(DEGS_CONTROL_RESUME, kControlResume);
    EXPECT_EQ(DEGS_STATUS_FAULTED, kStatusFaulted);
    EXPECT_EQ(DEGS_IRQ_STATUS_FAULT, kIrqFault);
    EXPECT_EQ(DEGS_POWER_GATE_IDLE, kPowerGateIdle);
    EXPECT_EQ(DEGS_FAULT_STREAM_FRAME_BUFFER,
              static_cast<std::uint32_t>(RequestStream::FrameBuffer));
    EXPECT_EQ(DEGS_ERROR_CODE_OUT_OF_MEMORY,
              static_cast<std::uint32_t>(AcceleratorError::OutOfMemory));
}

TEST(Driver, FieldsOfItsEntriesAreThoseOfTheModel) {
    using F = ViewField;
    const std::vector<std::pair<std::uint32_t, F>> offsets{
        {DEGS_ENTRY_FRAME_BUFFER, F::FrameBuffer},
        {DEGS_ENTRY_WIDTH, F::Width},
        {DEGS_ENTRY_HEIGHT, F::Height},
        {DEGS_ENTRY_FOCAL_X, F::FocalX},
        {DEGS_ENTRY_FOCAL_Y, F::FocalY},
        {DEGS_ENTRY_AXES, F::Axes},
        {DEGS_ENTRY_POSITION, F::Position},
        {DEGS_ENTRY_SHIFT_X, F::ShiftX},
        {DEGS_ENTRY_SHIFT_Y, F::ShiftY},
        {DEGS_ENTRY_ORIGIN_X, F::OriginX},
        {DEGS_ENTRY_ORIGIN_Y, F::OriginY},
        {DEGS_ENTRY_LENS, F::Lens},
        {DEGS_ENTRY_RADIAL, F::Radial},
        {DEGS_ENTRY_DENOMINATOR, F::Denominator},
        {DEGS_ENTRY_TANGENTIAL, F::Tangential},
        {DEGS_ENTRY_GAZE_X, F::GazeX},
        {DEGS_ENTRY_GAZE_Y, F::GazeY},
        {DEGS_ENTRY_FOVEA, F::Fovea},
        {DEGS_ENTRY_PERIPHERY, F::Periphery},
    };
    ASSERT_EQ(offsets.size(), view_layout().size());
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const ViewFieldInfo& field = view_layout()[i];
        EXPECT_EQ(offsets[i].second, field.offset) << field.name;
        EXPECT_EQ(offsets[i].first, static_cast<std::uint32_t>(field.offset)) << field.name;
        EXPECT_GE(offsets[i].first, end) << field.name;
        EXPECT_NE(field.meaning, "") << field.name;
        end = offsets[i].first + 4 * field.words;
        const RegisterInfo* const same =
            AcceleratorRegisters::find(AcceleratorRegisters::offset_of(field.same));
        if (field.same != Register::Id) {
            EXPECT_EQ(same->words, field.words) << field.name;
            EXPECT_STREQ(same->name, field.name);
        }
    }
    EXPECT_LE(end, kViewBytes);
    EXPECT_EQ(DEGS_VIEW_BYTES, kViewBytes);
    EXPECT_EQ(kViewBytes % kBaseAlignment, 0U);
    EXPECT_EQ(DEGS_MOST_VIEWS, kMostViews);
    EXPECT_EQ(DEGS_LENS_FISHEYE, static_cast<std::uint32_t>(LensKind::Fisheye));
}

TEST(SmallRunDriver, RendersTheFrameOfTheRegistersAndReportsErrors) {
    const GaussianCloud cloud = test_cloud();
    const Camera camera = test_camera();
    Platform driven("driven", DegsConfig(), cloud);
    Platform written("written", DegsConfig(), cloud);
    degs_counters counters{};
    driven.host.script = [&](Host& host) {
        const degs_device device = device_of(host);
        EXPECT_EQ(degs_probe(&device), 1);
        const degs_scene scene{0, kSh, static_cast<std::uint32_t>(cloud.size()),
                               static_cast<std::uint32_t>(cloud.sh_degree)};
        const degs_camera view = driver_camera(camera);
        degs_set_scene(&device, &scene);
        degs_set_camera(&device, &view);
        degs_set_frame_buffer(&device, kFrame, DEGS_FORMAT_RGBA8);
        degs_set_workspace(&device, kWorkspace, 0);
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_SMALL_WORKSPACE);
        EXPECT_GT(degs_workspace_needed(&device), 0U);
        degs_set_workspace(&device, kWorkspace, degs_workspace_needed(&device));
        degs_start(&device, 0);
        EXPECT_EQ(degs_busy(&device), 1);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_NONE);
        EXPECT_EQ(degs_acknowledge(&device), DEGS_IRQ_STATUS_DONE); // of this frame alone
        EXPECT_EQ(degs_acknowledge(&device), 0U);
        degs_gate_idle(&device, 1);
        EXPECT_EQ(host.read(Register::Power), kPowerGateIdle);
        degs_gate_idle(&device, 0);
        EXPECT_EQ(host.read(Register::Power), 0U);
        degs_read_counters(&device, &counters);
        EXPECT_EQ(counters.frame_energy, host.read_pair(Register::FrameEnergy));
        EXPECT_EQ(counters.idle_energy, host.read_pair(Register::IdleEnergy));
    };
    std::uint64_t cycles = 0;
    written.host.script = [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        cycles = host.read_pair(Register::Cycles);
    };
    sc_core::sc_start();
    ASSERT_TRUE(driven.host.finished && written.host.finished);
    EXPECT_EQ(driven.frame(camera), written.frame(camera));
    EXPECT_EQ(counters.cycles, cycles);
    EXPECT_EQ(counters.frames, 1U);
    EXPECT_GT(counters.fragments, 0U);
    EXPECT_GT(counters.frame_energy, 0U);
    EXPECT_EQ(counters.dropped, 0U);
}

// Two foveated eyes: probed for their memory, drawn, read back, and then one view by registers.
TEST(SmallRunDriver, RendersTheViewsOfATable) {
    const GaussianCloud cloud = test_cloud();
    const std::vector<Camera> eyes = eyes_of(test_camera(61, 47), 0.3);
    std::vector<RequestedView> views{{eyes[0], Foveation{{0.5, 0.5}, 10, 20}}, {eyes[1]}};
    place(views);
    DegsConfig config;
    Platform p("p", config, cloud);
    ClosedViews closed("closed", config, cloud, views);
    std::vector<degs_drawn_view> asked, drawn;
    degs_counters counters{};
    p.host.script = [&](Host& host) {
        const degs_device device = device_of(host);
        const degs_scene scene{0, kSh, static_cast<std::uint32_t>(cloud.size()),
                               static_cast<std::uint32_t>(cloud.sh_degree)};
        const std::vector<unsigned char> table = table_of(views);
        std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
        degs_set_scene(&device, &scene);
        degs_set_views(&device, kTable, 2);
        degs_set_workspace(&device, kWorkspace, 0);
        const auto read = [&device](std::vector<degs_drawn_view>& all) {
            all.resize(degs_views_drawn(&device));
            for (std::uint32_t v = 0; v < all.size(); ++v) {
                degs_read_view(&device, v, &all[v]);
            }
        };
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_SMALL_WORKSPACE);
        read(asked);
        degs_set_workspace(&device, kWorkspace, degs_workspace_needed(&device));
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_NONE);
        read(drawn);
        degs_read_counters(&device, &counters);
        degs_set_views(&device, 0, 0);
        const degs_camera view = driver_camera(eyes[1]);
        degs_set_camera(&device, &view);
        degs_set_frame_buffer(&device, kFrame, DEGS_FORMAT_RGBA8);
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_NONE);
        EXPECT_EQ(degs_views_drawn(&device), 1U);
        EXPECT_EQ(p.frame(eyes[1]), rgba8(closed.image(3)));
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    ASSERT_EQ(drawn.size(), 4U);
    ASSERT_EQ(asked.size(), 4U);
    std::uint64_t fragments = 0;
    for (std::size_t v = 0; v < 4; ++v) {
        const DrawnView& same = closed.drawn[v];
        EXPECT_EQ(drawn[v].entry, v / 3);
        EXPECT_EQ(static_cast<int>(drawn[v].scale), same.level.scale);
        EXPECT_EQ(drawn[v].address, same.address);
        EXPECT_EQ(static_cast<int>(drawn[v].width), same.level.camera.width);
        EXPECT_EQ(static_cast<int>(drawn[v].height), same.level.camera.height);
        EXPECT_EQ(static_cast<int>(drawn[v].x), same.level.first.x);
        EXPECT_EQ(static_cast<int>(drawn[v].y), same.level.first.y);
        EXPECT_EQ(static_cast<int>(drawn[v].shown[0]), same.level.shown.x0);
        EXPECT_EQ(static_cast<int>(drawn[v].shown[3]), same.level.shown.height());
        EXPECT_EQ(drawn[v].cycles, closed.finished[v]);
        EXPECT_EQ(asked[v].address, drawn[v].address);
        EXPECT_EQ(asked[v].cycles, 0U);
        fragments += drawn[v].fragments;
    }
    EXPECT_EQ(counters.fragments, fragments);
    EXPECT_EQ(counters.cycles, closed.finished.back());
}

// A frame that does not exist is never reported as rendered.
TEST(SmallRunDriver, NeverTakesAFrameThatDoesNotExistForRendered) {
    const GaussianCloud cloud = test_cloud();
    const Camera camera = test_camera();
    Platform p("p", DegsConfig(), cloud);
    constexpr std::uint32_t kPolls = 1'000'000;
    p.host.script = [&](Host& host) {
        const degs_device device = device_of(host);
        EXPECT_EQ(degs_wait(&device), DEGS_RESULT_NO_FRAME);
        program(host, cloud, camera);
        degs_start(&device, 0);
        EXPECT_EQ(degs_error(&device), DEGS_RESULT_BUSY);
        EXPECT_EQ(degs_wait_for(&device, 1), DEGS_RESULT_BUSY);
        degs_abort(&device);
        EXPECT_EQ(degs_wait(&device), DEGS_RESULT_ABORTED);
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait_for(&device, kPolls), DEGS_ERROR_CODE_NONE);
        degs_start(&device, 0);
        degs_start(&device, 0); // ignored: the frame before is being rendered
        EXPECT_EQ(degs_wait(&device), DEGS_RESULT_START_IGNORED);
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_NONE);
        degs_start(&device, 0);
        host.write(Register::Control, kControlReset);
        program(host, cloud, camera);
        degs_start(&device, 0); // ignored: the reset has not ended
        EXPECT_EQ(degs_wait(&device), DEGS_RESULT_START_IGNORED);
        EXPECT_EQ(degs_reset(&device, kPolls), DEGS_ERROR_CODE_NONE);
        EXPECT_EQ(degs_wait(&device), DEGS_RESULT_NO_FRAME);
        program(host, cloud, camera);
        degs_start(&device, 0);
        EXPECT_EQ(degs_wait(&device), DEGS_ERROR_CODE_NONE);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

// What frames before have left pending: the error of one that asks for the workspace, the end of
// one that was polled, an abort.
TEST(SmallRunDriver, TheInterruptOfAFrameComesAtItsEnd) {
    const GaussianCloud cloud = test_cloud();
    const Camera camera = test_camera();
    Platform p("p", DegsConfig(), cloud);
    p.host.script = [&](Host& host) {
        const degs_device device = device_of(host);
        const auto leave_pending = [&](std::uint32_t which) {
            program(host, cloud, camera);
            degs_set_workspace(&device, kWorkspace,
                               which == DEGS_IRQ_STATUS_ERROR ? 0 : kWorkspaceBytes);
            degs_start(&device, 0);
            if (which == DEGS_IRQ_STATUS_ABORTED) {
                degs_abort(&device);
            }
            degs_wait(&device);
            EXPECT_EQ(host.read(Register::IrqStatus), which);
        };
        for (const std::uint32_t which :
             {DEGS_IRQ_STATUS_ERROR, DEGS_IRQ_STATUS_DONE, DEGS_IRQ_STATUS_ABORTED}) {
            SCOPED_TRACE(which);
            leave_pending(which);
            degs_set_workspace(&device, kWorkspace, kWorkspaceBytes);
            degs_start(&device,
                       DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR | DEGS_IRQ_ENABLE_ABORTED);
            while (!host.irq.read()) {
                sc_core::wait(host.irq.value_changed_event());
            }
            EXPECT_EQ(degs_error(&device), DEGS_ERROR_CODE_NONE); // not "busy"
            EXPECT_EQ(degs_acknowledge(&device), DEGS_IRQ_STATUS_DONE);
        }
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

TEST(Driver, ReachesRegistersThatAreMappedIntoMemory) {
    std::array<std::uint32_t, kRegisterBytes / 4> words{};
    words[0] = kAcceleratorId;
    words[1] = kAcceleratorVersion;
    const degs_device device{words.data(), degs_mmio_read, degs_mmio_write};
    EXPECT_EQ(degs_probe(&device), 1);
    degs_set_workspace(&device, 0x123456789ABCDE00, 64);
    EXPECT_EQ(words[DEGS_REG_WORKSPACE / 4], 0x9ABCDE00U);
    EXPECT_EQ(words[DEGS_REG_WORKSPACE / 4 + 1], 0x12345678U);
    words[0] = 1;
    EXPECT_EQ(degs_probe(&device), 0);
}

} // namespace
} // namespace degs::test
