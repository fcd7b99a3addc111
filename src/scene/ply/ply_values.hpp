// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "scene/ply/ply_header.hpp"

namespace degs {

inline bool host_is_big_endian() {
    const std::uint16_t probe = 1;
    char first = 0;
    std::memcpy(&first, &probe, 1);
    return first == 0;
}

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

/// Calls `function(Value{})` with the C++ type that `type` names.
template <class Function>
void with_type(PlyType type, Function&& function) {
    switch (type) {
    case PlyType::Int8:
        return function(std::int8_t{});
    case PlyType::UInt8:
        return function(std::uint8_t{});
    case PlyType::Int16:
        return function(std::int16_t{});
    case PlyType::UInt16:
        return function(std::uint16_t{});
    case PlyType::Int32:
        return function(std::int32_t{});
    case PlyType::UInt32:
        return function(std::uint32_t{});
    case PlyType::Float32:
        return function(float{});
    case PlyType::Float64:
        return function(double{});
    }
}

} // namespace degs
