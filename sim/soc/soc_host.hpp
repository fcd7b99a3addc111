// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "degs/degs_driver.h"
#include "sim/view/foveated_view.hpp"
#include "splat/model/gaussian.hpp"

namespace degs::sim {

/// A frame as the driver of the accelerator saw it.
struct SocFrame {
    std::uint64_t cycles = 0, bytes_read = 0, bytes_written = 0, fragments = 0;
    std::uint64_t energy_nj = 0;        ///< without the memory, see FRAME_ENERGY
    double latency_ns = 0;              ///< start written to interrupt seen
    std::vector<degs_drawn_view> views; ///< whose pixels are in memory
};

/// The processor that drives the accelerator, as a program on it would: puts a scene into memory,
/// works the registers with the driver in C, sleeps until the interrupt. Scene and pixels go by
/// debug transport, because their transfer is not measured. Throws std::runtime_error if a register
/// access is refused or a frame ends with an error.
class SocHost : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<SocHost> out;
    sc_core::sc_in<bool> irq;

    /// `registers`: bus address; memory of `bytes` from `memory` on is the driver's.
    SocHost(const sc_core::sc_module_name& name, std::uint64_t registers, std::uint64_t memory,
            std::uint64_t bytes);

    /// The program of the processor; set once, before the simulation starts.
    std::function<void(SocHost&)> program;
    bool finished() const { return finished_; }

    // The functions below are for the program only.
    void load_scene(const GaussianCloud& cloud);
    /// The images of a frame, with their levels. Registers describe the camera of one pinhole,
    /// a table in memory anything else.
    void set_images(const std::vector<FoveatedView>& images,
                    const std::optional<Foveation>& foveation);
    /// Asks the accelerator how much it needs, and reserves that and two frame buffers for each
    /// image. Throws InputError if memory is too small.
    void reserve_memory();
    /// Renders into one of the two sets of frame buffers in turn. Throws std::logic_error if the
    /// pixels are not those of the first frame.
    SocFrame render();
    /// RGBA8 of each drawn view, which no frame changes.
    using Pixels = std::vector<std::vector<unsigned char>>;
    const Pixels& pixels() const { return pixels_; }

private:
    /// Where a frame is drawn.
    struct Target {
        std::vector<std::uint64_t> frame_buffers; // of the views
        std::uint64_t table = 0;
    };
    void run();
    std::uint32_t access(tlm::tlm_command command, std::uint32_t offset, std::uint32_t value);
    std::uint32_t start_and_wait();
    std::uint64_t reserve(std::uint64_t bytes);
    void set_target(const Target& target);
    void write_table(const Target& target);
    void check_pixels(const SocFrame& frame);
    std::vector<degs_drawn_view> drawn_views();
    degs_drawn_view only_view(const Target& target) const;
    void debug(tlm::tlm_command command, std::uint64_t address, std::vector<unsigned char>& data);

    degs_device device_;
    std::uint64_t registers_, next_, end_; // next_ to end_: memory that is not reserved
    std::vector<degs_view> views_;         // of a frame
    bool in_table_ = false;                // the views, and not in registers
    std::array<Target, 2> targets_;
    std::size_t frames_ = 0;
    Pixels pixels_; // of the first frame
    bool finished_ = false;
};

} // namespace degs::sim
