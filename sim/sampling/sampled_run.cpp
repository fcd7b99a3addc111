// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/sampled_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "base/ratio.hpp"
#include "degs/error.hpp"
#include "modules/kit/analytic/analytic_frame.hpp"
#include "modules/kit/analytic/expected_work.hpp"
#include "sim/accelerator/accelerator_run.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/sampling/frame_estimate.hpp"
#include "sim/sampling/sample_design.hpp"
#include "sim/sampling/stopping_rule.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

void hatch(Image& image, const Camera& camera, const JobTile& tile) {
    constexpr int kApart = 8;
    constexpr std::array<double, 3> kLine{0.5, 0.5, 0.5}, kGround{0.1, 0.1, 0.1};
    const PixelRange rows = tile.rows(), columns = tile.columns();
    for (int y = rows.first; y <= rows.last; ++y) {
        for (int x = columns.first; x <= columns.last; ++x) {
            const bool line = (x + y) % kApart == 0;
            image.put(camera.place_of(x, y), (line ? kLine : kGround).data(), 1.0, 0);
        }
    }
}

/// The engine with its job, to which tiles are added while it exists.
class OpenRun {
public:
    OpenRun(const AcceleratorConfig& config, const FrameWorkload& frame, const Timebase& time,
            const BuildOptions& options)
        : config_(config), time_(time), job_(make_render_job({&frame}, config)),
          all_(job_.tiles.begin(), job_.tiles.end()) {
        job_.tiles = TileList();
        job_.joined = std::make_unique<sc_core::sc_event>();
        job_.recorder = std::make_unique<SlotRecorder>(nullptr);
        engine_ = config.build("accelerator", time_, job_, options);
    }

    const std::vector<JobTile>& all() const { return all_; }
    std::size_t simulated() const { return job_.tiles.size(); }
    const AcceleratorConfig& config() const { return config_; }

    /// Returns the tile's number in the job.
    std::size_t add(std::size_t tile) {
        job_.tiles.push_back(all_[tile]);
        return job_.tiles.size() - 1;
    }
    /// Simulates until nothing is left to happen.
    void settle() {
        (job_.joined ? job_.joined : joined_)->notify(sc_core::SC_ZERO_TIME);
        sc_core::sc_start();
        for (std::size_t number = over_.size(); number < job_.tiles.size(); ++number) {
            window_.include(activity_of(number).window);
            over_.push_back(window_.last + 1);
        }
    }
    /// The tiles that have been added are the last.
    void close() {
        joined_ = std::move(job_.joined);
        settle();
        job_.recorder->close();
    }
    /// What `count` tiles of the job from `first` on have of the blending window, so far. Where
    /// tiles are in work one after the other, their share is the time from the last task of the
    /// tiles before them to the last task of their own; else it is their PE-cycles.
    WindowPart part_of(std::size_t first, std::size_t count, bool in_turn) const {
        WindowPart part;
        for (std::size_t number = first; number < first + count; ++number) {
            part.slots += activity_of(number).slots;
        }
        part.total =
            in_turn ? config_.pes() * (end_of(first + count) - end_of(first)) : part.slots.total();
        return part;
    }
    AcceleratorResult result(bool array_only) const {
        AcceleratorResult result;
        result.name = config_.name;
        result.pes = config_.pes();
        result.clock_ghz = config_.clock_ghz;
        result.array_only = array_only;
        result.tiles_listed = job_.tiles.size();
        result.stopped = time_.clock.ceil(sc_core::sc_time_stamp());
        engine_->collect(result);
        return result;
    }
    /// Tiles that were not simulated are hatched, and as transparent as where nothing was drawn.
    std::vector<Image> images() {
        std::set<std::pair<int, int>> drawn;
        for (const JobTile& tile : job_.tiles) {
            drawn.emplace(tile.x, tile.y);
        }
        for (const JobTile& tile : all_) {
            if (drawn.count({tile.x, tile.y}) == 0) {
                hatch(job_.images.front(), job_.frame_of(tile).camera, tile);
            }
        }
        return {std::make_move_iterator(job_.images.begin()),
                std::make_move_iterator(job_.images.end())};
    }

private:
    /// When the last task of the first `count` tiles of the job is over.
    Cycle end_of(std::size_t count) const {
        return std::max(count == 0 ? 0 : over_[count - 1], window_.first);
    }
    TileActivity activity_of(std::size_t number) const {
        const std::vector<TileActivity>& tiles = job_.recorder->tiles();
        return number < tiles.size() ? tiles[number] : TileActivity();
    }

