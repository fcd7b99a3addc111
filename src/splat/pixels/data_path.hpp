// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splat/frame/frame_workload.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/frame/pixel_mask.hpp"
#include "splat/frame/rendering_rules.hpp"
#include "splat/numbers/number_set.hpp"
#include "splat/pixels/exponent_gemm.hpp"

namespace degs {

/// Arithmetic of the modelled data path: Fp32 and Fp64 in the machine's own operations, the others
/// in the formats of a named NumberSet. Ideal is Fp64.
enum class Arithmetic { Fp32, Fp64, Ideal, Fp16, Paper, Tuned };
/// "fp32", "fp64", "ideal", "fp16", "paper", "tuned", in the order of Arithmetic.
const std::vector<const char*>& arithmetic_names();
/// The name among them.
const char* name_of(Arithmetic arithmetic);

/// `Refuse`: the splat that would push T under 1e-4 is not blended and ends the pixel (reference).
/// `After`: it is blended, then the pixel ends (paper, Sec. II-A).
enum class StopRule { Refuse, After };

struct DataPathOptions {
    Arithmetic numbers = Arithmetic::Fp32;
    SpanEnds ends = SpanEnds::Exact; ///< in place of a number set's own
    int delta = 0; ///< px added at both ends that are not exact, in place of a number set's own
    StopRule stop = StopRule::Refuse;
    std::optional<NumberSet> set = std::nullopt; ///< in place of `numbers`: any formats
    /// The formats in which its frames are projected (ProjectionOptions::numbers). The data path
    /// itself takes splats as they are.
    ProjectionNumbers projection = {};
    RenderingRules rules = {}; ///< by which its frames are projected
    /// test() forms exponents so; nothing: as a completed square.
    std::optional<ExponentGemm> gemm = std::nullopt;
};

/// The options that project a scene for a data path; `antialiased` as in RenderingRules::options().
ProjectionOptions projection_of(const DataPathOptions& path, bool antialiased);

/// The number set of an arithmetic; that of Fp64 is `ideal`.
NumberSet set_of(Arithmetic arithmetic);
/// The numbers of that name with the span ends and the projection of their set; fp64 has exact
/// ends. Throws InputError, which lists the names, for any other.
DataPathOptions named_numbers(const std::string& name);
/// Named numbers with parts changed ("key=value" of NumberSet::describe). fp32 and fp64 stay the
/// machine's own operations if projection, SH coefficients and depth keys alone are.
DataPathOptions named_numbers(const std::string& name, const std::vector<std::string>& assignments);
/// The formats, span ends and projection of any set.
DataPathOptions options_of(const NumberSet& set);

/// One row of one splat inside one tile: the Span Vector of the paper (Eq. 20). Values of g0 and d0
/// are already rounded to the data path's format; double only carries them.
struct RowSpan {
    std::uint32_t splat = 0; ///< global index, see DataPath::add_frame
    std::int16_t y = 0;      ///< row inside the tile
    std::int16_t x0 = 0;     ///< first pixel inside the tile
    std::int16_t length = 0; ///< pixels, >= 1
    std::int16_t base = 0;   ///< the pixel of n = 0, from the tile's first; mostly x0
    double g0 = 0; ///< q - 2 ln o at the base (the opacity is folded into the start value)
    double d0 = 0; ///< first forward difference
};

/// Tile contexts are numbered in 16 bits, the sign included.
constexpr int kMostContexts = 32767;

/// Up to 32 neighbouring pixels of one row span, handed to the PEs in one go.
struct BlendTask {
    double g0 = 0, d0 = 0; ///< of the span
    std::uint32_t splat = 0;
    std::uint32_t mask = 0;   ///< bit i: the pixel at column + i has a task
    std::int16_t row = 0;     ///< inside the tile
    std::int16_t column = 0;  ///< inside the tile, of mask bit 0; a multiple of the segment length
    std::int16_t offset = 0;  ///< n of mask bit 0, i.e. column - base; may be negative
    std::int16_t context = 0; ///< tile context of the Pixel Buffer
};

/// Up to 32 neighbouring pixels of a row, each of which tests whether it is inside the ellipse, as
/// the lanes of a coupled "checking-while-blending" array do (paper, Sec. II-B).
struct PixelTest {
    std::uint32_t splat = 0;
    std::uint32_t mask = 0; ///< bit i: the pixel at column + i is tested
    int x = 0, y = 0;       ///< raster pixel of mask bit 0
    int row = 0;            ///< inside the tile
    int column = 0;         ///< inside the tile, of mask bit 0
    int context = 0;        ///< tile context of the Pixel Buffer
};

/// The result of the tasks: disjoint masks whose union is the mask of the request, and the pixels
/// that ended.
struct BlendOutcome {
    std::uint32_t useful = 0;     ///< inside the ellipse and blended
    std::uint32_t boundary = 0;   ///< outside the ellipse (alpha < 1/255, or beyond the cut)
    std::uint32_t terminated = 0; ///< inside, but the pixel has ended or refuses the splat
    std::uint32_t ended = 0;      ///< pixels that ended now
};

/// Leaves the pixels of a span that lie among `columns` of the tile. What is counted from its base
/// stays as it was solved. False if there are none.
inline bool cut(RowSpan& span, const PixelRange& columns) {
    const PixelRange left = PixelRange{span.x0, span.x0 + span.length - 1}.within(columns);
    span.x0 = inside_tile(left.first);
    span.length = inside_tile(left.size());
    return !left.empty();
}

/// One finished pixel.
struct PixelValue {
    double rgb[3] = {0, 0, 0};
    double transmittance = 1;
    std::uint32_t updates = 0;
    bool ended = false;
};

/// The columns of a RowMask, and so of the widest tile whose rows rasterise_rows() can take.
constexpr int kMostMaskColumns = 128;
/// The most rows that rasterise_rows() takes at a time.
constexpr int kMostRowsAtOnce = 64;

/// Up to kMostRowsAtOnce rows of one splat inside one tile of at most kMostMaskColumns columns.
struct TileRows {
    std::uint32_t splat = 0;
    int context = 0;                    ///< tile context of the pixels
    int x_begin = 0, x_end = 0;         ///< columns of the tile, raster px
    int tile_y = 0;                     ///< raster row of the tile's row 0
    int first = 0, last = -1, step = 1; ///< rows inside the tile: first, first + step, ... last
    PixelRange image_columns{0,
                             kMostMaskColumns - 1}; ///< columns inside the tile that the image has
    bool tests = false; ///< rows are as wide as the splat's box, and every pixel tests itself
};

/// What becomes of the pixels of a row of a splat. Bit i of a mask is column i of the tile. The
/// struct has no padding, so that a copy of what was just written need not wait for the write.
struct RowOutcome {
    RowMask inside;          ///< tasks inside the ellipse; all others of the span are outside
    RowMask useful;          ///< of these, blended; the others have ended or refuse the splat
    RowMask ended;           ///< pixels that end with this splat
    std::int32_t x0 = 0;     ///< first pixel of the span, inside the tile
    std::int32_t length = 0; ///< pixels; 0: the row covers no pixel of the tile
};

/// The arithmetic that the modules call: row spans, closed-form q_n, alpha, transmittance and
/// colour, and the pixel state of all tile contexts. It has no time.
class DataPath {
public:
    virtual ~DataPath() = default;

