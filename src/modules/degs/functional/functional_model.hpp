// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/shared_bytes.hpp"
#include "modules/degs/functional/sliced_rows.hpp"
#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/pixels/pixel_source.hpp"

namespace degs {

/// The functional model of functional-first simulation, which `--fidelity exact` is: it rasterises
/// the rows of a tile without any time, and the timed blocks replay the outcomes. That is exact,
/// because which splats a pixel takes depends on the order of the splats in its row alone, and no
/// block changes that order: queues, conflicts and terminations only decide when a task executes,
/// and how many tasks of ended pixels do. In strict mode, where tasks are blended when they
/// execute, reports and images are the same.
///
/// A splat is named by its place in the list of its tile, from 0.
class FunctionalModel : public PixelSource {
public:
    /// A hint that the splats of a chunk will be asked for next.
    virtual void expect(const SplatChunk& chunk) { (void)chunk; }
    /// The rows inside the tile that are sliced of a splat; see sliced_rows().
    virtual PixelRange rows(TileNumber number, std::uint32_t place) = 0;
    /// Writes the outcomes of the rows first, first + step, ... last of these to `outcomes`. Each
    /// of the modules that share a tile asks once for each splat, in the order of the list,
    /// although its range may be empty. A module may stop early, when all pixels of the tile have
    /// ended.
    virtual void take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
                      RowOutcome* outcomes) = 0;
    /// Host seconds that the simulation has slept until outcomes were there.
    virtual double waited_s() const { return 0; }
    /// The number of pixel updates in the rows that were taken.
    std::uint64_t fragments() const { return fragments_; }

protected:
    void count(const RowOutcome& row) { fragments_ += row.useful.count(); }

private:
    std::uint64_t fragments_ = 0;
};

/// How the tiles of a job are rasterised.
struct FunctionalOptions {
    bool tests = false; ///< the PEs test their pixels, see TileRows
    SlicedRows rows = SlicedRows::Splat;
    int modules = 1; ///< Slicing Unit modules that share a tile and take rows
};

/// What simulations of the same frames share, see BuildOptions::kept.
struct KeptTiles {
    SharedBytes* bytes = nullptr; ///< nullptr: nothing is shared
    std::string pixels;           ///< names what the pixels of a frame depend on beside the frame
};

/// The model for a job: with `kept`, one that shares the traces of tiles with other simulations;
/// else one that runs ahead on a thread of its own, if the host may use another processor;
/// otherwise one that rasterises each splat when it is taken. Results are the same. `job` must
/// outlive it.
std::unique_ptr<FunctionalModel>
make_functional_model(RenderJob& job, const FunctionalOptions& options, const KeptTiles& kept = {});

} // namespace degs
