// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_target_socket.h>

#include "dram/activity.hpp"
#include "dram/channels.hpp"
#include "dram/sparse_storage.hpp"
#include "dram/transfer_account.hpp"
#include "tlm/latency_histogram.hpp"
#include "tlm/process.hpp"

namespace degs::dram {

/// LPDDR5 main memory at bank level, for LT and AT initiators at once. One socket per initiator.
///
/// Requests are served in the order of their dates (kernel time plus annotated delay), ties broken
/// by socket index; contents change in the same order. A payload with the extension TimingOnly
/// takes time and moves no data; one with Scattered moves every record at its own address. Of a
/// payload with byte enables the enabled bytes move, in the time of all of them: whole bursts go
/// over the bus.
///
/// AT, the accurate path: four phases. END_REQ comes at once unless `waiting_requests` requests of
/// the initiator wait for room in the controllers' queues; then it is withheld until one has got
/// in, which is the only back-pressure. BEGIN_RESP comes at the date of the last beat (a posted
/// write: when the queues have it), one per socket at a time. Early completion is accepted. LT:
/// b_transport() returns half a cycle of `time` after the request's date with the rest of the
/// response time annotated: the answer that the present queues, banks and buses give if nothing
/// more comes.
///
/// Not modelled: the interconnect (every channel takes any number of requests per CK), and what
/// channel.hpp and timing.hpp leave out.
class Lpddr5 : public sc_core::sc_module {
public:
    struct Stats {
        std::uint64_t reads = 0, writes = 0;             ///< requests answered
        std::uint64_t bytes_read = 0, bytes_written = 0; ///< in whole bursts
        LatencyHistogram read_latency, write_latency;    ///< date of the request to its answer
        sc_core::sc_time last_answer;
        void describe(StatsVisitor& v) const;
    };

    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<Lpddr5>> in;

    Lpddr5(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
           std::size_t initiators);

    /// A CK in kernel time: a whole number of picoseconds, whatever the time resolution.
    static sc_core::sc_time ck_time(const Config& config);
    /// Why the resolution of the kernel's time does not hold a CK, or half a cycle of `time`, as a
    /// sentence without its end; empty if it does, so that dates are those of any finer one.
    static std::string time_problem(const Config& config, const Timebase& time);

    const Stats& stats(std::size_t initiator) const { return stats_[initiator]; }
    Stats total() const;
    /// All numbers of the memory up to now, and those of one initiator, whose requests count when
    /// they are answered.
    void describe(StatsVisitor& v);
    void describe(std::size_t initiator, StatsVisitor& v) const;
    /// Counters of all channels, up to now.
    Channel::Stats commands() { return commands(sc_core::sc_time_stamp()); }
    Energy energy() { return energy(sc_core::sc_time_stamp()); }
    /// Counters, energy and transfers up to another date, for a run that is over: it may end before
    /// or after the date at which the kernel had nothing left to do. `until` is not before the last
    /// request, and no request follows.
    Channel::Stats commands(const sc_core::sc_time& until);
    Energy energy(const sc_core::sc_time& until);
    TransferAccount transfers(const sc_core::sc_time& until);
    Activity activity(const sc_core::sc_time& until);
    const Channels& channels() const { return channels_; }
    /// Calls `observer` with every command. Set it before the simulation starts.
    void observe(const std::function<void(unsigned channel, const Issued&)>& observer);

private:
    using Payload = tlm::tlm_generic_payload;
    struct Transaction { // AT; its index is the id of its request
        Payload* payload = nullptr;
        std::uint32_t socket = 0;
        std::uint64_t sequence = 0; // in the socket
        sc_core::sc_time date;
    };
    struct Direct { // LT; lives on the stack of its caller
        sc_core::sc_time done;
        bool served = false;
    };
    struct Arrival {
        std::uint64_t date = 0; // kernel time units
        std::uint32_t socket = 0;
        std::uint64_t sequence = 0;
        Payload* payload = nullptr;
        Direct* direct = nullptr; // or, if null,
        std::uint32_t id = 0;
    };
    struct Initiator {
        std::uint64_t sequence = 0;
        unsigned waiting = 0;         // requests not yet in the queues
        Payload* held_back = nullptr; // with END_REQ withheld
        std::uint64_t held_date = 0;  // of it, kernel time units
        bool responding = false;      // between BEGIN_RESP and END_RESP
        sc_core::sc_time resume;      // the date of END_RESP
        std::deque<std::uint32_t> responses;
    };

    void transport(int socket, Payload& payload, sc_core::sc_time& delay);
    tlm::tlm_sync_enum forward(int socket, Payload& payload, tlm::tlm_phase& phase,
                               sc_core::sc_time& delay);
    bool direct_memory(int socket, Payload& payload, tlm::tlm_dmi& dmi);
    unsigned int debug(int socket, Payload& payload);

    Arrival register_arrival(std::uint32_t socket, Payload& payload, const sc_core::sc_time& delay);
    tlm::tlm_sync_enum begin_request(std::uint32_t socket, Payload& payload, tlm::tlm_phase& phase,
                                     const sc_core::sc_time& delay);
    void serve();
    void respond();
    /// Takes in all requests dated up to `date`, and runs the channels as far as they are known.
    void advance(std::uint64_t date);
    void take_in(Arrival& arrival);
    void predict(std::vector<Arrival>::iterator first, std::vector<Arrival>::iterator last,
                 Ck known);
    void release_held_back();
    void plan_answers();
    void send_responses(std::uint32_t socket);
    void send_response(std::uint32_t socket);
    void end_response(std::uint32_t socket, const sc_core::sc_time& delay);
    void schedule();
    void serve_by(Ck due);
    void schedule_responses();
    /// Everything dated before `date`, in kernel time units, is in the statistics; returns it in
    /// CK.
    Ck settle(std::uint64_t date);

    tlm::tlm_response_status check(const Payload& payload) const;
    void copy(const Payload& payload);
    void count(std::uint32_t socket, const Payload& payload, const sc_core::sc_time& date,
               const sc_core::sc_time& done);

    Ck ceil_ck(std::uint64_t units) const { return (units + ck_ - 1) / ck_; }
    static std::uint64_t now() { return sc_core::sc_time_stamp().value(); }

    Config config_;
    std::uint64_t ck_; // kernel time units
    Ck extra_;         // controller_latency_ns
    sc_core::sc_time half_cycle_;
    std::uint64_t* activations_; // see Timebase
    Channels channels_;
    SparseStorage storage_;
    std::vector<Stats> stats_;
    std::vector<Initiator> initiators_;
    unsigned held_back_ = 0; // initiators
    std::vector<Arrival> arrivals_;
    std::vector<Transaction> transactions_;
    std::vector<std::uint32_t> free_;
    std::vector<std::vector<std::uint32_t>> answers_; // ids by CK of the answer, a ring
    Ck answered_ = 0;                                 // all before this have been sent
    std::size_t answers_planned_ = 0;
    sc_core::sc_event serve_event_, respond_event_, resume_event_;
};

} // namespace degs::dram
