// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "baselines/gbu/config.hpp"
#include "modules/kit/engine/tiled_accelerator.hpp"

namespace degs::gbu {

/// The standalone GBU with its memory:
///
///   Tile Front End -> List Collectors -> Tile Dispatcher -> per engine: Splat Fetcher with reuse
///   cache -> tile engine -> Pixel Buffer -> memory
class Engine : public TiledAccelerator {
public:
    /// `job` supplies the work and receives the images. `config.problem()` must be empty.
    Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
           RenderJob& job, const BuildOptions& options = {});

    const Config& config() const { return config_; }
    const std::vector<std::unique_ptr<TileEngine>>& engines() const { return engines_; }

private:
    void collect_engines(AcceleratorResult& result) const override;
    void collect_slots(AcceleratorResult& result) const;
    void collect_stages(AcceleratorResult& result) const;
    void collect_buffers(AcceleratorResult& result) const;
    void collect_activity(AcceleratorResult& result) const;
    void collect_laws(AcceleratorResult& result) const;

    Config config_;
    std::vector<std::unique_ptr<TileEngine>> engines_;
};

} // namespace degs::gbu
