// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <utility>

#include "accuracy/image_difference.hpp"
#include "sim/accuracy/speed/speed.hpp"
#include "sim/analytic/analytic_run.hpp"
#include "sim/cache/binary.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/process/child_process.hpp"
#include "sim/process/stopping_signals.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/measures.hpp"
#include "sim/sampling/sampled_run.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/warnings.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/reference.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

/// What a run sends to the process that compares it.
struct SpeedOutcome {
    double run_s = 0, cycles = 0, utilization = 0;
    std::optional<double> dram_bytes, psnr_db, share, low, high;
    bool identical = false;
    Image image; ///< only if nothing is there yet to compare with

    template <class Archive>
    void pass(Archive& archive) {
        archive.pass(run_s, cycles, utilization, dram_bytes, psnr_db, share, low, high, identical,
                     image.width, image.height, image.rgb, image.transmittance, image.fragments);
    }
};

SpeedOutcome outcome_of(const RunResult& result) {
    SpeedOutcome outcome;
    const Measures measures = measures_of(result);
    outcome.run_s = result.host.run_s;
    outcome.cycles = measures[Measure::Cycles].value_or(0);
    outcome.utilization = measures[Measure::Utilization].value_or(0);
    if (measures[Measure::DramRead] && measures[Measure::DramWritten]) {
        outcome.dram_bytes = *measures[Measure::DramRead] + *measures[Measure::DramWritten];
    }
    if (result.sampling) {
        const SamplingFacts& facts = *result.sampling;
        outcome.share = static_cast<double>(facts.measured) / static_cast<double>(facts.tiles);
        if (const ReportInterval* cycles = facts.interval_of("timing.cycles")) {
            outcome.low = cycles->low;
            outcome.high = cycles->high;
        }
    }
    return outcome;
}

void compare_pictures(const Image& truth, const Image& image, SpeedOutcome& outcome) {
    ImageDifference difference;
    difference.add(truth, image);
    outcome.identical = difference.identical();
    if (!outcome.identical && !std::isnan(difference.psnr_db())) {
        outcome.psnr_db = difference.psnr_db();
    }
}

/// In the child: a run, compared with `truth`; without one its image goes along.
std::string run_in_child(const RunRequest& request, const FrameWorkload& frame,
                         const Image& truth) {
    Progress::silence();
    RunResult result = run_frames(request, source_of({&frame}));
    SpeedOutcome outcome = outcome_of(result);
    Image& image = result.accelerator.images.front();
    if (truth.rgb.empty()) {
        outcome.image = std::move(image);
    } else if (!result.sampling) { // most of a sample's image is missing
        compare_pictures(truth, image, outcome);
    }
    BinaryWriter message;
    outcome.pass(message);
    return std::move(message.bytes);
}

/// Runs of one accelerator after the other, and what they are compared with.
class SpeedRuns {
public:
    explicit SpeedRuns(const SpeedRequest& request)
        : request_(request), view_(request.view, PathRequest(), FrameCache()) {}

    SpeedResult measure() {
        SpeedResult result;
        for (const SpeedDesign& design : request_.designs) {
            frames_ = view_.first_frame(design.config.accelerator());
            if (accelerator_ != design.accelerator) {
                begin_accelerator(design);
                if (result.rows.empty()) {
                    result.view = view_facts();
                }
            }
            for (const std::string& name : request_.fidelities) {
                measure_fidelity(design, speed_fidelity(name), result.rows);
            }
        }
        return result;
    }

private:
    /// The run that the others are measured against is the first one.
    void begin_accelerator(const SpeedDesign& design) {
        accelerator_ = design.accelerator;
        print_warnings(near_plane_warnings(*frames_.front()));
        const Reference reference = view_.references(frames_).views.front();
        render_s_ = reference.render_s;
        fragments_ = reference.counts.fragments;
        truth_.image = Image();
        truth_ = run(design, speed_fidelity("strict"));
        truth_.identical = true;
    }

