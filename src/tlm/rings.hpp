// SPDX-License-Identifier: Apache-2.0
// Makes the rings that a module owns because it wires blocks together.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tlm/dated_fifo.hpp"

namespace degs {

/// Names of numbered modules and rings: "bank_3".
inline std::string numbered(const char* name, std::size_t index) {
    return std::string(name) + "_" + std::to_string(index);
}

/// A ring of at least one cell, owned by the module that wires blocks together.
template <class T>
DatedFifo<T>& add_ring(std::vector<std::unique_ptr<DatedFifo<T>>>& rings, const char* name,
                       const Timebase& time, int depth, int latency, int release = 0) {
    rings.push_back(std::make_unique<DatedFifo<T>>(numbered(name, rings.size()).c_str(), time,
                                                   depth, latency, release));
    return *rings.back();
}

/// Adds a ring for tokens and messages, which never push back.
template <class T>
DatedFifo<T>& add_wire(std::vector<std::unique_ptr<DatedFifo<T>>>& rings, const char* name,
                       const Timebase& time, int latency) {
    rings.push_back(std::make_unique<DatedFifo<T>>(numbered(name, rings.size()).c_str(), time,
                                                   FifoBase::kWire, latency));
    return *rings.back();
}

} // namespace degs
