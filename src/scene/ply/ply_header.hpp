// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/files/input_file.hpp"

namespace degs {

enum class PlyFormat { Ascii, LittleEndian, BigEndian };
enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    std::optional<PlyType> list_count; ///< type of the length in front of each list; none = scalar
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< as the file claims; believed only after `check_claimed_size`
    std::vector<PlyProperty> properties;

    bool has(const std::string& property) const;
    bool has_lists() const;
    /// Bytes of the scalars and list lengths of one row of a binary file, and at most 2 characters
    /// per value of an ASCII file: no row can be shorter.
    std::uint64_t minimum_row_bytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::LittleEndian;
    std::vector<PlyElement> elements;
    std::vector<std::string> comments; ///< without the word 'comment'
    std::uint64_t data_begin = 0;      ///< byte after the header

    const PlyElement* find(const std::string& element) const;
};

/// Parses the header and leaves the file at the first byte of data. Accepts every kind of line
/// end (LF, CRLF, CR, LFCR), comments, obj_info, padding and both families of type names; every
/// mistake is an InputError with its line. Limits: 1 MiB of header, 4096 characters per line, 4096
/// properties, 64 elements.
PlyHeader read_ply_header(InputFile& file);

/// InputError if the `remaining` bytes of the file are too few for the rows that `element` claims.
/// To be called at its first row and before anything is allocated.
void check_claimed_size(const std::string& path, const PlyElement& element, PlyFormat format,
                        std::uint64_t remaining);

} // namespace degs
