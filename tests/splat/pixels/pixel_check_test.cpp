// SPDX-License-Identifier: Apache-2.0
// DataPath::test: every pixel of a row checks for itself, against q in long double and against the
// spans of the decoupled path.
#include <cmath>
#include <cstring>

#include "splat/pixels/blend_lanes.hpp"
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::exact_q;
using test::make_splat;
using test::path_of;
using test::path_options;
using test::random_splat;

constexpr int kTileSize = 32;

DataPathOptions stop_options(Arithmetic numbers, StopRule stop) {
    DataPathOptions options = path_options(numbers);
    options.stop = stop;
    return options;
}

PixelTest test_of(std::uint32_t splat, int y, std::uint32_t mask, int context = 0) {
    PixelTest test;
    test.splat = splat;
    test.mask = mask;
    test.y = y;
    test.row = static_cast<std::int16_t>(y);
    test.context = static_cast<std::int16_t>(context);
    return test;
}

/// Bound on the error of q' in a format of unit roundoff `eps`: first-order propagation through
/// dy, m dy, the centre, u and the two squares, each operation and each stored coefficient rounded
/// once; times 1.5 for what is left out.
double q_error(const ProjectedSplat& s, double x, double y, double eps) {
    const double dy = std::abs(y - s.mu_y);
    const double m = std::abs(s.cov_b / s.cov_c);
    const double a = s.cov_c / s.det;
    const double u = std::abs(x - s.mu_x - s.cov_b / s.cov_c * (y - s.mu_y));
    const double vertical = dy * dy / s.cov_c;
    const double e_dy = eps * (0.5 + dy);
    const double e_u = m * e_dy + 2 * eps * m * dy + eps * (1 + m * dy) + eps * u;
    const double e_squares = 2 * a * u * e_u + a * e_u * e_u + 3 * eps * a * u * u +
                             2 * dy / s.cov_c * e_dy + 3 * eps * vertical;
    const double fold = std::abs(2 * std::log(s.opacity));
    return 1.5 * (e_squares + eps * (2 * fold + 2 * vertical + a * u * u));
}

/// What the words of the paper (Eq. 5-8) make of one pixel, in double.
struct ExpectedPixel {
    double transmittance, red;
    bool useful = false, boundary = false, terminated = false, ended = false;
    double q, next;

    ExpectedPixel(const ProjectedSplat& s, const PixelValue& before, double x, double y,
                  bool refuse)
        : transmittance(before.transmittance), red(before.rgb[0]),
          q(static_cast<double>(exact_q(s, x, y))) {
        const double alpha = std::min(0.99, s.opacity * std::exp(-0.5 * q));
        next = transmittance * (1 - alpha);
        boundary = q > s.q_threshold;
        ended = !boundary && !before.ended && next < 1e-4;
        useful = !boundary && !before.ended && !(ended && refuse);
        terminated = !boundary && !useful;
        if (useful) {
            red += alpha * transmittance;
            transmittance = next;
        }
    }
    /// Decisions that a q of error `slack` may take either way.
    bool close_call(const ProjectedSplat& s, double slack) const {
        return std::abs(q - s.q_threshold) <= slack || std::abs(next - 1e-4) <= 1e-4 * slack;
    }
};

bool bit(std::uint32_t mask, int i) {
    return (mask >> i & 1U) != 0;
}

