// SPDX-License-Identifier: Apache-2.0
#include "degs/request_info.hpp"

#include <array>
#include <cstring>

namespace degs {
namespace {

// In the order of the numbers.
constexpr std::array<const char*, 14> kNames{"other",
                                             "scene_load",
                                             "geometry",
                                             "sh",
                                             "splats_written",
                                             "splats_read",
                                             "tile_lists_written",
                                             "tile_lists_sorted",
                                             "list_heads",
                                             "frame_buffer",
                                             "means",
                                             "shapes",
                                             "group_lists_written",
                                             "group_lists_read"};

} // namespace

const char* to_string(RequestStream stream) {
    const auto number = static_cast<std::size_t>(stream);
    return kNames[number < kNames.size() ? number : 0];
}

RequestStream request_stream(const char* name) {
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (std::strcmp(kNames[i], name) == 0) {
            return static_cast<RequestStream>(i);
        }
    }
    return RequestStream::Other;
}

} // namespace degs
