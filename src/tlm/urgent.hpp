// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tlm>

namespace degs {

/// A read with this extension may be served before reads without it, as with the QoS signals of
/// AMBA AXI. Targets that do not know it serve both alike.
struct Urgent : tlm::tlm_extension<Urgent> {
    tlm_extension_base* clone() const override { return new Urgent; }
    void copy_from(const tlm_extension_base&) override {}
};

} // namespace degs
