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

/// The frames of each load with each rate, one after the other in one simulation.
class StudyRuns {
public:
    StudyRuns(const SocRequest& request, SocPlatform& platform, const View& view)
        : request_(request), platform_(platform), cloud_(as_floats(view.scene.cloud)),
          images_(request.images.empty() ? images_of({view.camera}, {}) : request.images),
          antialiased_(view.scene.traits.antialiased) {
        platform_.host(0).program = [this](SocHost& host) { measure_all(host); };
        for (std::size_t i = 1; i < platform_.accelerators(); ++i) {
            others_.push_back(std::make_unique<Competitor>(
                platform_.host(i), [this](SocHost& host) { prepare(host); }));
        }
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
    /// `first`: the drawn view that is its finest level.
    SocImage judge(const FoveatedView& image, std::size_t first) {
        const AcceleratorConfig& config = request_.config().accelerator();
        SocImage judged;
        std::vector<Image> drawn;
        std::vector<Image> references;
        for (std::size_t v = 0; v < image.levels.size(); ++v) {
            const FrameWorkload frame = make_frame_workload(
                cloud_, image.levels[v].camera, config.tile_size_px(), config.tile_mode(),
                config.data_path().rules.options(antialiased_));
            references.push_back(reference_of(frame));
            drawn.push_back(image_of(platform_.host(0).pixels()[first + v], frame.camera));
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
    void prepare(SocHost& host) const {
        host.load_scene(cloud_);
        host.set_images(images_, request_.foveation);
        host.reserve_memory();
    }
    void set_rates(double frames_per_s) {
        for (const auto& other : others_) {
            other->set_rate(frames_per_s);
        }
    }
    void measure_all(SocHost& host) {
        prepare(host);
        for (const double load : request_.loads) {
            for (const double rate : request_.rates) {
                for (const auto& other : others_) {
                    other->wait_until_idle();
                }
                platform_.set_load(load);
                sc_core::wait(sc_core::sc_time(kSettleUs, sc_core::SC_US));
                set_rates(rate);
                measure(host, load, rate);
                set_rates(0);
            }
        }
        platform_.set_load(0);
        result.display = platform_.display().stats();
    }
    /// What has been counted up to now.
    struct Snapshot {
        std::uint64_t cpu = 0;
        Display::Stats display;
        std::vector<std::uint64_t> bytes;
        std::vector<Competitor::Counts> counts;
    };
    Snapshot snapshot() const {
        Snapshot now{platform_.cpu_bytes(), platform_.display().stats(), {}, {}};
        for (std::size_t i = 0; i < others_.size(); ++i) {
            now.bytes.push_back(platform_.accelerator_bytes(i + 1));
            now.counts.push_back(others_[i]->counts());
        }
        return now;
    }
    void measure(SocHost& host, double load, double rate) {
        SocPoint point;
        point.offered_gb_per_s = load;
        point.rate_per_s = rate;
        const Snapshot before = snapshot();
        const sc_core::sc_time begin = sc_core::sc_time_stamp();
        for (int f = 0; f < request_.frames; ++f) {
            point.frames.push_back(render(host, load));
        }
        fill(point, before, snapshot(), (sc_core::sc_time_stamp() - begin).to_seconds() * 1e9);
        result.points.push_back(point);
    }
    static void fill(SocPoint& point, const Snapshot& before, const Snapshot& after, double ns) {
        const auto rate = [ns](std::uint64_t bytes) { return rate_of(bytes, ns); };
        point.cpu_gb_per_s = rate(after.cpu - before.cpu);
        point.display_gb_per_s = rate(after.display.bytes - before.display.bytes);
        point.display_rows = after.display.rows - before.display.rows;
        point.late_rows = after.display.underruns - before.display.underruns;
        std::uint64_t own = 0;
        for (const SocFrame& frame : point.frames) {
            own += frame.bytes_read + frame.bytes_written;
        }
        point.accelerator_gb_per_s = rate(own);
        for (std::size_t i = 0; i < after.bytes.size(); ++i) {
            point.others.push_back(
                {rate(after.bytes[i] - before.bytes[i]), after.counts[i].since(before.counts[i])});
        }
    }
    SocFrame render(SocHost& host, double load) {
        const sc_core::sc_time begin = sc_core::sc_time_stamp();
        SocFrame frame = host.render();
        const ClockDomain clock(request_.config().accelerator().clock_ghz);
        result.frames.push_back({"frame, cores ask for " + three_digits(load) + " GB/s",
                                 clock.floor(begin), clock.ceil(sc_core::sc_time_stamp())});
        if (request_.refresh_hz > 0) {
            platform_.display().show(parts_of(frame));
        }
        return frame;
    }

    const SocRequest& request_;
    SocPlatform& platform_;
    GaussianCloud cloud_;
    std::vector<FoveatedView> images_;
    bool antialiased_;
    std::vector<std::unique_ptr<Competitor>> others_;
};

} // namespace

double SocPoint::latency_ns() const {
    double sum = 0;
    for (const SocFrame& frame : frames) {
        sum += frame.latency_ns;
    }
    return mean_of(sum, frames.size());
}

std::size_t SocPoint::late_frames(double deadline_ms) const {
    return std::count_if(frames.begin(), frames.end(), [deadline_ms](const SocFrame& frame) {
        return deadline_ms > 0 && frame.latency_ns > 1e6 * deadline_ms;
    });
}

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
    {
        Progress progress("platform");
        const std::size_t frames =
            request.loads.size() * request.rates.size() * static_cast<std::size_t>(request.frames);
        while (!platform.host(0).finished()) {
            sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_US));
            progress.done(ratio_of(study.result.frames.size(), frames));
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
