// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/tlm/arbitration.hpp"

namespace degs::test {

/// The systems of arbitration.hpp, simulated cycle by cycle without SystemC: in every cycle all
/// state machines step until none can. Within a cycle their order does not matter, because rings
/// that an arbiter or a polling writer looks at have a forward latency of at least 1.
class CycleByCycle {
public:
    explicit CycleByCycle(const SystemSpec& spec);
    Logs run();

private:
    struct Ring {
        std::deque<Cycle> free, readable;
        std::deque<Item> items;
        Cycle forward = 0, release = 0;
        Ring() = default;
        explicit Ring(const RingSpec& r)
            : free(static_cast<std::size_t>(r.depth), 0), forward(r.forward), release(r.release) {}
        bool can_write(Cycle t) const { return !free.empty() && free.front() <= t; }
        bool can_read(Cycle t) const { return !readable.empty() && readable.front() <= t; }
        void write(Cycle t, const Item& item) {
            free.pop_front();
            readable.push_back(t + forward);
            items.push_back(item);
        }
        Item read(Cycle t) {
            const Item item = items.front();
            items.pop_front();
            readable.pop_front();
            free.push_back(t + release);
            return item;
        }
    };
    enum class Phase { Begin, Working, Asking, Writing, Done };
    struct Machine {
        Phase phase = Phase::Begin;
        Cycle until = 0; ///< end of the work; for an idle arbiter: idle since
        Item item;
        int index = 0, outstanding = 0, cursor = 0, left = 0;
    };
    bool step_feeder(std::size_t w, Cycle t);
    bool step_writer(std::size_t w, Cycle t);
    bool step_arbiter(int a, Cycle t);
    bool grant(int a, Cycle t);
    bool step_server(Cycle t);
    void log(std::size_t who, Cycle t, const Item& item, int note) {
        logs_[who].push_back({t, item.writer, item.index, note});
    }

