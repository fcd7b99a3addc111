// SPDX-License-Identifier: Apache-2.0
// The monitor finds every kind of mistake, on either side, and nothing where there is none.
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "tests/platform/protocol/base_protocol_monitor.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

using Payload = tlm::tlm_generic_payload;
using Time = sc_core::sc_time;

DECLARE_EXTENDED_PHASE(PHASE_OF_SOMEBODY_ELSE);

Time ns(double value) {
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
std::ostream& operator<<(std::ostream& out, const Deed& deed) {
    return out << deed.name;
}

class SmallRunMonitor : public ::testing::TestWithParam<Deed> {};

TEST_P(SmallRunMonitor, FindsWhatIsWrongAndNothingElse) {
    Bench bench("bench");
    const Script script("script", [&] { GetParam().act(bench); });
    sc_core::sc_start();
    EXPECT_EQ(bench.monitor.broken(), GetParam().broken)
        << ::testing::PrintToString(bench.monitor.violations());
}

/// Changes a payload of a blocking call before it is made.
Deed before(const char* name, std::set<Rule> broken, const std::function<void(Payload&)>& change) {
    return {name, std::move(broken), [change](Bench& b) {
                change(b.first());
                b.block(b.first());
            }};
}
/// The same before BEGIN_REQ.
Deed before_request(const char* name, std::set<Rule> broken,
                    const std::function<void(Payload&)>& change) {
    return {name, std::move(broken), [change](Bench& b) {
                change(b.first());
                b.begin(b.first());
                b.respond(b.first());
                b.end(b.first());
            }};
}
/// Changes one between BEGIN_REQ and its response.
Deed under_way(const char* name, const std::function<void(Bench&)>& change) {
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

const Deed kGood[] = {
    {"Blocking",
     {},
     [](Bench& b) {
         b.block(b.first());
         b.prepare(b.first());
         b.block(b.first(), 5);
     }},
    {"Debug", {}, [](Bench& b) { b.out->transport_dbg(b.first()); }},
    {"FourPhases",
     {},
     [](Bench& b) {
         b.begin(b.first());
         sc_core::wait(ns(1));
         b.answer(b.first(), tlm::END_REQ);
         b.begin(b.second());
         sc_core::wait(ns(1));
         b.respond(b.first());
         sc_core::wait(ns(1));
         b.end(b.first());
         b.respond(b.second()); // ends the request, too
         b.end(b.second());
     }},
    {"OutOfOrder",
     {},
     [](Bench& b) {
         b.begin(b.first());
         b.answer(b.first(), tlm::END_REQ, 2);
         b.begin(b.second(), 3);
         b.answer(b.second(), tlm::END_REQ, 3);
         b.respond(b.second(), 9);
         b.end(b.second(), 9);
         b.respond(b.first(), 9);
         b.end(b.first(), 10);
     }},
    {"Updated",
     {},
     [](Bench& b) {
         b.forward = [](Payload& p, tlm::tlm_phase& phase, Time& t) {
             if (phase != tlm::BEGIN_REQ) {
                 return tlm::TLM_COMPLETED;
             }
             p.set_response_status(tlm::TLM_OK_RESPONSE);
             phase = tlm::BEGIN_RESP;
             t += ns(4);
             return tlm::TLM_UPDATED;
         };
         b.begin(b.first());
         b.end(b.first(), 4);
     }},
    {"Completed",
     {},
     [](Bench& b) {
         b.forward = [](Payload& p, tlm::tlm_phase&, Time& t) {
             p.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
             t += ns(4);
             return tlm::TLM_COMPLETED;
         };
         for (int i = 0; i < 2; ++i) {
             b.prepare(b.first());
             b.begin(b.first());
             b.first().release();
         }
     }},
    {"ResponseCompleted",
     {},
     [](Bench& b) {
         b.backward = [](Payload& p, tlm::tlm_phase&, Time&) {
             p.release();
             return tlm::TLM_COMPLETED;
         };
         b.begin(b.first());
         b.respond(b.first());
     }},
    {"ResponseUpdated",
     {},
     [](Bench& b) {
         b.backward = [](Payload&, tlm::tlm_phase& phase, Time&) {
             phase = tlm::END_RESP;
             return tlm::TLM_UPDATED;
         };
         b.begin(b.first());
         b.respond(b.first());
         b.first().release();
     }},
    {"APhaseOfSomebodyElse",
     {},
     [](Bench& b) {
         b.send(b.first(), PHASE_OF_SOMEBODY_ELSE);
         b.begin(b.first());
         b.send(b.first(), PHASE_OF_SOMEBODY_ELSE);
         b.answer(b.first(), PHASE_OF_SOMEBODY_ELSE);
         b.respond(b.first());
         b.end(b.first());
     }},
    {"AnExtensionThatMeansNothing",
     {},
     [](Bench& b) {
         Meaning meaning;
         b.first().set_extension(&meaning);
         b.block(b.first());
         b.first().clear_extension(&meaning);
     }},
};

const Deed kWrongRequests[] = {
    before("DmiHintKept", {Rule::Attributes}, [](Payload& p) { p.set_dmi_allowed(true); }),
    before("ResponseKept", {Rule::Attributes},
           [](Payload& p) { p.set_response_status(tlm::TLM_OK_RESPONSE); }),
    before("NoData", {Rule::Attributes},
           [](Payload& p) {
               p.set_read();
               p.set_data_ptr(nullptr);
           }),
    before("NoLength", {Rule::Attributes}, [](Payload& p) { p.set_data_length(0); }),
    before("NoWidth", {Rule::Attributes}, [](Payload& p) { p.set_streaming_width(0); }),
    before("EnablesWithoutLength", {Rule::Attributes},
           [](Payload& p) {
               p.set_byte_enable_ptr(p.get_data_ptr());
               p.set_byte_enable_length(0);
           }),
    before_request("DmiHintAtBeginReq", {Rule::Attributes},
                   [](Payload& p) { p.set_dmi_allowed(true); }),
    before_request("ResponseAtBeginReq", {Rule::Attributes},
                   [](Payload& p) { p.set_response_status(tlm::TLM_OK_RESPONSE); }),
    before_request("NoWidthAtBeginReq", {Rule::Attributes},
                   [](Payload& p) { p.set_streaming_width(0); }),
    {"DebugWithoutData",
     {Rule::Attributes},
     [](Bench& b) {
         b.first().set_data_ptr(nullptr);
         b.out->transport_dbg(b.first());
     }},
    {"DebugWithoutCommand",
     {Rule::Attributes},
     [](Bench& b) {
         b.first().set_command(tlm::TLM_IGNORE_COMMAND);
         b.out->transport_dbg(b.first());
     }},
    {"ExtensionThatIsTheMessage",
     {Rule::Extension},
     [](Bench& b) {
         Meaning meaning;
         b.first().set_command(tlm::TLM_IGNORE_COMMAND);
         b.first().set_extension(&meaning);
         b.block(b.first());
         b.first().clear_extension(&meaning);
     }},
    under_way("AddressChanged", [](Bench& b) { b.first().set_address(64); }),
    under_way("CommandChanged", [](Bench& b) { b.first().set_read(); }),
    under_way("LengthChanged", [](Bench& b) { b.first().set_data_length(2); }),
    under_way("WidthChanged", [](Bench& b) { b.first().set_streaming_width(2); }),
    under_way("DataMoved", [](Bench& b) { b.first().set_data_ptr(b.data[1]); }),
    under_way("DataChanged", [](Bench& b) { b.data[0][0] = 1; }),
    under_way("EnablesAppear",
              [](Bench& b) {
                  b.first().set_byte_enable_ptr(b.data[1]);
                  b.first().set_byte_enable_length(4);
              }),
    {"ChangedByABlockingTarget",
     {Rule::Constancy},
     [](Bench& b) {
         b.blocking = [](Payload& p, Time&) { p.set_data_length(8); };
         b.block(b.first());
     }},
};

const Deed kWrongAnswers[] = {
    {"BlockingWithoutResponse",
     {Rule::Response},
     [](Bench& b) {
         b.blocking = [](Payload& p, Time&) {
             p.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
         };
         b.block(b.first());
     }},
    {"BeginRespWithoutResponse",
     {Rule::Response},
     [](Bench& b) {
         b.begin(b.first());
         b.answer(b.first(), tlm::BEGIN_RESP);
         b.end(b.first());
     }},
    {"CompletedWithoutResponse",
     {Rule::Response},
     [](Bench& b) {
         b.forward = [](Payload&, tlm::tlm_phase&, Time&) { return tlm::TLM_COMPLETED; };
         b.begin(b.first());
         b.first().release();
     }},
    {"ResponseChanged",
     {Rule::Response},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
         b.first().set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
         b.end(b.first());
     }},
    {"DebugMovesTooMuch",
     {Rule::Response},
     [](Bench& b) {
         b.moved = 5;
         b.out->transport_dbg(b.first());
     }},
    {"TwoResponses",
     {Rule::OneResponse},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
         b.answer(b.first(), tlm::BEGIN_RESP);
         b.end(b.first());
     }},
    {"ResponseAfterTheEnd",
     {Rule::OneResponse},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
         b.end(b.first());
         b.answer(b.first(), tlm::BEGIN_RESP);
     }},
    {"ResponseAfterCompletion",
     {Rule::OneResponse},
     [](Bench& b) {
         b.forward = [](Payload& p, tlm::tlm_phase&, Time&) {
             p.set_response_status(tlm::TLM_OK_RESPONSE);
             return tlm::TLM_COMPLETED;
         };
         b.begin(b.first());
         b.answer(b.first(), tlm::BEGIN_RESP);
         b.first().release();
     }},
};

