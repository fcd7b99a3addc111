// SPDX-License-Identifier: Apache-2.0
// A passive checker of the TLM-2.0 base protocol, written from IEEE 1666-2011.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm>

#include "tests/platform/protocol/payload_record.hpp"

namespace degs::test {

/// What a component can break, with the clauses of IEEE 1666-2011.
enum class Rule {
    Attributes,        ///< 14.7 to 14.17: set by the initiator before each call
    Extension,         ///< 14.21: a payload means the same without its extensions
    Constancy,         ///< 14.7: nothing changes while the transaction is under way
    Response,          ///< 14.17: set by the target when it answers, and left alone afterwards
    MemoryManager,     ///< 14.5: nb_transport needs one, and a reference that is held
    References,        ///< 14.5: given back after the transaction has ended, all of them
    Phase,             ///< 15.2.4: the order of the four phases, each from its own side
    OneResponse,       ///< 15.2.4: a transaction has one response
    RequestExclusion,  ///< 15.2.6: one request at a time
    ResponseExclusion, ///< 15.2.6: one response at a time
    Annotation,        ///< 15.2.7: dates fall neither within a channel nor during a call
    Unfinished         ///< a transaction that never ends
};

/// Stands between an initiator and a memory and passes every call on as it is; checks both and
/// records what they break.
///
/// Channels are that of requests (BEGIN_REQ, END_REQ) and that of responses (BEGIN_RESP, END_RESP).
/// A request that ends without END_REQ, by BEGIN_RESP or by TLM_COMPLETED, ends with that call,
/// whatever date it is annotated with. Phases that are not of the base protocol may be ignored, and
/// are. An interconnect may change addresses and belongs on the initiator's side.
class BaseProtocolMonitor : public sc_core::sc_module,
                            public tlm::tlm_fw_transport_if<>,
                            public tlm::tlm_bw_transport_if<> {
public:
    using Payload = tlm::tlm_generic_payload;
    tlm::tlm_target_socket<> in;
    tlm::tlm_initiator_socket<> out;
    /// Blocking calls reach the target without extensions, as they may.
    bool hides_extensions = false;

    explicit BaseProtocolMonitor(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in"), out("out") {
        in.bind(*this);
        out.bind(*this);
    }

    /// What was broken so far; with `ended`, transactions that have not ended and references that
    /// have not been given back count, too.
    std::vector<std::string> violations(bool ended = true) const {
        std::vector<std::string> all;
        for (const Violation& each : all_found(ended)) {
            all.push_back(each.text);
        }
        return all;
    }
    std::set<Rule> broken(bool ended = true) const {
        std::set<Rule> rules;
        for (const Violation& each : all_found(ended)) {
            rules.insert(each.rule);
        }
        return rules;
    }
    std::uint64_t blocking_calls() const { return blocking_calls_; }
    std::uint64_t requests() const { return requests_; }
    std::uint64_t debug_calls() const { return debug_calls_; }

private:
    using Time = sc_core::sc_time;
    struct Violation {
        Rule rule;
        std::string text;
    };
    enum class State { Request, Accepted, Response };
    struct Transaction {
        PayloadRecord record;
        State state;
        tlm::tlm_response_status status;
        bool managed; ///< has a memory manager
    };

    void b_transport(Payload& payload, Time& delay) override {
        ++blocking_calls_;
        check_request(payload);
        const PayloadRecord record(payload);
        const Time begin = sc_core::sc_time_stamp() + delay;
        if (hides_extensions) {
            const HiddenExtensions hidden(payload);
            out->b_transport(payload, delay);
        } else {
            out->b_transport(payload, delay);
        }
        expect(record.is_of(payload), Rule::Constancy,
               "the payload of a blocking call was changed");
        check_answer(payload);
        expect(sc_core::sc_time_stamp() + delay >= begin, Rule::Annotation,
               "a blocking call returned a date before its own");
    }

    unsigned int transport_dbg(Payload& payload) override {
        ++debug_calls_;
        expect(payload.is_read() || payload.is_write(), Rule::Attributes, "debug without command");
        expect(payload.get_data_ptr() != nullptr, Rule::Attributes, "debug without data");
        const unsigned int moved = out->transport_dbg(payload);
        expect(moved <= payload.get_data_length(), Rule::Response, "debug moved more than asked");
        return moved;
    }
    bool get_direct_mem_ptr(Payload& payload, tlm::tlm_dmi& dmi) override {
        return out->get_direct_mem_ptr(payload, dmi);
    }
    void invalidate_direct_mem_ptr(sc_dt::uint64 first, sc_dt::uint64 last) override {
        in->invalidate_direct_mem_ptr(first, last);
    }

    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       Time& delay) override {
        const tlm::tlm_phase sent = phase;
        const Time before = delay;
        pass(payload, phase, Side::Initiator, delay);
        const tlm::tlm_sync_enum sync = out->nb_transport_fw(payload, phase, delay);
        returned(payload, sync, {sent, before}, {phase, delay}, Side::Target);
        return sync;
    }
    tlm::tlm_sync_enum nb_transport_bw(Payload& payload, tlm::tlm_phase& phase,
                                       Time& delay) override {
        const tlm::tlm_phase sent = phase;
        const Time before = delay;
        pass(payload, phase, Side::Target, delay);
        const tlm::tlm_sync_enum sync = in->nb_transport_bw(payload, phase, delay);
        returned(payload, sync, {sent, before}, {phase, delay}, Side::Initiator);
        return sync;
    }

