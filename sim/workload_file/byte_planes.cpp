// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/byte_planes.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <zstd.h>

#include "sim/workload_file/file_layout.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kLengthBytes = 4;
constexpr std::size_t kPart = 1024; // values that are put together at a time

/// The plane compressed, or itself if that is no longer.
std::string packed_plane(const std::string& plane) {
    constexpr int kLevel = 9;
    std::string packed(ZSTD_compressBound(plane.size()), '\0');
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), plane.data(), plane.size(), kLevel);
    if (ZSTD_isError(size) != 0) {
        throw std::runtime_error(std::string("libzstd failed: ") + ZSTD_getErrorName(size));
    }
    packed.resize(size);
    return size < plane.size() ? packed : plane;
}

bool is_exact_in_single(double value) {
    const auto narrow = static_cast<double>(static_cast<float>(value));
    std::uint64_t narrow_bits = 0, bits = 0; // -0 and 0 are two values
    std::memcpy(&narrow_bits, &narrow, sizeof narrow);
    std::memcpy(&bits, &value, sizeof value);
    return narrow_bits == bits;
}

template <class Bits, class Value>
std::vector<Bits> bits_of(const std::vector<double>& column) {
    std::vector<Bits> bits(column.size());
    for (std::size_t i = 0; i < column.size(); ++i) {
        const auto value = static_cast<Value>(column[i]);
        std::memcpy(&bits[i], &value, sizeof value);
    }
    return bits;
}

/// Puts a part of the planes together. The compiler turns the loop into vector instructions.
void join(const std::array<const unsigned char*, 8>& planes, std::size_t first, std::size_t begin,
          std::size_t count, std::uint32_t* values) {
    const unsigned char* const a = planes[first] + begin;
    const unsigned char* const b = planes[first + 1] + begin;
    const unsigned char* const c = planes[first + 2] + begin;
    const unsigned char* const d = planes[first + 3] + begin;
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = std::uint32_t{a[i]} | std::uint32_t{b[i]} << 8U | std::uint32_t{c[i]} << 16U |
                    std::uint32_t{d[i]} << 24U;
    }
}

} // namespace

template <class Bits>
void PlaneWriter::put_planes(const std::vector<Bits>& column) {
    packed_ += static_cast<char>(sizeof(Bits));
    plain_ += static_cast<char>(sizeof(Bits));
    for (std::size_t number = 0; number < sizeof(Bits); ++number) {
        std::string plane;
        plane.reserve(column.size());
        for (const Bits value : column) {
            plane += static_cast<char>(value >> 8 * number & 0xffU);
        }
        const std::string packed = packed_plane(plane);
        packed_ += little_endian(static_cast<std::uint32_t>(packed.size())) + packed;
        plain_ += little_endian(static_cast<std::uint32_t>(plane.size())) + plane;
    }
}

void PlaneWriter::put(const std::vector<std::uint32_t>& column) {
    put_planes(column);
}

void PlaneWriter::put(const std::vector<double>& column) {
    if (std::all_of(column.begin(), column.end(), is_exact_in_single)) {
        put_planes(bits_of<std::uint32_t, float>(column));
    } else {
        put_planes(bits_of<std::uint64_t, double>(column));
    }
}

std::string PlaneWriter::block(std::size_t plain_bytes) const {
    return packed_.size() >= plain_bytes / kMostInflation ? packed_ : plain_;
}

PlaneReader::Workspace::Workspace() : context_(ZSTD_createDCtx()) {}

void PlaneReader::Workspace::Free::operator()(ZSTD_DCtx_s* context) const {
    ZSTD_freeDCtx(context);
}

void PlaneReader::Column::get(std::size_t begin, std::size_t count, std::uint32_t* values) const {
    join(planes, 0, begin, count, values);
}

void PlaneReader::Column::get(std::size_t begin, std::size_t count, float* values) const {
    std::array<std::uint32_t, kPart> bits;
    for (std::size_t done = 0; done < count; done += kPart) {
        const std::size_t part = std::min(kPart, count - done);
        join(planes, 0, begin + done, part, bits.data());
        std::memcpy(values + done, bits.data(), part * sizeof(float));
    }
}

void PlaneReader::Column::get(std::size_t begin, std::size_t count, double* values) const {
    std::array<std::uint32_t, kPart> low;
    std::array<std::uint32_t, kPart> high;
    std::array<float, kPart> narrow;
    for (std::size_t done = 0; done < count; done += kPart) {
        const std::size_t part = std::min(kPart, count - done);
        join(planes, 0, begin + done, part, low.data());
        if (bytes == sizeof(float)) {
            std::memcpy(narrow.data(), low.data(), part * sizeof(float));
            std::copy_n(narrow.data(), part, values + done);
            continue;
        }
        join(planes, 4, begin + done, part, high.data());
        for (std::size_t i = 0; i < part; ++i) {
            const std::uint64_t bits = std::uint64_t{high[i]} << 32U | low[i];
            std::memcpy(values + done + i, &bits, sizeof bits);
        }
    }
}

PlaneReader::PlaneReader(std::string_view block, std::size_t values, Workspace& workspace)
    : block_(block), values_(values), workspace_(workspace) {
    if (workspace_.values_ < values) {
        workspace_.planes_.clear();
        workspace_.values_ = values;
    }
}

char* PlaneReader::room() {
    std::vector<std::unique_ptr<char[]>>& planes = workspace_.planes_;
    if (used_ == planes.size()) {
        planes.emplace_back(new char[workspace_.values_]); // not set to zero
    }
    return planes[used_++].get();
}

bool PlaneReader::take_plane(const unsigned char*& plane) {
    if (block_.size() < kLengthBytes) {
        return false;
    }
    const std::size_t length = little_endian_at(block_, 0);
    block_.remove_prefix(kLengthBytes);
    if (length > block_.size() || length > values_) {
        return false;
    }
    const char* at = block_.data();
    if (length < values_) {
        char* const to = room();
        const std::size_t size =
            ZSTD_decompressDCtx(workspace_.context_.get(), to, values_, at, length);
        if (ZSTD_isError(size) != 0 || size != values_) {
            return false;
        }
        at = to;
    }
    plane = reinterpret_cast<const unsigned char*>(at);
    block_.remove_prefix(length);
    return true;
}

bool PlaneReader::next(bool wide, Column& column) {
    if (block_.empty()) {
        return false;
    }
    column.bytes = static_cast<unsigned char>(block_.front());
    block_.remove_prefix(1);
    if (column.bytes != 4 && !(wide && column.bytes == 8)) {
        return false;
    }
    for (std::size_t number = 0; number < column.bytes; ++number) {
        if (!take_plane(column.planes[number])) {
            return false;
        }
    }
    return true;
}

} // namespace degs::sim
