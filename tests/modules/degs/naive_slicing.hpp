// SPDX-License-Identifier: Apache-2.0
// A Slicing Unit, or those that share out the splats of a stream, awake in every cycle, which does
// what docs/gaussian-slicing-unit.md says in the plainest code. The box of a splat comes from the
// log.
#pragma once

#include <set>
#include <stdexcept>
#include <string>

#include "tests/modules/degs/naive_block.hpp"

namespace degs::test {

/// Runs on what came in according to a log, and says what it takes and sends.
class NaiveSlicing : public NaiveBlock {
public:
    NaiveSlicing(const std::map<std::string, Number>& facts, const std::vector<LoggedEvent>& events)
        : NaiveBlock(facts, events) {
        for (const LoggedEvent& event : events) {
            if (event.kind() == "splat") {
                boxes_[{event["tile"], event["entry"]}] = event;
            } else if (event.kind() == "over") {
                over_ = static_cast<Number>(event.now);
            }
        }
    }

private:
    void follow() override {
        for (Number tile = 0; left("chunk"); ++tile) {
            if (fact("granted") != 0) {
                wait_for("chunk");
                tile = messages("chunk").front().event["tile"];
            }
            slice(tile);
            end_lanes(tile);
        }
        if (fact("granted") != 0) {
            now_ = std::max(now_, over_); // then it is known that no tile follows
            end_lanes(kNobody);
        }
    }

    static constexpr Number kSkip = 1; // broadcast_skip
    struct Unit {
        Number splat, row, last_row; // `row` is sent next
        Number first_segment, last_segment;
        Number rows, splats; // that it may still send and begin in this cycle
        bool done() const { return row > last_row; }
    };

    void slice(Number tile) {
        ended_.clear();
        input_ = input_of(tile);
        last_ = false;
        left_ = 0;
        for (;; next_cycle()) {
            dropped_ = false;
            reads_ = fact("splat_ports") == 0 ? 1000000 : fact("splat_ports");
            while (Number(units_.size()) < fact("units") && begin_splat(tile)) {
            }
            if (units_.empty() && !dropped_ && reads_ != 0) {
                return; // it was the last one
            }
            for (Unit& unit : units_) {
                unit.rows = fact("rows_per_cycle");
                unit.splats = fact("splats_per_cycle");
            }
            send_rows(tile);
        }
    }
    // The ring on which the tile's splats come, which its sorter decides.
    Number input_of(Number tile) {
        for (Number port = 0; port < fact("inputs"); ++port) {
            for (const Message& message : messages("chunk", port)) {
                if (message.event["tile"] == tile) {
                    return port;
                }
            }
        }
        throw std::logic_error("no splats come for tile " + std::to_string(tile));
    }
    // The next splat of the tile that costs the unit something, if it is there.
    bool begin_splat(Number tile) {
        while (reads_ > 0 && has_splat(tile)) {
            --reads_;
            --left_;
            const LoggedEvent& box = boxes_.at({tile, entry_});
            lines_.say(now_, "splat", 0, {tile, entry_++});
            Unit unit{box["splat"], box["first_row"], box["last_row"], 0, -1, 0, 0};
            if (box["first_column"] <= box["last_column"]) {
                unit.first_segment = box["first_column"] / fact("segment_length");
                unit.last_segment = box["last_column"] / fact("segment_length");
            }
            while (unit.row % fact("modules") != fact("module")) {
                ++unit.row;
            }
            if (fact("distribution") != kSkip || !unit.done()) {
                units_.push_back(unit);
                return true;
            }
        }
        return false;
    }
    // Waits for a chunk only if there is nothing else to do.
    bool has_splat(Number tile) {
        while (left_ == 0) {
            if (last_ || dropped_ || (!units_.empty() && !arrived("chunk", input_))) {
                return false;
            }
            wait_for("chunk", input_);
            const LoggedEvent chunk = take("chunk", input_);
            last_ = chunk["last"] != 0;
            while (arrived("cancelled")) {
                cancelled_before_ = std::max(cancelled_before_, take("cancelled")["value"] + 1);
            }
            dropped_ = tile < cancelled_before_;
            if (!dropped_) {
                see_ended(tile);
                left_ = chunk["count"];
                entry_ = chunk["first"];
            }
        }
        return true;
    }
    void see_ended(Number tile) {
        for (Number port = 0; port < fact("slices"); ++port) {
            while (arrived("region_ended", port)) {
                const LoggedEvent region = take("region_ended", port);
                if (region["tile"] == tile) {
                    ended_.insert({region["row"], region["segment"]});
                }
            }
        }
    }
    bool dead(const Unit& unit) const {
        for (Number s = unit.first_segment; s <= unit.last_segment; ++s) {
            if (ended_.count({unit.row, s}) == 0) {
                return false;
            }
        }
        return fact("skip_dead_rows") != 0;
    }
    // A younger splat sends a row only when all older ones have passed it.
    void send_rows(Number tile) {
        Number passed = fact("tile_size");
        for (std::size_t i = 0; i < units_.size(); ++i) {
            send_rows(tile, units_[i], passed);
            const Unit unit = units_[i];
            if (!unit.done()) {
                passed = std::min(passed, unit.row);
            } else if (unit.splats > 1 && begin_splat(tile)) {
                units_.back().rows = unit.rows;
                units_.back().splats = unit.splats - 1;
            }
        }
        units_.erase(std::remove_if(units_.begin(), units_.end(),
                                    [](const Unit& unit) { return unit.done(); }),
                     units_.end());
    }
    void send_rows(Number tile, Unit& unit, Number before) {
        for (; !unit.done() && unit.row < before; unit.row += fact("modules")) {
            if (dead(unit)) {
                continue;
            }
            if (unit.rows == 0) {
                return;
            }
            const Number lane = unit.row % (fact("lanes") * fact("modules")) / fact("modules");
            wait_for_room(lane);
            Writes& writes = writes_[lane];
            writes = writes.now == now_ ? writes : Writes{now_, 0};
            if (fact("row_ports") != 0 && writes.rows == fact("row_ports")) {
                return;
            }
            ++writes.rows;
            --unit.rows;
            fill("row", lane, {tile, 0, unit.splat, unit.row}, 1);
        }
    }
    void end_lanes(Number tile) {
        for (Number lane = 0; lane < fact("lanes"); ++lane) {
            wait_for_room(lane);
            fill("row", lane, {tile, 1, 0, 0}, 1);
        }
    }

    struct Writes {
        Number now = -1, rows = 0;
    };
    std::map<std::pair<Number, Number>, LoggedEvent> boxes_; // by tile and entry
    std::set<std::pair<Number, Number>> ended_;              // segments of rows of the tile
    std::vector<Unit> units_;                                // in work, the oldest first
    std::map<Number, Writes> writes_;                        // by lane
    Number input_ = 0, cancelled_before_ = 0, left_ = 0, entry_ = 0, reads_ = 0, over_ = 0;
    bool last_ = false, dropped_ = false;
};

} // namespace degs::test
