// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace degs {

/// One array of NumPy's .npy format: row-major numbers of any integer or floating type of 1 to 8
/// bytes.
struct NpyArray {
    char kind = 'f';      ///< f float, i signed, u unsigned, b bool
    int item_bytes = 4;   ///< of one number
    bool swapped = false; ///< of the other endianness than this machine's
    std::vector<std::uint64_t> shape;
    std::string bytes;       ///< the whole file
    std::size_t data_at = 0; ///< of the first number

    std::uint64_t size() const; ///< numbers
    double at(std::uint64_t index) const;
    /// The shape as NumPy writes it, e.g. "(3, 4)".
    std::string shape_words() const;
};

/// Parses a .npy file (versions 1 to 3). InputError "<where>: ..." that calls it `name` if it is
/// none, is stored column by column, of another type, or longer or shorter than its shape says.
NpyArray parse_npy(const std::string& where, const std::string& name, std::string bytes);

} // namespace degs
