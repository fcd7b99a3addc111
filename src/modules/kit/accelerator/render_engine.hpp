// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <systemc>

#include "cost/bill_of_materials.hpp"
#include "cost/clock_limits.hpp"
#include "modules/kit/accelerator/accelerator_result.hpp"
#include "modules/kit/accelerator/analytic_model.hpp"
#include "modules/kit/accelerator/loss_keys.hpp"
#include "modules/kit/config/frame_end_config.hpp"
#include "modules/kit/config/pipeline_config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/view_sharing.hpp"
#include "tlm/event_log.hpp"
#include "tlm/process.hpp"

namespace degs {

class MainMemory;
class RequestListener;
class SharedBytes;

/// An accelerator with its memory: built for a job, run by the kernel, and read out when no event
/// is left.
class RenderEngine : public sc_core::sc_module {
public:
    using sc_core::sc_module::sc_module;
    /// Tiles whose pixels have all been read out.
    virtual std::size_t finished_tiles() const = 0;
    /// Reads the counters. It does not fill in names, images, host times or job fields.
    virtual void collect(AcceleratorResult& result) const = 0;
    /// Blocks of a kind that can write a log, in the order of their numbers.
    struct BlockGroup {
        std::string kind;
        std::vector<LoggedBlock*> blocks;
    };
    virtual std::vector<BlockGroup> logged_blocks() const { return {}; }
};

/// The block `name` of an engine, "bank:3". InputError, which lists the blocks of `design` that
/// write a log, if there is none of that name.
LoggedBlock& logged_block(const RenderEngine& engine, const std::string& design,
                          const std::string& name);

/// Which parts of an accelerator to build, and what to connect them to.
struct BuildOptions {
    /// The rasterisation array alone: depth-ordered lists are there at once and memory is
    /// unlimited, so that arrays can be compared without their front ends.
    bool array_only = false;
    /// Receives the number of every frame once its last pixel is in memory. The engine writes it,
    /// with the forward latency FrameEndConfig::gate_latency_cycles.
    DatedFifo<std::uint32_t>* finished = nullptr;
    /// Memory of somebody else, e.g. of a platform; nullptr: the accelerator gets the memory that
    /// its configuration describes.
    MainMemory* memory = nullptr;
    /// Hears of every request to memory; nullptr: nobody listens.
    RequestListener* requests = nullptr;
    /// Where simulations of the same frames keep what does not depend on the design's timing, for
    /// each other; nullptr: there is no other one.
    SharedBytes* kept = nullptr;
};

/// Something of a design that makes the time of a tile depend on which other tiles run before it or
/// beside it, so that a sample of tiles does not stand for the frame. Empty: nothing does.
struct TileCoupling {
    std::string cause;  ///< subject and verb of a sentence: "The reuse cache keeps records ..."
    std::string remedy; ///< an assignment that takes it out; empty if there is none

    bool empty() const { return cause.empty(); }
    /// The coupling in a design whose clusters take tiles in turn; empty for one cluster.
    static TileCoupling of_clusters(int clusters) {
        if (clusters == 1) {
            return {};
        }
        return {"The clusters of this design compete for memory while each has a tile of its own",
                "clusters=1"};
    }
};

/// The configuration of any accelerator. A new accelerator derives one of these and is
/// registered with add_accelerator(); docs/adding-an-accelerator.md is a worked example.
struct AcceleratorConfig {
    std::string name;
    double clock_ghz = 1.0;
    int frames_in_flight = 2; ///< frames between the first Gaussian read and the last pixel written
    int grant_cycles = 1;     ///< from a request for a tile to who grants it, and back
    TileOrder tile_order = TileOrder::Raster;
    FrameEndConfig frame_end;
    cost::Technology cost; ///< constants of area, power and energy

    AcceleratorConfig() = default;
    AcceleratorConfig(const AcceleratorConfig&) = default;
    AcceleratorConfig& operator=(const AcceleratorConfig&) = default;
    virtual ~AcceleratorConfig() = default;

    virtual std::unique_ptr<AcceleratorConfig> clone() const = 0;
    virtual void describe(ConfigVisitor& visitor) = 0;
    /// Checks a configuration that a program has filled. Returns the first range or rule of
    /// describe() that does not hold, as one sentence, or nothing if all do.
    std::string problem() const;

    /// Becomes the design of its family with that many PEs, by the rule of docs/families.md.
    /// Expects a configuration with default values. Throws InputError, which names the nearest
    /// sizes, if the family has no such design.
    virtual void scale_to(int pes);
    virtual int pes() const = 0;
    /// Side of the square of pixels whose list is one unit of work, px.
    virtual int tile_size_px() const = 0;
    virtual TileMode tile_mode() const = 0;
    virtual DataPathOptions data_path() const = 0;
    /// Tiles whose pixels are on chip at a time.
    virtual int tile_contexts() const = 0;
    /// What makes tiles depend on each other; with `array_only` memory takes no time.
    virtual TileCoupling tile_coupling(bool array_only) const = 0;
    /// Keys that move losses of PE-cycles, without those that other keys make idle. Of several keys
    /// for a cause the one that moves most on close-ups stands first. Empty: reports name losses
    /// without keys.
    virtual std::vector<LossKey> loss_keys() const { return {}; }
    /// Record layouts of the streams that all accelerators have.
    virtual TrafficConfig records() const = 0;
    /// The blocks of the design and what they cost. A run reports the activity of each of them.
    virtual cost::BillOfMaterials bill() const = 0;
    /// Logic that limits the clock, where it has been synthesised (docs/synthesis.md).
    virtual std::vector<cost::ClockLimit> clock_limits() const { return {}; }
    /// The clock that the design can reach.
    cost::ClockEstimate clock() const { return {clock_limits(), cost.logic.fo4_per_ns, clock_ghz}; }
    /// How much the views of a frame share. With Nothing they are frames of their own; else their
    /// Gaussians are read together.
    virtual ViewSharing view_sharing() const { return ViewSharing::Nothing; }
    /// Sorted lists stay for the next frame, so that a frame costs less behind another one.
    virtual bool keeps_lists() const { return false; }
    /// How splat records lie in memory.
    virtual RecordOrder record_order() const { return RecordOrder::Index; }
    /// Switches to the scene as a platform's memory holds it: values of 4 B, see
    /// docs/accelerator.md.
    virtual void read_floats() = 0;
    /// `job` must be made for this configuration and outlive the engine.
    virtual std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time,
                                                RenderJob& job,
                                                const BuildOptions& options) const = 0;
    /// How long a frame takes on the design, without a simulation; null if nobody has worked it
    /// out.
    virtual std::unique_ptr<AnalyticModel> analytic() const { return nullptr; }

protected:
    void describe_common(ConfigVisitor& visitor);
    /// The keys of the cost model, last because they are many.
    void describe_cost(ConfigVisitor& visitor);

private:
    /// The rows of the cost model that only this accelerator has: a cost::RowSection named after
    /// its kind.
    virtual void describe_rows(ConfigVisitor& visitor) = 0;
};

/// A job without frames for the data path that `config` asks for. `views` consecutive ones will be
/// views of one frame, of the same Gaussians; their number divides that of the frames.
RenderJob make_render_job(const AcceleratorConfig& config, int views = 1);
/// Such a job with these frames, which outlive it.
RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const AcceleratorConfig& config, int views = 1);

} // namespace degs
