// SPDX-License-Identifier: Apache-2.0
// A slice of the Blending Array that is awake in every cycle and does what docs/blending-array.md
// says, in the plainest code. Which pixels a task ends comes from the log.
#pragma once

#include <numeric>
#include <tuple>

#include "tests/modules/degs/naive_block.hpp"

namespace degs::test {

/// Runs on what came in according to a log, and says what it executes and reports.
class NaiveSlice : public NaiveBlock {
public:
    NaiveSlice(const std::map<std::string, Number>& facts, const std::vector<LoggedEvent>& events)
        : NaiveBlock(facts, events) {
        for (const LoggedEvent& event : events) {
            if (event.kind() == "ended") {
                ends_[{event["tile"], event["splat"], event["row"], event["column"]}] |=
                    static_cast<std::uint32_t>(event["mask"]);
            } else if (event.kind() == "tile") {
                parts_[event["tile"]] = {event["first_row"], event["last_row"],
                                         event["first_column"], event["last_column"]};
            }
        }
    }

private:
    void follow() override {
        Number streams_over = 0;
        while (left("packet")) {
            wait_for("packet");
            const LoggedEvent packet = take("packet");
            const bool executes = packet["tasks"] != 0;
            if (executes) {
                execute(packet);
            }
            const bool ends = packet["ends_tile"] != 0;
            if (ends && packet["ended_tile"] != kNobody) {
                end_tile(packet["ended_tile"], stream_of(packet["ended_context"]));
            }
            now_ += executes ? 1 : 0;
            streams_over += ends && packet["ended_tile"] == kNobody ? 1 : 0;
        }
        for (Number stream = 0; streams_over != 0 && stream < fact("streams"); ++stream) {
            send("tile_state", stream, {kNobody, 0});
            send("tile_done", stream, {kNobody, 0});
        }
    }

    struct Part { // inside the image
        Number first_row = 0, last_row = 0, first_column = 0, last_column = 0;
    };
    struct Tile {
        Number live = 0; // pixels
        bool reported = false;
        std::map<std::pair<Number, Number>, std::uint32_t> ended; // by row and first column
    };

    Number stream_of(Number context) const {
        return (context - fact("first_context")) / fact("contexts");
    }
    Tile& tile(Number number) {
        const bool starts = tiles_.count(number) == 0;
        Tile& tile = tiles_[number];
        const Part& part = parts_.at(number);
        for (Number row = fact("slice"); starts && row <= part.last_row; row += fact("slices")) {
            tile.live += row < part.first_row ? 0 : part.last_column - part.first_column + 1;
        }
        return tile;
    }
    // A packet executes in the slot for which it was planned.
    void execute(const LoggedEvent& packet) {
        if (packet["slot"] != now_) {
            lines_.say(now_, "not in its slot", 0, {packet["slot"]});
        }
        for (std::size_t i = 0; i < packet.parts; ++i) { // the fields of TaskRun
            const Number number = packet.part(i, 0), context = packet.part(i, 1);
            const Number splat = packet.part(i, 3), row = packet.part(i, 4);
            const Number column = packet.part(i, 5);
            const auto ends = ends_.find({number, splat, row, column});
            const auto tasks = static_cast<std::uint32_t>(packet.part(i, 7));
            if (ends != ends_.end() && (ends->second & tasks) != 0) {
                end_pixels(number, context, row, column, ends->second & tasks);
            }
        }
    }
    void end_pixels(Number number, Number context, Number row, Number column, std::uint32_t mask) {
        Tile& tile = this->tile(number);
        std::uint32_t& ended = tile.ended[{row, column}];
        ended |= mask;
        tile.live -= __builtin_popcount(mask);
        const Part& part = parts_.at(number);
        const Number last = std::min(column + fact("segment_length") - 1, part.last_column);
        const Number inside = last - std::max(column, part.first_column) + 1;
        const bool all = __builtin_popcount(ended) == inside;
        if (all && fact("region_listeners") != 0) {
            report_region(number, stream_of(context), row, column / fact("segment_length"));
        }
        if (all || fact("termination") != 0) {
            send("terminated", 0, {number, context, row, column, ended});
        }
        if (tile.live == 0 && !tile.reported) {
            tile.reported = true;
            send("tile_state", stream_of(context), {number, 1});
        }
    }
    void report_region(Number number, Number stream, Number row, Number segment) {
        const Number listeners = fact("region_listeners");
        const Number common = std::gcd(listeners, fact("slices"));
        const Number port = stream * (listeners / common) + row % listeners / common;
        send("region_ended", port, {number, row, segment});
    }
    void end_tile(Number number, Number stream) {
        Tile& tile = this->tile(number);
        if (!tile.reported) {
            send("tile_state", stream, {number, tile.live == 0});
        }
        send("tile_done", stream, {number, tile.live == 0});
        tiles_.erase(number);
    }

    std::map<std::tuple<Number, Number, Number, Number>, std::uint32_t> ends_;
    std::map<Number, Part> parts_; // of tiles
    std::map<Number, Tile> tiles_;
};

} // namespace degs::test
