// SPDX-License-Identifier: Apache-2.0
#include "loader.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "map.h"

namespace {

view to_view(const degs::MemoryScene::View& from) {
    view to{};
    to.focal_x = from.focal_x;
    to.focal_y = from.focal_y;
    std::memcpy(to.axes, from.axes, sizeof to.axes);
    std::memcpy(to.position, from.position, sizeof to.position);
    to.shift_x = from.shift_x;
    to.shift_y = from.shift_y;
    to.origin_x = static_cast<std::uint32_t>(from.origin_x);
    to.origin_y = static_cast<std::uint32_t>(from.origin_y);
    to.width = static_cast<std::uint32_t>(from.width);
    to.height = static_cast<std::uint32_t>(from.height);
    return to;
}

} // namespace

Loader::Loader(const sc_core::sc_module_name& name, const degs::MemoryScene& scene,
               const std::vector<degs::MemoryScene::View>& views)
    : sc_module(name) {
    if (views.size() > MOST_FRAMES) {
        throw std::runtime_error("The firmware renders at most " + std::to_string(MOST_FRAMES) +
                                 " views.");
    }
    boot_table table{};
    std::uint64_t pixels = 0;
    for (const degs::MemoryScene::View& from : views) {
        view& each = table.views[table.frames++] = to_view(from);
        pixels = std::max(pixels, std::uint64_t{each.width} * each.height);
    }
    add(std::vector<unsigned char>(sizeof table));
    table.geometry = add(scene.geometry);
    table.sh = add(scene.sh);
    table.count = scene.gaussians;
    table.sh_degree = scene.sh_degree;
    table.frame_buffer = add(std::vector<unsigned char>(pixels * 4));
    table.workspace_bytes = std::uint32_t{64} << 20U;
    table.workspace = add(std::vector<unsigned char>(table.workspace_bytes));
    std::memcpy(memory_.data(), &table, sizeof table);
}

/// The address of a copy of `bytes` in new memory; a multiple of 4096.
std::uint32_t Loader::add(const std::vector<unsigned char>& bytes) {
    constexpr std::uint64_t page = 4096;
    const std::uint64_t at = BOOT_TABLE + memory_.size();
    const std::uint64_t size = (memory_.size() + bytes.size() + page - 1) / page * page;
    if (size > (std::uint64_t{1} << 32U) - BOOT_TABLE) {
        throw std::runtime_error("The scene does not fit below 4 GiB.");
    }
    memory_.insert(memory_.end(), bytes.begin(), bytes.end());
    memory_.resize(size);
    return static_cast<std::uint32_t>(at);
}

void Loader::start_of_simulation() {
    constexpr std::size_t piece = std::size_t{1} << 24U;
    for (std::size_t at = 0; at < memory_.size(); at += piece) {
        tlm::tlm_generic_payload payload;
        const std::size_t size = std::min(piece, memory_.size() - at);
        payload.set_command(tlm::TLM_WRITE_COMMAND);
        payload.set_address(BOOT_TABLE + at);
        payload.set_data_ptr(memory_.data() + at);
        payload.set_data_length(static_cast<unsigned>(size));
        payload.set_streaming_width(static_cast<unsigned>(size));
        if (out->transport_dbg(payload) != size) {
            throw std::runtime_error("The memory is too small for the scene.");
        }
    }
}
