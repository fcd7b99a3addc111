// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/traffic.hpp"

namespace degs::gcc {
namespace {

std::uint64_t aligned_64(std::uint64_t bytes) {
    return (bytes + 63) / 64 * 64;
}

} // namespace

void Traffic::describe(ConfigVisitor& visitor) {
    visitor.integer(
        "mean_bytes", mean_bytes, 0, 1024,
        "bytes per Gaussian read by Stage I; 0: as the formats of pipeline.records need");
    visitor.integer("bound_bytes", bound_bytes, 0, 1024,
                    "bytes per Gaussian that tell Stage I its extent: a radius in FP16, computed "
                    "offline [assumed]");
    visitor.integer("shape_bytes", shape_bytes, 0, 1024,
                    "bytes per Gaussian read by Stage II: scale, rotation, opacity; 0: as the "
                    "formats need [assumed]");
    visitor.integer("sh_value_bytes", sh_value_bytes, 0, 8,
                    "bytes per SH value read by Stage III; 0: as the formats need");
    visitor.integer("list_entry_bytes", list_entry_bytes, 1, 64,
                    "bytes per entry of a group or view list; depth key 4 + index 4 [assumed]");
    visitor.integer("pixel_bytes", pixel_bytes, 4, 8,
                    "bytes per frame-buffer pixel; 4 is RGBA8, 8 is RGBA16F");
    visitor.integer("burst_bytes", burst_bytes, 1, 4096,
                    "bytes; scattered records are read in whole bursts of this size");
}

TrafficConfig Traffic::common() const {
    TrafficConfig common = formats;
    common.mean_bytes = mean_bytes;
    common.bound_bytes = bound_bytes;
    common.shape_bytes = shape_bytes;
    common.sh_value_bytes = sh_value_bytes;
    common.list_entry_bytes = list_entry_bytes;
    common.pixel_bytes = pixel_bytes;
    common.burst_bytes = burst_bytes;
    return common;
}

MemoryMap::MemoryMap(const Traffic& traffic, const RenderJob& job, std::uint32_t frame) {
    const FrameWorkload& work = *job.frames[frame];
    const degs::MemoryMap common = job.map(frame, traffic.common());
    means = common.geometry;
    shapes = traffic.gaussian_bytes == 0
                 ? means + aligned_64(work.gaussians * traffic.stage_one_bytes())
                 : means + traffic.gaussian_bytes - traffic.shape_bytes;
    sh = common.sh;
    views = common.lists;
    groups = views + aligned_64(work.tile_pairs() * traffic.entry_bytes());
}

ScatteredRecords shape_records(const Traffic& traffic, const RenderJob& job, std::uint32_t frame,
                               const std::uint32_t* gaussians, std::size_t count) {
    const FrameWorkload& work = *job.frames[frame];
    ScatteredRecords records;
    records.base = MemoryMap(traffic, job, frame).shapes;
    records.bytes = traffic.shape_size();
    records.stride = traffic.gaussian_bytes == 0 ? records.bytes : traffic.gaussian_bytes;
    records.burst = traffic.burst_bytes;
    const std::uint64_t before_last = (work.gaussians - 1) * records.stride;
    records.array_bytes = traffic.gaussian_bytes == 0 ? aligned_64(before_last + records.bytes)
                                                      : before_last + records.bytes;
    records.numbers = gaussians;
    records.count = count;
    return records;
}

} // namespace degs::gcc
