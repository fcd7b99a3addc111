// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/supply/splat_supply.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"
#include "tlm/rings.hpp"

namespace degs {

void SplatSupply::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("splats_per_cycle", splats_per_cycle, 0, 4096,
                    "splat records delivered to all clusters together per cycle; 0: unlimited");
    visitor.integer("fifo_splats", fifo_splats, 1, 65536,
                    "splats that wait in front of the Gaussian Buffer of a cluster, at least a "
                    "chunk for each fetcher [assumed]");
    visitor.integer("multicast_window", multicast_window, 0, 4096,
                    "list entries; a record is captured for every tile in work that has it among "
                    "its next so many; 0: no multicast");
    visitor.integer("cache_bytes", cache_bytes, 0, 1 << 30,
                    "bytes of splat records that all clusters keep together, least recently used "
                    "first out; 0: none");
    visitor.integer("request_cycles", request_cycles, 1, 1024,
                    "cycles of a fetcher's request to the supply, and of the word that a chunk has "
                    "left [assumed]");
    if (!built()) {
        visitor.unused("fifo_splats", "splats_per_cycle",
                       "fetchers read by themselves while no other key of its section is set");
        visitor.unused("request_cycles", "splats_per_cycle",
                       "fetchers read by themselves while no other key of its section is set");
    }
}

std::int64_t SplatSupply::Config::bytes(int clusters, int fetchers, int record_bytes) const {
    const std::int64_t of_cluster =
        std::int64_t{1} * fifo_splats + std::int64_t{1} * fetchers * multicast_window;
    return built() ? clusters * of_cluster * record_bytes + cache_bytes : 0;
}

void SplatSupply::Stats::describe(StatsVisitor& v) const {
    v.count("records_requested", records.requested, "records", "Splat records asked for.");
    v.count("records_read", records.read, "records", "Splat records read from memory.");
    v.count("records_captured", records.captured, "records",
            "Splat records that the read of another tile had brought.");
    v.count("cache_hits", records.hits, "records", "Splat records found in the shared cache.");
    v.count("captures_unused", records.unused, "records",
            "Captured records whose tile was finished before it asked for them.");
    v.count("records_delivered", delivered, "records",
            "Splat records that the bus brought to a cluster.");
    v.count("chunks", chunks, "chunks", "Chunks delivered.");
    v.count("bus_cycles", bus_busy, "cycles", "Cycles in which the bus carried a record.");
    v.count("bus_wait_cycles", bus_wait, "cycles",
            "Complete chunks waiting for the bus, summed; their cluster had room.");
    v.count("room_wait_cycles", room_wait, "cycles",
            "Complete chunks waiting for room in their cluster, summed.");
}

SplatSupply::SplatSupply(const sc_core::sc_module_name& name, const Config& config,
                         const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                         const Shape& shape)
    : sc_core::sc_module(name), in("in", shape.clusters * shape.fetchers),
      taken("taken", in.size()), records("records", time), config_(config), traffic_(traffic),
      job_(job), shape_(shape),
      sharing_(job, in.size(), config.multicast_window, config.cache_bytes / traffic.splat_bytes),
      reader_(time), bus_(time), lanes_(in.size()) {
    build_lanes(time);
    DEGS_HAS_PROCESS(SplatSupply);
    SC_THREAD(read);
    SC_THREAD(deliver);
    reader_.show(*this, "reader");
    bus_.show(*this, "bus");
}

void SplatSupply::build_lanes(const Timebase& time) {
    const SplatFetcher::Config& fetching = shape_.fetching;
    const int depth = config_.fifo_chunks(shape_.fetchers, fetching.chunk);
    for (std::size_t f = 0; f < in.size(); ++f) {
        lanes_[f].room = depth;
        // One more for the end of the stream, which takes no place.
        add_ring(arrived_, "arrived", time, fetching.chunks_in_flight + 1, 1).set_billed();
        add_ring(fifos_, "fifo", time, depth, 1).set_billed();
        add_wire(emptied_, "emptied", time, 1);
        outlets_.push_back(std::make_unique<SplatOutlet>(numbered("outlet", f).c_str(), time,
                                                         shape_.readers, fetching.splat_ports,
                                                         fetching.chunks, shape_.instant));
        outlets_[f]->in.bind(*fifos_[f]);
        outlets_[f]->moved.bind(*emptied_[f]);
    }
    waited_.resize(in.size());
}

void SplatSupply::end_of_elaboration() {
    for (std::size_t f = 0; f < in.size(); ++f) {
        in[f]->connect_reader(reader_);
        asked_.push_back(&in[f].ring());
        arrived_[f]->connect_writer(reader_);
        arrived_[f]->connect_reader(bus_);
        taken[f]->connect_writer(bus_);
        fifos_[f]->connect_writer(bus_);
        emptied_[f]->connect_reader(bus_);
    }
}

