// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/engine/tiled_accelerator.hpp"

namespace degs {

/// A TiledAccelerator whose engines are arrays with two buffers each: one for the splats on their
/// way to the array, which also holds the lists being sorted, and the Pixel Buffer. With one array
/// and Parts as they are:
///
///   Tile Front End -> Splat Fetchers -> [buffer] -> (array) -> Pixel Buffer -> memory
///
/// There is one way back: a tile whose pixels have all ended is cancelled upstream. A derived
/// class builds its array in its constructor and hands over the ports;
/// docs/adding-an-accelerator.md is a worked example.
class ArrayAccelerator : public TiledAccelerator {
public:
    struct Parts : TiledAccelerator::Parts {
        using TiledAccelerator::Parts::Parts;
        int buffer_bytes = 0;    ///< of an array's first buffer, for reports
        double pixel_bytes = 16; ///< of the state of a pixel
    };

protected:
    ArrayAccelerator(const sc_core::sc_module_name& name, const Parts& parts, const Timebase& time,
                     RenderJob& job, const BuildOptions& options)
        : TiledAccelerator(name, parts, time, job, options), parts_(parts) {}

    /// Fills slots, window, and the stages, activity and invariants of the arrays.
    virtual void collect_array(AcceleratorResult& result) const = 0;

private:
    void collect_engines(AcceleratorResult& result) const override;

    Parts parts_;
};

} // namespace degs
