// SPDX-License-Identifier: Apache-2.0
// When requests are taken in and answered; their data and counters are in payload.cpp.
#include "dram/lpddr5.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "degs/request_info.hpp"
#include "tlm/has_process.hpp"
#include "tlm/memory.hpp"
#include "tlm/scattered_records.hpp"
#include "tlm/urgent.hpp"

namespace degs::dram {
namespace {

double whole_ck_ps(const Config& config) {
    return std::round(1000 * config.timing.ck_ns());
}

std::size_t power_above(Ck value) {
    std::size_t power = 64;
    while (power <= value) {
        power *= 2;
    }
    return power;
}

} // namespace

Lpddr5::Lpddr5(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               std::size_t initiators)
    : sc_core::sc_module(name), in("in", initiators), config_(config), ck_(ck_time(config).value()),
      extra_(
          static_cast<Ck>(std::ceil(config.controller_latency_ns / config.timing.ck_ns() - 1e-9))),
      half_cycle_(sc_core::sc_time::from_value(time.clock.period().value() / 2)),
      activations_(time.activations), channels_(config), stats_(initiators),
      initiators_(initiators),
      // An answer lies at most a whole read or write, and the extra latency, ahead.
      answers_(power_above(config.timing.read_latency() + config.timing.write_latency() + extra_)) {
    for (std::size_t i = 0; i < initiators; ++i) {
        const auto tag = static_cast<int>(i);
        in[i].register_b_transport(this, &Lpddr5::transport, tag);
        in[i].register_nb_transport_fw(this, &Lpddr5::forward, tag);
        in[i].register_get_direct_mem_ptr(this, &Lpddr5::direct_memory, tag);
        in[i].register_transport_dbg(this, &Lpddr5::debug, tag);
    }
    DEGS_HAS_PROCESS(Lpddr5);
    SC_METHOD(serve);
    sensitive << serve_event_;
    dont_initialize();
    SC_METHOD(respond);
    sensitive << respond_event_ << resume_event_;
    dont_initialize();
}

sc_core::sc_time Lpddr5::ck_time(const Config& config) {
    return {whole_ck_ps(config), sc_core::SC_PS};
}

std::string Lpddr5::time_problem(const Config& config, const Timebase& time) {
    const double ps = whole_ck_ps(config);
    const sc_core::sc_time ck = ck_time(config);
    // A half is needed between two edges, at which all requests of the first are there.
    if (ck.value() >= 2 && std::abs(1e12 * ck.to_seconds() - ps) < 0.5 &&
        time.clock.period().value() >= 2) {
        return "";
    }
    return "the time resolution " + sc_core::sc_get_time_resolution().to_string() +
           " is too coarse for the command clock of " + config.name + ", " +
           std::to_string(static_cast<int>(ps)) + " ps; 1 ps, the default, is fine enough";
}

void Lpddr5::transport(int socket, Payload& payload, sc_core::sc_time& delay) {
    if (const auto status = check(payload); status != tlm::TLM_OK_RESPONSE) {
        payload.set_response_status(status);
        return;
    }
    const sc_core::sc_time date = sc_core::sc_time_stamp() + delay;
    Direct direct;
    Arrival arrival;
    arrival.date = date.value();
    arrival.socket = socket;
    arrival.sequence = initiators_[arrival.socket].sequence++;
    arrival.payload = &payload;
    arrival.direct = &direct;
    arrivals_.push_back(arrival);
    sc_core::wait(delay + half_cycle_);
    count_activation(activations_);
    if (!direct.served) {
        advance(arrival.date);
        schedule();
    }
    const sc_core::sc_time time = sc_core::sc_time_stamp();
    delay = direct.done > time ? direct.done - time : sc_core::SC_ZERO_TIME;
    count(arrival.socket, payload, date, time + delay);
    payload.set_dmi_allowed(config_.dmi);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

tlm::tlm_sync_enum Lpddr5::forward(int socket, Payload& payload, tlm::tlm_phase& phase,
                                   sc_core::sc_time& delay) {
    const std::uint32_t from = socket;
    if (phase == tlm::BEGIN_REQ) {
        if (const auto status = check(payload); status != tlm::TLM_OK_RESPONSE) {
            payload.set_response_status(status);
            return tlm::TLM_COMPLETED;
        }
        return begin_request(from, payload, phase, delay);
    }
    if (phase == tlm::END_RESP && initiators_[from].responding) {
        end_response(from, delay);
        return tlm::TLM_COMPLETED;
    }
    SC_REPORT_ERROR(name(), "an initiator sent a phase that the base protocol does not allow here");
    return tlm::TLM_ACCEPTED;
}

Lpddr5::Arrival Lpddr5::register_arrival(std::uint32_t socket, Payload& payload,
                                         const sc_core::sc_time& delay) {
    payload.acquire();
    std::uint32_t id = static_cast<std::uint32_t>(transactions_.size());
    if (free_.empty()) {
        transactions_.emplace_back();
    } else {
        id = free_.back();
        free_.pop_back();
    }
    Arrival arrival;
    arrival.date = now() + delay.value();
    arrival.socket = socket;
    arrival.sequence = initiators_[socket].sequence++;
    arrival.payload = &payload;
    arrival.id = id;
    transactions_[id] = {&payload, socket, arrival.sequence, sc_core::sc_time_stamp() + delay};
    arrivals_.push_back(arrival);
    return arrival;
}

tlm::tlm_sync_enum Lpddr5::begin_request(std::uint32_t socket, Payload& payload,
                                         tlm::tlm_phase& phase, const sc_core::sc_time& delay) {
    Initiator& initiator = initiators_[socket];
    if (initiator.held_back != nullptr) {
        SC_REPORT_ERROR(name(), "an initiator sent BEGIN_REQ before the END_REQ of its last one");
    }
    const Arrival arrival = register_arrival(socket, payload, delay);
    const unsigned limit = config_.waiting_requests;
    if (++initiator.waiting <= limit) {
        serve_by(channels_.due_of(payload.is_write(), ceil_ck(arrival.date)));
        phase = tlm::END_REQ;
        return tlm::TLM_UPDATED;
    }
    // The count may be behind, but only too high. Everything dated before now is certain.
    settle(now());
    const bool held_back = initiator.waiting > limit;
    if (held_back) {
        initiator.held_back = &payload;
        initiator.held_date = arrival.date;
        ++held_back_;
        channels_.watch_admissions(true);
    }
    schedule();
    phase = held_back ? phase : tlm::tlm_phase(tlm::END_REQ);
    return held_back ? tlm::TLM_ACCEPTED : tlm::TLM_UPDATED;
}

// Half a CK after an edge all requests dated up to that edge have been made.
void Lpddr5::serve() {
    count_activation(activations_);
    const std::uint64_t edge = now() / ck_ * ck_;
    advance(edge);
    release_held_back();
    schedule();
}

void Lpddr5::advance(std::uint64_t date) {
    const auto due = std::partition(arrivals_.begin(), arrivals_.end(),
                                    [date](const Arrival& a) { return a.date > date; });
    std::sort(due, arrivals_.end(), [](const Arrival& a, const Arrival& b) {
        return std::tie(a.date, a.socket, a.sequence) < std::tie(b.date, b.socket, b.sequence);
    });
    std::for_each(due, arrivals_.end(), [this](Arrival& a) { take_in(a); });
    const Ck known = date / ck_;
    channels_.run(known);
    predict(due, arrivals_.end(), known);
    arrivals_.erase(due, arrivals_.end());
    plan_answers();
}

void Lpddr5::take_in(Arrival& arrival) {
    Request request;
    request.date = ceil_ck(arrival.date);
    request.address = arrival.payload->get_address();
    request.bytes = arrival.payload->get_data_length();
    request.write = arrival.payload->is_write();
    request.urgent = !request.write && arrival.payload->get_extension<Urgent>() != nullptr;
    if (const auto* info = arrival.payload->get_extension<RequestInfo>()) {
        request.qos = static_cast<std::uint8_t>(std::min(info->qos, RequestInfo::kMostQos));
    }
    request.id = arrival.id;
    if (const auto* scattered = arrival.payload->get_extension<Scattered>()) {
        request.records = scattered->records;
    }
    if (arrival.direct != nullptr) {
        channels_.push_for_prediction(request);
    } else {
        channels_.push(request);
    }
    if (arrival.payload->get_extension<TimingOnly>() == nullptr) {
        copy(*arrival.payload);
    }
}

void Lpddr5::predict(std::vector<Arrival>::iterator first, std::vector<Arrival>::iterator last,
                     Ck known) {
    first = std::find_if(first, last, [](const Arrival& a) { return a.direct != nullptr; });
    if (first == last) {
        return;
    }
    const std::vector<Ck> dates = channels_.predict(known);
    for (std::size_t next = 0; first != last; ++first) {
        if (first->direct != nullptr) {
            first->direct->done = sc_core::sc_time::from_value((dates[next++] + extra_) * ck_);
            first->direct->served = true;
        }
    }
}

void Lpddr5::release_held_back() {
    if (held_back_ == 0) {
        return;
    }
    for (std::size_t i = 0; i < initiators_.size(); ++i) {
        Initiator& initiator = initiators_[i];
        if (initiator.held_back == nullptr ||
            initiator.waiting > static_cast<unsigned>(config_.waiting_requests)) {
            continue;
        }
        Payload* payload = initiator.held_back;
        initiator.held_back = nullptr;
        --held_back_;
        tlm::tlm_phase phase = tlm::END_REQ;
        const std::uint64_t early = std::max(initiator.held_date, now()) - now();
        sc_core::sc_time delay = sc_core::sc_time::from_value(early);
        in[i]->nb_transport_bw(*payload, phase, delay);
    }
    channels_.watch_admissions(held_back_ != 0);
}

void Lpddr5::plan_answers() {
    for (const std::uint32_t id : channels_.admitted()) {
        --initiators_[transactions_[id].socket].waiting;
    }
    channels_.admitted().clear();
    for (const Answer& answer : channels_.completed()) {
        // A channel is never run too late to answer in time; this guards the ring all the same.
        const Ck date = std::max({answer.date + extra_, answered_, ceil_ck(now())});
        answers_[date % answers_.size()].push_back(answer.id);
        ++answers_planned_;
    }
    if (!channels_.completed().empty()) {
        channels_.completed().clear();
        schedule_responses();
    }
}

void Lpddr5::schedule() {
    Ck due = channels_.due();
    for (const Arrival& arrival : arrivals_) {
        if (arrival.direct == nullptr) {
            due =
                std::min(due, channels_.due_of(arrival.payload->is_write(), ceil_ck(arrival.date)));
        }
    }
    serve_by(due);
}

void Lpddr5::serve_by(Ck due) {
    if (due < kNoDate) {
        const std::uint64_t time = due * ck_ + ck_ / 2;
        serve_event_.notify(sc_core::sc_time::from_value(time > now() ? time - now() : 0));
    }
}

void Lpddr5::schedule_responses() {
    const Ck next_edge = ceil_ck(now());
    for (Ck date = std::max(answered_, next_edge); answers_planned_ != 0; ++date) {
        if (!answers_[date % answers_.size()].empty()) {
            respond_event_.notify(sc_core::sc_time::from_value(date * ck_ - now()));
            return;
        }
    }
}

// Equal dates by socket, then in the order of its requests.
void Lpddr5::respond() {
    count_activation(activations_);
    const Ck date = now() / ck_;
    std::vector<std::uint32_t>& due = answers_[date % answers_.size()];
    std::sort(due.begin(), due.end(), [this](std::uint32_t a, std::uint32_t b) {
        return std::tie(transactions_[a].socket, transactions_[a].sequence) <
               std::tie(transactions_[b].socket, transactions_[b].sequence);
    });
    for (const std::uint32_t id : due) {
        initiators_[transactions_[id].socket].responses.push_back(id);
    }
    answers_planned_ -= due.size();
    due.clear();
    answered_ = date + 1;
    for (std::uint32_t i = 0; i < initiators_.size(); ++i) {
        if (!initiators_[i].responses.empty()) {
            send_responses(i);
        }
    }
    schedule_responses();
}

void Lpddr5::send_responses(std::uint32_t socket) {
    Initiator& initiator = initiators_[socket];
    while (!initiator.responding && !initiator.responses.empty()) {
        if (initiator.resume > sc_core::sc_time_stamp()) {
            resume_event_.notify(initiator.resume - sc_core::sc_time_stamp());
            return;
        }
        send_response(socket);
    }
}

void Lpddr5::send_response(std::uint32_t socket) {
    Initiator& initiator = initiators_[socket];
    const std::uint32_t id = initiator.responses.front();
    initiator.responses.pop_front();
    const Transaction transaction = transactions_[id];
    free_.push_back(id);
    Payload& payload = *transaction.payload;
    payload.set_dmi_allowed(config_.dmi);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    count(socket, payload, transaction.date, sc_core::sc_time_stamp());
    initiator.responding = true;
    tlm::tlm_phase phase = tlm::BEGIN_RESP;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    const auto answer = in[socket]->nb_transport_bw(payload, phase, delay);
    if (answer == tlm::TLM_COMPLETED || (answer == tlm::TLM_UPDATED && phase == tlm::END_RESP)) {
        initiator.responding = false;
        initiator.resume = sc_core::sc_time_stamp() + delay;
    }
    payload.release();
}

void Lpddr5::end_response(std::uint32_t socket, const sc_core::sc_time& delay) {
    Initiator& initiator = initiators_[socket];
    initiator.responding = false;
    initiator.resume = sc_core::sc_time_stamp() + delay;
    if (!initiator.responses.empty()) {
        resume_event_.notify(delay);
    }
}

} // namespace degs::dram
