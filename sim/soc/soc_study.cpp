// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/soc_study.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/ratio.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/simulation/completed_run.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/soc/soc_platform.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/view.hpp"
#include "splat/images/image_metrics.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs::sim {
namespace {

constexpr double kSettleUs = 5; // from a change of load to the frame

/// The scene as floats hold it, which is what memory holds.
GaussianCloud as_floats(GaussianCloud cloud) {
    for (glm::dvec3& mean : cloud.means) {
        mean = glm::dvec3(glm::vec3(mean));
    }
    return cloud;
}

Image image_of(const std::vector<unsigned char>& rgba, const Camera& camera) {
    Image image(camera.width, camera.height);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            image.rgb[3 * i + c] = static_cast<float>(rgba[4 * i + c]) / 255.0F;
        }
    }
    return image;
}

double psnr(const std::vector<unsigned char>& rgba, const FrameWorkload& frame) {
    ReferenceCounts counts;
    Image reference = render_reference(frame, counts);
    for (float& value : reference.rgb) {
        value = std::clamp(value, 0.0F, 1.0F);
    }
    return compare_images(reference, image_of(rgba, frame.camera)).psnr_db;
}

/// A frame for each load, one after the other in one simulation.
class StudyRuns {
public:
    StudyRuns(const SocRequest& request, SocPlatform& platform, const View& view)
        : request_(request), platform_(platform), cloud_(as_floats(view.scene.cloud)),
          camera_(view.camera), antialiased_(view.scene.traits.antialiased) {}

    void operator()(SocHost& host) {
        host.load_scene(cloud_);
        host.set_camera(camera_);
        host.reserve_memory();
        for (const double load : request_.loads) {
            platform_.set_load(load);
            sc_core::wait(sc_core::sc_time(kSettleUs, sc_core::SC_US));
            measure(host, load);
            const std::vector<unsigned char> pixels = host.pixels(result.points.back().frame);
            if (pixels_.empty()) {
                pixels_ = pixels;
            } else if (pixels_ != pixels) {
                throw std::logic_error("the model is broken: pixels depend on the memory's load");
            }
        }
        platform_.set_load(0);
        result.display = platform_.display().stats();
    }
    void judge() {
        const AcceleratorConfig& config = request_.config.accelerator();
        const FrameWorkload frame =
            make_frame_workload(cloud_, camera_, config.tile_size_px(), config.tile_mode(),
                                config.data_path().rules.options(antialiased_));
        result.psnr_db = psnr(pixels_, frame);
        result.warnings = near_plane_warnings(frame);
    }

    SocResult result;

private:
    void measure(SocHost& host, double load) {
        const std::uint64_t cpu = platform_.cpu_bytes();
        const Display::Stats shown = platform_.display().stats();
        SocPoint point;
        point.offered_gb_per_s = load;
        const sc_core::sc_time begin = sc_core::sc_time_stamp();
        point.frame = host.render();
        const ClockDomain clock(request_.config.accelerator().clock_ghz);
        result.frames.push_back({"frame, cores ask for " + three_digits(load) + " GB/s",
                                 clock.floor(begin), clock.ceil(sc_core::sc_time_stamp())});
        const double ns = point.frame.latency_ns;
        const auto rate = [ns](std::uint64_t bytes) { return rate_of(bytes, ns); };
        point.cpu_gb_per_s = rate(platform_.cpu_bytes() - cpu);
        const Display::Stats& display = platform_.display().stats();
        point.display_gb_per_s = rate(display.bytes - shown.bytes);
        point.display_rows = display.rows - shown.rows;
        point.late_rows = display.underruns - shown.underruns;
        point.accelerator_gb_per_s = rate(point.frame.bytes_read + point.frame.bytes_written);
        result.points.push_back(point);
        if (request_.refresh_hz > 0) {
            platform_.display().show(point.frame.frame_buffer);
        }
    }

    const SocRequest& request_;
    SocPlatform& platform_;
    GaussianCloud cloud_;
    Camera camera_;
    bool antialiased_;
    std::vector<unsigned char> pixels_;
};

} // namespace

SocResult run_soc(const SocRequest& request, const View& view) {
    const Stopwatch wall;
    std::optional<Timeline> timeline;
    if (request.timeline) {
        timeline.emplace(*request.timeline);
    }
    SocPlatform platform("soc", request, view, timeline ? &*timeline : nullptr);
    StudyRuns study(request, platform, view);
    platform.host().program = [&study](SocHost& host) { study(host); };
    {
        Progress progress("platform");
        while (!platform.host().finished()) {
            sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_US));
            progress.done(ratio_of(study.result.points.size(), request.loads.size()));
        }
    }
    study.judge();
    if (timeline) {
        platform.complete_timeline();
        study.result.timeline = timeline->record(study.result.frames.back().to);
    }
    study.result.wall_s = wall.seconds();
    return study.result;
}

} // namespace degs::sim
