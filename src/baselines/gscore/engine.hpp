// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "baselines/gscore/config.hpp"
#include "modules/kit/engine/array_accelerator.hpp"

namespace degs::gscore {

/// GSCore with its memory (Lee et al., ASPLOS 2024; the paper's Sec. II-B and Table I):
///
///   Tile Front End with Hierarchical Sorters -> Splat Fetchers -> [buffer] -> Lockstep Array ->
///   Pixel Buffer -> memory
///
/// There is one way back: a tile whose pixels have all ended is cancelled, neither
/// fetched nor sorted any further. With several clusters each of them is a Splat Fetcher, a buffer,
/// a Lockstep Array, a Tile Monitor and a Pixel Buffer, on tiles that the Tile Dispatcher grants.
class Engine : public ArrayAccelerator {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options = {});

    const Config& config() const { return config_; }
    /// One for each cluster.
    const std::vector<std::unique_ptr<LockstepArray>>& arrays() const { return arrays_; }

private:
    void collect_array(AcceleratorResult& result) const override;
    void collect_slots(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;

    Config config_;
    OrientedBoxes boxes_;
    std::vector<std::unique_ptr<LockstepArray>> arrays_;
};

} // namespace degs::gscore
