// SPDX-License-Identifier: Apache-2.0
// What an initiator or a target may do right or wrong, with the monitor between them.
#pragma once

#include <functional>
#include <set>
#include <string>

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "tests/platform/protocol/base_protocol_monitor.hpp"

namespace degs::test::protocol {

using Payload = tlm::tlm_generic_payload;
using Time = sc_core::sc_time;

DECLARE_EXTENDED_PHASE(PHASE_OF_SOMEBODY_ELSE);

inline Time ns(double value) {
    return Time(value, sc_core::SC_NS);
}

struct Pool : tlm::tlm_mm_interface {
    void free(Payload* payload) override { payload->reset(); }
};

struct Meaning : tlm::tlm_extension<Meaning> {
    tlm_extension_base* clone() const override { return new Meaning; }
    void copy_from(const tlm_extension_base& /*other*/) override {}
};

/// An initiator and a target that do what a test says, with the monitor between them.
class Bench : public sc_core::sc_module {
public:
    using Answer = std::function<tlm::tlm_sync_enum(Payload&, tlm::tlm_phase&, Time&)>;
    tlm_utils::simple_initiator_socket<Bench> out;
    BaseProtocolMonitor monitor{"monitor"};
    tlm_utils::simple_target_socket<Bench> in;
    Answer forward, backward;                      ///< TLM_ACCEPTED if empty
    std::function<void(Payload&, Time&)> blocking; ///< TLM_OK_RESPONSE if empty
    unsigned int moved = 4;                        ///< by debug transport
    Pool pool;
    unsigned char data[2][4] = {};
    Payload payloads[2];

    explicit Bench(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), out("out"), in("in") {
        out.register_nb_transport_bw(this, &Bench::on_backward);
        in.register_nb_transport_fw(this, &Bench::on_forward);
        in.register_b_transport(this, &Bench::on_blocking);
        in.register_transport_dbg(this, &Bench::on_debug);
        out.bind(monitor.in);
        monitor.out.bind(in);
        for (int i = 0; i < 2; ++i) {
            payloads[i].set_mm(&pool);
            prepare(payloads[i], i);
        }
    }
    void prepare(Payload& payload, int index = 0) {
        payload.set_write();
        payload.set_address(4 * index);
        payload.set_data_ptr(data[index]);
        payload.set_data_length(4);
        payload.set_streaming_width(4);
        payload.set_byte_enable_ptr(nullptr);
        payload.set_dmi_allowed(false);
        payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
    }
    Payload& first() { return payloads[0]; }
    Payload& second() { return payloads[1]; }
    tlm::tlm_sync_enum send(Payload& payload, tlm::tlm_phase phase, double delay = 0) {
        Time annotated = ns(delay);
        return out->nb_transport_fw(payload, phase, annotated);
    }
    tlm::tlm_sync_enum answer(Payload& payload, tlm::tlm_phase phase, double delay = 0) {
        Time annotated = ns(delay);
        return in->nb_transport_bw(payload, phase, annotated);
    }
    void begin(Payload& payload, double delay = 0) {
        payload.acquire();
        send(payload, tlm::BEGIN_REQ, delay);
    }
    void respond(Payload& payload, double delay = 0) {
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
        answer(payload, tlm::BEGIN_RESP, delay);
    }
    void end(Payload& payload, double delay = 0) {
        send(payload, tlm::END_RESP, delay);
        payload.release();
    }
    void block(Payload& payload, double delay = 0) {
        Time annotated = ns(delay);
        out->b_transport(payload, annotated);
    }

private:
    static tlm::tlm_sync_enum call(const Answer& by, Payload& p, tlm::tlm_phase& phase, Time& t) {
        return by ? by(p, phase, t) : tlm::TLM_ACCEPTED;
    }
    tlm::tlm_sync_enum on_forward(Payload& p, tlm::tlm_phase& phase, Time& t) {
        return call(forward, p, phase, t);
    }
    tlm::tlm_sync_enum on_backward(Payload& p, tlm::tlm_phase& phase, Time& t) {
        return call(backward, p, phase, t);
    }
    void on_blocking(Payload& payload, Time& delay) {
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
        if (blocking) {
            blocking(payload, delay);
        }
    }
    unsigned int on_debug(Payload& /*payload*/) { return moved; }
};

/// What one side does, and the rules that it breaks.
struct Deed {
    const char* name;
    std::set<Rule> broken;
    std::function<void(Bench&)> act;
};
inline std::ostream& operator<<(std::ostream& out, const Deed& deed) {
    return out << deed.name;
}

/// Changes a payload of a blocking call before it is made.
inline Deed before(const char* name, std::set<Rule> broken,
                   const std::function<void(Payload&)>& change) {
    return {name, std::move(broken), [change](Bench& b) {
                change(b.first());
                b.block(b.first());
            }};
}
/// Changes a payload before BEGIN_REQ.
inline Deed before_request(const char* name, std::set<Rule> broken,
                           const std::function<void(Payload&)>& change) {
    return {name, std::move(broken), [change](Bench& b) {
                change(b.first());
                b.begin(b.first());
                b.respond(b.first());
                b.end(b.first());
            }};
}
/// Changes one between BEGIN_REQ and its response.
inline Deed under_way(const char* name, const std::function<void(Bench&)>& change) {
    return {name, {Rule::Constancy}, [change](Bench& b) {
                b.begin(b.first());
                change(b);
                b.answer(b.first(), tlm::END_REQ);
                b.prepare(b.first());
                b.data[0][0] = 0;
                b.respond(b.first());
                b.end(b.first());
            }};
}

} // namespace degs::test::protocol
