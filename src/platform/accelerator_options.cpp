// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "platform/accelerator.hpp"

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

void Accelerator::Options::describe(ConfigVisitor& visitor) {
    visitor.choice("fidelity", fidelity, {"strict", "exact"}, "how processes are kept in order");
    visitor.boolean("antialiased", antialiased, "what the files of its scenes say");
    visitor.begin_section("limits", "of a request");
    visit_count(visitor, "gaussians", limits.gaussians, 1, kMostGaussians, "of a scene");
    visit_count(visitor, "pixels", limits.pixels, 1, "of a frame");
    visitor.end_section();
    visitor.begin_section("memory", "how accesses leave the socket mem");
    visitor.choice("transport", memory.transport, {"lt", "at"}, "b_transport() or four phases");
    visit_count(visitor, "outstanding", memory.outstanding, 1, "at: transactions in flight");
    visit_count(visitor, "outstanding_per_stream", memory.outstanding_per_stream, 1,
                "at: the same of one stream");
    visit_count(visitor, "burst_bytes", memory.burst_bytes, 0,
                "bytes; a power of two from 4 on, 0 cuts no access");
    visitor.choice("burst_ends", memory.burst_ends, {"pieces", "full_bursts"},
                   "where an access begins or ends inside of a burst: smaller transactions, or the "
                   "whole burst, with byte enables if it is written");
    visitor.choice("pacing", memory.pacing, {"exact", "quantum", "annotated"},
                   "when accesses are issued");
    visitor.end_section();
}

} // namespace degs
