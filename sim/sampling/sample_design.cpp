// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/sample_design.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace degs::sim {
namespace {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): the standard library's distributions differ
/// between implementations.
class Draws {
public:
    explicit Draws(std::uint64_t seed) : state_(seed) {}
    /// 0 .. count - 1; the bias of the remainder is below 2^-40 for any image.
    std::size_t below(std::size_t count) { return next() % count; }
    template <class T>
    void shuffle(std::vector<T>& values) {
        for (std::size_t i = values.size(); i > 1; --i) {
            std::swap(values[i - 1], values[below(i)]);
        }
    }

private:
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    std::uint64_t state_;
};

/// A rough price of a block, good enough to sort by.
double price_of(const std::vector<TileWork>& work, const TileBlock& block) {
    double price = 0;
    for (std::size_t t = block.first; t < block.first + block.count; ++t) {
        price +=
            work[t].cycles > 0 ? work[t].cycles : work[t].tasks + work[t].rows + work[t].walked;
    }
    return price;
}

std::vector<std::size_t> sorted_by_price(const std::vector<TileWork>& work,
                                         const std::vector<TileBlock>& blocks) {
    std::vector<double> price;
    price.reserve(blocks.size());
    for (const TileBlock& block : blocks) {
        price.push_back(price_of(work, block));
    }
    std::vector<std::size_t> order(blocks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&price](std::size_t a, std::size_t b) { return price[a] < price[b]; });
    return order;
}

} // namespace

SampleDesign design_sample(const std::vector<TileWork>& work, const SampleSizes& sizes,
                           std::uint64_t seed) {
    SampleDesign design;
    design.edge = sizes.edge;
    if (work.size() <= 2 * sizes.edge) {
        return design;
    }
    const std::size_t end = work.size() - sizes.edge;
    for (std::size_t first = sizes.edge; first < end; first += sizes.block) {
        design.blocks.push_back({first, std::min(sizes.block, end - first)});
    }
    const std::size_t count = std::max<std::size_t>(1, (end - sizes.edge) / sizes.group);
    design.groups.resize(count);
    const std::vector<std::size_t> order = sorted_by_price(work, design.blocks);
    Draws draws(seed);
    std::vector<std::size_t> turn(count);
    std::iota(turn.begin(), turn.end(), std::size_t{0});
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i % count == 0) {
            draws.shuffle(turn);
        }
        design.groups[turn[i % count]].push_back(order[i]);
    }
    // The last stratum is not full: without this the first groups would always be the large ones.
    draws.shuffle(design.groups);
    return design;
}

} // namespace degs::sim
