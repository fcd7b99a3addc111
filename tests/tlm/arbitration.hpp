// SPDX-License-Identifier: Apache-2.0
// Random systems in which order in time decides: writers, arbiters, a server, responses; as dated
// processes. arbitration_reference.hpp has the same without SystemC.
#pragma once

#include <deque>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/tlm/script.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs::test {

struct Item {
    int writer = 0;
    int index = 0;
};

/// One thing that a process did. Systems are equal if all logs are.
struct Event {
    Cycle date = 0;
    int writer = 0;
    int index = 0;
    int note = 0;
    bool operator==(const Event& o) const {
        return date == o.date && writer == o.writer && index == o.index && note == o.note;
    }
};
using Logs = std::vector<std::vector<Event>>; // one per process: writers, arbiters, server

struct RingSpec {
    int depth = 1;
    Cycle forward = 1, release = 0;
};

/// A process that produces items, perhaps fed by another one and perhaps waiting for responses.
struct WriterSpec {
    Cycle longest_gap = 4; ///< cycles before each item, uniform
    int burst = 1;         ///< items; every other burst has no gaps
    bool fed = false;
    int outstanding = 0; ///< requests without a response; 0: no responses
    bool polls = false;  ///< takes responses that have arrived, before each item
    RingSpec feed, request, response;
};

struct ArbiterSpec {
    bool round_robin = false; ///< else the earliest head; ties by port in both
    Cycle longest_service = 2;
    Cycle tick = 0; ///< > 0: does something of its own after so many idle cycles
    RingSpec out;
};

/// `groups` arbiters with the writers dealt out to them; with two, a third arbiter merges them.
struct SystemSpec {
    std::uint64_t seed = 0;
    int items = 60; ///< per writer
    int groups = 1;
    bool spread = false; ///< writers spread their items over both groups, as a crossbar does
    std::vector<WriterSpec> writers;
    ArbiterSpec arbiters[3];
    Cycle longest_server = 2;

    int arbiter_count() const { return groups == 1 ? 1 : 3; }
    int total() const { return items * static_cast<int>(writers.size()); }
    Cycle gap(int writer, int index) const {
        const WriterSpec& w = writers[static_cast<std::size_t>(writer)];
        return index / w.burst % 2 != 0 ? 0
                                        : mix(seed, 1, static_cast<std::uint64_t>(writer),
                                              static_cast<std::uint64_t>(index)) %
                                              (w.longest_gap + 1);
    }
    Cycle feed_gap(int writer, int index) const { return gap(writer, index + 1000); }
    /// `who` 0..2: arbiters, 3: server.
    Cycle service(int who, const Item& item) const {
        const Cycle longest =
            who == 3 ? longest_server : arbiters[static_cast<std::size_t>(who)].longest_service;
        return mix(seed, 2 + static_cast<std::uint64_t>(who),
                   static_cast<std::uint64_t>(item.writer),
                   static_cast<std::uint64_t>(item.index)) %
               (longest + 1);
    }
    /// The arbiter that gets the item.
    int target(int writer, int index) const {
        return !spread ? writer % groups
                       : static_cast<int>(mix(seed, 9, static_cast<std::uint64_t>(writer),
                                              static_cast<std::uint64_t>(index)) %
                                          2);
    }
    int items_of(int arbiter) const {
        int count = 0;
        for (int w = 0; w < static_cast<int>(writers.size()); ++w) {
            for (int i = 0; i < items; ++i) {
                count += arbiter == 2 || target(w, i) == arbiter ? 1 : 0;
            }
        }
        return count;
    }
    /// Every writer has a request ring to every lower arbiter, used or not.
    std::size_t request_ring(int writer, int arbiter) const {
        return static_cast<std::size_t>(writer * groups + arbiter);
    }
    /// Inputs of an arbiter: request rings, or for the third one the two lower arbiters.
    std::vector<std::size_t> inputs_of(int arbiter) const {
        if (arbiter == 2) {
            return {0, 1};
        }
        std::vector<std::size_t> list;
        for (int w = 0; w < static_cast<int>(writers.size()); ++w) {
            if (spread || w % groups == arbiter) {
                list.push_back(request_ring(w, arbiter));
            }
        }
        return list;
    }
    int last_arbiter() const { return groups == 1 ? 0 : 2; }
};

