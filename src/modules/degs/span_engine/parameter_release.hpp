// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/job/message_rings.hpp"

namespace degs {

/// Keeps the Temporary Gaussian Parameters of a chunk in the Gaussian Buffer until the spans of all
/// its splats have been made (paper, Sec. IV-A: they are "released after span generation"), then
/// lets the Splat Fetcher write another chunk there. One module per Slicing module.
class ParameterRelease : public sc_core::sc_module {
public:
    /// From the Slicing module: the chunk whose last row has been sent, by the fetcher that sent
    /// it.
    FifoPort<ChunkSliced> sliced;
    /// From the Slicing module, by lane: the rows of that chunk.
    sc_core::sc_vector<FifoPort<RowCount>> rows;
    /// From the Span Units, by lane: one row more has become a span, or none.
    sc_core::sc_vector<FifoPort<RowSolved>> solved;
    sc_core::sc_vector<FifoPort<ChunkReleased>> released; ///< to the fetchers

    ParameterRelease(const sc_core::sc_module_name& name, const Timebase& time, std::size_t lanes,
                     std::size_t fetchers);

private:
    void end_of_elaboration() override;
    void run();

    Process self_;
};

} // namespace degs