    SystemSpec spec_;
    std::size_t writers_;
    std::vector<Ring> feed_, request_, response_, out_;
    std::vector<Machine> feeder_, writer_, arbiter_;
    Machine server_;
    Logs logs_;
};

inline CycleByCycle::CycleByCycle(const SystemSpec& spec)
    : spec_(spec), writers_(spec.writers.size()), feeder_(writers_), writer_(writers_),
      arbiter_(static_cast<std::size_t>(spec.arbiter_count())), logs_(writers_ + 4) {
    for (const WriterSpec& w : spec.writers) {
        feed_.emplace_back(w.feed);
        request_.insert(request_.end(), static_cast<std::size_t>(spec.groups), Ring(w.request));
        response_.emplace_back(w.response);
    }
    for (std::size_t a = 0; a < arbiter_.size(); ++a) {
        out_.emplace_back(spec.arbiters[a].out);
        arbiter_[a].left = spec.items_of(static_cast<int>(a));
    }
    for (int w = 0; w < static_cast<int>(writers_); ++w) {
        feeder_[static_cast<std::size_t>(w)].until = spec.feed_gap(w, 0);
    }
    server_.left = spec.total();
}

inline Logs CycleByCycle::run() {
    for (Cycle t = 0; server_.left > 0; ++t) {
        for (bool moved = true; moved;) {
            moved = step_server(t);
            for (int a = 0; a < spec_.arbiter_count(); ++a) {
                moved = step_arbiter(a, t) || moved;
            }
            for (std::size_t w = 0; w < writers_; ++w) {
                moved = (spec_.writers[w].fed && step_feeder(w, t)) || moved;
                moved = step_writer(w, t) || moved;
            }
        }
    }
    return logs_;
}

inline bool CycleByCycle::step_feeder(std::size_t w, Cycle t) {
    Machine& m = feeder_[w];
    if (m.index == spec_.items || t < m.until || !feed_[w].can_write(t)) {
        return false;
    }
    feed_[w].write(t, {static_cast<int>(w), m.index});
    if (++m.index < spec_.items) {
        m.until = t + spec_.feed_gap(static_cast<int>(w), m.index);
    }
    return true;
}

inline bool CycleByCycle::step_writer(std::size_t w, Cycle t) {
    Machine& m = writer_[w];
    const WriterSpec& spec = spec_.writers[w];
    const Item item{static_cast<int>(w), m.index};
    if (m.phase == Phase::Begin) {
        if (spec.fed && !feed_[w].can_read(t)) {
            return false;
        }
        if (spec.fed) {
            feed_[w].read(t);
        }
        m.until = t + spec_.gap(item.writer, m.index);
        m.phase = Phase::Working;
        return true;
    }
    if (m.phase == Phase::Working) {
        if (t < m.until) {
            return false;
        }
        for (; spec.polls && response_[w].can_read(t); --m.outstanding) {
            response_[w].read(t);
        }
        log(w, t, item, m.outstanding);
        m.phase = Phase::Asking;
    }
    if (m.phase == Phase::Asking) {
        if (spec.outstanding != 0 && m.outstanding == spec.outstanding) {
            if (!response_[w].can_read(t)) {
                return false;
            }
            response_[w].read(t);
            --m.outstanding;
        }
        m.phase = Phase::Writing;
        return true;
    }
    if (m.phase == Phase::Done) {
        return false;
    }
    Ring& request = request_[spec_.request_ring(item.writer, spec_.target(item.writer, m.index))];
    if (!request.can_write(t)) {
        return false;
    }
    request.write(t, item);
    log(w, t, item, -1);
    ++m.outstanding;
    m.phase = ++m.index == spec_.items ? Phase::Done : Phase::Begin;
    return true;
}

inline bool CycleByCycle::step_arbiter(int a, Cycle t) {
    Machine& m = arbiter_[static_cast<std::size_t>(a)];
    Ring& out = out_[static_cast<std::size_t>(a)];
    if (m.phase == Phase::Begin) {
        return grant(a, t);
    }
    if (m.phase != Phase::Working || t < m.until || !out.can_write(t)) {
        return false;
    }
    out.write(t, m.item);
    log(writers_ + static_cast<std::size_t>(a), t, m.item, -1);
    m.phase = --m.left == 0 ? Phase::Done : Phase::Begin;
    m.until = t;
    return true;
}

inline bool CycleByCycle::grant(int a, Cycle t) {
    Machine& m = arbiter_[static_cast<std::size_t>(a)];
    const ArbiterSpec& spec = spec_.arbiters[a];
    const std::size_t who = writers_ + static_cast<std::size_t>(a);
    if (t < m.until) {
        return false;
    }
    std::vector<Ring*> in;
    std::vector<Cycle> heads;
    for (const std::size_t input : spec_.inputs_of(a)) {
        in.push_back(&(a == 2 ? out_ : request_)[input]);
        heads.push_back(in.back()->readable.empty() ? kNever : in.back()->readable.front());
    }
    const int port = choose(heads, t, spec.round_robin, m.cursor);
    if (port < 0) {
        if (spec.tick != 0 && t == m.until + spec.tick) {
            log(who, t, {}, -2);
            m.until = t + 1;
        }
        return false;
    }
    m.item = in[static_cast<std::size_t>(port)]->read(t);
    log(who, t, m.item, port);
    m.until = t + spec_.service(a, m.item);
    m.phase = Phase::Working;
    return true;
}

inline bool CycleByCycle::step_server(Cycle t) {
    Machine& m = server_;
    if (m.phase == Phase::Begin) {
        Ring& in = out_[static_cast<std::size_t>(spec_.last_arbiter())];
        if (m.left == 0 || t < m.until || !in.can_read(t)) {
            return false;
        }
        m.item = in.read(t);
        log(writers_ + 3, t, m.item, 0);
        m.until = t + spec_.service(3, m.item);
        m.phase = Phase::Working;
        return true;
    }
    const auto writer = static_cast<std::size_t>(m.item.writer);
    if (t < m.until) {
        return false;
    }
    if (spec_.writers[writer].outstanding != 0) {
        response_[writer].write(t, m.item);
    }
    --m.left;
    m.phase = Phase::Begin;
    return true;
}

} // namespace degs::test
