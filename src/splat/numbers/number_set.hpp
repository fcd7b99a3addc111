// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "splat/numbers/lookup_table.hpp"
#include "splat/numbers/projection_numbers.hpp"

namespace degs {

/// How the descriptor of a projected splat is made. `Reference`: in double precision, then every
/// field rounded once. `Literal`: A, B, C rounded first, then Eq. 10 and 11 of the paper, every
/// operation rounded to the format of its result.
enum class Derivation { Reference, Literal };
/// dy^2 inv_ry^2 and C' dy^2: `Squared` forms dy^2 first (and leaves FP16 at |dy| = 256),
/// `Stepwise` multiplies by dy twice. `FromRatio` takes C' dy^2 from x = dy^2 inv_ry^2, so that
/// neither C' nor the opacity's fold is needed: q' = Q_limit - Q_th (1 - x) + A u^2.
enum class Vertical { Squared, Stepwise, FromRatio };
/// A mean is a coordinate, or its nearest pixel (an integer) and an offset in -0.5 .. 0.5.
enum class Mean { Coordinate, PixelAndOffset };
/// Which pixels a row span covers. `Exact`: ceil(x_c - w) .. floor(x_c + w), the pixels with
/// q <= Q_th. `Outward`: floor(x_c - w) - delta .. ceil(x_c + w) + delta (paper, Sec.
/// III-A). `Slope`: outward, and delta grows by |dw/dy| times half a unit of the mean, to
/// the nearest px and at most 1 (the paper "estimates the error based on dw/dy"); fp32 and
/// fp64 have no such unit: 0.
enum class SpanEnds { Exact, Outward, Slope };
/// The pixel of n = 0. `Start`: the span's first (paper). `Vertex`: the pixel of the span nearest
/// to x_c; all terms of q_n have one sign there, so nothing cancels.
enum class Base { Start, Vertex };
/// Products with the integers n and n(n-1). `Whole`: one multiplier. `HalfLookup`: the
/// integer is cut into its low `lookup_bits` bits and the rest, each product is looked up and
/// rounded, then they are added.
enum class IntegerMultiplier { Whole, HalfLookup };
/// q counts nats of exp(-q/2), as in the paper, or binary orders of alpha = 2^-q: A, C' and Q_th
/// are stored times log2(e) / 2, which costs nothing and saves a multiplier in front of the table.
enum class Exponent { Natural, Binary };

/// One number format for each stage of the data path, both tables, and the orders of operations.
/// Every operation is rounded to the format of its result.
struct NumberSet {
    std::string name;
    std::string meaning; ///< a sentence for people

    // What projection and sorting read from memory (ProjectionNumbers).
    NumberFormat gaussian_mean, gaussian_scale, gaussian_rotation, gaussian_opacity;
    NumberFormat sh_dc, sh_rest;
    NumberFormat depth_key = ProjectionNumbers().depth_key;

    NumberFormat projection; ///< every value and operation that makes splats (ProjectionOptions)

    // Splat record in memory.
    NumberFormat mean;            ///< mu_x, mu_y, px
    NumberFormat slope;           ///< m
    NumberFormat c_prime;         ///< C'; not stored with Vertical::FromRatio
    NumberFormat radius;          ///< r_x, px
    NumberFormat inverse_radius2; ///< 1 / r_y^2, px^-2
    NumberFormat conic;           ///< A (and B, C while Literal derives)
    NumberFormat q_threshold;     ///< Q_th
    NumberFormat colour;          ///< red, green, blue

    // Span Unit.
    NumberFormat distance; ///< dy, u = x - x_c, px
    NumberFormat square;   ///< dy^2, dy inv_ry^2, A u, 2u + 1 and other intermediate products
    NumberFormat ratio;    ///< x = dy^2 inv_ry^2 and 1 - x
    NumberFormat edge;     ///< m dy, x_c, w, x_c -+ w; px
    NumberFormat level;    ///< terms of g0
    NumberFormat g0, d0;   ///< Span Vector

