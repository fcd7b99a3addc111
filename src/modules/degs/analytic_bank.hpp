// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "modules/degs/scheduler/issue_bank.hpp"

namespace degs {

/// The queue of an Issue Bank without cycles: segments wait by conflict domain, and whichever may
/// go first does, when the PEs are free and its domain may be updated again; of several, one of the
/// oldest tile, by the scan rule. Cycles are real numbers.
class AnalyticBank {
public:
    /// `depth` segments may wait in the bank, which has `domains` conflict domains in a tile.
    AnalyticBank(std::size_t depth, std::size_t domains, double reuse_cycles, DomainScan scan)
        : depth_(depth), reuse_cycles_(reuse_cycles), scan_(scan),
          domains_(kTilesInFlight * domains) {}

    /// Begins a tile. All waiting segments of the tile whose place it takes are issued first.
    void begin_tile();

    /// A segment that arrives at `date` and keeps the PEs busy for `taken` cycles waits for its
    /// domain; returns the date at which there was room for it. Dates do not fall.
    double add(double date, double taken, std::size_t domain);
    /// The date at which the PEs have had all tasks, if they never have to wait for a domain.
    double done() const { return free_ + waiting_cycles_; }

private:
    struct Segment {
        double arrived = 0, taken = 0;
        std::uint64_t number = 0;
    };
    struct Domain {
        std::vector<Segment> segments; ///< the first `issued` have been
        std::size_t issued = 0;
        double free = 0; ///< from which it may be updated
        bool empty() const { return issued == segments.size(); }
        std::size_t size() const { return segments.size() - issued; }
        const Segment& front() const { return segments[issued]; }
        void pop() {
            if (++issued == segments.size()) {
                segments.clear();
                issued = 0;
            }
        }
    };

    /// A domain with segments, and what its first one waits for. They lie beside each other,
    /// because every issue looks at all of them.
    struct Candidate {
        std::size_t domain;
        double ready;         ///< the segment is there, and the domain may be updated
        std::uint64_t number; ///< of the segment
    };

    static constexpr std::size_t kTilesInFlight = 2;
    Candidate candidate_of(std::size_t domain) const;
    std::uint64_t rank_of(const Candidate& candidate) const;
    static constexpr double kLast = std::numeric_limits<double>::infinity();
    /// Issues the next segment if that is possible before `limit`. Returns the date, or `limit`.
    double issue(double limit);

    std::size_t depth_;
    double reuse_cycles_;
    DomainScan scan_;
    std::size_t first_ = 0;  ///< domain of the tile that began last
    std::size_t cursor_ = 0; ///< behind the domain that was issued last
    std::vector<Domain> domains_;
    std::vector<Candidate> occupied_;
    std::size_t size_ = 0;      ///< segments that wait
    std::uint64_t number_ = 0;  ///< of the next segment
    double free_ = 0;           ///< when the PEs have had the tasks issued so far
    double waiting_cycles_ = 0; ///< that the waiting segments take
};

} // namespace degs
