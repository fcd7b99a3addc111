// SPDX-License-Identifier: Apache-2.0
// A scene costs the bands of spherical harmonics that it has, and no others.
#include <cmath>
#include <limits>

#include "splat/model/sh_evaluation.hpp"
#include "tests/sim/needed_work/counted_run.hpp"

namespace degs::sim_test {
namespace {

/// What an evaluation did.
struct Operations {
    int products = 0, sums = 0, values = 0;
} done;

struct CountedScalar {
    double value;
    friend CountedScalar operator+(CountedScalar a, CountedScalar b) {
        ++done.sums;
        return {a.value + b.value};
    }
    friend CountedScalar operator-(CountedScalar a, CountedScalar b) {
        ++done.sums;
        return {a.value - b.value};
    }
    friend CountedScalar operator*(CountedScalar a, CountedScalar b) {
        ++done.products;
        return {a.value * b.value};
    }
};

struct CountedNumbers {
    using Scalar = CountedScalar;
    CountedScalar operator()(double x) const {
        ++done.values;
        return {x};
    }
};

/// Coefficients of one Gaussian, followed by NaN where a higher band would lie.
std::vector<float> coefficients_up_to(int degree) {
    const std::size_t count = std::size_t{3} * (degree + 1) * (degree + 1);
    std::vector<float> values(3 * kMaxShCoefficients, std::numeric_limits<float>::quiet_NaN());
    std::fill_n(values.begin(), count, 0.5F);
    return values;
}

Operations operations_of(int degree) {
    done = {};
    const std::vector<float> sh = coefficients_up_to(degree);
    const auto rgb = evaluate_sh(CountedNumbers(), degree, sh.data(),
                                 Vector3<CountedScalar>{{0.6}, {0.0}, {0.8}});
    const Operations counted = done;
    const glm::dvec3 expected = evaluate_sh(degree, sh.data(), {0.6, 0.0, 0.8});
    EXPECT_EQ(rgb.x.value, expected.x) << degree;
    EXPECT_TRUE(std::isfinite(rgb.z.value))
        << degree << ": a coefficient of a higher band was read";
    return counted;
}

// A product and a sum for each coefficient; a basis of more than a constant comes on top.
TEST(NeededShWork, DegreeZeroIsOneProductPerChannel) {
    const Operations zero = operations_of(0);
    EXPECT_EQ(zero.products, 3);
    EXPECT_EQ(zero.sums, 3);
}

TEST(NeededShWork, EveryBandAddsItsOwnOperationsOnly) {
    // Operations of the basis functions alone: -k y, k z, -k x; then three squares and the five
    // functions of band 2.
    const int basis_products[] = {0, 3, 3 + 3 + 9};
    const int basis_sums[] = {0, 0, 3};
    for (int degree = 0; degree <= 2; ++degree) {
        const int coefficients = 3 * (degree + 1) * (degree + 1);
        const Operations counted = operations_of(degree);
        EXPECT_EQ(counted.products, coefficients + basis_products[degree]) << degree;
        EXPECT_EQ(counted.sums, coefficients + basis_sums[degree]) << degree;
    }
    EXPECT_GT(operations_of(3).products, operations_of(2).products + 3 * 7);
}

/// Balls that all are visible, in chunks that fill whole bursts.
GaussianCloud visible_cloud(int degree) {
    GaussianCloud cloud;
    cloud.sh_degree = degree;
    for (int i = 0; i < 640; ++i) {
        add_ball(cloud, {0.02 * (i % 32 - 16), 0.02 * (i / 32 - 10), 1 + 0.001 * i}, 0.01F);
    }
    return cloud;
}

TEST(NeededShWork, MemoryMovesTheCoefficientsThatTheSceneHas) {
    const sim::RunConfig config = shipped("degs-16");
    const Camera camera = plain_camera(128, 96);
    Counts counts[2];
    for (const int degree : {0, 3}) {
        const FrameWorkload frame = frame_for(config, visible_cloud(degree), camera);
        ASSERT_EQ(frame.splats.size(), 640U);
        Counts& own = counts[degree == 0 ? 0 : 1];
        own = counted_run(config, frame);
        EXPECT_EQ(own["streams"]["sh"]["bytes"], 640 * 2 * 3 * (degree + 1) * (degree + 1));
    }
    EXPECT_EQ(counts[0]["stages"]["projection"], counts[1]["stages"]["projection"]);
    for (const char* stream : {"geometry", "splats_written", "splats_read", "frame_buffer"}) {
        EXPECT_EQ(counts[0]["streams"][stream], counts[1]["streams"][stream]) << stream;
    }
}

} // namespace
} // namespace degs::sim_test