    const AcceleratorConfig& config_;
    const Timebase& time_;
    RenderJob job_;
    std::vector<JobTile> all_;
    ActiveWindow window_;     ///< of the tiles that have been simulated
    std::vector<Cycle> over_; ///< its end with the first n + 1 of them
    std::unique_ptr<RenderEngine> engine_;
    std::unique_ptr<sc_core::sc_event> joined_; ///< of a closed job: processes still wait for it
};

/// The sample as it grows.
class Sampler {
public:
    Sampler(OpenRun& run, const std::vector<TileWork>& work, SampleDesign design,
            FrameEstimate& estimate, bool array_only, bool in_turn)
        : run_(run), work_(work), design_(std::move(design)), estimate_(estimate),
          array_only_(array_only), in_turn_(in_turn), contexts_(run.config().tile_contexts()),
          warm_up_(warm_up_tiles(run.config().tile_contexts())) {}

    void begin() {
        for (std::size_t t = 0; t < design_.edge; ++t) {
            run_.add(t);
        }
        run_.settle();
        before_ = run_.result(array_only_);
        estimate_.begin(before_);
    }

    bool more() const { return next_ < design_.groups.size(); }

    void simulate_group() {
        const std::size_t group = next_++;
        TileWork simulated = kNoWork;
        std::vector<std::pair<std::size_t, std::size_t>> blocks; // number of the first tile
        std::size_t least = warm_up_, over = 0;                  // `over`: behind the block before
        for (const std::size_t b : design_.groups[group]) {
            const TileBlock& block = design_.blocks[b];
            std::size_t from = warm_up_from(block.first, least);
            from = over <= block.first ? std::max(over, from) : from; // else it lies further down
            for (std::size_t t = from; t < block.first; ++t) {
                run_.add(t);
                simulated += work_[t];
            }
            least = contexts_; // the pipeline is full
            over = block.first + block.count;
            blocks.emplace_back(b, run_.simulated());
            for (std::size_t t = block.first; t < block.first + block.count; ++t) {
                run_.add(t);
                simulated += work_[t];
            }
            measured_ += block.count;
        }
        run_.settle();
        AcceleratorResult now = run_.result(array_only_);
        for (const auto& [block, number] : blocks) {
            estimate_.add_block(block, group,
                                run_.part_of(number, design_.blocks[block].count, in_turn_));
        }
        estimate_.add_group(before_, now, simulated);
        before_ = std::move(now);
    }

    AcceleratorResult end() {
        const std::size_t tiles = run_.all().size();
        const std::size_t first = tiles - std::min(design_.edge + warm_up_, tiles);
        for (std::size_t t = first; t < tiles; ++t) {
            run_.add(t);
        }
        run_.close();
        AcceleratorResult now = run_.result(array_only_);
        WindowPart edges = run_.part_of(0, design_.edge, in_turn_);
        edges += run_.part_of(run_.simulated() - design_.edge, design_.edge, in_turn_);
        TileWork warm = kNoWork;
        for (std::size_t t = first; t < tiles - design_.edge; ++t) {
            warm += work_[t];
        }
        estimate_.end(before_, now, edges, warm);
        return now;
    }

