// SPDX-License-Identifier: Apache-2.0
#include "platform/memory_gateway.hpp"

#include <algorithm>
#include <stdexcept>

#include "platform/full_burst.hpp"
#include "tlm/scattered_records.hpp"
#include "tlm/set_access.hpp"

namespace degs {

namespace {

bool is_power_of_two_from_4(std::uint64_t value) {
    return value >= 4 && (value & (value - 1)) == 0;
}

/// Gives a payload its RequestInfo, and takes it away before the payload frees it.
class Informed {
public:
    Informed(tlm::tlm_generic_payload& payload, RequestStream stream, std::uint32_t qos)
        : payload_(payload) {
        info_.stream = stream;
        info_.qos = qos;
        payload_.set_extension(&info_);
    }
    Informed(const Informed&) = delete;
    Informed& operator=(const Informed&) = delete;
    ~Informed() { payload_.clear_extension(&info_); }

private:
    tlm::tlm_generic_payload& payload_;
    RequestInfo info_;
};

} // namespace

MemoryGateway::MemoryGateway(const sc_core::sc_module_name& name)
    : MemoryGateway(name, Options()) {}

MemoryGateway::MemoryGateway(const sc_core::sc_module_name& name, const Options& options,
                             const ClockDomain& clock)
    : sc_core::sc_module(name), out("out"), in_("in"), options_(options), clock_(clock),
      pacer_(options.transport == Transport::At ? Pacing::Exact : options.pacing, clock),
      in_flight_(options.lt_outstanding) {
    if (const std::string wrong = problem(options); !wrong.empty()) {
        throw std::invalid_argument(std::string(this->name()) + ": " + wrong);
    }
    if (options.transport == Transport::At) {
        requester_ = std::make_unique<AtRequester>(
            "requester", out,
            AtRequester::Limits{options.outstanding, options.outstanding_per_stream},
            options.faults == RefusedAccess::Stall ? &stalled_ : nullptr);
        out.register_nb_transport_bw(this, &MemoryGateway::backward);
    }
}

std::string MemoryGateway::problem(const Options& options) {
    const std::uint64_t burst = options.burst_bytes;
    const std::uint64_t boundary = options.boundary_bytes;
    if (burst != 0 && !is_power_of_two_from_4(burst)) {
        return "memory.burst_bytes is " + std::to_string(burst) +
               ", but must be a power of two from 4 on, or 0";
    }
    if (boundary != 0 && !is_power_of_two_from_4(boundary)) {
        return "memory.boundary_bytes is " + std::to_string(boundary) +
               ", but must be a power of two from 4 on, or 0";
    }
    if (options.burst_ends == BurstEnds::FullBursts && boundary != 0 && boundary < burst) {
        return "memory.burst_ends are full bursts of " + std::to_string(burst) +
               " bytes, which cross the multiples of memory.boundary_bytes, " +
               std::to_string(boundary);
    }
    if (options.qos > RequestInfo::kMostQos) {
        return "memory.qos is " + std::to_string(options.qos) + ", but must be at most " +
               std::to_string(RequestInfo::kMostQos);
    }
    if (burst == 0 && options.burst_ends == BurstEnds::FullBursts) {
        return "memory.burst_ends are full bursts, but memory.burst_bytes is 0, which cuts no "
               "access into bursts";
    }
    if (options.transport == Transport::At &&
        (options.outstanding == 0 || options.outstanding_per_stream == 0)) {
        return std::string("memory.outstanding") + (options.outstanding == 0 ? "" : "_per_stream") +
               " is 0, but an AT memory needs at least 1 transaction in flight";
    }
    if (options.lt_outstanding != 0 && burst == 0) {
        return "memory.lt_outstanding is " + std::to_string(options.lt_outstanding) +
               ", but memory.burst_bytes is 0, which makes one transaction of any access";
    }
    return "";
}

void MemoryGateway::connect(const std::vector<MemoryStream>& streams) {
    in_.init(streams.size());
    traffic_.resize(streams.size());
    int tag = 0;
    for (const MemoryStream& stream : streams) {
        in_[tag].register_b_transport(this, &MemoryGateway::serve, tag);
        in_[tag].register_transport_dbg(this, &MemoryGateway::debug_of, tag);
        stream.port->out.bind(in_[tag++]);
        streams_.push_back(request_stream(stream.kind.name));
        of_scene_.push_back(scene_ && stream.kind.data == StreamData::Scene);
        if (of_scene_.back()) {
            stream.port->observe_reads(scene_);
        }
        if (requester_) {
            stream.port->accept_late_answers();
        }
    }
}

std::vector<std::string> MemoryGateway::explain() const {
    return {"The memory belongs to the platform: its peak, its occupation and its energy are not "
            "known here."};
}

tlm::tlm_sync_enum MemoryGateway::backward(tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                           sc_core::sc_time& delay) {
    return requester_->backward(payload, phase, delay);
}

void MemoryGateway::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    const Informed informed(payload, RequestStream::SceneLoad, options_.qos);
    access(static_cast<unsigned>(traffic_.size()), payload, delay);
}

