// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "baselines/orange/gemm_batch.hpp"
#include "config/config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "stats/statistics.hpp"

namespace degs::orange {

/// Which operand stays in the array. `Weight`: the monomials of the pixels, a row for each step of
/// the reduction and a column for each pixel, while splats stream through. `Output`: the sums of as
/// many splats as there are rows and as many pixels as there are columns, while the reduction
/// streams through.
enum class Dataflow { Weight, Output };
/// What a pass pays for the skew of a systolic array. `Pass`: every pass fills and drains. `Batch`:
/// passes of a product follow each other closely. `None`: those of neighbouring products, too.
enum class Fill { Pass, Batch, None };

/// The matrix unit of a core: the product of a batch's coefficients (splats x kGemmDepth) and the
/// monomials of a tile's pixels (kGemmDepth x pixels) on `rows` x `columns` multipliers. It works
/// on one product at a time, and on the next as soon as that one's coefficients are there and its
/// result has room.
class SystolicArray : public sc_core::sc_module {
public:
    struct Config {
        int rows = 32, columns = 32;
        Dataflow dataflow = Dataflow::Weight;
        Fill fill = Fill::Pass;
        bool preload = true; ///< the monomials of a pass are loaded behind those of the one before
        void describe(ConfigVisitor& visitor);

        int macs() const { return rows * columns; }
        /// Passes of a product.
        std::int64_t passes(int splats, int pixels) const;
        /// Cycles of a product; 0 without splats.
        Cycle cycles(int splats, int pixels) const;
        /// Share of the multipliers that the reduction fills: K / (ceil(K / rows) rows) with
        /// Dataflow::Weight; all with Dataflow::Output.
        double reduction_share() const;
    };
    struct Stats {
        Cycle busy = 0, input_wait = 0, output_wait = 0;
        std::uint64_t batches = 0, splats = 0;
        void describe(StatsVisitor& v) const {
            v.count("batches", batches, "batches", "Products of matrices computed.");
            v.count("splats", splats, "splats", "Rows of coefficients that took part in them.");
            v.count("input_wait_cycles", input_wait, "cycles", "Waiting for coefficients.");
            v.count("output_wait_cycles", output_wait, "cycles",
                    "Waiting for room for the next product.");
        }
    };

    FifoPort<GemmBatch> in;
    FifoPort<GemmBatch> out;

    SystolicArray(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                  const RenderJob& job);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();

    Config config_;
    int pixels_; // of a tile
    Process self_;
    Stats stats_;
};

} // namespace degs::orange
