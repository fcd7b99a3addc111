// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/tile_dispatcher.hpp"

#include "tlm/has_process.hpp"

namespace degs {

TileDispatcher::TileDispatcher(const sc_core::sc_module_name& name, const Timebase& time,
                               const RenderJob& job, std::size_t inputs, std::size_t engines)
    : sc_core::sc_module(name), in("in", inputs), request("request", engines), out("out", engines),
      job_(job), self_(time) {
    DEGS_HAS_PROCESS(TileDispatcher);
    SC_THREAD(run);
    self_.show(*this, stats_.tiles);
}

void TileDispatcher::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    for (auto& port : request) {
        port->connect_reader(self_);
        requests_.push_back(&port.ring());
    }
    for (auto& port : out) {
        port->connect_writer(self_);
    }
}

void TileDispatcher::run() {
    for (TileNumber number = 0; job_.has_tile(self_, number); ++number) {
        const Cycle ready = self_.local();
        const SortedRun list = in[job_.sorter_of(number, in.size())]->get(self_);
        stats_.list_wait += self_.local() - ready;
        if (job_.tiles[number].turn == 0) {
            frame_begun_ = self_.local();
        }
        const std::size_t engine = next_engine();
        request[engine]->take(self_);
        out[engine]->put(self_, list);
        self_.work(1, stats_.tiles);
    }
    for (auto& port : out) {
        port->put(self_, {kNoTile, 0});
    }
    self_.finish();
}

// The date moves to the one at which an engine has asked.
std::size_t TileDispatcher::next_engine() {
    const Cycle ready = self_.local();
    self_.advance_to(self_.next_arrival(requests_.data(), requests_.size(), ready, kNever));
    stats_.request_wait += self_.local() - ready;
    std::size_t first = requests_.size();
    for (std::size_t e = 0; e < requests_.size(); ++e) {
        const FifoBase& asked = *requests_[e];
        if (!asked.empty() && asked.head_date() <= self_.local() &&
            (first == requests_.size() || asked_at(e) < asked_at(first))) {
            first = e;
        }
    }
    return first;
}

} // namespace degs
