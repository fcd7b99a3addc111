// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "baselines/orange/mac_account.hpp"
#include "config/config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "stats/statistics.hpp"

namespace degs::orange {

/// When a core leaves the list of a tile. `Batch`: once a batch has been blended and every pixel of
/// the tile has ended; what is in the core by then is thrown away. `None`: never.
enum class Termination { Batch, None };

/// The vector unit of a core, which does everything but the product: it forms the coefficients of
/// each chunk of splats for the systolic array, and takes each product through exponential, alpha
/// test, transmittance and colour. Both are streams of element operations on `lanes` lanes, one
/// after the other; products come first where both wait. A product has every pixel of the tile, and
/// pixels outside of the ellipse are masked, not skipped.
///
/// Values are those of DataPath::test_rows(): the product is formed when it is blended, because it
/// depends on nothing else. Once no pixel of a tile takes splats, its further pixels count as
/// terminated without a look at them.
class VectorUnit : public sc_core::sc_module {
public:
    struct Config {
        int lanes = 512;
        int coefficient_operations = 17; ///< per splat
        int blend_operations = 10;       ///< per pixel of a product
        int latency_cycles = 16;         ///< last operation of a tile to its written-back pixels
        Termination termination = Termination::Batch;
        void describe(ConfigVisitor& visitor);

        Cycle coefficient_cycles(std::uint64_t splats) const;
        Cycle blend_cycles(std::uint64_t pixels) const;
    };
    struct Stats {
        Cycle busy = 0, coefficient_cycles = 0, blend_cycles = 0;
        std::uint64_t tiles = 0, splats = 0, splats_abandoned = 0, splats_blended = 0;
        std::uint64_t splats_wasted = 0, pixels_ended = 0;
        void describe(StatsVisitor& v) const {
            v.count("splats", splats, "splats", "Splats whose coefficients were formed.");
            v.count("splats_abandoned", splats_abandoned, "splats",
                    "Splats that came when their tile had ended.");
            v.count("splats_blended", splats_blended, "splats", "Splats of blended products.");
            v.count("splats_wasted", splats_wasted, "splats",
                    "Splats of products thrown away because their tile had ended.");
            v.count("coefficient_cycles", coefficient_cycles, "cycles", "Forming coefficients.");
            v.count("blend_cycles", blend_cycles, "cycles", "Blending products.");
            v.count("pixels_ended", pixels_ended, "pixels",
                    "Pixels that ended before the end of their list.");
        }
    };

    FifoPort<SplatChunk> in;           ///< tiles in the order granted, then kNoTile
    FifoPort<TileNumber> context_free; ///< one message for each tile from tile `contexts` on
    FifoPort<GemmBatch> coefficients;  ///< to the systolic array, then kNoTile; Lb >= 1
    FifoPort<GemmBatch> products;      ///< from it
    FifoPort<SliceReport> tile_done;   ///< to the Pixel Buffer, once per tile, then kNoTile
    FifoPort<SliceReport> tile_state;  ///< to the Tile Monitor, once per tile, then kNoTile

    /// The core's n-th tile lives in context first_context + n mod contexts of the data path.
    /// `macs`: multipliers of the core's systolic array.
    VectorUnit(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, int macs, int first_context, int contexts);

    const Stats& stats() const { return stats_; }
    const MacAccount& account() const { return account_; }

private:
    void end_of_elaboration() override;
    void run();
    bool blends_next();
    bool take_chunk();
    void form_coefficients(const SplatChunk& chunk);
    void blend_product();
    void start_tile(TileNumber number);
    BatchOutcome blend(const GemmBatch& batch);
    void report_tile(bool all_ended);

    Config config_;
    RenderJob& job_;
    int first_context_, contexts_;
    Process self_;
    MacAccount account_;
    std::vector<BlendOutcome> outcomes_; // of the rows of a tile
    int batches_ahead_ = 0;              // between coefficients and products
    bool input_over_ = false;
    TileNumber ended_ = kNoTile; // the latest tile that ended before its list
    // State of the tile that is being blended.
    TileNumber number_ = kNoTile;
    const JobTile* tile_ = nullptr;
    int context_ = 0;
    int live_ = 0; // pixels
    Stats stats_;
};

} // namespace degs::orange
