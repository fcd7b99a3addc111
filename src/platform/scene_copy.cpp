// SPDX-License-Identifier: Apache-2.0
#include "platform/scene_copy.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "modules/kit/job/traffic.hpp"
#include "tlm/set_access.hpp"

namespace degs {
namespace {

constexpr std::size_t kValues = 11; // floats per geometry record
constexpr std::uint64_t kDebugPiece = 1U << 20U;
constexpr std::uint64_t kTimedPiece = 4096;

float float_at(const unsigned char* bytes) {
    std::uint32_t bits = 0;
    for (unsigned int i = 4; i-- > 0;) {
        bits = bits << 8U | bytes[i];
    }
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

void append(std::vector<unsigned char>& bytes, float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; ++i, bits >>= 8U) {
        bytes.push_back(bits & 0xFFU);
    }
}

tlm::tlm_response_status read_timed(MemoryGateway& memory, std::uint64_t address,
                                    unsigned char* data, std::uint64_t bytes) {
    for (std::uint64_t at = 0; at < bytes; at += kTimedPiece) {
        tlm::tlm_generic_payload payload;
        set_access(payload, tlm::TLM_READ_COMMAND, address + at, data + at,
                   std::min(kTimedPiece, bytes - at));
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        memory.transport(payload, delay);
        sc_core::wait(delay);
        if (payload.is_response_error()) {
            return payload.get_response_status();
        }
    }
    return tlm::TLM_OK_RESPONSE;
}

// A target may move a part, such as a page, and is asked for the rest. Returns what it has moved.
std::uint64_t read_debug(MemoryGateway& memory, std::uint64_t address, unsigned char* data,
                         std::uint64_t bytes) {
    for (std::uint64_t at = 0; at < bytes;) {
        tlm::tlm_generic_payload payload;
        set_access(payload, tlm::TLM_READ_COMMAND, address + at, data + at, bytes - at);
        const std::uint64_t moved = memory.debug(payload);
        if (moved == 0) {
            return at;
        }
        at += std::min(moved, bytes - at);
    }
    return bytes;
}

GaussianCloud one_gaussian(const unsigned char* geometry, const unsigned char* sh, int degree) {
    std::array<float, kValues> v{};
    for (std::size_t i = 0; i < kValues; ++i) {
        v[i] = float_at(geometry + 4 * i);
    }
    GaussianCloud one;
    one.sh_degree = degree;
    one.means.emplace_back(v[0], v[1], v[2]);
    one.scales.emplace_back(v[3], v[4], v[5]);
    one.rotations.emplace_back(v[6], v[7], v[8], v[9]);
    one.opacities.push_back(v[10]);
    for (int i = 0; i < 3 * one.sh_coefficients(); ++i) {
        one.sh.push_back(float_at(sh + 4 * i));
    }
    return one;
}

GaussianCloud invisible(int degree) {
    GaussianCloud none;
    none.sh_degree = degree;
    none.means.emplace_back(0.0);
    none.scales.emplace_back(1.0F);
    none.rotations.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
    none.opacities.push_back(0.0F);
    none.sh.assign(3 * none.sh_coefficients(), 0.0F);
    return none;
}

void append(GaussianCloud& cloud, const GaussianCloud& one) {
    cloud.means.push_back(one.means.front());
    cloud.scales.push_back(one.scales.front());
    cloud.rotations.push_back(one.rotations.front());
    cloud.opacities.push_back(one.opacities.front());
    cloud.sh.insert(cloud.sh.end(), one.sh.begin(), one.sh.end());
}

bool same(const std::vector<unsigned char>& copy, std::uint64_t offset, const unsigned char* data,
          std::uint64_t bytes) {
    return bytes <= copy.size() - offset && std::memcmp(copy.data() + offset, data, bytes) == 0;
}

} // namespace

// Step by step, and lets the array grow only as it is read, because memory may hold less
// than a wrong count promises.
tlm::tlm_response_status read_memory(MemoryGateway& memory, std::uint64_t address,
                                     std::uint64_t bytes, std::vector<unsigned char>& out) {
    out.clear();
    for (std::uint64_t at = 0; at < bytes; at = out.size()) {
        const std::uint64_t piece = std::min(kDebugPiece, bytes - at);
        out.resize(at + piece);
        const std::uint64_t got = read_debug(memory, address + at, out.data() + at, piece);
        const auto status =
            read_timed(memory, address + at + got, out.data() + at + got, piece - got);
        if (status != tlm::TLM_OK_RESPONSE) {
            return status;
        }
    }
    return tlm::TLM_OK_RESPONSE;
}

std::uint64_t SceneCopy::Place::geometry_bytes() const {
    return std::uint64_t{count} * kFloatGeometryBytes;
}

std::uint64_t SceneCopy::Place::sh_bytes() const {
    const std::uint64_t coefficients = (sh_degree + 1) * (sh_degree + 1);
    return std::uint64_t{count} * 3 * coefficients * kFloatBytes;
}

tlm::tlm_response_status SceneCopy::load(MemoryGateway& memory, const Place& place) {
    place_ = place;
    const auto status = read_memory(memory, place.geometry, place.geometry_bytes(), geometry_);
    return status == tlm::TLM_OK_RESPONSE ? read_memory(memory, place.sh, place.sh_bytes(), sh_)
                                          : status;
}

GaussianCloud SceneCopy::cloud(std::uint32_t& dropped) const {
    GaussianCloud cloud;
    cloud.sh_degree = place_.sh_degree;
    cloud.sh.reserve(sh_.size() / kFloatBytes);
    const std::uint64_t record = place_.sh_bytes() / place_.count;
    dropped = 0;
    for (std::uint64_t i = 0; i < place_.count; ++i) {
        GaussianCloud one = one_gaussian(geometry_.data() + i * kFloatGeometryBytes,
                                         sh_.data() + i * record, place_.sh_degree);
        dropped += static_cast<std::uint32_t>(sanitize(one).total());
        append(cloud, one.empty() ? invisible(place_.sh_degree) : one);
    }
    return cloud;
}

bool SceneCopy::matches(std::uint64_t address, const unsigned char* data,
                        std::uint64_t bytes) const {
    if (address - place_.geometry < geometry_.size()) {
        return same(geometry_, address - place_.geometry, data, bytes);
    }
    if (address - place_.sh < sh_.size()) {
        return same(sh_, address - place_.sh, data, bytes);
    }
    return true;
}

void encode_scene(const GaussianCloud& cloud, std::vector<unsigned char>& geometry,
                  std::vector<unsigned char>& sh) {
    geometry.clear();
    sh.clear();
    geometry.reserve(cloud.size() * kFloatGeometryBytes);
    sh.reserve(cloud.sh.size() * kFloatBytes);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            append(geometry, static_cast<float>(cloud.means[i][axis]));
        }
        for (int axis = 0; axis < 3; ++axis) {
            append(geometry, cloud.scales[i][axis]);
        }
        for (int part = 0; part < 4; ++part) {
            append(geometry, cloud.rotations[i][part]);
        }
        append(geometry, cloud.opacities[i]);
    }
    for (const float value : cloud.sh) {
        append(sh, value);
    }
}

} // namespace degs
