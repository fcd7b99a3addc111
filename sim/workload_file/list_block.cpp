// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/list_block.hpp"

#include "scene/files/input_file.hpp"

namespace degs::sim {
namespace {

/// Refuses a block that is not one column of `count` numbers.
void get_numbers(const std::string& path, const std::string& place, std::string_view block,
                 std::size_t count, PlaneReader::Workspace& workspace, std::uint32_t* values) {
    PlaneReader reader(block, count, workspace);
    PlaneReader::Column column;
    if (!reader.next(false, column) || !reader.complete()) {
        fail_file(path, place + " is damaged; it must hold a column of " + std::to_string(count) +
                            " numbers whose planes libzstd unpacks.");
    }
    column.get(0, count, values);
}

} // namespace

std::string pack_lengths(const FrameWorkload& frame) {
    std::vector<std::uint32_t> lengths;
    for (std::size_t tile = 0; tile + 1 < frame.tile_begin.size(); ++tile) {
        lengths.push_back(
            static_cast<std::uint32_t>(frame.tile_begin[tile + 1] - frame.tile_begin[tile]));
    }
    PlaneWriter writer;
    writer.put(lengths);
    return writer.block(lengths.size() * kBytesPerEntry);
}

void unpack_lengths(const std::string& path, const std::string& place, std::string_view block,
                    std::uint64_t splats, std::uint64_t entries,
                    std::vector<std::uint64_t>& tile_begin) {
    PlaneReader::Workspace workspace;
    std::vector<std::uint32_t> lengths(tile_begin.size() - 1);
    get_numbers(path, place, block, lengths.size(), workspace, lengths.data());
    for (std::size_t tile = 0; tile < lengths.size(); ++tile) {
        if (lengths[tile] > splats) {
            fail_file(path, place + ", tile " + std::to_string(tile) + " lists " +
                                std::to_string(lengths[tile]) + " splats; at most the " +
                                std::to_string(splats) + " of the frame are allowed.");
        }
        tile_begin[tile + 1] = tile_begin[tile] + lengths[tile];
    }
    if (tile_begin.back() != entries) {
        fail_file(path, place + " has " + std::to_string(tile_begin.back()) +
                            " entries in all lists; the " + std::to_string(entries) +
                            " of its head are allowed.");
    }
}

std::vector<std::size_t> list_cuts(const std::vector<std::uint64_t>& tile_begin) {
    constexpr std::uint64_t kEntriesPerBlock = 1U << 15U;
    std::vector<std::size_t> cuts{0};
    for (std::size_t tile = 1; tile < tile_begin.size(); ++tile) {
        const std::uint64_t entries = tile_begin[tile] - tile_begin[cuts.back()];
        if (entries >= kEntriesPerBlock || (tile + 1 == tile_begin.size() && entries > 0)) {
            cuts.push_back(tile);
        }
    }
    return cuts;
}

std::string pack_lists(const FrameWorkload& frame, std::size_t first, std::size_t end) {
    std::vector<std::uint32_t> steps;
    for (std::size_t tile = first; tile < end; ++tile) {
        std::uint32_t next = 0; // the first splat that may follow
        for (std::uint64_t i = frame.tile_begin[tile]; i < frame.tile_begin[tile + 1]; ++i) {
            steps.push_back(frame.tile_splats[i] - next);
            next = frame.tile_splats[i] + 1;
        }
    }
    PlaneWriter writer;
    writer.put(steps);
    return writer.block(steps.size() * kBytesPerEntry);
}

void unpack_lists(const std::string& path, const std::string& place, std::string_view block,
                  std::size_t first, std::size_t end, PlaneReader::Workspace& workspace,
                  FrameWorkload& frame, std::vector<std::uint32_t>& touched) {
    const std::uint64_t begin = frame.tile_begin[first];
    get_numbers(path, place, block, frame.tile_begin[end] - begin, workspace,
                frame.tile_splats.data() + begin);
    for (std::size_t tile = first; tile < end; ++tile) {
        std::uint64_t next = 0; // in 64 bits, so that hostile steps cannot wrap it
        for (std::uint64_t i = frame.tile_begin[tile]; i < frame.tile_begin[tile + 1]; ++i) {
            next += frame.tile_splats[i];
            if (next >= touched.size()) {
                fail_file(path, place + ", tile " + std::to_string(tile) + " lists splat " +
                                    std::to_string(next) + "; only the " +
                                    std::to_string(touched.size()) + " of the frame are allowed.");
            }
            frame.tile_splats[i] = static_cast<std::uint32_t>(next);
            ++touched[next];
            ++next;
        }
    }
}

} // namespace degs::sim
