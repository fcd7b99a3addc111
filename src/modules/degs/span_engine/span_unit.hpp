// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/degs/span_engine/span_replay.hpp"
#include "modules/degs/span_engine/span_stage.hpp"

namespace degs {

/// A Span Unit with rows of its own and a Span Buffer lane of its own: one scanline per
/// cycles_per_row, in the order of the lane.
class SpanUnit : public SpanStage, private Pumped {
public:
    /// Unit `index` of config.count reaches the banks that share a row with it.
    SpanUnit(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
             const RenderJob& job, int index, int banks);

    /// If the unit reaches one bank alone.
    const std::vector<std::unique_ptr<SpanReplay>>& hand_over(Process& bank) override;

private:
    void end_of_elaboration() override;
    void start_of_simulation() override;
    void run();
    void pump() override;
    void take();
    bool deliver();

    int index_, banks_;
    Process self_;
    // The rings to which the ports are bound.
    DatedFifo<RowItem>* rows_ = nullptr;
    std::vector<DatedFifo<SpanItem>*> rings_;
    std::vector<std::size_t> port_of_row_; // by row inside the tile
    SpanItem held_;             // the result of the item taken last, while its ring is full
    std::size_t next_port_ = 0; // where it goes; an end goes to all ports in turn
    bool holding_ = false;
};

} // namespace degs
