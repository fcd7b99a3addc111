// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "splat/pixels/data_path.hpp"
#include "splat/pixels/span_record.hpp"

namespace degs {

/// q' = q - 2 ln o at which alpha = 1/255: 2 ln 255.
constexpr double kQLimit = 11.082527090316852;

/// The parameters that a PE fetches by G_ID (paper: Global Gaussian Parameter).
template <class T>
struct BlendRecord {
    T a; // quadratic coefficient A
    T r, g, b;
    T limit = static_cast<T>(kQLimit); // largest q' inside, nearer for a splat that is cut
};

/// Pixels behind the last one that a block of lanes may touch.
constexpr std::size_t kLanePadding = 16;

/// Pixel state as planes, so that neighbouring pixels are neighbouring lanes.
template <class T>
struct PixelPlanes {
    std::vector<T> transmittance, r, g, b;
    std::vector<T> live; // 1 while the pixel takes splats, 0 once it has ended
    std::vector<std::uint32_t> updates;

    explicit PixelPlanes(std::size_t size = 0) { hold(size); }

    /// Room for `size` pixels at least; new ones are clear.
    void hold(std::size_t size) {
        if (size <= updates.size()) {
            return;
        }
        transmittance.resize(size, T(1));
        live.resize(size, T(1));
        for (std::vector<T>* plane : {&r, &g, &b}) {
            plane->resize(size, T(0));
        }
        updates.resize(size, 0U);
    }
    /// Makes room if need be, for lanes behind the last pixel, too.
    void clear(std::size_t first, std::size_t count) {
        hold(first + count + kLanePadding);
        std::fill_n(transmittance.begin() + first, count, T(1));
        std::fill_n(live.begin() + first, count, T(1));
        for (std::vector<T>* plane : {&r, &g, &b}) {
            std::fill_n(&(*plane)[first], count, T(0));
        }
        std::fill_n(&updates[first], count, 0U);
    }
    PixelValue read(std::size_t i) const {
        PixelValue value;
        value.rgb[0] = r[i];
        value.rgb[1] = g[i];
        value.rgb[2] = b[i];
        value.transmittance = transmittance[i];
        value.updates = updates[i];
        value.ended = live[i] == T(0);
        return value;
    }
    /// All of a value that was read here but its count of updates.
    void write(std::size_t i, const PixelValue& value) {
        r[i] = static_cast<T>(value.rgb[0]);
        g[i] = static_cast<T>(value.rgb[1]);
        b[i] = static_cast<T>(value.rgb[2]);
        transmittance[i] = static_cast<T>(value.transmittance);
        live[i] = value.ended ? T(0) : T(1);
    }
};

/// The PE for up to 32 neighbouring pixels: q_n (paper Eq. 19), alpha (Eq. 21), recurrence
/// (Eq. 8). `first` is the pixel of mask bit 0. `refuse`: StopRule::Refuse. Neighbouring lanes
/// are computed together; lanes without a task change nothing. The planes must have
/// kLanePadding pixels more than are used. It uses the widest vectors of the machine; results
/// are the same at any width.
template <class T>
using BlendFunction = BlendOutcome (*)(const BlendTask& task, const BlendRecord<T>& splat,
                                       bool refuse, PixelPlanes<T>& pixels, std::size_t first);
BlendFunction<float> blend_function(float);
BlendFunction<double> blend_function(double);

/// One splat on up to 32 neighbouring pixels of a row, each tested by itself:
/// q'_i = A (n0 + i - centre)^2 + rest.
template <class T>
struct TestRow {
    T centre;           ///< of the ellipse on this row, px from the splat's nearest column
    T rest;             ///< C' dy^2 - 2 ln o
    std::int32_t n0;    ///< column of mask bit 0 minus the splat's nearest column
    std::uint32_t mask; ///< pixels to test
    std::size_t first;  ///< pixel of mask bit 0
};

/// PEs that check while they blend: alpha test, then alpha, transmittance and colour of the pixels
/// inside, for `count` rows of a splat, each with its outcome. Planes, `refuse` and widths as for
/// BlendFunction.
template <class T>
using TestFunction = void (*)(const TestRow<T>* rows, int count, const BlendRecord<T>& splat,
                              bool refuse, PixelPlanes<T>& pixels, BlendOutcome* outcomes);
TestFunction<float> test_function(float);
TestFunction<double> test_function(double);

/// Neighbouring pixels of a row whose exponents are products of matrices (exponent_gemm.hpp).
struct ProductRow {
    std::int32_t x, y;  ///< pixel of mask bit 0, from the origin of the product
    std::uint32_t mask; ///< pixels to test
    std::size_t first;  ///< pixel of mask bit 0
};
/// PEs that check while they blend, as for TestFunction, with the exponents of gemm_product().
template <class T>
using ProductFunction = void (*)(const ProductRow* rows, int count, const GemmRow<T>& coefficients,
                                 const BlendRecord<T>& splat, bool refuse, PixelPlanes<T>& pixels,
                                 BlendOutcome* outcomes);
ProductFunction<float> product_function(float);
ProductFunction<double> product_function(double);

/// How rows end in single precision.
struct EndsOfRows {
    bool exact = true; ///< ceil and floor; else floor and ceil, and `delta`
    float delta = 0;   ///< px more at either end
};
/// DataPath::rasterise_rows() of solved rows in single precision: neighbouring rows are solved
/// together, then the neighbouring pixels of each row are blended together. `firsts` has the first
/// pixel of every row, by row of the tile. Planes, `refuse` and widths as for BlendFunction.
using RasteriseFunction = void (*)(const TileRows& rows, const SpanRecord<float>& span,
                                   const BlendRecord<float>& splat, const EndsOfRows& ends,
                                   bool refuse, PixelPlanes<float>& pixels,
                                   const std::size_t* firsts, RowOutcome* outcomes);
RasteriseFunction rasterise_function();

/// For tests: all variants of this build that the machine can run, narrow ones first.
std::vector<BlendFunction<float>> blend_variants();
std::vector<TestFunction<float>> test_variants();
std::vector<ProductFunction<float>> product_variants();
std::vector<RasteriseFunction> rasterise_variants();
/// The exponential of the float lanes, x in [-80, 1]; relative error < 3e-7.
float lane_exp(float x);

} // namespace degs
