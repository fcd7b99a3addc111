// SPDX-License-Identifier: Apache-2.0
// Values of binary files, whose byte order need not be that of the host.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace degs {

inline bool host_is_big_endian() {
    const std::uint16_t probe = 1;
    char first = 0;
    std::memcpy(&first, &probe, 1);
    return first == 0;
}

/// The value that starts at `bytes`; `swap`: its bytes are in the other order than those of the
/// host.
template <class Value>
Value load_value(const char* bytes, bool swap) {
    char ordered[sizeof(Value)];
    if (swap) {
        std::reverse_copy(bytes, bytes + sizeof(Value), ordered);
    } else {
        std::memcpy(ordered, bytes, sizeof(Value));
    }
    Value value;
    std::memcpy(&value, ordered, sizeof(Value));
    return value;
}

} // namespace degs