    SpeedView view_facts() const {
        SpeedView facts;
        facts.scene = view_.facts().name;
        facts.camera = request_.view.camera;
        facts.width = frames_.front()->camera.width;
        facts.height = frames_.front()->camera.height;
        facts.fragments = fragments_;
        return facts;
    }

    void measure_fidelity(const SpeedDesign& design, SpeedFidelity fidelity,
                          std::vector<SpeedRow>& rows) {
        if (!fidelity.sampling) {
            const bool truth = design.numbers == "ideal" && fidelity.name == "strict";
            rows.push_back(row(design, fidelity, truth ? truth_ : run(design, fidelity)));
            return;
        }
        for (std::uint64_t seed = 1; seed <= request_.seeds; ++seed) {
            fidelity.sampling->seed = seed;
            rows.push_back(row(design, fidelity, run(design, fidelity)));
        }
    }

    /// Estimates a design in this process, because that takes only some milliseconds.
    SpeedOutcome estimated(const SpeedDesign& design) const {
        const std::unique_ptr<AnalyticModel> model = analytic_model_of(design.config);
        const CpuStopwatch clock;
        const AnalyticFrame frame =
            estimate_frame(*model, *frames_.front(), design.config.accelerator().tile_order);
        SpeedOutcome outcome;
        outcome.run_s = clock.seconds();
        outcome.cycles = frame.cycles;
        outcome.utilization = frame.utilization;
        outcome.dram_bytes = frame.bytes;
        return outcome;
    }

    SpeedOutcome run(const SpeedDesign& design, const SpeedFidelity& fidelity) const {
        if (fidelity.analytic) {
            return estimated(design);
        }
        RunRequest request;
        request.config = design.config;
        request.fidelity = fidelity.fidelity;
        request.sampling = fidelity.sampling;
        const std::string name = design.accelerator + ", " + design.numbers + ", " + fidelity.name;
        ChildOutcome ended;
        {
            const Progress progress(name);
            run_children(
                {{name, [&] { return run_in_child(request, *frames_.front(), truth_.image); }}}, 1,
                {[&ended](std::size_t, ChildOutcome&& outcome) { ended = std::move(outcome); },
                 {}});
        }
        if (ended.failure) {
            throw FailureError(*ended.failure);
        }
        BinaryReader message(ended.output.data(), ended.output.size());
        SpeedOutcome outcome;
        outcome.pass(message);
        if (!message.complete()) { // a signal has come
            throw FailureError({interruption_code(), "Interrupted; nothing has been written."});
        }
        return outcome;
    }

    SpeedRow row(const SpeedDesign& design, const SpeedFidelity& fidelity,
                 const SpeedOutcome& outcome) const {
        SpeedRow row;
        row.accelerator = design.accelerator;
        row.fidelity = fidelity.name;
        row.numbers = design.numbers;
        if (fidelity.sampling) {
            row.seed = fidelity.sampling->seed;
        }
        row.sim_s = outcome.run_s;
        row.over_render = outcome.run_s / render_s_;
        row.fragments_per_s = static_cast<double>(fragments_) / outcome.run_s;
        row.cycles = outcome.cycles;
        row.cycles_error = outcome.cycles / truth_.cycles - 1;
        row.utilization_error = outcome.utilization - truth_.utilization;
        if (outcome.dram_bytes && truth_.dram_bytes.value_or(0) > 0) {
            row.dram_error = *outcome.dram_bytes / *truth_.dram_bytes - 1;
        }
        row.identical = outcome.identical;
        row.psnr_db = outcome.psnr_db;
        row.share = outcome.share;
        row.interval_low = outcome.low;
        row.interval_high = outcome.high;
        return row;
    }

    const SpeedRequest& request_;
    CachedView view_;
    std::vector<FramePointer> frames_; ///< of the present design
    std::string accelerator_;          ///< the present one
    double render_s_ = 0;
    std::uint64_t fragments_ = 0;
    SpeedOutcome truth_; ///< with its image
};

} // namespace

SpeedResult measure_speed(const SpeedRequest& request) {
    return SpeedRuns(request).measure();
}

} // namespace degs::sim
