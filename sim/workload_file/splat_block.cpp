// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/splat_block.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include <zstd.h>

#include "scene/files/input_file.hpp"
#include "sim/simulation/frame_checks.hpp"

namespace degs::sim {
namespace {

template <class Value>
using BitsOf = std::conditional_t<sizeof(Value) == 8, std::uint64_t, std::uint32_t>;

/// The columns of a block, one after the other: those of small differences and of equal signs and
/// exponents have planes that compress well.
template <class Pass>
void pass_columns(Pass&& pass) {
    pass([](auto& splat, auto&) -> auto& { return splat.id; });
    pass([](auto&, auto& mean) -> auto& { return mean.x; });
    pass([](auto&, auto& mean) -> auto& { return mean.y; });
    pass([](auto&, auto& mean) -> auto& { return mean.z; });
    pass([](auto& splat, auto&) -> auto& { return splat.mu_x; });
    pass([](auto& splat, auto&) -> auto& { return splat.mu_y; });
    pass([](auto& splat, auto&) -> auto& { return splat.cov_a; });
    pass([](auto& splat, auto&) -> auto& { return splat.cov_b; });
    pass([](auto& splat, auto&) -> auto& { return splat.cov_c; });
    pass([](auto& splat, auto&) -> auto& { return splat.det; });
    pass([](auto& splat, auto&) -> auto& { return splat.opacity; });
    pass([](auto& splat, auto&) -> auto& { return splat.q_threshold; });
    pass([](auto& splat, auto&) -> auto& { return splat.q_cut_off; });
    pass([](auto& splat, auto&) -> auto& { return splat.colour[0]; });
    pass([](auto& splat, auto&) -> auto& { return splat.colour[1]; });
    pass([](auto& splat, auto&) -> auto& { return splat.colour[2]; });
    pass([](auto& splat, auto&) -> auto& { return splat.depth; });
}

/// Appends the lowest byte of every value, then the next one of every value, and so on.
template <class Bits>
void put_planes(const std::vector<Bits>& values, std::string& bytes) {
    for (std::size_t plane = 0; plane < sizeof(Bits); ++plane) {
        for (const Bits value : values) {
            bytes += static_cast<char>(value >> 8 * plane & 0xffU);
        }
    }
}

template <class Bits>
void get_planes(const char*& at, std::vector<Bits>& values) {
    for (Bits& value : values) {
        value = 0;
    }
    for (std::size_t plane = 0; plane < sizeof(Bits); ++plane) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] |= Bits{static_cast<unsigned char>(at[i])} << 8 * plane;
        }
        at += values.size();
    }
}

std::string columns_of(const ReadySplats& splats, std::size_t begin, std::size_t end) {
    std::string bytes;
    bytes.reserve((end - begin) * kBytesPerSplat);
    pass_columns([&](auto member) {
        using Value = std::decay_t<decltype(member(splats.splats.front(), splats.means.front()))>;
        std::vector<BitsOf<Value>> column(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const Value& value = member(splats.splats[i], splats.means[i]);
            std::memcpy(&column[i - begin], &value, sizeof value);
        }
        if constexpr (std::is_integral_v<Value>) { // the step from the splat before
            for (std::size_t i = column.size(); i-- > 1;) {
                column[i] -= column[i - 1];
            }
        }
        put_planes(column, bytes);
    });
    return bytes;
}

void set_columns(const char* at, std::size_t begin, std::size_t end, ReadySplats& splats) {
    pass_columns([&](auto member) {
        using Value = std::decay_t<decltype(member(splats.splats.front(), splats.means.front()))>;
        std::vector<BitsOf<Value>> column(end - begin);
        get_planes(at, column);
        if constexpr (std::is_integral_v<Value>) {
            for (std::size_t i = 1; i < column.size(); ++i) {
                column[i] += column[i - 1];
            }
        }
        for (std::size_t i = begin; i < end; ++i) {
            std::memcpy(&member(splats.splats[i], splats.means[i]), &column[i - begin],
                        sizeof(Value));
        }
    });
}

void check_splats(const std::string& path, const std::string& place, std::size_t begin,
                  std::size_t end, const ReadySplats& splats) {
    for (std::size_t i = begin; i < end; ++i) {
        const ProjectedSplat& splat = splats.splats[i];
        const glm::vec3& mean = splats.means[i];
        if (!is_sound(splat, splats.options) || !std::isfinite(mean.x + mean.y + mean.z)) {
            fail_file(path, place + ", splat " + std::to_string(i) +
                                " has a value that is not finite or outside its range; only "
                                "what a projection gives is allowed.");
        }
        if (splat.id >= splats.gaussians || (i > begin && splat.id <= splats.splats[i - 1].id)) {
            fail_file(path, place + ", splat " + std::to_string(i) + " is of Gaussian " +
                                std::to_string(splat.id) +
                                ", but numbers must rise and lie below " +
                                std::to_string(splats.gaussians) + ".");
        }
    }
}

} // namespace

std::size_t blocks_of(std::size_t splats) {
    return splats / kSplatsPerBlock + (splats % kSplatsPerBlock == 0 ? 0 : 1);
}

std::string pack_splats(const ReadySplats& splats, std::size_t begin, std::size_t end) {
    constexpr int kLevel = 9;
    std::string plain = columns_of(splats, begin, end);
    std::string packed(ZSTD_compressBound(plain.size()), '\0');
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), kLevel);
    if (ZSTD_isError(size) != 0) {
        throw std::runtime_error(std::string("libzstd failed: ") + ZSTD_getErrorName(size));
    }
    packed.resize(size);
    const bool allowed = size < plain.size() && plain.size() / kMostInflation < size;
    return allowed ? packed : plain;
}

void unpack_splats(const std::string& path, const std::string& place, std::string_view packed,
                   std::size_t begin, std::size_t end, ReadySplats& splats) {
    const std::size_t bytes = (end - begin) * kBytesPerSplat;
    if (packed.size() == bytes) {
        set_columns(packed.data(), begin, end, splats);
    } else {
        std::string plain(bytes, '\0');
        const std::size_t size =
            ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size());
        if (ZSTD_isError(size) != 0 || size != bytes) {
            fail_file(path, place + " is damaged; it must hold " + std::to_string(bytes) +
                                " bytes that libzstd unpacks.");
        }
        set_columns(plain.data(), begin, end, splats);
    }
    check_splats(path, place, begin, end, splats);
}

} // namespace degs::sim
