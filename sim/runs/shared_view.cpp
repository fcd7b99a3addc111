// SPDX-License-Identifier: Apache-2.0
#include "sim/runs/shared_view.hpp"

#include <cstring>
#include <string_view>

#include <nlohmann/json.hpp>

#include "sim/analytic/analytic_run.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/report.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/simulation/completed_run.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

void SharedView::render_references() {
    const FrameWorkload& frame = frames.front();
    const decltype(reference_kind) kind{image_tiles(frame), rule_kind(frame.projection)};
    if (!references.views.empty() && reference_kind == kind) {
        return;
    }
    references.views.clear();
    for (int v = 0; v < views; ++v) {
        references.views.push_back(make_reference(*cloud, frames[v], workload_s));
    }
    reference_kind = kind;
}

void SharedView::share_colours() {
    const auto step = static_cast<std::size_t>(views);
    for (std::size_t first = 0; first < frames.size(); first += step) {
        if (dynamic) {
            sim::share_colours(dynamic->frame(static_cast<int>(first / step)), frames, first, step);
        } else {
            sim::share_colours(*cloud, frames, first, step);
        }
    }
}

// Most designs of a study draw the same image, whose error is found once.
ImageError SharedView::error_of(std::size_t view, const Image& reference,
                                const Image& image) const {
    constexpr int kMostImages = 8; // of different numbers
    std::string pixels(reinterpret_cast<const char*>(image.rgb.data()),
                       image.rgb.size() * sizeof(float));
    pixels.append(reinterpret_cast<const char*>(image.transmittance.data()),
                  image.transmittance.size() * sizeof(float));
    for (int number = 0; kept != nullptr && number < kMostImages; ++number) {
        const std::string name =
            "image " + std::to_string(number) + " of view " + std::to_string(view);
        const std::string_view known = kept->find(name);
        if (known.data() == nullptr) {
            const ImageError error = compare_images(reference, image);
            std::string bytes(reinterpret_cast<const char*>(&error), sizeof error);
            kept->put(name, bytes.append(pixels));
            return error;
        }
        if (known.substr(sizeof(ImageError)) == pixels) {
            ImageError error;
            std::memcpy(&error, known.data(), sizeof error);
            return error;
        }
    }
    return compare_images(reference, image);
}

std::string SharedView::run(const RunRequest& request, bool path) const {
    const Stopwatch wall;
    Progress::silence();
    std::vector<const FrameWorkload*> wanted;
    const auto per_frame = static_cast<std::size_t>(views);
    for (const FrameWorkload& frame : frames) {
        if (path || wanted.size() < per_frame) {
            wanted.push_back(&frame);
        }
    }
    RunResult result = run_frames(request, source_of(wanted));
    put_scene(scene, result);
    if (request.reference && !path) {
        judge(result, references,
              [this](std::size_t view, const Image& reference, const Image& image) {
                  return error_of(view, reference, image);
              });
    }
    result.host.load_s = load_s;
    result.host.workload_s = workload_s;
    result.host.wall_s = wall.seconds();
    RunSummary summary = summary_of(result, camera);
    summary.report = json_text(report(result));
    return message_of(summary);
}

std::string SharedView::estimate(const RunConfig& config) const {
    AnalyticRun run = run_analytic(config, scene, frames.front());
    run.load_s = load_s;
    run.workload_s = workload_s;
    RunSummary summary = summary_of(run, camera);
    summary.report = json_text(analytic_json(run));
    return message_of(summary);
}

} // namespace degs::sim
