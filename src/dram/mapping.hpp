// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dram/timing.hpp"

namespace degs::dram {

/// The place of 64 bytes, which never cross a row.
struct Place {
    unsigned channel = 0;
    unsigned bank = 0; ///< group * (banks per group) + bank in the group
    unsigned row = 0;
    unsigned block = 0; ///< of 64 bytes in the row
};

/// Maps an address to channel, bank group, bank, row and column. An address has, from low to high:
/// * 6 bits inside an access of 64 bytes
/// * the bits of `order` that fit under the interleave grain
/// * the channel
/// * the rest of `order`
///
/// XOR folding then adds bits above a field to it, which spreads strides that are powers of two. It
/// keeps the mapping one to one, because the bits above stay as they are.
class Mapping {
public:
    struct Config {
        int interleave_bytes = 256;
        std::string order = "column:2 group column bank row";
        bool fold_channel = true;
        bool fold_bank = true;
        void describe(ConfigVisitor& visitor);
    };

    /// `channels` is a power of two. Throws InputError if `order` does not name every bit once.
    Mapping(const Config& config, const Timing& timing, unsigned channels);
    /// What `order` must be instead ("must ..."); empty if it names every bit once.
    static std::string problem(const Config& config, const Timing& timing, int channels);

    /// Place of the access that holds `address`, which is below capacity().
    Place place(std::uint64_t address) const;
    /// The first byte of the access at a place; the inverse of place().
    std::uint64_t address(const Place& place) const;
    std::uint64_t capacity() const { return capacity_; } ///< bytes

private:
    enum Field : std::uint8_t { kColumn, kGroup, kBank, kRow, kChannel };
    static constexpr std::size_t kFields = 5;
    struct Piece { // some bits of a field at one place of the address
        unsigned field, shift, bits, field_shift;
    };
    using Values = std::array<unsigned, kFields>;
    Mapping() = default;
    std::string build(const Config& config, const Timing& timing, unsigned channels);
    std::string read_order(const std::string& order, unsigned grain_bits);
    std::string count_problem(const std::string& count, unsigned field) const;
    void place_field(unsigned field, unsigned bits, unsigned grain_bits);
    void append(unsigned field, unsigned bits);
    /// Mixes row bits into bank and bank group. It is its own inverse, because the row does not
    /// change.
    void fold(Values& values) const;

    bool fold_channel_ = false, fold_bank_ = false;
    std::array<unsigned, kFields> bits_{}; // of each field
    std::array<unsigned, kFields> taken_{};
    unsigned address_bits_ = 6;
    std::vector<Piece> pieces_; // from low to high
    std::uint64_t capacity_ = 0;
};

} // namespace degs::dram