inline SystemSpec random_system(std::mt19937& random) {
    const auto upto = [&](unsigned n) { return static_cast<int>(random() % (n + 1)); };
    const auto ring = [&](int least_forward) {
        RingSpec r;
        r.depth = 1 + (random() % 3 == 0 ? upto(20) : upto(3));
        r.forward = static_cast<Cycle>(least_forward + (random() % 2 == 0 ? 0 : upto(5)));
        r.release = static_cast<Cycle>(upto(2));
        return r;
    };
    SystemSpec s;
    s.seed = random();
    s.groups = 1 + upto(1);
    s.spread = s.groups == 2 && random() % 2 == 0;
    const int writers = 2 * s.groups + upto(2);
    const bool closed = random() % 2 == 0;
    for (int w = 0; w < writers; ++w) {
        WriterSpec spec;
        spec.longest_gap = static_cast<Cycle>(upto(random() % 2 == 0 ? 3 : 40));
        spec.burst = 1 + upto(10);
        spec.fed = random() % 3 == 0;
        spec.outstanding = closed ? 1 + upto(15) : 0;
        spec.polls = closed && random() % 2 == 0;
        spec.feed = ring(0);
        spec.request = ring(1);
        spec.response = ring(1);
        spec.response.depth = spec.outstanding + 1; // the server never waits: no deadlock
        s.writers.push_back(spec);
    }
    for (ArbiterSpec& a : s.arbiters) {
        a.round_robin = random() % 2 == 0;
        a.longest_service = static_cast<Cycle>(upto(4));
        a.tick = random() % 3 == 0 ? static_cast<Cycle>(1 + upto(20)) : 0;
        a.out = ring(1);
    }
    s.longest_server = static_cast<Cycle>(upto(random() % 2 == 0 ? 1 : 12));
    return s;
}

/// The arbiter's written rule; `heads[i]` is the date of input i's oldest item or kNever.
inline int choose(const std::vector<Cycle>& heads, Cycle now, bool round_robin, int& cursor) {
    const int n = static_cast<int>(heads.size());
    int best = -1;
    for (int step = 0; step < n; ++step) {
        const int i = round_robin ? (cursor + step) % n : step;
        const Cycle head = heads[static_cast<std::size_t>(i)];
        if (head <= now &&
            (best < 0 || (!round_robin && head < heads[static_cast<std::size_t>(best)]))) {
            best = i;
        }
    }
    cursor = best < 0 ? cursor : best + 1;
    return best;
}

/// The system as dated processes.
class DatedSystem {
public:
    DatedSystem(const std::string& name, const SystemSpec& spec, Fidelity fidelity);
    const Logs& logs() const { return logs_; }

private:
    using Ring = DatedFifo<Item>;
    Ring* ring(const RingSpec& r) {
        rings_.push_back(
            std::make_unique<Ring>((name_ + "_ring" + std::to_string(rings_.size())).c_str(), time_,
                                   static_cast<std::size_t>(r.depth), r.forward, r.release));
        return rings_.back().get();
    }
    template <class Body>
    Process& process(Body body) {
        processes_.push_back(std::make_unique<Process>(time_));
        Process& self = *processes_.back();
        scripts_.push_back(std::make_unique<Script>(
            (name_ + "_process" + std::to_string(scripts_.size())).c_str(), [body, &self] {
                body(self);
                self.finish();
            }));
        return self;
    }
    void log(std::size_t who, const Process& self, const Item& item, int note) {
        logs_[who].push_back({self.local(), item.writer, item.index, note});
    }
    void write(int w, Process& self);
    void arbitrate(int a, Process& self);
    void serve(Process& self);

    std::string name_;
    SystemSpec spec_;
    Timebase time_;
    Logs logs_;
    std::vector<std::unique_ptr<Ring>> rings_;
    std::vector<Ring*> feed_, request_, response_, out_;
    std::vector<std::unique_ptr<Process>> processes_;
    std::vector<std::unique_ptr<Script>> scripts_;
};

