// SPDX-License-Identifier: Apache-2.0
#include "dram/mapping.hpp"

#include <sstream>

#include "config/config_words.hpp"

namespace degs::dram {
namespace {

constexpr const char* kFieldNames[] = {"column", "group", "bank", "row"};

unsigned log2_of(std::uint64_t power) {
    unsigned bits = 0;
    while ((std::uint64_t{1} << bits) < power) {
        ++bits;
    }
    return bits;
}

/// XOR of the chunks of `width` bits of `value`.
unsigned folded(std::uint64_t value, unsigned width) {
    if (width == 0) {
        return 0;
    }
    const unsigned mask = (1U << width) - 1;
    std::uint64_t result = 0;
    for (; value != 0; value >>= width) {
        result ^= value;
    }
    return static_cast<unsigned>(result & mask);
}

} // namespace

void Mapping::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("interleave_bytes", interleave_bytes, 64, 2048,
                    "bytes, a power of two; neighbours of this size are in different channels");
    visitor.require_power_of_two("interleave_bytes", interleave_bytes);
    visitor.text("order", order,
                 "fields from low to high: column, group, bank, row; column:2 takes two bits, a "
                 "field without a number all that are left");
    visitor.boolean("fold_channel", fold_channel, "XOR all higher bits into the channel");
    visitor.boolean("fold_bank", fold_bank, "XOR all bits of the row into group and bank");
}

Mapping::Mapping(const Config& config, const Timing& timing, unsigned channels) {
    const std::string problem = build(config, timing, channels);
    if (!problem.empty()) {
        throw InputError("The order " + config_words::quote(config.order) +
                         " of an address mapping " + problem + ".");
    }
}

std::string Mapping::problem(const Config& config, const Timing& timing, int channels) {
    return Mapping().build(config, timing, static_cast<unsigned>(channels));
}

std::string Mapping::build(const Config& config, const Timing& timing, unsigned channels) {
    fold_channel_ = config.fold_channel;
    fold_bank_ = config.fold_bank;
    const std::uint64_t rows = timing.rows;
    capacity_ = channels * rows * timing.banks * timing.page_bytes;
    const unsigned group_bits = log2_of(timing.groups());
    bits_ = {log2_of(timing.page_bytes / kAccessBytes), group_bits,
             log2_of(timing.banks) - group_bits, log2_of(rows), log2_of(channels)};
    return read_order(config.order, log2_of(config.interleave_bytes));
}

std::string Mapping::read_order(const std::string& order, unsigned grain_bits) {
    std::istringstream words(order);
    for (std::string word; words >> word;) {
        const std::size_t colon = word.find(':');
        unsigned field = 0;
        while (field < kChannel && word.substr(0, colon) != kFieldNames[field]) {
            ++field;
        }
        if (field == kChannel) {
            return "must consist of column, group, bank and row";
        }
        unsigned bits = bits_[field] - taken_[field];
        if (colon != std::string::npos) {
            const std::string count = word.substr(colon + 1);
            if (std::string problem = count_problem(count, field); !problem.empty()) {
                return problem;
            }
            bits = std::min<unsigned>(bits, count[0] - '0');
        }
        place_field(field, bits, grain_bits);
    }
    for (unsigned field = 0; field < kChannel; ++field) {
        if (taken_[field] != bits_[field]) {
            return std::string("must name every bit of the ") + kFieldNames[field];
        }
    }
    return "";
}

std::string Mapping::count_problem(const std::string& count, unsigned field) const {
    if (count.size() != 1 || count[0] < '1' || count[0] > '9') {
        return "must have numbers of bits from 1 to 9";
    }
    const unsigned wanted = count[0] - '0';
    if (bits_[field] != 0 && wanted + taken_[field] > bits_[field]) {
        return std::string("must not name more bits than there are of the ") + kFieldNames[field];
    }
    return "";
}

// The channel comes where the grain ends.
void Mapping::place_field(unsigned field, unsigned bits, unsigned grain_bits) {
    while (bits != 0) {
        if (address_bits_ == grain_bits && taken_[kChannel] == 0) {
            append(kChannel, bits_[kChannel]);
            taken_[kChannel] = 1 + bits_[kChannel];
        }
        const unsigned room =
            address_bits_ < grain_bits ? std::min(bits, grain_bits - address_bits_) : bits;
        append(field, room);
        bits -= room;
    }
}

void Mapping::append(unsigned field, unsigned bits) {
    if (bits != 0) {
        pieces_.push_back({field, address_bits_, bits, taken_[field]});
        taken_[field] += bits;
        address_bits_ += bits;
    }
}

// The bank takes the chunks of the row, the group every other one: 16 rows that follow each other
// then meet 16 banks, and streams whose distance is a power of two differ in the bank itself,
// which matters because the group alternates within each stream anyway.
void Mapping::fold(Values& values) const {
    if (fold_bank_) {
        const unsigned row = values[kRow];
        values[kBank] ^= folded(row, bits_[kBank]);
        const unsigned width = bits_[kGroup];
        for (unsigned shift = width; width != 0 && shift < bits_[kRow]; shift += 2 * width) {
            values[kGroup] ^= (row >> shift) & ((1U << width) - 1);
        }
    }
}

Place Mapping::place(std::uint64_t address) const {
    Values values{};
    for (const Piece& piece : pieces_) {
        const auto bits = static_cast<unsigned>(address >> piece.shift) & ((1U << piece.bits) - 1U);
        values[piece.field] |= bits << piece.field_shift;
        if (piece.field == kChannel && fold_channel_) {
            values[kChannel] ^= folded(address >> (piece.shift + piece.bits), piece.bits);
        }
    }
    fold(values);
    return {values[kChannel], values[kGroup] << bits_[kBank] | values[kBank], values[kRow],
            values[kColumn]};
}

std::uint64_t Mapping::address(const Place& place) const {
    Values values{};
    values[kColumn] = place.block;
    values[kGroup] = place.bank >> bits_[kBank];
    values[kBank] = place.bank & ((1U << bits_[kBank]) - 1);
    values[kRow] = place.row;
    values[kChannel] = place.channel;
    fold(values);
    std::uint64_t address = 0;
    for (auto piece = pieces_.rbegin(); piece != pieces_.rend(); ++piece) {
        if (piece->field == kChannel && fold_channel_) {
            values[kChannel] ^= folded(address >> (piece->shift + piece->bits), piece->bits);
        }
        const std::uint64_t bits =
            (values[piece->field] >> piece->field_shift) & ((1U << piece->bits) - 1U);
        address |= bits << piece->shift;
    }
    return address;
}

} // namespace degs::dram
