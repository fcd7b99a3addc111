// SPDX-License-Identifier: Apache-2.0
#include "baselines/orange/systolic_array.hpp"

#include "splat/pixels/exponent_gemm.hpp"
#include "tlm/ceil_div.hpp"

namespace degs::orange {

void SystolicArray::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("rows", rows, 1, 1024,
                    "multipliers along the reduction, or along the splats (ORANGE: 32)");
    visitor.integer("columns", columns, 1, 1024, "multipliers along the pixels (ORANGE: 32)");
    visitor.choice("dataflow", dataflow, {"weight", "output"},
                   "what stays in the array; weight: the monomials of the pixels, which no splat "
                   "changes (ORANGE); output: sums of splats and pixels");
    visitor.choice(
        "fill", fill, {"pass", "batch", "none"},
        "what pays rows + columns - 2 cycles for filling and draining: every pass, every "
        "product, or nothing [assumed]");
    visitor.boolean("preload", preload,
                    "load monomials of the next pass during the present one; false: a pass begins "
                    "with `rows` cycles of loading; dataflow weight alone [assumed]");
}

std::int64_t SystolicArray::Config::passes(int splats, int pixels) const {
    const std::int64_t across = ceil_div(pixels, columns);
    return across *
           (dataflow == Dataflow::Weight ? ceil_div(kGemmDepth, rows) : ceil_div(splats, rows));
}

Cycle SystolicArray::Config::cycles(int splats, int pixels) const {
    if (splats == 0) {
        return 0;
    }
    const Cycle all = passes(splats, pixels);
    const Cycle skew = rows + columns - 2;
    const Cycle load = dataflow == Dataflow::Weight && !preload ? rows : 0;
    const Cycle streamed = dataflow == Dataflow::Weight ? splats : kGemmDepth;
    const Cycle fills = fill == Fill::Pass ? all : fill == Fill::Batch ? 1 : 0;
    return all * (streamed + load) + fills * skew;
}

double SystolicArray::Config::reduction_share() const {
    return dataflow == Dataflow::Output ? 1.0
                                        : double(kGemmDepth) / (ceil_div(kGemmDepth, rows) * rows);
}

SystolicArray::SystolicArray(const sc_core::sc_module_name& name, const Config& config,
                             const Timebase& time, const RenderJob& job)
    : sc_core::sc_module(name), in("in"), out("out"), config_(config),
      pixels_(job.tile_size * job.tile_size), self_(time) {
    SC_HAS_PROCESS(SystolicArray);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

void SystolicArray::end_of_elaboration() {
    in->connect_reader(self_);
    out->connect_writer(self_);
}

// Coefficients stay in their place until the product is complete.
void SystolicArray::run() {
    Cycle idle_from = 0;
    for (;;) {
        Cycle before = self_.local();
        GemmBatch batch = in->arrive(self_);
        if (batch.tile == kNoTile) {
            break;
        }
        stats_.input_wait += self_.local() - before;
        before = self_.local();
        out->reserve(self_);
        batch.blocked = self_.local() - before;
        stats_.output_wait += batch.blocked;
        batch.idle_from = idle_from;
        batch.begin = self_.local();
        self_.work(config_.cycles(static_cast<int>(batch.splats), pixels_), stats_.busy);
        batch.end = idle_from = self_.local();
        stats_.batches++;
        stats_.splats += batch.splats;
        out->staged() = batch;
        out->put_staged(self_);
        in->drop(self_);
    }
    in->drop(self_);
    self_.finish();
}

} // namespace degs::orange
