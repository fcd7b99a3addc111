// SPDX-License-Identifier: Apache-2.0
// A platform in little whose frames can be given up, with any kind of bus.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {

enum class Bus { Annotated, Blocking, FourPhases, Quantum };

inline Accelerator::Options options_of(Bus bus, Fidelity fidelity) {
    Accelerator::Options options;
    options.fidelity = fidelity;
    if (bus == Bus::FourPhases) {
        options.memory.transport = Transport::At;
        options.memory.burst_bytes = 64;
    } else if (bus == Bus::Quantum) {
        options.memory.pacing = Pacing::Quantum;
    }
    return options;
}

/// A platform with a reset line and either kind of memory, which watches what the memory sees.
struct ResetPlatform : Platform {
    ResetPlatform(const std::string& name, const AcceleratorConfig& config,
                  const GaussianCloud& cloud, Bus bus, const Accelerator::Options& options,
                  bool has_debug = true)
        : Platform(name.c_str(), config, cloud,
                   bus == Bus::FourPhases
                       ? nullptr
                       : std::make_unique<PlainMemory>((name + "_memory").c_str(), kMemoryBytes,
                                                       bus == Bus::Blocking ? Timing::Blocking
                                                                            : Timing::Annotated,
                                                       has_debug),
                   options),
          reset_n((name + "_reset_n").c_str(), true) {
        accelerator.reset_n.bind(reset_n);
        if (bus == Bus::FourPhases) {
            at = std::make_unique<AtMemory>((name + "_at_memory").c_str(), kMemoryBytes);
            at->has_debug = has_debug;
            mem().bind(at->in);
            std::vector<unsigned char> geometry;
            std::vector<unsigned char> sh;
            encode_scene(cloud, geometry, sh);
            std::copy(geometry.begin(), geometry.end(), at->bytes.begin());
            std::copy(sh.begin(), sh.end(), at->bytes.begin() + kSh);
        }
    }
    std::vector<unsigned char>& bytes() { return at ? at->bytes : memory->bytes; }
    std::uint64_t accesses() const { return at ? at->requests : memory->accesses; }
    std::vector<unsigned char> pixels(const Camera& camera) {
        const auto begin = bytes().begin() + kFrame;
        return {begin, begin + camera.width * camera.height * 4};
    }
    void erase(const Camera& camera) {
        std::fill_n(bytes().begin() + kFrame, camera.width * camera.height * 4, kErased);
    }
    static constexpr unsigned char kErased = 0xA5;

    std::unique_ptr<AtMemory> at;
    sc_core::sc_signal<bool> reset_n;
};

} // namespace degs::test