const Deed kWrongLives[] = {
    {"NoMemoryManager",
     {Rule::MemoryManager},
     [](Bench& b) {
         Payload payload;
         b.prepare(payload);
         b.send(payload, tlm::BEGIN_REQ);
         b.respond(payload);
         b.send(payload, tlm::END_RESP);
     }},
    {"NoReference",
     {Rule::MemoryManager, Rule::References},
     [](Bench& b) {
         b.send(b.first(), tlm::BEGIN_REQ);
         b.respond(b.first());
         b.send(b.first(), tlm::END_RESP);
     }},
    {"ReferenceKept",
     {Rule::References},
     [](Bench& b) {
         b.first().acquire();
         b.begin(b.first());
         b.respond(b.first());
         b.end(b.first());
     }},
    {"UsedAgainWhileHeld",
     {Rule::References},
     [](Bench& b) {
         b.first().acquire();
         for (int i = 0; i < 2; ++i) {
             b.prepare(b.first());
             b.begin(b.first());
             b.respond(b.first());
             b.end(b.first());
         }
         b.first().release();
     }},
    {"GivenBackUnderWay",
     {Rule::References},
     [](Bench& b) {
         b.begin(b.first());
         b.first().release();
         b.first().acquire();
         b.respond(b.first());
         b.end(b.first());
     }},
    {"GivenBackBeforeEndResp",
     {Rule::References},
     [](Bench& b) {
         b.backward = [](Payload& p, tlm::tlm_phase&, Time&) {
             p.release();
             return tlm::TLM_ACCEPTED;
         };
         b.begin(b.first());
         b.respond(b.first());
         b.send(b.first(), tlm::END_RESP);
     }},
    {"NeverAnswered", {Rule::Unfinished}, [](Bench& b) { b.begin(b.first()); }},
    {"ResponseNeverEnded",
     {Rule::Unfinished},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
     }},
};