void expect_blended_by_hand(Arithmetic numbers, StopRule stop) {
    const double eps = numbers == Arithmetic::Fp32 ? 0x1p-24 : 0x1p-53;
    const double exp_error = numbers == Arithmetic::Fp32 ? 3e-7 : 1e-15;
    std::mt19937 random(21);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 2000; ++i) {
        splats.push_back(random_splat(random, 0, 0, kTileSize));
    }
    const auto path = path_of(splats, stop_options(numbers, stop), kTileSize);
    std::vector<PixelValue> before(kTileSize), after(kTileSize);
    int compared = 0, useful = 0;
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        if (i % 40 == 0) {
            test::begin_tile(*path, 0, kTileSize);
        }
        for (int y = 0; y < kTileSize; ++y) {
            const std::uint32_t mask =
                random() % 2 == 0 ? ~0U : static_cast<std::uint32_t>(random());
            path->read_row(0, y, kTileSize, before.data());
            const BlendOutcome outcome = path->test(test_of(i, y, mask));
            path->read_row(0, y, kTileSize, after.data());
            ASSERT_EQ(outcome.useful & outcome.boundary, 0U);
            ASSERT_EQ((outcome.useful | outcome.boundary) & outcome.terminated, 0U);
            ASSERT_EQ(outcome.useful | outcome.boundary | outcome.terminated, mask);
            ASSERT_EQ(outcome.ended & ~(outcome.useful | outcome.terminated), 0U);
            for (int x = 0; x < kTileSize; ++x) {
                const PixelValue& old = before[static_cast<std::size_t>(x)];
                const PixelValue& now = after[static_cast<std::size_t>(x)];
                ASSERT_EQ(now.updates, old.updates + (bit(outcome.useful, x) ? 1U : 0U));
                if (!bit(outcome.useful, x)) {
                    ASSERT_EQ(now.transmittance, old.transmittance);
                    ASSERT_EQ(now.rgb[0], old.rgb[0]);
                }
                ASSERT_EQ(now.ended, old.ended || bit(outcome.ended, x));
                const ProjectedSplat& s = splats[i];
                const ExpectedPixel expected(s, old, x, y, stop == StopRule::Refuse);
                const double slack = q_error(s, x, y, eps);
                // alpha is right to slack / 2 and the exponential's own error; 1 - alpha >= 0.01.
                const double tolerance = slack + 4 * exp_error;
                if (!bit(mask, x) || expected.close_call(s, 100 * tolerance)) {
                    continue;
                }
                ++compared;
                ASSERT_EQ(bit(outcome.boundary, x), expected.boundary);
                ASSERT_EQ(bit(outcome.useful, x), expected.useful);
                ASSERT_EQ(bit(outcome.terminated, x), expected.terminated);
                ASSERT_EQ(bit(outcome.ended, x), expected.ended);
                ASSERT_NEAR(now.transmittance, expected.transmittance, tolerance);
                ASSERT_NEAR(now.rgb[0], expected.red, tolerance);
                useful += expected.useful ? 1 : 0;
            }
        }
    }
    EXPECT_GT(compared, 1'000'000);
    EXPECT_GT(useful, 50'000);
}

TEST(PixelCheck, Fp32AgainstBruteForce) {
    expect_blended_by_hand(Arithmetic::Fp32, StopRule::Refuse);
    expect_blended_by_hand(Arithmetic::Fp32, StopRule::After);
}

TEST(PixelCheck, Fp64AgainstBruteForce) {
    expect_blended_by_hand(Arithmetic::Fp64, StopRule::Refuse);
    expect_blended_by_hand(Arithmetic::Fp64, StopRule::After);
}

/// Blends the row of the splat by its span.
BlendOutcome blend_span(DataPath& path, std::uint32_t splat, int y, int context) {
    const auto span = path.solve_row(splat, y, 0, kTileSize, 0);
    if (!span) {
        return {};
    }
    BlendTask task;
    task.splat = splat;
    task.g0 = span->g0;
    task.d0 = span->d0;
    task.row = static_cast<std::int16_t>(y);
    task.context = static_cast<std::int16_t>(context);
    task.offset = static_cast<std::int16_t>(-span->x0);
    const std::uint32_t run = span->length == 32 ? ~0U : (1U << span->length) - 1U;
    task.mask = run << span->x0;
    return path.blend(task);
}

// The coupled and the decoupled path agree on what is inside, what is blended and what ends.
TEST(PixelCheck, SameMasksAndPixelsAsExactSpans) {
    std::mt19937 random(22);
    std::vector<ProjectedSplat> splats;
    while (splats.size() < 1000) {
        const ProjectedSplat s = random_splat(random, 0, 0, kTileSize);
        bool close = false; // the two forms of q may round to either side of the limit
        for (int p = 0; p < kTileSize * kTileSize; ++p) {
            const auto q = static_cast<double>(exact_q(s, p % kTileSize, p / kTileSize));
            close = close || std::abs(q - s.q_threshold) < 1e-6;
        }
        if (!close) {
            splats.push_back(s);
        }
    }
    const auto path = path_of(splats, path_options(Arithmetic::Fp64), kTileSize, 2);
    std::vector<PixelValue> spans(kTileSize), tests(kTileSize);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        for (int y = 0; y < kTileSize; ++y) {
            const BlendOutcome by_span = blend_span(*path, i, y, 0);
            const BlendOutcome by_test = path->test(test_of(i, y, ~0U, 1));
            ASSERT_EQ(by_test.useful, by_span.useful);
            ASSERT_EQ(by_test.terminated, by_span.terminated);
            ASSERT_EQ(by_test.ended, by_span.ended);
            ASSERT_EQ(by_test.boundary, ~(by_span.useful | by_span.terminated));
            path->read_row(0, y, kTileSize, spans.data());
            path->read_row(1, y, kTileSize, tests.data());
            for (std::size_t x = 0; x < kTileSize; ++x) {
                ASSERT_EQ(tests[x].updates, spans[x].updates);
                ASSERT_NEAR(tests[x].transmittance, spans[x].transmittance, 1e-9);
                ASSERT_NEAR(tests[x].rgb[0], spans[x].rgb[0], 1e-9);
            }
        }
    }
}

