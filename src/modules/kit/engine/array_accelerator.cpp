// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/engine/array_accelerator.hpp"

namespace degs {

void ArrayAccelerator::collect_engines(AcceleratorResult& result) const {
    const std::int64_t arrays = parts_.engines;
    const TrafficConfig& traffic = parts_.front.traffic;
    add_buffer(result, {"gaussian_buffer", "Chunks of splats on their way to the array."},
               arrays * parts_.buffer_bytes, parts_.splat_chunks, splat_buffer());
    add_pixel_buffer(result, arrays * parts_.pixel_buffer.bytes, parts_.engines * parts_.contexts,
                     pixel_buffers());
    result.conservation.push_back({"list entries = records fetched + cancelled", list_entries(),
                                   records_fetched() + records_cancelled()});
    collect_array(result);
    add_activity(result, "gaussian_buffer",
                 real_of(2 * records_fetched()) * traffic.splat_bytes +
                     real_of(front_end().keys_moved()) * traffic.list_entry_bytes);
    add_pixel_activity(result, job(), parts_.pixel_bytes);
}

} // namespace degs