void MemoryGateway::serve(int port, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    pacer_.await_turn(static_cast<unsigned>(port), delay);
    const Informed informed(payload, streams_[port], options_.qos);
    MemoryTraffic& traffic = traffic_[port];
    (payload.is_read() ? traffic.reads : traffic.writes)++;
    (payload.is_read() ? traffic.bytes_read : traffic.bytes_written) += bus_bytes(payload);
    auto* const late = payload.get_extension<MayAnswerLate>();
    if (requester_ && late != nullptr && !detached_) {
        late->answer = start(port, payload);
    } else {
        access(static_cast<unsigned>(port), payload, delay);
        pacer_.settle(delay);
        note(payload.get_response_status());
    }
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

void MemoryGateway::note(tlm::tlm_response_status status) {
    if (status != tlm::TLM_OK_RESPONSE) {
        first_error_ = errors_++ == 0 ? status : first_error_;
    }
}

// Starts an access without waiting for it, so that the stream goes on. The answer comes when the
// last piece is answered.
std::shared_ptr<LateAnswer> MemoryGateway::start(int port,
                                                 const tlm::tlm_generic_payload& payload) {
    auto answer = std::make_shared<LateAnswer>();
    const Pieces pieces = cut(payload);
    ++under_way_;
    const bool observed = payload.is_read() && of_scene_[port];
    requester_->start(static_cast<unsigned>(port), payload, pieces,
                      [this, answer, seen = observed ? pieces : Pieces()](
                          tlm::tlm_response_status status, const unsigned char* data) {
                          note(status);
                          for (const AccessPiece& piece : seen) {
                              scene_(piece.address, data + piece.offset, piece.bytes);
                          }
                          end_access(sc_core::SC_ZERO_TIME);
                          answer->come(clock_.ceil(sc_core::sc_time_stamp()));
                      });
    return answer;
}

void MemoryGateway::access(unsigned rank, tlm::tlm_generic_payload& payload,
                           sc_core::sc_time& delay) {
    if (detached_) {
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
        return;
    }
    ++under_way_;
    if (requester_) {
        requester_->transport(rank, payload, cut(payload), delay);
    } else if (is_one_transaction(payload)) {
        send(rank, payload, delay);
    } else {
        access_pieces(rank, payload, cut(payload), delay);
    }
    end_access(delay);
}

// Bytes of the transactions that an access becomes.
std::uint64_t MemoryGateway::bus_bytes(const tlm::tlm_generic_payload& access) const {
    if (options_.burst_ends == BurstEnds::Pieces) {
        return access.get_data_length();
    }
    std::uint64_t bytes = 0;
    for (const AccessPiece& piece : cut(access)) {
        bytes += piece.length();
    }
    return bytes;
}

bool MemoryGateway::is_one_transaction(const tlm::tlm_generic_payload& access) const {
    const std::uint64_t boundary = options_.boundary_bytes;
    return options_.burst_bytes == 0 && access.get_extension<Scattered>() == nullptr &&
           (boundary == 0 ||
            access.get_address() % boundary + access.get_data_length() <= boundary);
}

void MemoryGateway::end_access(const sc_core::sc_time& delay) {
    if (--under_way_ == 0 && detached_) {
        became_idle_.notify(sc_core::SC_ZERO_TIME);
    }
    last_answer_ = std::max(last_answer_, sc_core::sc_time_stamp() + delay);
}

void MemoryGateway::detach() {
    detached_ = true;
    pacer_.open();
    if (requester_) {
        requester_->detach();
    }
    stalled_.drop();
}

void MemoryGateway::attach() {
    detached_ = false;
    pacer_.close();
    if (requester_) {
        requester_->attach();
    }
}

// Sends an LT transaction, and once more whenever software has resumed it.
void MemoryGateway::send(unsigned rank, tlm::tlm_generic_payload& payload,
                         sc_core::sc_time& delay) {
    const std::uint64_t address = payload.get_address();
    out->b_transport(payload, delay);
    payload.set_address(address); // which an interconnect may have changed
    while (options_.faults == RefusedAccess::Stall && payload.is_response_error()) {
        const bool resumed = await_resume(payload, delay);
        delay = sc_core::SC_ZERO_TIME;
        if (resumed) {
            pacer_.await_turn(rank, delay);
        }
        if (!resumed || detached_) {
            payload.set_response_status(tlm::TLM_OK_RESPONSE);
            return;
        }
        payload.set_dmi_allowed(false);
        payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
        out->b_transport(payload, delay);
        payload.set_address(address);
    }
}

// A transaction has faulted when its answer comes. False if the frame is given up.
bool MemoryGateway::await_resume(const tlm::tlm_generic_payload& refused,
                                 const sc_core::sc_time& delay) {
    if (delay > sc_core::SC_ZERO_TIME) {
        sc_core::wait(delay);
    }
    if (detached_) {
        return false;
    }
    bool again = false;
    sc_core::sc_event resumes;
    stalled_.add({refused.get_address(), refused.get_extension<RequestInfo>()->stream,
                  refused.get_response_status()},
                 [&again, &resumes] {
                     again = true;
                     resumes.notify(sc_core::SC_ZERO_TIME);
                 });
    while (!again) {
        sc_core::wait(resumes);
    }
    return !detached_;
}

/// Waits until one more transaction may go out, for one that is dated `date`, as far as the pacing
/// waits for dates. Returns the date at which it goes out.
sc_core::sc_time MemoryGateway::await_room(unsigned rank, const sc_core::sc_time& date) {
    sc_core::sc_time goes = std::max(date, sc_core::sc_time_stamp());
    while (in_flight_.bounded() && !detached_) {
        const sc_core::sc_time admitted = in_flight_.admit(goes);
        if (admitted == goes) {
            break;
        }
        // Others may have taken the room in the meantime.
        sc_core::sc_time delay = clock_.at(clock_.ceil(admitted)) - sc_core::sc_time_stamp();
        pacer_.await_turn(rank, delay);
        goes = std::max(admitted, sc_core::sc_time_stamp() + delay);
    }
    return goes;
}

// All pieces are issued at the date of the access, or when there is room; the access ends with the
// last of them, and the first error is its own. Targets see ordinary transactions.
void MemoryGateway::access_pieces(unsigned rank, tlm::tlm_generic_payload& payload,
                                  const Pieces& pieces, sc_core::sc_time& delay) {
    const std::uint64_t address = payload.get_address();
    unsigned char* const data = payload.get_data_ptr();
    const unsigned int bytes = payload.get_data_length();
    auto* const scattered = payload.get_extension<Scattered>();
    payload.clear_extension(scattered);
    const sc_core::sc_time date = sc_core::sc_time_stamp() + delay;
    sc_core::sc_time done = date;
    FullBurst burst;
    tlm::tlm_response_status status = tlm::TLM_OK_RESPONSE;
    for (const AccessPiece& piece : pieces) {
        if (detached_) { // while the last piece was on the bus
            break;
        }
        sc_core::sc_time wait = await_room(rank, date) - sc_core::sc_time_stamp();
        burst.open(payload, piece, data);
        send(rank, payload, wait);
        burst.close(payload);
        const sc_core::sc_time end = sc_core::sc_time_stamp() + wait;
        if (in_flight_.bounded()) {
            in_flight_.add(end);
        }
        done = std::max(done, end);
        status = status == tlm::TLM_OK_RESPONSE ? payload.get_response_status() : status;
    }
    payload.set_extension(scattered);
    set_access(payload, payload.get_command(), address, data, bytes);
    payload.set_response_status(status);
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    delay = done > now ? done - now : sc_core::SC_ZERO_TIME;
}

MemoryTraffic MemoryGateway::total() const {
    MemoryTraffic sum;
    for (const MemoryTraffic& each : traffic_) {
        sum.reads += each.reads;
        sum.writes += each.writes;
        sum.bytes_read += each.bytes_read;
        sum.bytes_written += each.bytes_written;
    }
    return sum;
}

unsigned int MemoryGateway::debug_of(int /*port*/, tlm::tlm_generic_payload& payload) {
    return out->transport_dbg(payload);
}

} // namespace degs
