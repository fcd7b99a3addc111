// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/gltf/gltf_model.hpp"

namespace degs {

/// Component types of accessors, as a set. `Normalized` ones map their range to 0..1 or -1..1.
enum GltfComponents : unsigned {
    kGltfFloat = 1,
    kGltfByte = 2,
    kGltfUbyte = 4,
    kGltfShort = 8,
    kGltfUshort = 16,
    kGltfByteNormalized = 32,
    kGltfUbyteNormalized = 64,
    kGltfShortNormalized = 128,
    kGltfUshortNormalized = 256,
};

/// What an accessor may be.
struct GltfAccessorRule {
    std::string what; ///< who names it, for messages: "mesh 0, primitive 1: POSITION"
    int least_width = 1, most_width = 4; ///< components: 1 SCALAR .. 4 VEC4
    unsigned components = kGltfFloat;    ///< set of GltfComponents
    /// A sparse accessor may do without a buffer view: what it does not replace is 0. Nothing in
    /// the file then bears its count out, so that another accessor must.
    bool may_be_zeros = false;
};

/// Elements of a sparse accessor that replace those of its buffer view, all of them checked.
struct GltfReplacements {
    const unsigned char* indices = nullptr; ///< strictly increasing, below the count
    const unsigned char* values = nullptr;  ///< packed
    std::size_t count = 0, index_bytes = 0; ///< 1, 2 or 4 bytes each

    std::size_t index(std::size_t i) const;
};

/// An accessor whose every byte lies in its buffer.
class GltfAccessor {
public:
    /// Checks index, type, count, alignment, stride and range, and the indices of sparse ones;
    /// InputError names the one that is wrong.
    /// `placeholder`: only index, type and count matter, and the elements cannot be read.
    GltfAccessor(const GltfFile& file, int index, const GltfAccessorRule& rule,
                 bool placeholder = false);

    std::size_t count() const { return count_; }
    int width() const { return width_; } ///< components of an element

    /// Component `c` of element i goes to to[i * pitch + c], for the first min(width(), components)
    /// of each. Integers: normalised ones as c / 255, max(c / 127, -1) and so on, others as they
    /// are.
    void read(float* to, std::size_t pitch, int components) const;
    void read(double* to, std::size_t pitch, int components) const;

private:
    template <class To>
    void read_as(To* to, std::size_t pitch, int components) const;

    const unsigned char* data_ = nullptr; // none: zeros
    GltfReplacements sparse_;
    std::size_t count_ = 0, stride_ = 0, component_bytes_ = 0;
    int width_ = 0, type_ = 0;
    bool normalized_ = false;
};

/// A part of a buffer.
struct GltfBytes {
    const unsigned char* data;
    std::size_t bytes;
    std::size_t stride; ///< 0: packed
};

/// The bytes of a buffer view, checked; `what` names who refers to it.
GltfBytes gltf_view(const GltfFile& file, int index, const std::string& what);

} // namespace degs
