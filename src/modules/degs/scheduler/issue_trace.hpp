// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tlm/event_log.hpp"

namespace degs {

/// A segment that an Issue Bank issues.
struct IssuedSegment {
    Cycle now = 0, slot = 0; ///< cycle of the issue, and execution date of the first task
    Cycle ready = 0;         ///< date from which the array may touch the domain again
    int context = 0, domain = 0;
    std::uint32_t mask = 0; ///< tasks that are packed

    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("slot", static_cast<std::int64_t>(slot));
        visitor.number("ready", static_cast<std::int64_t>(ready));
        visitor.number("context", context);
        visitor.number("domain", domain);
        visitor.number("mask", mask);
    }
};

/// Digest of everything that an Issue Bank issues, in its order: two banks that decide alike have
/// the same one.
class IssueTrace {
public:
    void add(const IssuedSegment& segment) {
        ++segments_;
        for (const std::uint64_t word :
             {segment.now, segment.slot, static_cast<Cycle>(segment.context),
              static_cast<Cycle>(segment.domain), segment.ready, Cycle{segment.mask}}) {
            digest_ = (digest_ ^ word) * 0x9E3779B97F4A7C15U;
            digest_ ^= digest_ >> 29U;
        }
        if (log_ != nullptr) {
            log_->begin(kind_, segment.now);
            FieldValues values(*log_);
            segment.visit(values);
        }
    }
    /// Writes every segment as an event `issue`, too.
    void log_to(EventLog& log) {
        FieldNames names;
        IssuedSegment().visit(names);
        log_ = &log;
        kind_ = log.kind("issue", names.fields());
    }
    std::uint64_t digest() const { return digest_; }
    std::uint64_t segments() const { return segments_; }

private:
    std::uint64_t digest_ = 0, segments_ = 0;
    EventLog* log_ = nullptr;
    std::size_t kind_ = 0;
};

} // namespace degs
