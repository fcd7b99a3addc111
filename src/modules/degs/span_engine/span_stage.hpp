// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <new>
#include <vector>

#include <systemc>

#include "config/config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/sram_ports.hpp"
#include "modules/kit/job/tile_end.hpp"
#include "splat/pixels/coupled_row.hpp"
#include "stats/statistics.hpp"

namespace degs {

class SpanReplay;

/// Which Span Unit solves a row: the one whose number is the row's modulo their number, or any that
/// is free.
enum class RowAssignment { Fixed, Pool };

/// Span Units: they solve scanlines (centre, half-width, ends, g0 and d0; paper, Sec. III-A and
/// IV-A) and send the Span Vectors through the spatial crossbar to bank y mod banks. A row that
/// misses every pixel of the tile costs its cycle and sends nothing.
class SpanStage : public sc_core::sc_module, public LoggedBlock {
public:
    struct Config {
        int count = 8;       ///< units
        bool parsing = true; ///< false: rows are not solved, see row_of_box()
        RowAssignment rows = RowAssignment::Fixed;
        int rows_per_cycle = 1;    ///< that a unit takes; more than 1 needs cycles_per_row 1
        int cycles_per_row = 1;    ///< initiation interval
        int latency_cycles = 6;    ///< pipeline from row item to Span Vector
        int crossbar_depth = 2;    ///< Span Vectors that wait between a unit and a bank
        int crossbar_width = 0;    ///< Span Vectors that a bank takes per cycle; 0: all it can cut
        SramPorts row_ports;       ///< of a lane of the Span Buffer, whose section has the key
        bool reports_rows = false; ///< to Parameter Release
        bool replays = false;      ///< rows come with outcomes, see FunctionalModel
        bool granted = false;      ///< tiles come one by one, see TileEnd
        void describe(ConfigVisitor& visitor);
        /// Modules of the stage; each has units_per_module() units.
        int modules() const { return rows == RowAssignment::Pool ? 1 : count; }
        int units_per_module() const { return count / modules(); }
    };
    struct Stats {
        Cycle busy = 0;
        std::uint64_t rows = 0, spans = 0, empty_rows = 0, tasks = 0;
        std::uint64_t row_port_waits = 0;
        void describe(StatsVisitor& v) const {
            v.count("rows", rows, "rows", "Rows of splats solved.");
            v.count("empty_rows", empty_rows, "rows",
                    "Solved rows that cover no pixel of their tile.");
            v.count("spans", spans, "spans", "Span Vectors found.");
            v.count("tasks", tasks, "tasks", "Pixels in these spans.");
            v.count("row_port_waits", row_port_waits, "cycles",
                    "Lanes that could not give their next row: span_buffer.ports were taken.");
        }
    };

    sc_core::sc_vector<FifoPort<RowItem>> in; ///< Span Buffer lanes, those of a stream together
    /// The banks that the module can reach, ascending; those of a stream together.
    sc_core::sc_vector<FifoPort<SpanItem>> out;

    /// To Parameter Release, one per lane; empty unless parameters live until the spans are made.
    sc_core::sc_vector<FifoPort<RowSolved>> solved;

    const Stats& stats() const { return stats_; }
    ~SpanStage() override;
    /// Makes and returns the replays, one per stream, which `bank` reads in place of the crossbar's
    /// rings, and which the Slicing Units write in place of the lanes. `bank` must read no other
    /// rows. Empty unless rows come with outcomes and nobody watches the rings. Before the
    /// simulation starts.
    virtual const std::vector<std::unique_ptr<SpanReplay>>& hand_over(Process& bank) = 0;
    /// The replays that hand_over() has returned.
    const std::vector<std::unique_ptr<SpanReplay>>& replays() const { return replays_; }
    /// The replay that carries the rows of `lane`; nullptr if there is none.
    SpanReplay* replay_of(const DatedFifo<RowItem>& lane) const;
    /// Logs rows taken from the lanes, Span Vectors and ends of tiles sent.
    void log_to(EventLog& log) override { log_ = &log; }

protected:
    SpanStage(const sc_core::sc_module_name& name, const Config& config, const RenderJob& job,
              std::size_t inputs, std::size_t outputs, std::size_t streams);

    void start_of_simulation() override;
    void connect_reports(Process& self) {
        for (auto& port : solved) {
            port->connect_writer(self);
        }
    }
    /// Reports a row that has just been taken from a lane, if Parameter Release wants to know.
    void report(Process& self, std::size_t lane) {
        if (config_.reports_rows) {
            solved[lane]->put(self, {});
        }
    }
    /// Makes the replay that stands for lane `lane` and its ring of the crossbar.
    void hand_over(std::size_t lane, Process& self, Process& bank);
    /// True if rows come with outcomes, and nobody watches what goes through the rings.
    bool can_hand_over();
    /// Solves a row of a splat and writes its span to `result`. False if the row misses every pixel
    /// of the tile.
    inline bool solve(const RowItem& row, SpanItem& result);

    Config config_;
    const RenderJob& job_;
    TileEnd tiles_;
    Stats stats_;
    EventLog* log_ = nullptr;
    std::vector<std::unique_ptr<SpanReplay>> replays_; // by lane; see hand_over()
};

// Inlined in the hot loops. The pixels of the span are made in place, because a copy of what was
// just written waits for the write.
inline __attribute__((always_inline)) bool SpanStage::solve(const RowItem& row, SpanItem& result) {
    stats_.rows++;
    result.tile = row.tile;
    if (config_.replays) {
        if (row.outcome.length == 0) {
            stats_.empty_rows++;
            return false;
        }
        RowSpan& span = result.span.emplace();
        span.splat = row.splat;
        span.y = row.row;
        span.x0 = inside_tile(row.outcome.x0);
        span.length = inside_tile(row.outcome.length);
        result.outcome = row.outcome;
        stats_.spans++;
        stats_.tasks += row.outcome.length;
        return true;
    }
    const JobTile& tile = job_.tiles[row.tile];
    const int y = tile.y + row.row, x_end = tile.x + tile.width;
    auto& span = *new (&result.span) std::optional<RowSpan>(
        config_.parsing ? job_.path->solve_row(row.splat, y, tile.x, x_end, tile.y)
                        : row_of_box(*job_.path, row.splat, y, tile.x, x_end, tile.y));
    if (!span || !cut(*span, tile.image_columns())) {
        stats_.empty_rows++;
        return false;
    }
    stats_.spans++;
    stats_.tasks += span->length;
    return true;
}

} // namespace degs