    /// Derives the records of all splats of a frame; returns the global index of its first splat.
    virtual std::uint32_t add_frame(const FrameWorkload& workload) = 0;
    /// Gives up a frame of so many splats, whose first one has this index. The indices may be those
    /// of frames that are added later.
    virtual void remove_frame(std::uint32_t first, std::size_t splats) = 0;
    /// A hint that the rows of the splat will be needed soon. It changes nothing but host time.
    virtual void expect(std::uint32_t splat) const = 0;
    /// The raster's rows (unclipped) that the splat's ellipse meets.
    virtual PixelRange rows(std::uint32_t splat) const = 0;
    /// The raster's rows that the ellipse meets in columns [x_begin, x_end). May name a row too
    /// many at either end (rounding), never one too few; empty if the ellipse passes by.
    virtual PixelRange rows_in_columns(std::uint32_t splat, int x_begin, int x_end) const = 0;
    /// The raster's columns (unclipped) that the splat's ellipse meets.
    virtual PixelRange columns(std::uint32_t splat) const = 0;
    /// The columns of the bounding box of the ellipse as it was projected, to the pixel.
    virtual PixelRange box_columns(std::uint32_t splat) const = 0;
    /// Solves raster row `y` for the columns [x_begin, x_end) of a tile whose top row is `tile_y`
    /// (paper Eq. 12-15, 19). Nothing if no pixel of the tile is covered.
    virtual std::optional<RowSpan> solve_row(std::uint32_t splat, int y, int x_begin, int x_end,
                                             int tile_y) const = 0;

