// SPDX-License-Identifier: Apache-2.0
#include "tests/random/habits.hpp"

#include "baselines/gbu/config.hpp"
#include "baselines/orange/config.hpp"
#include "modules/degs/config.hpp"

namespace degs::trials {

Habits habits_of(const AcceleratorConfig& config) {
    Habits habits;
    if (const auto* const degs = dynamic_cast<const DegsConfig*>(&config)) {
        habits.search = degs->span.parsing ? Habits::Search::Solve : Habits::Search::Box;
        habits.rows_of_tile = degs->slicing.rows == SlicedRows::Tile;
        habits.keeps_pixel_order = degs->scheduler.scoreboard;
    }
    habits.ends_with_its_pixels = dynamic_cast<const gbu::Config*>(&config) == nullptr &&
                                  dynamic_cast<const orange::Config*>(&config) == nullptr;
    return habits;
}

} // namespace degs::trials
