// SPDX-License-Identifier: Apache-2.0
#include "platform/at_requester.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "degs/messages.hpp"
#include "tlm/has_process.hpp"
#include "tlm/memory.hpp"
#include "tlm/urgent.hpp"

namespace degs {
namespace {

/// Takes away the extensions of a transaction, which belong to a port and to the transaction.
void drop_extensions(tlm::tlm_generic_payload& payload) {
    payload.set_extension<TimingOnly>(nullptr);
    payload.set_extension<Urgent>(nullptr);
    payload.set_extension<RequestInfo>(nullptr);
}

} // namespace

AtRequester::AtRequester(const sc_core::sc_module_name& name, tlm::tlm_initiator_socket<>& out,
                         const Limits& limits, StalledAccesses* stalled)
    : sc_core::sc_module(name), out_(out), limits_(limits), stalled_(stalled), answers_("answers") {
    if (limits.all == 0 || limits.per_rank == 0) {
        throw std::invalid_argument(std::string(this->name()) +
                                    ": outstanding transactions must be at least 1");
    }
    DEGS_HAS_PROCESS(AtRequester);
    SC_METHOD(resume);
    sensitive << request_over_;
    dont_initialize();
    SC_METHOD(finish);
    sensitive << answers_.get_event();
    dont_initialize();
}

// Transactions that are still in flight then must not free the extensions of a port.
AtRequester::~AtRequester() {
    for (const auto& transaction : transactions_) {
        drop_extensions(*transaction);
    }
}

void AtRequester::transport(unsigned rank, Payload& access, const std::vector<Piece>& pieces,
                            sc_core::sc_time& delay) {
    if (delay != sc_core::SC_ZERO_TIME) {
        sc_core::wait(delay, detaches_);
        delay = sc_core::SC_ZERO_TIME;
    }
    if (detached_) {
        access.set_response_status(tlm::TLM_OK_RESPONSE);
        return;
    }
    Access& waiter = take_idle();
    enqueue(waiter, rank, access, access.get_data_ptr(), pieces);
    while (waiter.left != 0) {
        sc_core::wait(waiter.over);
    }
    access.set_response_status(release(waiter));
    idle_.push_back(&waiter);
}

void AtRequester::start(unsigned rank, const Payload& access, const std::vector<Piece>& pieces,
                        Done done) {
    Access& waiter = take_idle();
    waiter.done = std::move(done);
    waiter.data.resize(access.get_data_length());
    if (access.is_write() && access.get_extension<TimingOnly>() == nullptr) {
        std::copy_n(access.get_data_ptr(), access.get_data_length(), waiter.data.begin());
    }
    enqueue(waiter, rank, access, waiter.data.data(), pieces);
}

AtRequester::Access& AtRequester::take_idle() {
    if (idle_.empty()) {
        accesses_.push_back(std::make_unique<Access>());
        idle_.push_back(accesses_.back().get());
    }
    Access& access = *idle_.back();
    idle_.pop_back();
    return access;
}

void AtRequester::enqueue(Access& waiter, unsigned rank, const Payload& access, unsigned char* data,
                          const std::vector<Piece>& pieces) {
    waiter.left = pieces.size();
    if (rank >= queues_.size()) {
        queues_.resize(rank + 1);
    }
    for (const Piece& piece : pieces) {
        Transaction& part = make(access, data, piece);
        part.access = &waiter;
        part.date = sc_core::sc_time_stamp().value();
        part.rank = rank;
        waiter.parts.push_back(&part);
        queues_[rank].waiting.push_back(&part);
    }
    send();
}

// Releases the parts of an access and returns its response: that of the first part that failed, or
// OK if none did.
tlm::tlm_response_status AtRequester::release(Access& waiter) {
    tlm::tlm_response_status status = tlm::TLM_OK_RESPONSE;
    for (Transaction* part : waiter.parts) {
        status = status == tlm::TLM_OK_RESPONSE ? part->get_response_status() : status;
        part->release();
    }
    waiter.parts.clear();
    return status;
}

void AtRequester::end(Access& waiter) {
    if (!waiter.done) {
        waiter.over.notify(sc_core::SC_ZERO_TIME);
        return;
    }
    const tlm::tlm_response_status status = release(waiter);
    std::exchange(waiter.done, nullptr)(status, waiter.data.data());
    idle_.push_back(&waiter);
}

// Makes the transaction of a piece. The access holds it until its response has been read.
AtRequester::Transaction& AtRequester::make(const Payload& access, unsigned char* data,
                                            const Piece& piece) {
    if (free_.empty()) {
        transactions_.push_back(std::make_unique<Transaction>());
        transactions_.back()->set_mm(this);
        free_.push_back(transactions_.back().get());
    }
    Transaction& part = *free_.back();
    free_.pop_back();
    part.acquire();
    part.sequence = sequence_++;
    part.by_phase = part.answered = false;
    part.piece = piece;
    part.data = data;
    part.set_command(access.get_command());
    part.burst.open(part, piece, data);
    part.set_extension(access.get_extension<TimingOnly>());
    part.set_extension(access.get_extension<Urgent>());
    if (const auto* const info = access.get_extension<RequestInfo>()) {
        part.info.copy_from(*info);
        part.set_extension(&part.info);
    }
    return part;
}

void AtRequester::free(Payload* payload) {
    drop_extensions(*payload);
    payload->reset();
    free_.push_back(static_cast<Transaction*>(payload));
}

void AtRequester::end_part(Transaction& transaction) {
    transaction.burst.close(transaction);
    if (--transaction.access->left == 0) {
        end(*transaction.access);
    }
}

void AtRequester::stall(Transaction& transaction) {
    stalled_->add({transaction.piece.address - transaction.piece.lead, transaction.info.stream,
                   transaction.get_response_status()},
                  [this, &transaction] { resume_part(transaction); });
}

// Sends another transaction in the place of a refused one, which its target may still hold. It goes
// before all others of its rank, which are younger.
void AtRequester::resume_part(Transaction& refused) {
    if (detached_) {
        refused.set_response_status(tlm::TLM_OK_RESPONSE);
        end_part(refused);
        return;
    }
    Transaction& part = make(refused, refused.data, refused.piece);
    part.access = refused.access;
    part.date = refused.date;
    part.rank = refused.rank;
    auto& parts = part.access->parts;
    *std::find(parts.begin(), parts.end(), &refused) = &part;
    refused.burst.close(refused);
    refused.release();
    queues_[part.rank].waiting.push_front(&part);
    send();
}

void AtRequester::detach() {
    detached_ = true;
    detaches_.notify(sc_core::SC_ZERO_TIME);
    for (Queue& queue : queues_) {
        for (Transaction* const transaction : std::exchange(queue.waiting, {})) {
            transaction->set_response_status(tlm::TLM_OK_RESPONSE);
            end_part(*transaction);
        }
    }
}

// The queue whose transaction goes out next: the oldest date first, of equal ones the lowest rank.
// Null if no transaction may go out.
AtRequester::Queue* AtRequester::next_queue() {
    Queue* next = nullptr;
    for (Queue& queue : queues_) {
        if (!queue.waiting.empty() && queue.under_way < limits_.per_rank &&
            (next == nullptr || queue.waiting.front()->date < next->waiting.front()->date)) {
            next = &queue;
        }
    }
    return next;
}

void AtRequester::send() {
    if (requesting_ != nullptr || under_way_ == limits_.all) {
        return;
    }
    Queue* const queue = next_queue();
    if (queue == nullptr) {
        return;
    }
    Transaction& next = *queue->waiting.front();
    queue->waiting.pop_front();
    ++queue->under_way;
    most_under_way_ = std::max(most_under_way_, ++under_way_);
    request(next);
}

void AtRequester::request(Transaction& transaction) {
    requesting_ = &transaction;
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    switch (out_->nb_transport_fw(transaction, phase, delay)) {
    case tlm::TLM_ACCEPTED:
        break;
    case tlm::TLM_UPDATED:
        take(transaction, phase, delay);
        break;
    case tlm::TLM_COMPLETED:
        answer(transaction, false, delay);
        break;
    }
}

tlm::tlm_sync_enum AtRequester::backward(Payload& payload, tlm::tlm_phase& phase,
                                         sc_core::sc_time& delay) {
    take(static_cast<Transaction&>(payload), phase, delay);
    return tlm::TLM_ACCEPTED;
}

// Phases that are not of the base protocol may be ignored.
void AtRequester::take(Transaction& transaction, const tlm::tlm_phase& phase,
                       const sc_core::sc_time& delay) {
    if (phase == tlm::END_REQ && requesting_ == &transaction) {
        end_request(delay);
    } else if (phase == tlm::BEGIN_RESP && !transaction.answered) {
        answer(transaction, true, delay);
    } else if (phase <= tlm::END_RESP) {
        const std::string text =
            std::string(name()) +
            ": a target sent a phase that the base protocol does not allow here";
        SC_REPORT_ERROR(reports::kProtocol, text.c_str());
    }
}

void AtRequester::end_request(const sc_core::sc_time& delay) {
    request_over_.notify(delay);
}

// Takes the response of a transaction. If its request phase is still open, that ends here, too.
void AtRequester::answer(Transaction& transaction, bool by_phase, const sc_core::sc_time& delay) {
    if (requesting_ == &transaction) {
        request_over_.cancel();
        end_request(sc_core::SC_ZERO_TIME);
    }
    transaction.by_phase = by_phase;
    transaction.answered = true;
    answers_.notify(transaction, delay);
}

void AtRequester::resume() {
    requesting_ = nullptr;
    send();
}

void AtRequester::finish() {
    while (Transaction* const transaction = answers_.get_next_transaction()) {
        if (transaction->by_phase) {
            tlm::tlm_phase phase = tlm::END_RESP;
            sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
            out_->nb_transport_fw(*transaction, phase, delay);
        }
        --under_way_;
        --queues_[transaction->rank].under_way;
        if (stalled_ != nullptr && !detached_ && transaction->is_response_error()) {
            stall(*transaction);
        } else {
            end_part(*transaction); // which may give it back
        }
    }
    send();
}

} // namespace degs
