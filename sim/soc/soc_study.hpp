// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "dram/channels.hpp"
#include "sim/design/run_config.hpp"
#include "sim/soc/competitor.hpp"
#include "sim/soc/cpu_traffic.hpp"
#include "sim/soc/display.hpp"
#include "sim/soc/soc_host.hpp"
#include "sim/trace/trace_file.hpp"
#include "sim/view/foveated_view.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {

/// An accelerator of the platform; `qos`: of its accesses, 0 to 15.
struct SocAccelerator {
    RunConfig config;
    unsigned qos = 0;
};

/// The parts of the platform, and the loads that compete with the accelerator.
struct SocRequest {
    std::vector<SocAccelerator> accelerators =
        std::vector<SocAccelerator>(1); ///< the first is measured, the others compete with it
    dram::Config memory;
    std::vector<double> loads;    ///< GB/s that all cores together ask for
    std::vector<double> rates{0}; ///< frames per second that each other accelerator begins
    int frames = 1;               ///< for each load and rate
    double deadline_ms = 0;       ///< of a frame; 0: none
    int cores = 4;
    unsigned cores_qos = 0, display_qos = 0;
    CpuTraffic::Pattern pattern = CpuTraffic::Pattern::Stream;
    int reads_per_write = 2;
    double refresh_hz = 60;                   ///< of the display; 0: none
    std::optional<Timeline::Config> timeline; ///< of the measured accelerator
    std::vector<FoveatedView> images;         ///< of a frame; empty: the camera of the view
    std::optional<Foveation> foveation;       ///< of each image

    /// The design that is measured.
    const RunConfig& config() const { return accelerators.front().config; }
};

/// The images of cameras, with the levels that draw them.
std::vector<FoveatedView> images_of(const std::vector<Camera>& cameras,
                                    const std::optional<Foveation>& foveation);

struct SocPoint {
    double offered_gb_per_s = 0; ///< by the cores
    double cpu_gb_per_s = 0;     ///< that they got during the frame
    double display_gb_per_s = 0;
    std::uint64_t display_rows = 0; ///< that the display fetched during the frame
    std::uint64_t late_rows = 0;    ///< of those, underruns
    double accelerator_gb_per_s = 0;
    std::vector<SocFrame> frames; ///< of the measured accelerator, one after the other
    /// What another accelerator did meanwhile.
    struct Other {
        double gb_per_s = 0;
        Competitor::Counts counts;
    };
    double rate_per_s = 0; ///< at which they begin frames
    std::vector<Other> others;

    double latency_ns() const; ///< mean of the frames
    /// Frames that took longer; 0: no deadline.
    std::size_t late_frames(double deadline_ms) const;
};

/// An image as it was in memory, or was made from the levels that were there.
struct SocImage {
    double psnr_db = 0;              ///< against the image in double precision, clamped to 0..1
    std::vector<std::string> crc32s; ///< of its levels
};

struct SocResult {
    std::vector<SocPoint> points;
    double psnr_db = 0; ///< the least of the images
    std::vector<SocImage> images;
    std::vector<std::string> warnings; ///< sentences about the frame
    Display::Stats display;
    double wall_s = 0;
    TimelineRecord timeline;       ///< if asked for
    std::vector<TraceSpan> frames; ///< cycles of the accelerator, if asked for
};

/// Hosts, accelerators, display controller and cores on an AddressBus with an Lpddr5 memory:
/// renders the frames of each load with each rate. Once per process. Throws InputError if the scene
/// does not fit, std::logic_error if a frame's pixels depend on the load, std::runtime_error if an
/// accelerator reports an error.
SocResult run_soc(const SocRequest& request, const View& view);

nlohmann::ordered_json soc_json(const SocRequest& request, const View& view,
                                const SocResult& result);
std::string soc_words(const SocRequest& request, const View& view, const SocResult& result);
/// Frame latency over the traffic of cores and other accelerators.
std::string soc_svg(const std::string& title, const std::vector<SocPoint>& points);

} // namespace degs::sim