const Deed kWrongPhases[] = {
    {"BeginReqTwice",
     {Rule::Phase, Rule::RequestExclusion, Rule::References},
     [](Bench& b) {
         b.begin(b.first());
         b.send(b.first(), tlm::BEGIN_REQ);
         b.respond(b.first());
         b.end(b.first());
     }},
    {"EndReqTwice",
     {Rule::Phase},
     [](Bench& b) {
         b.begin(b.first());
         b.answer(b.first(), tlm::END_REQ);
         b.answer(b.first(), tlm::END_REQ);
         b.respond(b.first());
         b.end(b.first());
     }},
    {"EndReqAfterBeginResp",
     {Rule::Phase},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
         b.answer(b.first(), tlm::END_REQ);
         b.end(b.first());
     }},
    {"EndRespTooEarly",
     {Rule::Phase},
     [](Bench& b) {
         b.begin(b.first());
         b.send(b.first(), tlm::END_RESP);
         b.respond(b.first());
         b.end(b.first());
     }},
    {"EndRespOfNothing", {Rule::Phase}, [](Bench& b) { b.send(b.first(), tlm::END_RESP); }},
    {"BeginRespOfNothing", {Rule::Phase}, [](Bench& b) { b.answer(b.first(), tlm::BEGIN_RESP); }},
    {"EndReqFromTheInitiator",
     {Rule::Phase},
     [](Bench& b) {
         b.begin(b.first());
         b.send(b.first(), tlm::END_REQ);
         b.respond(b.first());
         b.end(b.first());
     }},
    {"EndRespFromTheTarget",
     {Rule::Phase},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
         b.answer(b.first(), tlm::END_RESP);
         b.end(b.first());
     }},
    {"NoPhase", {Rule::Phase}, [](Bench& b) { b.send(b.first(), tlm::UNINITIALIZED_PHASE); }},
    {"EndReqCompletes",
     {Rule::Phase},
     [](Bench& b) {
         b.backward = [](Payload&, tlm::tlm_phase&, Time&) { return tlm::TLM_COMPLETED; };
         b.begin(b.first());
         b.answer(b.first(), tlm::END_REQ);
         b.first().release();
     }},
    {"EndRespUpdated",
     {Rule::Phase},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first());
         b.forward = [](Payload&, tlm::tlm_phase&, Time&) { return tlm::TLM_UPDATED; };
         b.end(b.first());
     }},
    {"TwoRequestsAtATime",
     {Rule::RequestExclusion},
     [](Bench& b) {
         b.begin(b.first());
         b.begin(b.second());
         b.respond(b.first());
         b.end(b.first());
         b.respond(b.second());
         b.end(b.second());
     }},
    {"TwoResponsesAtATime",
     {Rule::ResponseExclusion},
     [](Bench& b) {
         b.begin(b.first());
         b.answer(b.first(), tlm::END_REQ);
         b.begin(b.second());
         b.respond(b.first());
         b.respond(b.second());
         b.end(b.first());
         b.end(b.second());
     }},
};