    enum class Side { Initiator, Target };
    struct Step {
        tlm::tlm_phase phase;
        Time delay;
    };

    /// A phase that was sent, by a call or by the return of one.
    void pass(Payload& payload, const tlm::tlm_phase& phase, Side from, const Time& delay) {
        if (phase > tlm::END_RESP) {
            return;
        }
        const Time date = sc_core::sc_time_stamp() + delay;
        const bool requests = phase == tlm::BEGIN_REQ || phase == tlm::END_REQ;
        const bool begins = phase == tlm::BEGIN_REQ || phase == tlm::BEGIN_RESP;
        if (phase == tlm::UNINITIALIZED_PHASE ||
            (begins == requests ? Side::Initiator : Side::Target) != from) {
            add(Rule::Phase, "a phase came from the wrong side");
        } else if (phase == tlm::BEGIN_REQ) {
            begin_request(payload, date);
        } else if (Transaction* const known = find(payload); known == nullptr) {
            const bool again = phase == tlm::BEGIN_RESP && answered_.count(&payload) != 0;
            add(again ? Rule::OneResponse : Rule::Phase, "a phase of no transaction under way");
        } else {
            expect(known->record.is_of(payload), Rule::Constancy,
                   "a payload was changed under way");
            phase == tlm::END_REQ      ? end_request(payload, *known, date)
            : phase == tlm::BEGIN_RESP ? begin_response(payload, *known, date)
                                       : end_response(payload, *known, date);
        }
    }

    void begin_request(Payload& payload, const Time& date) {
        ++requests_;
        check_request(payload);
        expect(requesting_ == nullptr, Rule::RequestExclusion,
               "BEGIN_REQ before the request before it was over");
        expect(payload.has_mm() && payload.get_ref_count() > 0, Rule::MemoryManager,
               "BEGIN_REQ without memory manager or reference");
        expect(find(payload) == nullptr, Rule::Phase, "BEGIN_REQ of a transaction under way");
        advance(request_date_, date);
        if (payload.has_mm() && !attach_lifetime(payload, lives_)) {
            add(Rule::References, "a payload came again before its references were given back");
        }
        if (payload.has_mm()) {
            lives_->held[&payload] = true;
        }
        requesting_ = &payload;
        answered_.erase(&payload);
        under_way_.erase(&payload);
        under_way_.emplace(&payload, Transaction{PayloadRecord(payload), State::Request,
                                                 tlm::TLM_INCOMPLETE_RESPONSE, payload.has_mm()});
    }
    void end_request(const Payload& payload, Transaction& transaction, const Time& date) {
        expect(transaction.state == State::Request, Rule::Phase,
               "END_REQ where no request is open");
        if (transaction.state == State::Request) {
            transaction.state = State::Accepted;
            release_request(payload);
            advance(request_date_, date);
        }
    }
    void begin_response(Payload& payload, Transaction& transaction, const Time& date) {
        if (transaction.state == State::Response) {
            add(Rule::OneResponse, "a second BEGIN_RESP");
            return;
        }
        expect(responding_ == nullptr, Rule::ResponseExclusion,
               "BEGIN_RESP before the response before it was over");
        release_request(payload);
        check_answer(payload);
        advance(response_date_, date);
        responding_ = &payload;
        transaction.state = State::Response;
        transaction.status = payload.get_response_status();
        settle(payload); // the initiator may let it go while it takes the answer
    }
    void end_response(const Payload& payload, const Transaction& transaction, const Time& date) {
        expect(transaction.state == State::Response, Rule::Phase, "END_RESP without BEGIN_RESP");
        if (transaction.state == State::Response) {
            expect(payload.get_response_status() == transaction.status, Rule::Response,
                   "the response was changed");
            advance(response_date_, date);
            finish(payload);
        }
    }

