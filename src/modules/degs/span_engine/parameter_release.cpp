// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/parameter_release.hpp"

#include "tlm/has_process.hpp"

namespace degs {

ParameterRelease::ParameterRelease(const sc_core::sc_module_name& name, const Timebase& time,
                                   std::size_t lanes, std::size_t fetchers)
    : sc_core::sc_module(name), sliced("sliced"), rows("rows", lanes), solved("solved", lanes),
      released("released", fetchers), self_(time) {
    DEGS_HAS_PROCESS(ParameterRelease);
    SC_THREAD(run);
    self_.show(*this);
}

void ParameterRelease::end_of_elaboration() {
    sliced->connect_reader(self_);
    for (std::size_t lane = 0; lane < rows.size(); ++lane) {
        rows[lane]->connect_reader(self_);
        solved[lane]->connect_reader(self_);
    }
    for (auto& port : released) {
        port->connect_writer(self_);
    }
}

// Chunks leave in order, each when the last of its rows has been solved; so every item is waited
// for in turn, and its date moves this process.
void ParameterRelease::run() {
    for (;;) {
        const std::size_t fetcher = sliced->get(self_).fetcher;
        for (std::size_t lane = 0; lane < rows.size(); ++lane) {
            for (std::uint32_t left = rows[lane]->get(self_).rows; left != 0; --left) {
                solved[lane]->get(self_);
            }
        }
        released[fetcher]->put(self_, {});
    }
}

} // namespace degs