    // Blending PE and Pixel Buffer.
    NumberFormat term; ///< n d0, A n(n-1), and their sum with Base::Vertex
    NumberFormat q;    ///< q_n
    NumberFormat alpha;
    NumberFormat transmittance; ///< T and 1 - alpha; fixed formats store 1 - T, so that 1 is exact
    NumberFormat weight;        ///< alpha T, and its products with the colour
    NumberFormat sum;           ///< accumulated colour

    TableSpec sqrt;
    TableSpec exp = table_of(TableFunction::ExpHalf);

    Derivation derivation = Derivation::Reference;
    Vertical vertical = Vertical::Stepwise;
    Mean mean_form = Mean::Coordinate;
    SpanEnds ends = SpanEnds::Exact; ///< unless a run says otherwise, see DataPathOptions
    int delta = 0;                   ///< px added at both ends that are not exact
    double guard = 0; ///< px by which exact ends are moved outwards before ceil and floor
    Base base = Base::Start;
    IntegerMultiplier multiplier = IntegerMultiplier::Whole;
    int lookup_bits = 4; ///< of the lower half of an integer, with HalfLookup
    Exponent exponent = Exponent::Natural;
    bool q_mask = false; ///< PEs drop pixels with q above that of alpha = 1/255

    /// q' at which alpha is 1/255: 2 ln 255 or log2 255.
    double q_limit() const;
    /// The formats that make and order splats.
    ProjectionNumbers projection_numbers() const {
        return {projection,       gaussian_mean, gaussian_scale, gaussian_rotation,
                gaussian_opacity, sh_dc,         sh_rest,        depth_key};
    }
    /// Does a key of describe() choose one of them, and nothing in the data path?
    static bool makes_splats(const std::string& key);
    /// Every part that a configuration may change: stages, orders of operations, tables; `ends` and
    /// `delta` are for a run to choose. Also makes the function of `exp` that of `exponent`.
    void describe(ConfigVisitor& visitor);
};

/// Everything that is known about a stage, in one place.
struct NumberStage {
    const char* key; ///< in configurations
    NumberFormat NumberSet::*format;
    bool is_signed;   ///< values may be negative
    const char* unit; ///< that makes its values; empty if it is stored only
    const char* meaning;
    std::vector<const char*> fields = {}; ///< of the splat record in this format
    const char* direct_field = nullptr;   ///< one more, unless C' dy^2 is taken from x
};
/// In the order of the data path. describe(), uniform sets, records and the checks of ranges
/// go through this list.
const std::vector<NumberStage>& number_stages();

/// A field of the splat record in memory.
struct RecordField {
    std::string name;
    int bits = 0;
};
/// The record of 32 B, field by field; what is left is padding.
std::vector<RecordField> splat_record(const NumberSet& set);
/// Bits of the record without padding.
int record_bits(const NumberSet& set);
/// Bits of a pixel's state: transmittance and three colours.
int pixel_bits(const NumberSet& set);

/// Named formats of a Gaussian's values in memory: "fp32", "fp16", "tuned"; and those of one of
/// them, as "key=value" of NumberSet::describe.
const std::vector<const char*>& record_set_names();
const std::vector<std::string>& record_formats(std::size_t set);
/// `assignments` with the formats of a record set in the place of `records=NAME`. Throws InputError
/// for an unknown name, which begins with `option`.
std::vector<std::string> with_record_formats(const std::vector<std::string>& assignments,
                                             const std::string& option = "--numbers");

/// "ideal", "fp32", "fp16", "paper", "tuned".
std::vector<std::string> number_set_names();
/// Throws InputError, which lists the names, for any other.
NumberSet number_set(const std::string& name);
/// A named set with parts changed by "key=value" of NumberSet::describe, and records=NAME. Throws
/// InputError that begins with `option`, where the assignments were given, and names the key.
NumberSet number_set(const std::string& name, const std::vector<std::string>& assignments,
                     const std::string& option = "--numbers");

} // namespace degs
