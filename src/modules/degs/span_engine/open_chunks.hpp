// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "modules/kit/job/message_rings.hpp"

namespace degs {

/// The chunks of splats whose last row a Slicing module has not sent yet, and their rows by lane,
/// which it reports to Parameter Release. Chunks are numbered from 0 in the order in which they are
/// taken.
class OpenChunks {
public:
    using Sliced = sc_core::sc_vector<FifoPort<ChunkSliced>>; // one, or none: nothing is reported
    using Rows = sc_core::sc_vector<FifoPort<RowCount>>;
    OpenChunks(Sliced& sliced, Rows& rows)
        : sliced_(sliced), rows_(rows), reported_(sliced.size() != 0) {}

    void connect_writer(Process& self) {
        for (auto& port : sliced_) {
            port->connect_writer(self);
        }
        for (auto& port : rows_) {
            port->connect_writer(self);
        }
    }
    /// Opens a chunk that the unit has taken, of so many splats; 0 if they are dropped.
    void open(Process& self, std::size_t fetcher, std::uint32_t splats) {
        if (reported_) {
            ++opened_;
            chunks_.push_back({fetcher, splats, std::vector<std::uint32_t>(rows_.size(), 0)});
            report(self);
        }
    }
    /// Number of the chunk that was taken last.
    std::uint64_t latest() const { return opened_ - 1; }
    void count_row(std::uint64_t chunk, std::size_t lane) {
        if (reported_) {
            ++chunks_[chunk - first_].rows[lane];
        }
    }
    /// Notes that the last row of a splat of the chunk has been sent.
    void finish_splat(Process& self, std::uint64_t chunk) {
        if (reported_) {
            --chunks_[chunk - first_].splats_left;
            report(self);
        }
    }

private:
    struct Chunk {
        std::size_t fetcher;
        std::uint32_t splats_left;
        std::vector<std::uint32_t> rows;
    };
    void report(Process& self) {
        for (; !chunks_.empty() && chunks_.front().splats_left == 0; ++first_) {
            sliced_[0]->put(self, {chunks_.front().fetcher});
            for (std::size_t lane = 0; lane < rows_.size(); ++lane) {
                rows_[lane]->put(self, {chunks_.front().rows[lane]});
            }
            chunks_.pop_front();
        }
    }

    Sliced& sliced_;
    Rows& rows_;
    bool reported_;
    std::deque<Chunk> chunks_; // oldest first
    std::uint64_t first_ = 0;  // number of the oldest
    std::uint64_t opened_ = 0; // chunks so far
};

} // namespace degs
