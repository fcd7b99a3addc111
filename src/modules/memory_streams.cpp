// SPDX-License-Identifier: Apache-2.0
#include "modules/memory_streams.hpp"

#include <algorithm>

namespace degs {

void MemoryStreams::build(const char* name, const MainMemoryConfig& config, const Timebase& time,
                          const BuildOptions& options) {
    if (options.memory == nullptr) {
        own_ = make_main_memory(name, config, time, options.array_only);
    }
    memory_ = options.memory == nullptr ? own_.get() : options.memory;
    memory_->connect(streams_);
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
            stream = result.streams.insert(
                stream, StreamUse{name(i), streams_[i].kind.sentence, 0, 0, 0, {}});
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