// alpha 0.98 each: T = 0.02, 4e-4, then 8e-6 is refused, or blended and ends the pixel.
TEST(PixelCheck, RefuseOrAfter) {
    const std::vector<ProjectedSplat> splats{make_splat(4, 4, 500, 500, 0, 0.98),
                                             make_splat(4, 4, 500, 500, 0, 0.1)};
    for (const StopRule stop : {StopRule::Refuse, StopRule::After}) {
        const bool refuse = stop == StopRule::Refuse;
        const auto path = path_of(splats, stop_options(Arithmetic::Fp64, stop), kTileSize);
        EXPECT_EQ(path->test(test_of(0, 4, 0x10)).useful, 0x10U);
        EXPECT_EQ(path->test(test_of(0, 4, 0x10)).useful, 0x10U);
        const BlendOutcome last = path->test(test_of(0, 4, 0x10));
        EXPECT_EQ(last.useful, refuse ? 0U : 0x10U);
        EXPECT_EQ(last.terminated, refuse ? 0x10U : 0U);
        EXPECT_EQ(last.ended, 0x10U);
        // A weak splat that would fit does not revive the pixel.
        const BlendOutcome weak = path->test(test_of(1, 4, 0x10));
        EXPECT_EQ(weak.terminated, 0x10U);
        EXPECT_EQ(weak.ended, 0U);
        std::vector<PixelValue> row(kTileSize);
        path->read_row(0, 4, kTileSize, row.data());
        EXPECT_EQ(row[4].updates, refuse ? 2U : 3U);
        EXPECT_NEAR(row[4].transmittance, refuse ? 4e-4 : 8e-6, 1e-12);
    }
}

// Outside the ellipse is boundary, on an ended pixel too.
TEST(PixelCheck, OutsideIsBoundaryAlsoOnEndedPixels) {
    const auto path = path_of({make_splat(4, 4, 500, 500, 0, 1.0), make_splat(20, 4, 1, 1, 0, 1.0)},
                              path_options(Arithmetic::Fp32), kTileSize);
    for (int i = 0; i < 3; ++i) {
        path->test(test_of(0, 4, ~0U));
    }
    const BlendOutcome outcome = path->test(test_of(1, 4, ~0U));
    EXPECT_EQ(outcome.terminated, 0x7FU << 17); // |x - 20| <= sqrt(11.08) = 3.3
    EXPECT_EQ(outcome.boundary, ~(0x7FU << 17));
    EXPECT_EQ(path->test(test_of(1, 30, 0xFF)).boundary, 0xFFU);
}

// The column counts in the tile, x in the image; context and row select the pixels.
TEST(PixelCheck, PixelOfTheImageAndPixelOfTheTile) {
    const auto path =
        path_of({make_splat(1003, 707, 0.6, 0.6, 0, 1.0)}, path_options(Arithmetic::Fp32), 16, 2);
    PixelTest test;
    test.mask = 0xFF;
    test.x = 1000;
    test.y = 707;
    test.row = 3;
    test.column = 8;
    test.context = 1;
    EXPECT_EQ(path->test(test).useful, 0x1CU); // |x - 1003| <= 3.33 * 0.6 = 2.0 (1.997)
    std::vector<PixelValue> row(16);
    path->read_row(1, 3, 16, row.data());
    for (std::size_t x = 0; x < 16; ++x) {
        EXPECT_EQ(row[x].updates, x >= 10 && x <= 12 ? 1U : 0U) << x;
    }
}