    void returned(Payload& payload, tlm::tlm_sync_enum sync, const Step& sent, const Step& back,
                  Side from) {
        const bool base = sent.phase <= tlm::END_RESP;
        const bool answers = sent.phase == tlm::BEGIN_REQ || sent.phase == tlm::BEGIN_RESP;
        if (sync == tlm::TLM_ACCEPTED) {
            check_kept(payload);
            return;
        }
        expect(back.delay >= sent.delay, Rule::Annotation, "a call returned a date before its own");
        if (sync == tlm::TLM_UPDATED) {
            expect(!base || answers, Rule::Phase, "TLM_UPDATED where no phase follows");
            pass(payload, back.phase, from, back.delay);
            check_kept(payload);
        } else if (base) {
            complete(payload, sent.phase, from);
        }
    }
    void complete(const Payload& payload, const tlm::tlm_phase& sent, Side from) {
        if (sent == tlm::END_RESP) {
            return; // it has ended
        }
        expect(sent != tlm::END_REQ, Rule::Phase, "TLM_COMPLETED in answer to END_REQ");
        Transaction* const known = find(payload);
        if (known == nullptr) {
            return;
        }
        if (from == Side::Target) {
            check_answer(payload);
            expect(known->record.is_of(payload), Rule::Constancy,
                   "a payload was changed under way");
            release_request(payload);
        }
        finish(payload);
    }
    void finish(const Payload& payload) {
        responding_ = responding_ == &payload ? nullptr : responding_;
        under_way_.erase(&payload);
        answered_.insert(&payload);
        settle(payload);
    }
    /// References may all be given back from now on.
    void settle(const Payload& payload) {
        const auto held = lives_->held.find(&payload);
        if (held != lives_->held.end()) {
            held->second = false;
        }
    }
    void release_request(const Payload& payload) {
        requesting_ = requesting_ == &payload ? nullptr : requesting_;
    }

    void check_request(const Payload& payload) {
        const bool empty = payload.get_data_length() == 0 || payload.get_data_ptr() == nullptr;
        expect(!empty && payload.get_streaming_width() != 0, Rule::Attributes,
               "an access without data, length or streaming width");
        expect(payload.get_byte_enable_ptr() == nullptr || payload.get_byte_enable_length() != 0,
               Rule::Attributes, "byte enables without length");
        expect(!payload.is_dmi_allowed(), Rule::Attributes, "the DMI hint is set at a request");
        expect(payload.get_response_status() == tlm::TLM_INCOMPLETE_RESPONSE, Rule::Attributes,
               "the response is set at a request");
        expect(payload.is_read() || payload.is_write(), Rule::Extension,
               "without its extensions a request means nothing");
    }
    void check_answer(const Payload& payload) {
        expect(payload.get_response_status() != tlm::TLM_INCOMPLETE_RESPONSE, Rule::Response,
               "an answer without response");
    }
    /// A transaction under way is still held by somebody.
    void check_kept(const Payload& payload) {
        const Transaction* const known = find(payload);
        expect(known == nullptr || !known->managed || lives_->held.count(&payload) != 0,
               Rule::References, "the last reference was given back under way");
    }
    void advance(Time& channel, const Time& date) {
        expect(date >= channel, Rule::Annotation, "the dates of a channel fell");
        channel = std::max(channel, date);
    }

    Transaction* find(const Payload& payload) {
        const auto found = under_way_.find(&payload);
        return found == under_way_.end() ? nullptr : &found->second;
    }
    void add(Rule rule, const char* text) {
        if (found_.size() < kMost) {
            found_.push_back({rule, std::string(name()) + ", " +
                                        sc_core::sc_time_stamp().to_string() + ": " + text});
        }
    }
    void expect(bool good, Rule rule, const char* text) {
        if (!good) {
            add(rule, text);
        }
    }
    std::vector<Violation> all_found(bool ended) const {
        std::vector<Violation> all = found_;
        for (std::size_t i = 0; i < lives_->early; ++i) {
            all.push_back({Rule::References, "the last reference was given back under way"});
        }
        for (std::size_t i = 0; ended && i < under_way_.size(); ++i) {
            all.push_back({Rule::Unfinished, "a transaction has not ended"});
        }
        for (const auto& [payload, held] : lives_->held) {
            if (ended && under_way_.count(payload) == 0) {
                all.push_back({Rule::References, "a reference was not given back"});
            }
        }
        return all;
    }

    static constexpr std::size_t kMost = 100;
    std::vector<Violation> found_;
    std::map<const Payload*, Transaction> under_way_;
    std::set<const Payload*> answered_;
    std::shared_ptr<PayloadLives> lives_ = std::make_shared<PayloadLives>();
    const Payload* requesting_ = nullptr;
    const Payload* responding_ = nullptr;
    Time request_date_, response_date_;
    std::uint64_t blocking_calls_ = 0, requests_ = 0, debug_calls_ = 0;
};

} // namespace degs::test
