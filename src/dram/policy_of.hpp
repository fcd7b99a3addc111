// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dram/chooser.hpp"
#include "dram/policy.hpp"

namespace degs::dram {

/// The base class of a policy `Derived`, which should be final: what is asked for every command is
/// then compiled into the Chooser's update.
template <class Derived>
class PolicyOf : public Policy {
public:
    std::unique_ptr<Policy> clone() const final { return std::make_unique<Derived>(derived()); }
    void update(Chooser& chooser, unsigned bank, const ChannelState& state) const final {
        chooser.update(derived(), bank, state);
    }

private:
    const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

} // namespace degs::dram
