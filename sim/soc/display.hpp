// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "degs/request_info.hpp"

namespace degs::sim {

/// Display controller: reads a frame of RGBA8 at the rate of its screen, row by row: the rows of
/// every drawn view, one view behind the other, each with as much time as any other. A row is
/// fetched while the row before it is shown; one that comes later is an underrun. The next picture
/// starts with the frame that was shown to it last. Not modelled: blanking, compression.
class Display : public sc_core::sc_module {
public:
    struct Config {
        double refresh_hz = 60;
        unsigned int request_bytes = 256;
        unsigned qos = 0; ///< of its accesses, 0 to 15
    };
    struct Stats {
        std::uint64_t pictures = 0, rows = 0, underruns = 0, errors = 0;
        std::uint64_t bytes = 0;
    };

    tlm_utils::simple_initiator_socket<Display> out;

    Display(const sc_core::sc_module_name& name, const Config& config);

    /// The pixels of a drawn view, row by row.
    struct Part {
        std::uint64_t address = 0;
        int width = 0, height = 0; ///< px
    };
    /// Sets what is read from the next picture on, at least one row. Before the first call nothing
    /// is shown.
    void show(std::vector<Part> frame);
    const Stats& stats() const { return stats_; }

private:
    void run();
    void show_picture(const std::vector<Part>& picture);
    sc_core::sc_time fetch_row(std::uint64_t address, int width);

    Config config_;
    std::vector<Part> frame_; // empty until it is turned on
    sc_core::sc_time due_;    // of the next row
    std::vector<unsigned char> row_;
    RequestInfo info_;
    Stats stats_;
    sc_core::sc_event turned_on_;
};

} // namespace degs::sim
