// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/kit/job/messages.hpp"
#include "splat/frame/pixel_mask.hpp"

namespace degs {

/// Where row spans are cut: at the fixed strides of their tile, columns 0 .. length - 1 and so on
/// (paper, Sec. IV-B). Numbers the conflict domains (row x segment) of one bank's rows of a tile.
class Segmenter {
public:
    struct Domain {
        int row, column; ///< inside the tile; the column is that of its first pixel
    };
    /// The segment of a row that a pixel lies in.
    struct Place {
        std::int16_t segment = 0, column = 0; ///< its number, and the column of its first pixel
    };

    /// For bank `index` of `banks`, which owns every row y with y mod banks = index.
    Segmenter(int tile_size, int length, int index, int banks) {
        const int per_row = (tile_size + length - 1) / length;
        for (int i = 0; i < tile_size; ++i) {
            first_domain_of_row_.push_back(i / banks * per_row);
            place_of_column_.push_back({inside_tile(i / length), inside_tile(i / length * length)});
        }
        for (int row = index; row < tile_size; row += banks) {
            for (int s = 0; s < per_row; ++s) {
                domains_.push_back({row, s * length});
            }
        }
    }

    /// Upper bound of the domains that any bank has in a tile.
    static int domains_per_tile(int tile_size, int length, int banks) {
        return (tile_size + banks - 1) / banks * ((tile_size + length - 1) / length);
    }
    const std::vector<Domain>& domains() const { return domains_; }
    int domain_of(int row, int column) const {
        return first_domain_of(row) + place_of(column).segment;
    }
    int first_domain_of(int row) const { return first_domain_of_row_.data()[row]; }
    Place place_of(int column) const { return place_of_column_.data()[column]; }

private:
    // Tables replace divisions in the hot loop.
    std::vector<Domain> domains_;
    std::vector<int> first_domain_of_row_;
    std::vector<Place> place_of_column_;
};

} // namespace degs
