// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace degs {

/// Where the splats of frames lie in the tables of a data path. A frame takes the lowest gap in
/// which all of its splats fit, so that tables do not grow while frames come and go.
class SplatPlaces {
public:
    /// The index of the first of `count` splats.
    std::uint32_t take(std::size_t count) {
        std::size_t first = 0;
        auto behind = ranges_.begin();
        for (; behind != ranges_.end() && behind->first < first + count; ++behind) {
            first = behind->end;
        }
        if (count != 0) {
            ranges_.insert(behind, {first, first + count});
            size_ = std::max(size_, first + count);
        }
        return static_cast<std::uint32_t>(first);
    }
    /// Makes the places of `count` splats that were taken together a gap.
    void release(std::size_t first, std::size_t count) {
        ranges_.erase(
            std::remove_if(ranges_.begin(), ranges_.end(),
                           [&](const Range& range) { return count != 0 && range.first == first; }),
            ranges_.end());
    }
    /// Entries that a table needs; it never falls.
    std::size_t size() const { return size_; }

private:
    struct Range {
        std::size_t first, end;
    };
    std::vector<Range> ranges_; // ascending, not empty
    std::size_t size_ = 0;
};

} // namespace degs
