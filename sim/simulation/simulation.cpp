// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/simulation.hpp"

#include <stdexcept>
#include <utility>

#include "sim/accelerator/accelerator_run.hpp"
#include "sim/process/memory_use.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/sampling/sampled_run.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/simulation/loss_keys.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_warnings.hpp"

namespace degs::sim {

namespace {

/// The sample that the request asks for, or the reason why there is none.
std::optional<SampledResult> try_sample(const RunRequest& request, const FrameWorkload& frame,
                                        std::string& refusal) {
    Progress progress("simulation of a sample");
    SampledResult sampled = run_sampled(request.config.accelerator(), frame, request.fidelity,
                                        request.build, *request.sampling, progress);
    refusal = sampled.facts.refusal;
    return refusal.empty() ? std::optional<SampledResult>(std::move(sampled)) : std::nullopt;
}

const char* name_of(Fidelity fidelity) {
    return fidelity == Fidelity::Strict ? "strict" : "exact";
}

void append(std::vector<std::string>& to, const std::vector<std::string>& sentences) {
    to.insert(to.end(), sentences.begin(), sentences.end());
}

/// The frames of a run on their way to the accelerator. Those of the first frame are there before
/// the others are taken.
class TakenFrames {
public:
    TakenFrames(FrameSource frames, std::size_t views)
        : all_(frames.frames), views_(views), frames_(std::move(frames)), changes_(all_ / views) {
        while (first_.size() < views) {
            first_.push_back(take_next());
        }
    }

    const std::vector<FramePointer>& first() const { return first_; }
    bool several() const { return all_ > views_; }
    /// All frames, from the first on.
    FrameSource source() {
        return {all_, [this] { return take(); }};
    }
    /// Is asked when all have been taken.
    FrameChanges changes() const { return changes_.changes(); }
    const WorstNearPlane& near_plane() const { return near_plane_; }
    /// Host time of all threads in which they were made.
    double made_s() const { return made_s_; }

private:
    FramePointer take() {
        FramePointer frame = given_ < views_ ? std::move(first_[given_]) : take_next();
        ++given_;
        return frame;
    }
    FramePointer take_next() {
        const CpuStopwatch clock;
        FramePointer frame = frames_.take();
        made_s_ += clock.seconds();
        if (frame != nullptr) {
            near_plane_.add(*frame);
            if (several() && taken_++ % views_ == 0) {
                changes_.add(frame);
            }
        }
        return frame;
    }

    std::size_t all_, views_, taken_ = 0, given_ = 0;
    FrameSource frames_;
    double made_s_ = 0;
    std::vector<FramePointer> first_; ///< until they are given
    FrameChangesSum changes_;         ///< of the first view of each frame
    WorstNearPlane near_plane_;
};

/// What is known of the first frame, its views and the design before the run.
void put_first_frame(const RunRequest& request, const std::vector<FramePointer>& views,
                     RunResult& result) {
    const FrameWorkload& first = *views.front();
    result.config = request.config;
    // Designs that are refused throw, behind a simulation from a stack that sanitizers do not know.
    result.movable_keys = LossKeys(result).movable();
    result.camera = first.camera;
    result.workload = facts_of(first);
    result.warnings = request.config.warnings;
    for (std::size_t v = 0; views.size() > 1 && v < views.size(); ++v) {
        result.views.push_back({views[v]->camera, facts_of(*views[v]), {}});
    }
    append(result.warnings, saturation_warnings(request.config.accelerator().data_path(), first));
    append(result.warnings, lens_warnings(first.camera, first.projection));
}

/// A sentence if pixels were updated again before their write-back.
std::vector<std::string> hazard_warnings(const AcceleratorResult& run) {
    if (run.hazards == 0) {
        return {};
    }
    return {"Hazards: " + grouped(run.hazards) +
            " pixels were updated again before their write-back, because scheduler.scoreboard is "
            "false. Updates are lost and the image is wrong; image.psnr_db and "
            "image.max_abs_error of the report say by how much."};
}

void put_host(const RunRequest& request, RunResult& result, double run_s) {
    result.host.fidelity = result.sampling ? "sampled" : name_of(request.fidelity);
    result.host.elaborate_s = result.accelerator.elaborate_s;
    result.host.sim_s = result.accelerator.sim_s;
    result.host.functional_s = result.accelerator.functional_s;
    result.host.activations = result.accelerator.activations;
    result.host.run_s = run_s;
    result.host.peak_rss_bytes = peak_rss_bytes();
}

} // namespace

RunResult run_frames(const RunRequest& request, FrameSource frames) {
    const CpuStopwatch clock;
    RunResult result;
    TakenFrames taken(std::move(frames), request.views);
    put_first_frame(request, taken.first(), result);
    std::string refusal;
    std::optional<SampledResult> sampled;
    if (request.sampling) {
        if (taken.several()) {
            throw std::logic_error("a sample of tiles is of one frame, and the run has several");
        }
        sampled = try_sample(request, *taken.first().front(), refusal);
    }
    std::vector<std::string> later; // warnings of the run
    if (sampled) {
        result.accelerator = std::move(sampled->result);
        result.sampling = std::move(sampled->facts);
        if (!result.sampling->warning.empty()) {
            later.push_back(result.sampling->warning);
        }
    } else {
        Progress progress("simulation");
        result.accelerator =
            run_accelerator(request.config.accelerator(), taken.source(), request.fidelity,
                            request.build, request.recording, progress, request.views);
        if (!result.accelerator.images.empty()) {
            later = saturation_warnings(request.config.accelerator().data_path(),
                                        result.accelerator.images.front());
        }
    }
    if (taken.several()) {
        result.changes = taken.changes();
    }
    append(result.warnings, taken.near_plane().sentences());
    if (!refusal.empty()) {
        result.warnings.push_back(refusal);
    }
    append(result.warnings, later);
    append(result.warnings, hazard_warnings(result.accelerator));
    put_host(request, result, clock.seconds() - taken.made_s());
    return result;
}

} // namespace degs::sim