inline DatedSystem::DatedSystem(const std::string& name, const SystemSpec& spec, Fidelity fidelity)
    : name_(name), spec_(spec), time_{ClockDomain(1.0), fidelity}, logs_(spec.writers.size() + 4) {
    for (std::size_t w = 0; w < spec_.writers.size(); ++w) {
        const WriterSpec& writer = spec_.writers[w];
        feed_.push_back(ring(writer.feed));
        for (int group = 0; group < spec_.groups; ++group) {
            request_.push_back(ring(writer.request));
        }
        response_.push_back(ring(writer.response));
    }
    for (int a = 0; a < spec_.arbiter_count(); ++a) {
        out_.push_back(ring(spec_.arbiters[a].out));
    }
    for (std::size_t w = 0; w < spec_.writers.size(); ++w) {
        const int number = static_cast<int>(w);
        if (spec_.writers[w].fed) {
            feed_[w]->connect_writer(process([this, w, number](Process& self) {
                for (int i = 0; i < spec_.items; ++i) {
                    self.advance(spec_.feed_gap(number, i));
                    feed_[w]->put(self, {number, i});
                }
            }));
        }
        Process& self = process([this, number](Process& p) { write(number, p); });
        for (int group = 0; group < spec_.groups; ++group) {
            request_[spec_.request_ring(number, group)]->connect_writer(self);
        }
        response_[w]->connect_reader(self);
    }
    for (int a = 0; a < spec_.arbiter_count(); ++a) {
        Process& self = process([this, a](Process& p) { arbitrate(a, p); });
        out_[static_cast<std::size_t>(a)]->connect_writer(self);
        for (const std::size_t input : spec_.inputs_of(a)) {
            (a == 2 ? out_ : request_)[input]->connect_reader(self);
        }
    }
    Process& server = process([this](Process& p) { serve(p); });
    for (Ring* response : response_) {
        response->connect_writer(server);
    }
}

inline void DatedSystem::write(int w, Process& self) {
    const auto number = static_cast<std::size_t>(w);
    const WriterSpec& spec = spec_.writers[number];
    int outstanding = 0;
    for (int i = 0; i < spec_.items; ++i) {
        if (spec.fed) {
            feed_[number]->get(self);
        }
        self.advance(spec_.gap(w, i));
        while (spec.polls && self.arrived(*response_[number])) {
            response_[number]->take(self);
            --outstanding;
        }
        log(number, self, {w, i}, outstanding);
        if (spec.outstanding != 0 && outstanding == spec.outstanding) {
            response_[number]->get(self);
            --outstanding;
        }
        request_[spec_.request_ring(w, spec_.target(w, i))]->put(self, {w, i});
        log(number, self, {w, i}, -1);
        ++outstanding;
    }
}

inline void DatedSystem::arbitrate(int a, Process& self) {
    const ArbiterSpec& spec = spec_.arbiters[a];
    const std::size_t who = spec_.writers.size() + static_cast<std::size_t>(a);
    std::vector<Ring*> in;
    std::vector<FifoBase*> inputs;
    for (const std::size_t input : spec_.inputs_of(a)) {
        in.push_back((a == 2 ? out_ : request_)[input]);
        inputs.push_back(in.back());
    }
    int cursor = 0;
    for (int left = spec_.items_of(a); left > 0;) {
        const Cycle limit = spec.tick == 0 ? kNever : self.local() + spec.tick;
        self.advance_to(self.next_arrival(inputs.data(), inputs.size(), self.local(), limit));
        std::vector<Cycle> heads;
        for (const Ring* ring : in) {
            heads.push_back(ring->empty() ? kNever : ring->head_date());
        }
        const int port = choose(heads, self.local(), spec.round_robin, cursor);
        if (port < 0) {
            log(who, self, {}, -2);
            self.advance();
            continue;
        }
        const Item item = in[static_cast<std::size_t>(port)]->take(self);
        log(who, self, item, port);
        self.advance(spec_.service(a, item));
        out_[static_cast<std::size_t>(a)]->put(self, item);
        log(who, self, item, -1);
        --left;
    }
}

inline void DatedSystem::serve(Process& self) {
    for (int i = 0; i < spec_.total(); ++i) {
        const Item item = out_[static_cast<std::size_t>(spec_.last_arbiter())]->get(self);
        log(spec_.writers.size() + 3, self, item, 0);
        self.advance(spec_.service(3, item));
        if (spec_.writers[static_cast<std::size_t>(item.writer)].outstanding != 0) {
            response_[static_cast<std::size_t>(item.writer)]->put(self, item);
        }
    }
}

} // namespace degs::test
