// SPDX-License-Identifier: Apache-2.0
// How the cells of a DatedFifo are replaced by others; the other part of dated_fifo.hpp.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "tlm/dated_fifo.hpp"

namespace degs {

/// Twice the cells, or all of them. The new ring starts with the oldest item. Behind the last
/// one come cells that are free from the start: the reads they would have to wait for all lie
/// before the latest write, else the ring would have grown then. Cells keep the dates of their
/// last item, which count_fill() and residence() ask for. A reader may hold on to an item in
/// the old cells.
template <class T>
void DatedFifo<T>::grow() {
    std::vector<Cell> cells(capacity_ <= depth_ / 2 ? 2 * capacity_ : depth_);
    const std::size_t added = cells.size() - capacity_;
    const std::size_t used = filled_ + late_.size();
    const Cell* from = front_;
    for (std::size_t i = 0; i < capacity_; ++i, from = next(from)) {
        Cell& behind = cells[added + i];
        behind.read = from->read;
        behind.written = from->written;
        if (added + i >= used && from->read != kNever) {
            behind.date = from->read + release_latency_;
        }
        if (i < used) {
            cells[i].date = from->date;
            cells[i].written = from->written;
            cells[i].value = from->value;
        } else if (i == used) {
            cells[i].value = from->value; // staged, perhaps
        }
    }
    left_.push_back(std::move(cells_));
    cells_ = std::move(cells);
    capacity_ = cells_.size();
    first_ = cells_.data();
    end_ = first_ + capacity_;
    front_ = first_;
    tail_ = first_ + used;
    earlier_ = stats_.high_water == 0 ? first_ : end_ - stats_.high_water;
    head_ = &front_->date;
    free_ = &tail_->date;
}

/// That many cells for an empty ring. The last ones keep the dates of the items that were read
/// last, as in grow(); a cell that was not there counts as one whose item was gone.
template <class T>
void DatedFifo<T>::renew(std::size_t count) {
    std::vector<Cell> cells(count);
    const Cell* from = front_;
    for (std::size_t back = 1; back <= count && stats_.items != 0; ++back) {
        Cell& cell = cells[count - back];
        from = (from == first_ ? end_ : from) - 1;
        cell.read = 0;
        if (back <= capacity_ && from->read != kNever) {
            cell.read = from->read;
            cell.written = from->written;
            cell.date = from->read + release_latency_;
        }
    }
    cells_ = std::move(cells);
    capacity_ = count;
    first_ = cells_.data();
    end_ = first_ + capacity_;
    front_ = tail_ = first_;
    // A mark above the depth is not counted any more.
    earlier_ = stats_.high_water == 0 ? first_ : end_ - std::min(stats_.high_water, capacity_);
    head_ = &front_->date;
    free_ = &tail_->date;
}

} // namespace degs
