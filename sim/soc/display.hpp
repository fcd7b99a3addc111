// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

namespace degs::sim {

/// Display controller: reads a frame buffer of RGBA8 at the rate of its screen, row by row. A row
/// is fetched while the row before it is shown; one that comes later is an underrun. The next
/// picture starts with the buffer that was shown to it last. Not modelled: blanking, compression.
class Display : public sc_core::sc_module {
public:
    struct Config {
        int width = 1920, height = 1080; ///< px
        double refresh_hz = 60;
        unsigned int request_bytes = 256;
    };
    struct Stats {
        std::uint64_t pictures = 0, rows = 0, underruns = 0, errors = 0;
        std::uint64_t bytes = 0;
    };

    tlm_utils::simple_initiator_socket<Display> out;

    Display(const sc_core::sc_module_name& name, const Config& config);

    /// Sets the buffer to read from the next picture on. Before the first call nothing is shown.
    void show(std::uint64_t frame_buffer);
    const Stats& stats() const { return stats_; }

private:
    void run();
    sc_core::sc_time fetch_row(std::uint64_t address);

    Config config_;
    std::uint64_t frame_buffer_ = 0;
    bool on_ = false;
    std::vector<unsigned char> row_;
    Stats stats_;
    sc_core::sc_event turned_on_;
};

} // namespace degs::sim
