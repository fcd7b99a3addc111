// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "splat/frame/tile_window.hpp"
#include "splat/images/image.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

/// The work of the PEs for an image.
struct DataPathCounts {
    std::uint64_t spans = 0;      ///< rows with at least one pixel
    std::uint64_t useful = 0;     ///< inside the ellipse and blended
    std::uint64_t boundary = 0;   ///< tasks outside the ellipse
    std::uint64_t terminated = 0; ///< tasks of pixels that end or refuse the splat
};

struct DataPathRender {
    DataPathOptions numbers;
    /// Rows per splat: all that its ellipse meets (slicing.rows: splat) or those that it meets in
    /// the tile's columns (tile). The two differ for rows of pixels that are wider than the
    /// ellipse.
    bool rows_in_columns = false;
    /// Rows are solved, or as wide as the splat's bounding box, and pixels test themselves
    /// (span.parsing). With numbers.gemm every pixel of a tile tests itself.
    bool parsing = true;
    /// Is called now and then with the share that is done, 0 .. 1.
    std::function<void(double)> progress;
};

/// Renders tiles of a frame with the arithmetic of the modelled data path, without time: the image
/// is that of a run of the same numbers to the bit, however the run cuts spans and whatever it
/// skips. One tile at a time, so memory is that of the image and of the splat records.
class DataPathRenderer {
public:
    /// Derives the records of all splats. The workload outlives the renderer.
    DataPathRenderer(const FrameWorkload& workload, DataPathRender options);
    ~DataPathRenderer();

    /// The tiles of a window; the image has the size of their pixels.
    Image render(const TileWindow& window);
    /// Counts of all windows so far.
    const DataPathCounts& counts() const { return counts_; }

private:
    class TileBlender;

    const FrameWorkload& work_;
    std::function<void(double)> progress_;
    DataPathCounts counts_;
    std::unique_ptr<TileBlender> blender_;
};

} // namespace degs