void expect_same_row(const DataPath& path, int row, int context, int other) {
    std::vector<PixelValue> first(kTileSize), second(kTileSize);
    path.read_row(context, row, kTileSize, first.data());
    path.read_row(other, row, kTileSize, second.data());
    for (int x = 0; x < kTileSize; ++x) {
        ASSERT_EQ(first[x].updates, second[x].updates);
        ASSERT_EQ(first[x].transmittance, second[x].transmittance);
        ASSERT_EQ(first[x].rgb[0], second[x].rgb[0]);
        ASSERT_EQ(first[x].ended, second[x].ended);
    }
}

// In every kind of numbers; a tile's first and last rows among them, and rows above the ellipse.
TEST(PixelCheck, RowsAtOnceLikeOneByOne) {
    std::mt19937 random(24);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 300; ++i) {
        splats.push_back(random_splat(random, 0, 0, kTileSize));
    }
    for (const Arithmetic numbers : {Arithmetic::Fp32, Arithmetic::Fp64, Arithmetic::Paper}) {
        const auto path = path_of(splats, path_options(numbers), kTileSize, 2);
        int useful = 0;
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            const int y = static_cast<int>(random() % kTileSize);
            const int rows = 1 + static_cast<int>(random() % (kTileSize - y));
            const std::uint32_t mask = random() % 2 == 0 ? ~0U : std::uint32_t{0xFF} << y % 24;
            std::vector<BlendOutcome> outcomes(rows);
            path->test_rows(test_of(i, y, mask), rows, outcomes.data());
            for (int row = 0; row < rows; ++row) {
                const BlendOutcome alone = path->test(test_of(i, y + row, mask, 1));
                ASSERT_EQ(outcomes[row].useful, alone.useful);
                ASSERT_EQ(outcomes[row].boundary, alone.boundary);
                ASSERT_EQ(outcomes[row].terminated, alone.terminated);
                ASSERT_EQ(outcomes[row].ended, alone.ended);
                useful += __builtin_popcount(alone.useful);
                expect_same_row(*path, y + row, 0, 1);
            }
        }
        EXPECT_GT(useful, 5'000);
    }
}

// Wide or narrow, and far from a splat where float does not name every pixel: the same bits.
TEST(PixelCheck, VariantsGiveTheSameBits) {
    std::mt19937 random(23);
    std::uniform_real_distribution<float> unit(0, 1);
    constexpr std::size_t kPixels = 64;
    for (int trial = 0; trial < 20000; ++trial) {
        TestRow<float> row{};
        const bool far = trial % 4 == 0;
        row.n0 = static_cast<int>(random() % 64) - 48 + (far ? (1 << 25) + trial : 0);
        row.centre = far ? static_cast<float>(row.n0) : -32 + 64 * unit(random);
        row.rest = 10 * unit(random);
        row.mask =
            random() % 2 == 0 ? ~0U >> (random() % 32) : static_cast<std::uint32_t>(random());
        row.first = 8;
        const BlendRecord<float> splat{0.3F * unit(random) * unit(random), 0.3F, 0.6F, 0.9F};
        PixelPlanes<float> before(kPixels + kLanePadding);
        for (std::size_t i = 0; i < kPixels; ++i) {
            before.transmittance[i] = std::pow(10.0F, -4 * unit(random));
            before.live[i] = random() % 4 == 0 ? 0.0F : 1.0F;
        }
        PixelPlanes<float> first = before;
        const bool refuse = trial % 2 == 0;
        BlendOutcome expected, outcome;
        test_variants()[0](&row, 1, splat, refuse, first, &expected);
        for (const TestFunction<float> variant : test_variants()) {
            PixelPlanes<float> planes = before;
            variant(&row, 1, splat, refuse, planes, &outcome);
            ASSERT_EQ(outcome.useful, expected.useful);
            ASSERT_EQ(outcome.boundary, expected.boundary);
            ASSERT_EQ(outcome.terminated, expected.terminated);
            ASSERT_EQ(outcome.ended, expected.ended);
            const auto same = [](const std::vector<float>& a, const std::vector<float>& b) {
                return std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
            };
            ASSERT_TRUE(same(planes.transmittance, first.transmittance));
            ASSERT_TRUE(same(planes.live, first.live));
            ASSERT_TRUE(same(planes.r, first.r) && same(planes.g, first.g));
            ASSERT_TRUE(same(planes.b, first.b));
            ASSERT_EQ(planes.updates, first.updates);
        }
    }
}

} // namespace
} // namespace degs
