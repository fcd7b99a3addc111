// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/analytic_bank.hpp"

#include <algorithm>
#include <cmath>

namespace degs {

AnalyticBank::Candidate AnalyticBank::candidate_of(std::size_t domain) const {
    const Domain& own = domains_[domain];
    return {domain, std::max(own.free, own.front().arrived), own.front().number};
}

// Several domains may go at the same time: the lowest rank does.
std::uint64_t AnalyticBank::rank_of(const Candidate& candidate) const {
    const std::size_t domain = candidate.domain;
    const std::uint64_t younger =
        domain >= first_ && domain < first_ + domains_.size() / kTilesInFlight ? 1 : 0;
    std::uint64_t rank = candidate.number;
    if (scan_ == DomainScan::RoundRobin) {
        rank = domain >= cursor_ ? domain - cursor_ : domain + domains_.size() - cursor_;
    } else if (scan_ == DomainScan::Deepest) {
        rank = ~std::uint32_t{0} - domains_[domain].size();
    }
    return younger << 63U | rank;
}

double AnalyticBank::issue(double limit) {
    if (free_ >= limit) {
        return limit;
    }
    double earliest = limit;
    std::uint64_t least = 0;
    std::size_t chosen = occupied_.size();
    for (std::size_t i = 0; i < occupied_.size(); ++i) {
        const double start = std::max(free_, occupied_[i].ready);
        if (start > earliest || start >= limit) {
            continue;
        }
        const std::uint64_t rank = rank_of(occupied_[i]);
        if (start < earliest || rank < least) {
            earliest = start;
            least = rank;
            chosen = i;
        }
    }
    if (chosen == occupied_.size()) {
        return limit;
    }
    Candidate& next = occupied_[chosen];
    cursor_ = next.domain + 1;
    Domain& domain = domains_[next.domain];
    const double taken = domain.front().taken;
    domain.pop();
    --size_;
    waiting_cycles_ -= taken;
    // What is left of a packet that nothing joined is lost.
    free_ = (earliest > free_ ? std::max(earliest, std::ceil(free_)) : earliest) + taken;
    // The last task executes in the packet that ends behind it.
    domain.free = std::ceil(free_) - 1 + reuse_cycles_;
    if (domain.empty()) {
        next = occupied_.back();
        occupied_.pop_back();
    } else {
        next = candidate_of(next.domain);
    }
    return earliest;
}

double AnalyticBank::add(double date, double taken, std::size_t domain) {
    while (issue(date) < date) {
    }
    while (size_ >= depth_) {
        date = std::max(date, issue(kLast));
    }
    domain += first_;
    Domain& own = domains_[domain];
    const bool first = own.empty();
    own.segments.push_back({std::ceil(date), taken, number_++});
    if (first) {
        occupied_.push_back(candidate_of(domain));
    }
    ++size_;
    waiting_cycles_ += taken;
    return date;
}

void AnalyticBank::begin_tile() {
    const std::size_t count = domains_.size() / kTilesInFlight;
    first_ = (first_ + count) % domains_.size();
    for (std::size_t i = first_; i < first_ + count; ++i) {
        while (!domains_[i].empty()) {
            issue(kLast);
        }
        domains_[i].free = 0;
    }
}

} // namespace degs
