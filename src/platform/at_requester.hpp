// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/peq_with_get.h>

#include "degs/request_info.hpp"
#include "platform/full_burst.hpp"
#include "platform/stalled_accesses.hpp"

namespace degs {

/// Performs blocking accesses of several processes over one socket, with the four phases of the
/// TLM-2.0 base protocol, for AT targets without b_transport().
///
/// BEGIN_REQ goes out at the date of the access without annotated delay, one at a time. The next
/// one follows when END_REQ, an answer or early completion has ended the request phase. The oldest
/// date goes first; ties are broken by rank. At most Limits::all transactions are in flight, and of
/// one rank at most Limits::per_rank; a rank at its limit does not hold back the others. Answers
/// may come in any order and with any kind of ending; END_RESP is sent at the date of the answer.
///
/// Not modelled: time of the phases on this side.
class AtRequester : public sc_core::sc_module, private tlm::tlm_mm_interface {
public:
    using Payload = tlm::tlm_generic_payload;
    using Piece = AccessPiece;

    /// Transactions in flight at a time; at least 1.
    struct Limits {
        unsigned all = 64;
        unsigned per_rank = ~0U;
    };

    /// Sends through `out`, whose nb_transport_bw() must call backward(). Transactions that are
    /// refused wait in `stalled`; without it they are done. Throws std::invalid_argument if a limit
    /// is 0.
    AtRequester(const sc_core::sc_module_name& name, tlm::tlm_initiator_socket<>& out,
                const Limits& limits, StalledAccesses* stalled = nullptr);
    ~AtRequester() override;

    /// Must be called from a thread, as b_transport(); returns when all pieces are answered. The
    /// response is that of the first piece that failed, in the order of the pieces, or OK.
    void transport(unsigned rank, Payload& access, const std::vector<Piece>& pieces,
                   sc_core::sc_time& delay);
    /// Starts an access without waiting. The bytes of a write are copied, unless they mean nothing
    /// (TimingOnly). `done` is called, outside of any thread, when all pieces are answered, with
    /// the bytes as the pieces number them.
    using Done = std::function<void(tlm::tlm_response_status, const unsigned char* data)>;
    void start(unsigned rank, const Payload& access, const std::vector<Piece>& pieces, Done done);
    tlm::tlm_sync_enum backward(Payload& payload, tlm::tlm_phase& phase, sc_core::sc_time& delay);

    /// Accesses end now, without the transactions of theirs that are not on the bus yet, and the
    /// others when these are answered; attach() ends this.
    void detach();
    void attach() { detached_ = false; }

    std::uint64_t transactions() const { return sequence_; }
    /// Largest number of transactions in flight at a time so far.
    unsigned most_under_way() const { return most_under_way_; }

private:
    struct Transaction;
    struct Access { // kept for the next one, because events are expensive
        sc_core::sc_event over;
        std::vector<Transaction*> parts;
        std::size_t left = 0;            // parts that are not answered
        Done done;                       // of an access that nobody waits for
        std::vector<unsigned char> data; // of an access that nobody waits for
    };
    struct Transaction : Payload {
        Access* access = nullptr;
        std::uint64_t date = 0; // kernel time units
        unsigned rank = 0;
        std::uint64_t sequence = 0;
        bool by_phase = false; // answered with BEGIN_RESP, so END_RESP is due
        bool answered = false;
        FullBurst burst;
        RequestInfo info; // of the access, for as long as a target holds the transaction
        Piece piece;
        unsigned char* data = nullptr; // of the access
    };
    struct Queue { // of a rank, in the order of dates
        std::deque<Transaction*> waiting;
        unsigned under_way = 0;
    };
    Queue* next_queue();
    Access& take_idle();
    void enqueue(Access& waiter, unsigned rank, const Payload& access, unsigned char* data,
                 const std::vector<Piece>& pieces);
    static tlm::tlm_response_status release(Access& waiter);
    void end(Access& waiter);
    Transaction& make(const Payload& access, unsigned char* data, const Piece& piece);
    void free(Payload* payload) override;
    void end_part(Transaction& transaction);
    void stall(Transaction& transaction);
    void resume_part(Transaction& refused);
    void send();
    void request(Transaction& transaction);
    void take(Transaction& transaction, const tlm::tlm_phase& phase, const sc_core::sc_time& delay);
    void end_request(const sc_core::sc_time& delay);
    void answer(Transaction& transaction, bool by_phase, const sc_core::sc_time& delay);
    void resume();
    void finish();

    tlm::tlm_initiator_socket<>& out_;
    Limits limits_;
    StalledAccesses* stalled_;
    bool detached_ = false;
    sc_core::sc_event detaches_;
    unsigned under_way_ = 0, most_under_way_ = 0;
    std::uint64_t sequence_ = 0;
    std::vector<Queue> queues_;         // by rank
    Transaction* requesting_ = nullptr; // the one whose request phase is not over
    sc_core::sc_event request_over_;
    tlm_utils::peq_with_get<Transaction> answers_;
    std::vector<Transaction*> free_;
    std::vector<std::unique_ptr<Transaction>> transactions_; // all there are
    std::vector<std::unique_ptr<Access>> accesses_;          // all there are
    std::vector<Access*> idle_;
};

} // namespace degs
