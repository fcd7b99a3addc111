// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/soc_study.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "base/ratio.hpp"
#include "scene/files/image_io.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/simulation/completed_run.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/soc/soc_platform.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/view.hpp"
#include "splat/foveation/compose.hpp"
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

Image reference_of(const FrameWorkload& frame) {
    ReferenceCounts counts;
    Image reference = render_reference(frame, counts);
    for (float& value : reference.rgb) {
        value = std::clamp(value, 0.0F, 1.0F);
    }
    return reference;
}

/// The image that its levels make up.
Image whole(const FoveatedView& image, const std::vector<Image>& levels) {
    std::vector<const Image*> pointers;
    pointers.reserve(levels.size());
    for (const Image& level : levels) {
        pointers.push_back(&level);
    }
    return levels.size() == 1 ? levels.front() : compose(image.camera, image.levels, pointers);
}

/// A frame for each load, one after the other in one simulation.
class StudyRuns {
public:
    StudyRuns(const SocRequest& request, SocPlatform& platform, const View& view)
        : request_(request), platform_(platform), cloud_(as_floats(view.scene.cloud)),
          images_(request.images.empty() ? images_of({view.camera}, {}) : request.images),
          antialiased_(view.scene.traits.antialiased) {}

    void operator()(SocHost& host) {
        host.load_scene(cloud_);
        host.set_images(images_, request_.foveation);
        host.reserve_memory();
        for (const double load : request_.loads) {
            platform_.set_load(load);
            sc_core::wait(sc_core::sc_time(kSettleUs, sc_core::SC_US));
            measure(host, load);
            const Pixels pixels = host.pixels(result.points.back().frame);
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
        result.psnr_db = std::numeric_limits<double>::infinity();
        std::size_t view = 0;
        for (const FoveatedView& image : images_) {
            result.images.push_back(judge(image, view));
            result.psnr_db = std::min(result.psnr_db, result.images.back().psnr_db);
            view += image.levels.size();
        }
    }

    SocResult result;

private:
    using Pixels = std::vector<std::vector<unsigned char>>; // of each drawn view

    /// `first`: the drawn view that is its finest level.
    SocImage judge(const FoveatedView& image, std::size_t first) {
        const AcceleratorConfig& config = request_.config.accelerator();
        SocImage judged;
        std::vector<Image> drawn;
        std::vector<Image> references;
        for (std::size_t v = 0; v < image.levels.size(); ++v) {
            const FrameWorkload frame = make_frame_workload(
                cloud_, image.levels[v].camera, config.tile_size_px(), config.tile_mode(),
                config.data_path().rules.options(antialiased_));
            references.push_back(reference_of(frame));
            drawn.push_back(image_of(pixels_[first + v], frame.camera));
            judged.crc32s.push_back(pixel_crc32(drawn.back()));
            if (first + v == 0) {
                result.warnings = near_plane_warnings(frame);
            }
        }
        judged.psnr_db = compare_images(whole(image, references), whole(image, drawn)).psnr_db;
        return judged;
    }
    static std::vector<Display::Part> parts_of(const SocFrame& frame) {
        std::vector<Display::Part> parts;
        for (const degs_drawn_view& view : frame.views) {
            parts.push_back(
                {view.address, static_cast<int>(view.width), static_cast<int>(view.height)});
        }
        return parts;
    }
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
            platform_.display().show(parts_of(point.frame));
        }
    }

    const SocRequest& request_;
    SocPlatform& platform_;
    GaussianCloud cloud_;
    std::vector<FoveatedView> images_;
    bool antialiased_;
    Pixels pixels_; // of the first frame
};

} // namespace

std::vector<FoveatedView> images_of(const std::vector<Camera>& cameras,
                                    const std::optional<Foveation>& foveation) {
    std::vector<FoveatedView> images;
    for (const Camera& camera : cameras) {
        const PixelBox all{0, 0, camera.width - 1, camera.height - 1};
        images.push_back({camera, foveation
                                      ? levels_of(camera, *foveation)
                                      : std::vector<FoveatedLevel>{{1, all, {0, 0}, camera}}});
    }
    return images;
}

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