    /// Makes a row of a context ready for a tile: T = 1, colour 0, nothing ended. All are at first.
    virtual void begin_row(int context, int row) = 0;
    /// Updates the pixels of one task, left to right.
    virtual BlendOutcome blend(const BlendTask& task) = 0;
    /// Tests each pixel by itself, q' = A u^2 + C' dy^2 - 2 ln o with u = dx - m dy (paper Eq.
    /// 10), and blends the live ones with q <= Q_th; the others keep their state. For number
    /// sets see QuantizedRow::check. With DataPathOptions::gemm, q' is that product instead.
    virtual BlendOutcome test(const PixelTest& test) = 0;
    /// Tests pixels as test() does on `rows` rows inside the tile, from the row of `test`
    /// downwards, each with the mask of `test` and an outcome of its own.
    virtual void test_rows(const PixelTest& test, int rows, BlendOutcome* outcomes) = 0;
    /// The rows among `rows` on which test() may find a pixel of `columns` inside. May name rows
    /// too many, never one too few. Like tested_columns() for the completed square alone.
    virtual PixelRange tested_rows(std::uint32_t splat, const PixelRange& columns,
                                   const PixelRange& rows) const = 0;
    /// The columns among [x_begin, x_end) whose pixels on raster row `y` pass test()'s q <= Q_th,
    /// to the last rounding. They are neighbours; there may be none.
    virtual PixelRange tested_columns(std::uint32_t splat, int y, int x_begin, int x_end) const = 0;
    /// True if rounding may let test() find pixels inside that lie visibly outside the ellipse of
    /// the splat as it was projected: number sets.
    virtual bool rounds_coarsely() const = 0;
    /// Rasterises rows: solves and blends each as solve_row() and blend() do, or as row_of_box()
    /// and test(). `outcomes` has a place for each of the rows, in their order. Splats of a row
    /// come in the order of their depth.
    virtual void rasterise_rows(const TileRows& rows, RowOutcome* outcomes) = 0;
    /// Makes room for tile contexts up to this number, at most kMostContexts.
    virtual void hold_contexts(int contexts) = 0;
    /// The first `count` pixels of a row.
    virtual void read_row(int context, int row, int count, PixelValue* pixels) const = 0;
    /// One pixel of a row.
    virtual PixelValue read_pixel(int context, int row, int column) const = 0;
    /// Gives a pixel the transmittance, the colour and the end of a value that was read from this
    /// data path. Its count of updates stays.
    virtual void write_pixel(int context, int row, int column, const PixelValue& value) = 0;
};

/// A data path for tiles of `tile_size` px and `contexts` tiles in flight, at most kMostContexts.
std::unique_ptr<DataPath> make_data_path(const DataPathOptions& options, int tile_size,
                                         int contexts);

} // namespace degs