const Deed kWrongDates[] = {
    {"RequestBeforeTheEndOfTheLast",
     {Rule::Annotation},
     [](Bench& b) {
         b.begin(b.first());
         b.answer(b.first(), tlm::END_REQ, 5);
         b.begin(b.second(), 4);
         b.respond(b.first());
         b.end(b.first());
         b.respond(b.second());
         b.end(b.second());
     }},
    {"EndReqBeforeItsRequest",
     {Rule::Annotation},
     [](Bench& b) {
         b.begin(b.first(), 5);
         b.answer(b.first(), tlm::END_REQ, 4);
         b.respond(b.first());
         b.end(b.first());
     }},
    {"EndRespBeforeItsResponse",
     {Rule::Annotation},
     [](Bench& b) {
         b.begin(b.first());
         b.respond(b.first(), 5);
         b.end(b.first());
     }},
    {"ReturnBeforeTheCall",
     {Rule::Annotation},
     [](Bench& b) {
         b.forward = [](Payload& p, tlm::tlm_phase&, Time& t) {
             p.set_response_status(tlm::TLM_OK_RESPONSE);
             t = ns(1);
             return tlm::TLM_COMPLETED;
         };
         b.begin(b.first(), 2);
         b.first().release();
     }},
    {"BlockingReturnBeforeTheCall",
     {Rule::Annotation},
     [](Bench& b) {
         b.blocking = [](Payload&, Time& t) { t = ns(1); };
         b.block(b.first(), 2);
     }},
};

std::string deed_name(const ::testing::TestParamInfo<Deed>& deed) {
    return deed.param.name;
}
INSTANTIATE_TEST_SUITE_P(Good, SmallRunMonitor, ::testing::ValuesIn(kGood), deed_name);
INSTANTIATE_TEST_SUITE_P(Requests, SmallRunMonitor, ::testing::ValuesIn(kWrongRequests), deed_name);
INSTANTIATE_TEST_SUITE_P(Answers, SmallRunMonitor, ::testing::ValuesIn(kWrongAnswers), deed_name);
INSTANTIATE_TEST_SUITE_P(Lives, SmallRunMonitor, ::testing::ValuesIn(kWrongLives), deed_name);
INSTANTIATE_TEST_SUITE_P(Phases, SmallRunMonitor, ::testing::ValuesIn(kWrongPhases), deed_name);
INSTANTIATE_TEST_SUITE_P(Dates, SmallRunMonitor, ::testing::ValuesIn(kWrongDates), deed_name);

} // namespace
} // namespace degs::test