    std::size_t measured() const { return measured_ + 2 * design_.edge; }
    /// With those that only fill the pipeline, which may come twice.
    std::size_t simulated() const { return run_.simulated(); }
    std::size_t groups() const { return next_; }

private:
    /// The first tile of those that bring the pipeline into the state in which it meets tile
    /// `first`. Where tiles take few cycles, writes of several tiles before are still under way.
    std::size_t warm_up_from(std::size_t first, std::size_t least) const {
        constexpr double kSettled = 200; // cycles
        constexpr std::size_t kMostWarmUp =
            6; // more of them would be light ones only, unlike a frame
        std::size_t from = first - std::min(first, least);
        double cycles = 0;
        for (std::size_t t = from; t < first; ++t) {
            cycles += work_[t].cycles;
        }
        for (;
             from > 0 && first - from < kMostWarmUp && cycles < kSettled && work_[first].cycles > 0;
             --from) {
            cycles += work_[from - 1].cycles;
        }
        return from;
    }

    OpenRun& run_;
    const std::vector<TileWork>& work_;
    SampleDesign design_;
    FrameEstimate& estimate_;
    bool array_only_, in_turn_;
    std::size_t contexts_; ///< a tile finds those before it in all others
    std::size_t warm_up_, next_ = 0, measured_ = 0;
    AcceleratorResult before_;
};

std::vector<TileWork> work_of_blocks(const std::vector<TileWork>& work,
                                     const SampleDesign& design) {
    std::vector<TileWork> blocks;
    blocks.reserve(design.blocks.size());
    for (const TileBlock& block : design.blocks) {
        TileWork sum = kNoWork;
        for (std::size_t t = block.first; t < block.first + block.count; ++t) {
            sum += work[t];
        }
        blocks.push_back(sum);
    }
    return blocks;
}

std::size_t listed_tiles(const FrameWorkload& frame) {
    std::size_t listed = 0;
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        listed += frame.tile_begin[tile] != frame.tile_begin[tile + 1] ? 1 : 0;
    }
    return listed;
}

/// Why tiles of this design cannot be taken out of their order; empty if they can.
std::string coupled(const TileCoupling& coupling) {
    if (coupling.empty()) {
        return {};
    }
    return coupling.cause +
           (coupling.remedy.empty() ? "" : " (" + coupling.remedy + " takes it out)") +
           "; all tiles are simulated, and the results are exact.";
}

std::string too_few(std::size_t tiles, std::size_t needed) {
    return "The frame has " + grouped(tiles) +
           " tiles that list a splat, and a sample of this design needs at least " +
           grouped(needed) + "; all tiles are simulated, and the results are exact.";
}

std::string too_narrow() {
    return "Tiles out of their order change a frame by ±" + percent(kPipelineError) +
           " %, so that no sample is as narrow as was asked for; all tiles are simulated, and the "
           "results are exact.";
}

std::string contended(double use) {
    return "The frame uses about " + percent(use, 0) + " % of the memory's peak, and above " +
           percent(kMostMemoryUse, 0) +
           " % of it tiles wait for requests of others that a sample leaves out; all tiles are "
           "simulated, and the results are exact.";
}

std::string too_wide(const SamplingFacts& facts) {
    return "The 95 % interval of " + facts.request.measure + " is ±" +
           three_digits(100 * facts.reached) + " % wide instead of ±" +
           three_digits(100 * facts.request.within) + " % with " + grouped(facts.measured) +
           " of " + grouped(facts.tiles) +
           " tiles, beyond which an exact run takes no longer (--fidelity exact).";
}

/// The share of the memory's peak that a frame uses while its tiles are rendered, by the model of
/// the design; 0 without one.
double expected_memory_use(const AnalyticModel* model, const FrameWorkload& frame,
                           const AcceleratorConfig& config) {
    if (model == nullptr) {
        return 0;
    }
    const AnalyticFrame expected = estimate_frame(*model, frame, config.tile_order);
    const double seconds = expected.cycles / config.clock_ghz * 1e-9;
    return seconds > 0 ? expected.bytes / seconds * 1e-9 / model->main_memory().peak_gb_per_s() : 0;
}

/// Why no sample of a frame with so many tiles that list a splat would do; empty if one may.
std::string refusal_of(const SamplingRequest& request, const AcceleratorConfig& config,
                       const AnalyticModel* model, const FrameWorkload& frame,
                       const BuildOptions& options, std::size_t tiles) {
    std::string coupling = coupled(config.tile_coupling(options.array_only));
    if (!coupling.empty()) {
        return coupling;
    }
    if (!can_sample(request, config.tile_contexts(), tiles)) {
        return too_few(tiles, least_tiles(request, config.tile_contexts()));
    }
    if (request.share == 0 && request.within <= kPipelineError) {
        return too_narrow();
    }
    const double use = options.array_only ? 0 : expected_memory_use(model, frame, config);
    return use > kMostMemoryUse ? contended(use) : "";
}

