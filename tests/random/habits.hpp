// SPDX-License-Identifier: Apache-2.0
// The laws that random designs must obey ask here how the array of an accelerator works.
#pragma once

#include "modules/kit/accelerator/render_engine.hpp"

namespace degs::trials {

/// How an array works. One that is not known here does as these values say.
struct Habits {
    enum class Search {
        Test, ///< it tests pixels near the ellipse one by one, in blocks of its own
        Box,  ///< it tests every pixel of the rows of the splat's box
        Solve ///< it solves each row for the first and the last pixel
    };
    Search search = Search::Test;
    /// Rows are those that the ellipse has inside the tile, not all of the box.
    bool rows_of_tile = false;
    /// A pixel is read only after its last update has been written. False: images may be wrong, and
    /// the result counts hazards.
    bool keeps_pixel_order = true;
    /// No unit of the array works once all pixels are in memory.
    bool ends_with_its_pixels = true;
};

Habits habits_of(const AcceleratorConfig& config);

} // namespace degs::trials
