// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_options.hpp"

#include <limits>

#include "config/config_source.hpp"
#include "config/key_walk.hpp"

namespace degs {
namespace {

/// Visits an unsigned number as the signed one that configurations have; without `high` up to its
/// largest value.
template <class Unsigned>
void visit_count(ConfigVisitor& visitor, const char* key, Unsigned& value, std::int64_t low,
                 std::int64_t high, const char* doc) {
    auto number = static_cast<std::int64_t>(value);
    visitor.integer(key, number, low, high, doc);
    value = static_cast<Unsigned>(number);
}

template <class Unsigned>
void visit_count(ConfigVisitor& visitor, const char* key, Unsigned& value, std::int64_t low,
                 const char* doc) {
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    constexpr std::int64_t kHigh =
        sizeof(Unsigned) < sizeof kMost
            ? static_cast<std::int64_t>(std::numeric_limits<Unsigned>::max())
            : kMost;
    visit_count(visitor, key, value, low, kHigh, doc);
}

} // namespace

void describe(AcceleratorOptions& options, ConfigVisitor& visitor) {
    visitor.choice("fidelity", options.fidelity, {"strict", "exact"},
                   "how processes are kept in order");
    visitor.boolean("antialiased", options.antialiased, "what the files of its scenes say");
    visitor.begin_section("limits", "of a request");
    visit_count(visitor, "gaussians", options.limits.gaussians, 1,
                AcceleratorOptions::kMostGaussians, "of a scene");
    visit_count(visitor, "pixels", options.limits.pixels, 1, "of a frame");
    visitor.end_section();
    visitor.begin_section("memory", "how accesses leave the socket mem");
    visitor.choice("transport", options.memory.transport, {"lt", "at"},
                   "b_transport() or four phases");
    visit_count(visitor, "outstanding", options.memory.outstanding, 1,
                "at: transactions in flight");
    visit_count(visitor, "outstanding_per_stream", options.memory.outstanding_per_stream, 1,
                "at: the same of one stream");
    visit_count(visitor, "lt_outstanding", options.memory.lt_outstanding, 0,
                "lt: transactions in flight; 0 is no bound");
    visit_count(visitor, "burst_bytes", options.memory.burst_bytes, 0,
                "bytes; a power of two from 4 on, 0 cuts at boundary_bytes alone");
    visitor.choice("burst_ends", options.memory.burst_ends, {"pieces", "full_bursts"},
                   "where an access begins or ends inside of a burst: smaller transactions, or the "
                   "whole burst, with byte enables if it is written");
    visit_count(visitor, "boundary_bytes", options.memory.boundary_bytes, 0,
                "bytes; a power of two from 4 on, of which no transaction crosses a multiple; 0 is "
                "no boundary");
    visit_count(visitor, "qos", options.memory.qos, 0, RequestInfo::kMostQos,
                "of every transaction, in its extension RequestInfo");
    visitor.choice(
        "faults", options.memory.faults, {"end", "stall"},
        "what becomes of a refused access: it ends the frame with an error, or waits for "
        "software");
    visitor.choice("pacing", options.memory.pacing, {"exact", "quantum", "annotated"},
                   "when accesses are issued");
    visitor.end_section();
    visitor.begin_section("power", "the supply that software has gated while no frame is rendered");
    visitor.real("gated_leakage", options.power.gated_leakage, 0, 1,
                 "share of the leakage that is left [assumed]");
    visitor.real("wake_ns", options.power.wake_ns, 0, AcceleratorOptions::kMostWakeNs,
                 "ns; from a start to the frame [assumed]");
    visitor.end_section();
}

void AcceleratorOptions::visit(KeyVisitor& visitor) {
    KeyWalk walk(visitor);
    describe(*this, walk);
}

void AcceleratorOptions::set(const std::string& key, const std::string& value) {
    AcceleratorOptions changed = *this;
    ConfigSource::from_overrides({key + "=" + value}).read([&](ConfigVisitor& visitor) {
        describe(changed, visitor);
    });
    *this = changed;
}

} // namespace degs
