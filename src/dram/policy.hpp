// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "config/config.hpp"
#include "dram/queue.hpp"

namespace degs::dram {

struct ChannelState;
class Chooser;
template <class Derived>
class PolicyOf;

/// The scheduling policy of a channel: which queued accesses may send commands, and in which order.
/// Every channel has a policy of its own, which may keep state; a copy of a channel copies it, too.
/// Derive from PolicyOf, and add a line to policies.cpp.
class Policy {
public:
    /// A command that may be sent now. ACT-2 is not among them: see order().
    struct Ready {
        Command command; ///< a column command, ACT-1 or PRE
        unsigned bank;
        const Queue::Entry& entry; ///< the access for which it is sent
    };

    virtual ~Policy() = default;
    virtual std::unique_ptr<Policy> clone() const = 0;
    /// Calls chooser.update() for this policy.
    virtual void update(Chooser& chooser, unsigned bank, const ChannelState& state) const = 0;

    /// name() is the value of the key in configurations; doc() is the sentence of the manual that
    /// explains it.
    virtual const char* name() const = 0;
    virtual const char* doc() const = 0;
    /// A policy with keys describes them; they stand in a section of its name.
    virtual bool has_keys() const { return false; }
    virtual void describe(ConfigVisitor& /*visitor*/) {}

    /// The access that a bank serves next from its open row; kNone: the bank closes the row for its
    /// oldest access. Only for banks with a queued access. May change only with the bank's accesses
    /// in the queue and with the calls below.
    virtual std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) const = 0;

    /// True if eligible() counts.
    virtual bool selective() const { return false; }
    /// Banks whose accesses may send commands, as a mask. Only if the queue is not empty.
    virtual std::uint32_t eligible(const Queue& /*queue*/) const { return ~0U; }

    /// True if order() counts. Otherwise column commands go before others and older accesses
    /// before younger ones.
    virtual bool has_order() const { return false; }
    /// The number of a command in the order of those that may be sent in one CK: the lowest goes
    /// first; below 2^63. ACT-2 goes before all of them, because it has a deadline. May change only
    /// with the bank's accesses in the queue and with the calls below for this bank.
    virtual std::uint64_t order(const Ready& /*ready*/) const { return 0; }

    /// The last burst of an access is sent; it leaves its queue next.
    virtual void served(const Queue::Entry& /*entry*/) {}
    /// An activation begins, or the row is closed, also by a refresh or an auto-precharge.
    virtual void opened(unsigned /*bank*/, std::uint32_t /*row*/) {}
    virtual void closed(unsigned /*bank*/) {}

protected:
    Policy() = default;
    Policy(const Policy&) = default;
    Policy& operator=(const Policy&) = default;
};

/// Owns a policy; copies of the holder have a copy of it.
class PolicyHolder {
public:
    template <class Derived>
    explicit PolicyHolder(const PolicyOf<Derived>& policy) : policy_(policy.clone()) {}
    PolicyHolder(const PolicyHolder& other) : policy_(other.policy_->clone()) {}
    PolicyHolder(PolicyHolder&&) = default;
    PolicyHolder& operator=(const PolicyHolder& other) {
        policy_ = other.policy_->clone();
        return *this;
    }
    PolicyHolder& operator=(PolicyHolder&&) = default;
    ~PolicyHolder() = default;

    Policy& operator*() { return *policy_; }
    const Policy& operator*() const { return *policy_; }
    Policy* operator->() { return policy_.get(); }
    const Policy* operator->() const { return policy_.get(); }

private:
    std::unique_ptr<Policy> policy_;
};

} // namespace degs::dram