/// Looks at the sample if it is time to; `looks` counts.
Verdict verdict_on(const Sampler& sampler, const FrameEstimate& estimate, SamplingFacts& facts,
                   std::size_t& looks) {
    facts.measured = sampler.measured();
    if (facts.request.share > 0) {
        return sampler.groups() < kLeastGroups && sampler.more()
                   ? Verdict::More
                   : judge_sample(facts.request, ratio_of(facts.measured, facts.tiles), 0,
                                  sampler.more());
    }
    const double share = ratio_of(sampler.simulated(), facts.tiles);
    if (sampler.groups() < groups_at_look(looks) && sampler.more() && share < kMostShare) {
        return Verdict::More;
    }
    ++looks;
    facts.reached = estimate.relative_half_width(facts.request.measure);
    return judge_sample(facts.request, share, facts.reached, sampler.more());
}

} // namespace

const ReportInterval* SamplingFacts::interval_of(const std::string& path) const {
    const auto found =
        std::find_if(intervals.begin(), intervals.end(),
                     [&path](const ReportInterval& interval) { return interval.path == path; });
    return found == intervals.end() ? nullptr : &*found;
}

SampledResult run_sampled(const AcceleratorConfig& config, const FrameWorkload& frame,
                          Fidelity fidelity, const BuildOptions& options,
                          const SamplingRequest& request, Progress& progress) {
    const Stopwatch elaborate;
    SampledResult sampled;
    SamplingFacts& facts = sampled.facts;
    facts.request = request;
    facts.tiles = listed_tiles(frame);
    const int contexts = config.tile_contexts();
    const std::unique_ptr<AnalyticModel> model = config.analytic();
    facts.refusal = refusal_of(request, config, model.get(), frame, options, facts.tiles);
    if (!facts.refusal.empty()) {
        return sampled;
    }
    const std::vector<TileWork> work = expected_work(frame, model.get(), config.tile_order);
    SampleDesign design = design_sample(work, sizes_for(contexts, work.size()), request.seed);
    std::uint64_t activations = 0;
    const Timebase time{ClockDomain(config.clock_ghz), fidelity, nullptr, &activations};
    OpenRun run(config, frame, time, options);
    FrameEstimate estimate(config, frame, work_of_blocks(work, design),
                           request.share > 0 ? kConfidence : kLookConfidence);
    Sampler sampler(run, work, std::move(design), estimate, options.array_only,
                    model != nullptr && model->engines() == 1);
    const double elaborate_s = elaborate.seconds();

    const auto sim_start = std::chrono::steady_clock::now();
    const SimulationClock clock;
    sampler.begin();
    std::size_t looks = 0;
    for (Verdict verdict = Verdict::More; verdict == Verdict::More;) {
        sampler.simulate_group();
        progress.done(std::min(1.0, ratio_of(sampler.measured(), work.size()) / kMostShare));
        verdict = verdict_on(sampler, estimate, facts, looks);
    }
    const AcceleratorResult raw = sampler.end();
    check_result(raw);
    sampled.result = estimate.whole_frame(facts.tiles);
    facts.reached = estimate.relative_half_width(request.measure);
    facts.intervals = estimate.intervals();
    sampled.result.images = run.images();
    facts.measured = sampler.measured();
    facts.simulated = run.simulated();
    facts.groups = sampler.groups();
    facts.looks = looks;
    if (request.share == 0 && facts.reached > request.within) {
        facts.warning = too_wide(facts);
    }
    sampled.result.elaborate_s = elaborate_s;
    clock.stop(sampled.result);
    sampled.result.sim_s += raw.waited_s;
    sampled.result.activations = activations;
    sampled.result.sim_start = sim_start;
    return sampled;
}

} // namespace degs::sim