void SplatSupply::read() {
    for (std::size_t f = next_request(); f != kNobody; f = next_request()) {
        const SplatChunk chunk = in[f]->take(reader_);
        arrived_[f]->put_at(reader_, chunk, answer(f, chunk));
    }
    reader_.finish();
}

// The date moves to the one at which a fetcher has asked.
std::size_t SplatSupply::next_request() {
    const Cycle date = reader_.next_arrival(asked_.data(), asked_.size(), reader_.local(), kNever);
    if (date == kNever) {
        return kNobody;
    }
    reader_.advance_to(date);
    return first_request();
}

// The oldest one; of those that came in the same cycle, that of the next fetcher in turn.
std::size_t SplatSupply::first_request() {
    std::size_t first = kNobody, first_turn = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const std::size_t turn = (asked_turn_ + i) % in.size();
        const std::size_t f = in_turn(turn);
        if (is_there(*asked_[f], reader_.local()) &&
            (first == kNobody || asked_[f]->head_date() < asked_[first]->head_date())) {
            first = f;
            first_turn = turn;
        }
    }
    asked_turn_ = first_turn + 1;
    return first;
}

Completion SplatSupply::answer(std::size_t fetcher, const SplatChunk& chunk) {
    if (chunk.tile == kNoTile) {
        return reader_.local();
    }
    const std::vector<std::uint32_t>& missed = sharing_.request(fetcher, chunk);
    if (missed.empty()) {
        return sharing_.known();
    }
    if (shape_.instant) {
        return sharing_.complete(reader_.local());
    }
    reader_.advance(); // the request leaves in the cycle after the choice
    const std::uint32_t frame = job_.tiles[chunk.tile].frame;
    return sharing_.complete(
        records.read(reader_, job_.splat_records(frame, traffic_, missed.data(), missed.size())));
}

void SplatSupply::deliver() {
    for (std::size_t f = next_ready(); f != kNobody; f = next_ready()) {
        move(f);
    }
    bus_.finish();
}

// A fetcher with a complete chunk and room for it, in turn; the date moves to the first such one.
std::size_t SplatSupply::next_ready() {
    for (;;) {
        for (std::size_t f = 0; f < in.size(); ++f) {
            waited_[f] =
                lanes_[f].room != 0 ? static_cast<FifoBase*>(arrived_[f].get()) : emptied_[f].get();
        }
        const Cycle date = bus_.next_arrival(waited_.data(), waited_.size(), bus_.local(), kNever);
        if (date == kNever) {
            return kNobody;
        }
        bus_.advance_to(date);
        bool emptied = false;
        for (std::size_t f = 0; f < in.size(); ++f) {
            if (lanes_[f].room == 0 && is_there(*emptied_[f], date)) {
                lanes_[f].room_since = emptied_[f]->head_date();
                emptied_[f]->drop(bus_);
                ++lanes_[f].room;
                emptied = true;
            }
        }
        for (std::size_t i = 0; i < in.size() && !emptied; ++i) {
            const std::size_t turn = (turn_ + i) % in.size();
            const std::size_t f = in_turn(turn);
            if (lanes_[f].room != 0 && is_there(*arrived_[f], date)) {
                turn_ = turn + 1;
                return f;
            }
        }
    }
}

void SplatSupply::move(std::size_t fetcher) {
    Lane& lane = lanes_[fetcher];
    const Cycle complete = arrived_[fetcher]->head_date();
    const Cycle both = std::max(complete, lane.room_since);
    stats_.room_wait += both - complete;
    stats_.bus_wait += bus_.local() - both;
    const SplatChunk chunk = arrived_[fetcher]->take(bus_);
    taken[fetcher]->put(bus_, {});
    --lane.room;
    stats_.chunks += chunk.count != 0 ? 1 : 0;
    stats_.delivered += chunk.count;
    fifos_[fetcher]->put_at(bus_, chunk, carry(chunk.count) + 1);
    if (config_.splats_per_cycle != 0) {
        bus_.advance_to(slot_ / config_.splats_per_cycle);
    }
}

// Returns the cycle in which the last of them is on the bus.
Cycle SplatSupply::carry(std::uint32_t splats) {
    const Cycle now = bus_.local();
    if (splats == 0) {
        return now;
    }
    const std::uint64_t rate = config_.splats_per_cycle;
    slot_ = rate == 0 ? 0 : std::max(slot_, now * rate);
    slot_ += splats;
    const Cycle last = rate == 0 ? now : (slot_ - 1) / rate;
    stats_.bus_busy += last + 1 - std::min(last + 1, std::max(now, counted_));
    counted_ = std::max(counted_, last + 1);
    return last;
}

} // namespace degs
