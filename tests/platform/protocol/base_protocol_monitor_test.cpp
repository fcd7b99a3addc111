// SPDX-License-Identifier: Apache-2.0
// The monitor finds every kind of mistake, on either side, and nothing where there is none.
#include <gmock/gmock.h>

#include "tests/platform/protocol/monitor_deeds.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test::protocol {
namespace {

class ProtocolMonitor : public ::testing::TestWithParam<Deed> {};

TEST_P(ProtocolMonitor, FindsWhatIsWrongAndNothingElse) {
    Bench bench("bench");
    const Script script("script", [&] { GetParam().act(bench); });
    sc_core::sc_start();
    EXPECT_EQ(bench.monitor.broken(), GetParam().broken)
        << ::testing::PrintToString(bench.monitor.violations());
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
INSTANTIATE_TEST_SUITE_P(Good, ProtocolMonitor, ::testing::ValuesIn(kGood), deed_name);
INSTANTIATE_TEST_SUITE_P(Requests, ProtocolMonitor, ::testing::ValuesIn(kWrongRequests), deed_name);
INSTANTIATE_TEST_SUITE_P(Answers, ProtocolMonitor, ::testing::ValuesIn(kWrongAnswers), deed_name);
INSTANTIATE_TEST_SUITE_P(Lives, ProtocolMonitor, ::testing::ValuesIn(kWrongLives), deed_name);
INSTANTIATE_TEST_SUITE_P(Phases, ProtocolMonitor, ::testing::ValuesIn(kWrongPhases), deed_name);
INSTANTIATE_TEST_SUITE_P(Dates, ProtocolMonitor, ::testing::ValuesIn(kWrongDates), deed_name);

} // namespace
} // namespace degs::test::protocol
