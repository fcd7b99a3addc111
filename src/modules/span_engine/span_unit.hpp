// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "config/config.hpp"
#include "config/statistics.hpp"
#include "modules/render_job.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// Solves one scanline per cycle: centre, half-width, ends, g0 and d0 (paper, Sec. III-A and IV-A),
/// and sends the Span Vector through the spatial crossbar to bank y mod banks. A row that misses
/// every pixel of the tile costs its cycle and sends nothing.
class SpanUnit : public sc_core::sc_module, private Pumped {
public:
    struct Config {
        int count = 8;          ///< units
        int cycles_per_row = 1; ///< initiation interval
        int latency_cycles = 6; ///< pipeline from row item to Span Vector
        int crossbar_depth = 2; ///< Span Vectors that wait between a unit and a bank
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle busy = 0;
        std::uint64_t rows = 0, spans = 0, empty_rows = 0, tasks = 0;
        void describe(StatsVisitor& v) const {
            v.count("rows", rows, "rows", "Rows of splats solved.");
            v.count("empty_rows", empty_rows, "rows",
                    "Solved rows that cover no pixel of their tile.");
            v.count("spans", spans, "spans", "Span Vectors found.");
            v.count("tasks", tasks, "tasks", "Pixels in these spans.");
        }
    };

    FifoPort<RowItem> in;
    sc_core::sc_vector<FifoPort<SpanItem>> out; ///< the banks this unit can reach, ascending

    /// Unit `index` of config.count reaches the banks that share a row with it.
    SpanUnit(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
             const RenderJob& job, int index, int banks);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    void pump() override;
    void take();
    bool deliver();

    Config config_;
    const RenderJob& job_;
    Process self_;
    // The rings to which the ports are bound.
    DatedFifo<RowItem>* rows_ = nullptr;
    std::vector<DatedFifo<SpanItem>*> rings_;
    std::vector<std::size_t> port_of_row_; // by row inside the tile
    SpanItem held_;             // the result of the item taken last, while its ring is full
    std::size_t next_port_ = 0; // where it goes; an end goes to all ports in turn
    bool holding_ = false;
    TileNumber tiles_done_ = 0;
    Stats stats_;
};

} // namespace degs
