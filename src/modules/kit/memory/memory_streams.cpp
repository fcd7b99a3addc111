// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/memory/memory_streams.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"

namespace degs {

void MemoryStreams::build(const char* name, const MainMemoryConfig& config, const Timebase& time,
                          const BuildOptions& options) {
    if (options.memory == nullptr) {
        own_ = make_main_memory(name, config, time, options.array_only);
    }
    memory_ = options.memory == nullptr ? own_.get() : options.memory;
    for (const MemoryStream& stream : streams_) {
        if (stream.urgent && config.priority == ReadPriority::Blending) {
            stream.port->make_urgent();
        }
    }
    memory_->connect(streams_);
    if (options.requests != nullptr) {
        for (std::size_t i = 0; i < streams_.size(); ++i) {
            options.requests->initiator(streams_[i].kind.name);
            streams_[i].port->tell(*options.requests, i);
        }
    }
    if (time.timeline != nullptr) {
        watched_.resize(streams_.size());
        for (std::size_t i = 0; i < streams_.size(); ++i) {
            watch(i, time);
        }
    }
}

// The bytes of an access are counted in its last cycles, as many as they take at the peak
// bandwidth.
void MemoryStreams::watch(std::size_t initiator, const Timebase& time) {
    const std::string name = streams_[initiator].kind.name;
    TimeSeries& read = time.timeline->series("memory", name + " read");
    TimeSeries& written = time.timeline->series("memory", name + " written");
    const double cycles_per_ns = 1e-9 / time.clock.period().to_seconds();
    const double peak = memory_->peak_gb_per_s();
    streams_[initiator].port->watch([=, &read, &written](Cycle asked, Cycle complete) {
        const MemoryTraffic now = memory_->traffic(initiator);
        MemoryTraffic& before = watched_[initiator];
        const std::uint64_t in = now.bytes_read - before.bytes_read;
        const std::uint64_t out = now.bytes_written - before.bytes_written;
        before = now;
        const double ns = peak > 0 ? rate_of(in + out, peak) : 0;
        const auto cycles = static_cast<Cycle>(std::ceil(ns * cycles_per_ns));
        const Cycle first = complete - std::min(complete - asked, cycles);
        read.add(first, complete, in);
        written.add(first, complete, out);
    });
}

MemoryTraffic MemoryStreams::total() const {
    MemoryTraffic sum;
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        const MemoryTraffic t = traffic(i);
        sum.reads += t.reads;
        sum.writes += t.writes;
        sum.bytes_read += t.bytes_read;
        sum.bytes_written += t.bytes_written;
    }
    return sum;
}

void MemoryStreams::collect_streams(AcceleratorResult& result) const {
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        const MemoryTraffic traffic = memory_->traffic(i);
        auto stream = std::find_if(result.streams.begin(), result.streams.end(),
                                   [&](const StreamUse& s) { return s.name == name(i); });
        if (stream == result.streams.end()) {
            stream = result.streams.insert(stream, StreamUse{name(i),
                                                             streams_[i].kind.sentence,
                                                             streams_[i].kind.prepares ? 1.0 : 0.0,
                                                             0,
                                                             0,
                                                             0,
                                                             {}});
        }
        stream->bytes_read += traffic.bytes_read;
        stream->bytes_written += traffic.bytes_written;
        stream->requests += traffic.reads + traffic.writes;
        if (const LatencyHistogram* latency = memory_->read_latency(i)) {
            stream->read_latency.add(*latency);
        }
    }
}

void MemoryStreams::collect(AcceleratorResult& result) const {
    collect_streams(result);
    result.memory_gb_per_s = memory_->peak_gb_per_s();
    memory_->collect(result);
    const std::vector<std::string> sentences = memory_->explain();
    result.left_out.insert(result.left_out.end(), sentences.begin(), sentences.end());
}

} // namespace degs
