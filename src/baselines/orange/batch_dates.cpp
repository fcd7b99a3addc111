// SPDX-License-Identifier: Apache-2.0
#include "baselines/orange/batch_dates.hpp"

#include <algorithm>

namespace degs::orange {

BatchDates::Tile BatchDates::tile(std::size_t entries, std::size_t blended) {
    begin(entries, blended);
    while (has_chunk() || blended_ < formed_.size()) {
        multiply();
        const bool waits = blended_ < formed_.size();
        const bool is_there = blended_ < multiplied_ && formed_[blended_].product <= vector_;
        if (waits && (!has_chunk() || !has_room() || is_there)) {
            blend();
        } else {
            take_chunk();
        }
    }
    Tile result;
    result.cycles = (ends_[kFirst + kMeasured - 1] - ends_[kFirst - 1]) / kMeasured;
    for (const Batch& batch : formed_) {
        const bool is_measured = batch.tile >= kFirst && batch.tile < kFirst + kMeasured;
        result.formed += is_measured ? double(batch.splats) / kMeasured : 0;
    }
    return result;
}

void BatchDates::begin(std::size_t entries, std::size_t blended) {
    const std::size_t batch = config_.fetching.chunk;
    entries_ = std::max<std::size_t>(entries, 1);
    batches_ = (entries_ + batch - 1) / batch;
    needed_ = std::clamp<std::size_t>(blended, 1, batches_);
    next_tile_ = next_place_ = multiplied_ = blended_ = ended_ = 0;
    vector_ = array_ = 0;
    formed_.clear();
    ends_.assign(kTiles, 0);
}

int BatchDates::splats_of(std::size_t place) const {
    const std::size_t batch = config_.fetching.chunk;
    return static_cast<int>(std::min(batch, entries_ - place * batch));
}

/// A batch keeps its coefficients until it has been multiplied.
bool BatchDates::has_room() const {
    const std::size_t places = config_.scratchpad.coefficient_batches, next = formed_.size();
    return next < places ||
           (next - places < multiplied_ && formed_[next - places].product <= vector_);
}

void BatchDates::take_chunk() {
    if (next_tile_ < ended_) {
        vector_ += 1;
    } else {
        Batch batch;
        batch.tile = next_tile_;
        batch.place = next_place_;
        batch.splats = splats_of(next_place_);
        vector_ += double(config_.cores.vector.coefficient_cycles(batch.splats));
        batch.coefficients = vector_;
        formed_.push_back(batch);
    }
    next_place_ = next_place_ + 1 == batches_ ? 0 : next_place_ + 1;
    next_tile_ += next_place_ == 0 ? 1 : 0;
}

/// All products whose place is known to be free at some date.
void BatchDates::multiply() {
    const std::size_t places = config_.scratchpad.product_batches;
    for (; multiplied_ < formed_.size() && multiplied_ < blended_ + places; ++multiplied_) {
        Batch& batch = formed_[multiplied_];
        array_ = std::max(array_, batch.coefficients);
        if (multiplied_ >= places) {
            array_ = std::max(array_, formed_[multiplied_ - places].blended);
        }
        array_ += double(config_.cores.array.cycles(batch.splats, config_.tile_area()));
        batch.product = array_;
    }
}

void BatchDates::blend() {
    Batch& batch = formed_[blended_++];
    vector_ = std::max(vector_, batch.product);
    if (batch.tile < ended_) {
        vector_ += 1;
    } else {
        const std::uint64_t pixels = std::uint64_t{1} * batch.splats * config_.tile_area();
        vector_ += double(config_.cores.vector.blend_cycles(pixels));
        if (batch.place + 1 == needed_) {
            ended_ = batch.tile + 1;
            ends_[batch.tile] = vector_;
        }
    }
    batch.blended = vector_;
}

} // namespace degs::orange
