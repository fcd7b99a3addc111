// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/splat_fetcher.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"

namespace degs {

void SplatFetcher::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("chunk", chunk, 1, 1024, "splat records per request [assumed]");
    visitor.integer("chunks_in_flight", chunks_in_flight, 1, 1024,
                    "record requests outstanding per fetcher; 8 cover 100 ns [assumed]");
}

SplatFetcher::SplatFetcher(const sc_core::sc_module_name& name, const Config& config,
                           const TrafficConfig& traffic, const Timebase& time, RenderJob& job,
                           std::size_t readers, bool instant, bool granted, ReuseCache* cache)
    : sc_core::sc_module(name), sorted("sorted"), cancel("cancel"), out("out", readers),
      request("request", granted ? 1 : 0), released("released", config.chunks == 0 ? 0 : readers),
      records("records", time), config_(config), traffic_(traffic), job_(job), instant_(instant),
      granted_(granted), cache_(cache), self_(time),
      writer_(out, released, config.splat_ports, config.chunks, instant),
      answered_(config.chunks_in_flight, 0) {
    DEGS_HAS_PROCESS(SplatFetcher);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

void SplatFetcher::end_of_elaboration() {
    sorted->connect_reader(self_);
    cancel->connect_reader(self_);
    writer_.connect(self_);
    for (auto& port : request) {
        port->connect_writer(self_);
    }
}

void SplatFetcher::run() {
    for (SortedRun run = next_run(); run.tile != kNoTile; run = next_run()) {
        fetch(run);
    }
    if (granted_) {
        SplatChunk end;
        end.tile = kNoTile;
        end.last = true;
        emit(end, 0);
    }
    self_.finish();
}

SortedRun SplatFetcher::next_run() {
    if (granted_ && done_ == 0) {
        request[0]->put(self_, {});
    }
    return sorted->get(self_);
}

// Asks before each request; the question takes a cycle.
bool SplatFetcher::cancelled(TileNumber number) {
    while (self_.arrived(cancel.ring())) {
        cancelled_before_ = std::max(cancelled_before_, cancel->take(self_) + 1);
    }
    if (!instant_) {
        self_.work(1, stats_.busy);
    }
    return number < cancelled_before_;
}

Completion SplatFetcher::read(const JobTile& tile, const SplatChunk& chunk) {
    if (instant_ || !config_.reads) {
        return self_.local();
    }
    const std::uint32_t* splats = job_.frame_of(tile).tile_splats.data() + chunk.first;
    std::size_t count = chunk.count;
    if (cache_ != nullptr) {
        const std::vector<std::uint32_t>& missed =
            cache_->request(chunk.tile, chunk.first, chunk.count);
        splats = missed.data();
        count = missed.size();
    }
    if (count == 0) {
        return self_.local();
    }
    Completion& oldest = answered_[requests_++ % answered_.size()];
    self_.wait_for_memory(oldest);
    oldest = records.read(self_, job_.splat_records(tile.frame, traffic_, splats, count));
    return oldest;
}

void SplatFetcher::emit(const SplatChunk& chunk, const Completion& ready) {
    writer_.put(self_, chunk, ready);
    const Cycle written = writer_.cycles(chunk);
    if (instant_) {
        self_.advance(written);
    } else {
        self_.work(written, stats_.busy);
    }
}

void SplatFetcher::fetch(const SortedRun& run) {
    const JobTile& tile = job_.tiles[run.tile];
    while (run.tile != skipped_ && done_ < run.end) {
        SplatChunk chunk;
        chunk.tile = run.tile;
        chunk.first = tile.first + done_;
        writer_.wait_for_place(self_);
        Completion ready = self_.local();
        if (cancelled(run.tile)) {
            stats_.records_cancelled += tile.count - done_;
            skipped_ = run.tile;
            done_ = tile.count;
        } else {
            chunk.count = next_chunk_of(config_.chunk, run.end - done_);
            done_ += chunk.count;
            stats_.records += chunk.count;
            ready = read(tile, chunk);
        }
        chunk.last = done_ == tile.count;
        emit(chunk, ready);
    }
    if (run.end == tile.count) {
        done_ = 0;
        job_.tiles[run.tile].passed = true;
    }
}

} // namespace degs
