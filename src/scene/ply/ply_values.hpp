// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/ply/ply_header.hpp"

namespace degs {

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
