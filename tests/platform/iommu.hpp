// SPDX-License-Identifier: Apache-2.0
// An IOMMU between an accelerator and a memory, whose pages are there or not.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm>

#include "degs/request_info.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {

/// Translates pages of 4 KiB, in LT and in AT. A transaction to a page that is not mapped, or of a
/// stream that may not go there, is refused with an address error; it is a failure of the test if
/// the page does not exist at all, if the stream may not, and if two pages are touched.
class Iommu : public sc_core::sc_module,
              public tlm::tlm_fw_transport_if<>,
              public tlm::tlm_bw_transport_if<>,
              private tlm::tlm_mm_interface {
public:
    using Payload = tlm::tlm_generic_payload;
    static constexpr std::uint64_t kPage = 4096;
    struct Page {
        std::uint64_t physical = 0; ///< number
        bool mapped = true;
    };
    tlm::tlm_target_socket<> in;
    tlm::tlm_initiator_socket<> out;
    std::map<std::uint64_t, Page> pages; ///< by number
    std::function<bool(std::uint64_t address, RequestStream stream)> allows;
    unsigned refused = 0;
    Timing timing = Timing::Immediate; ///< of refusals
    sc_core::sc_time latency{20, sc_core::SC_NS};

    explicit Iommu(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in"), out("out") {
        in.bind(*this);
        out.bind(*this);
    }

private:
    /// The physical address; kNowhere if there is none.
    std::uint64_t translate(const Payload& payload) {
        const std::uint64_t address = payload.get_address();
        EXPECT_LE(address % kPage + payload.get_data_length(), kPage) << "at " << address;
        const auto found = pages.find(address / kPage);
        const auto* const info = payload.get_extension<RequestInfo>();
        if (found == pages.end() || info == nullptr || !allows(address, info->stream)) {
            ADD_FAILURE() << "nothing may be done at " << address;
            return kNowhere;
        }
        if (!found->second.mapped) {
            ++refused;
            return kNowhere;
        }
        return found->second.physical * kPage + address % kPage;
    }
    void b_transport(Payload& payload, sc_core::sc_time& delay) override {
        const std::uint64_t address = payload.get_address();
        const std::uint64_t physical = translate(payload);
        if (physical != kNowhere) {
            payload.set_address(physical);
            out->b_transport(payload, delay);
            payload.set_address(address); // as the monitor before it wants
            return;
        }
        if (timing == Timing::Blocking) {
            sc_core::wait(delay + latency);
            delay = sc_core::SC_ZERO_TIME;
        } else if (timing == Timing::Annotated) {
            delay += latency;
        }
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    }
    unsigned int transport_dbg(Payload& payload) override {
        const std::uint64_t address = payload.get_address();
        const auto found = pages.find(address / kPage);
        if (found == pages.end() || !found->second.mapped) {
            return 0;
        }
        const unsigned int length = payload.get_data_length();
        payload.set_address(found->second.physical * kPage + address % kPage);
        payload.set_data_length(
            static_cast<unsigned int>(std::min<std::uint64_t>(length, kPage - address % kPage)));
        const unsigned int moved = out->transport_dbg(payload);
        payload.set_address(address);
        payload.set_data_length(length);
        return moved;
    }
    bool get_direct_mem_ptr(Payload& /*payload*/, tlm::tlm_dmi& /*dmi*/) override { return false; }
    void invalidate_direct_mem_ptr(sc_dt::uint64 first, sc_dt::uint64 last) override {
        in->invalidate_direct_mem_ptr(first, last);
    }

    // In four phases the memory gets a transaction of this module's, with the address of its own.
    tlm::tlm_sync_enum nb_transport_fw(Payload& payload, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        if (phase == tlm::BEGIN_REQ) {
            const std::uint64_t physical = translate(payload);
            if (physical == kNowhere) {
                payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
                delay += latency;
                return tlm::TLM_COMPLETED;
            }
            payload.acquire();
            auto* const inner = new Payload(this);
            inner->acquire();
            inner->deep_copy_from(payload); // without data, which it has not yet
            inner->set_data_ptr(payload.get_data_ptr());
            inner->set_byte_enable_ptr(payload.get_byte_enable_ptr());
            inner->set_address(physical);
            inner_[&payload] = inner;
            outer_[inner] = &payload;
        }
        Payload& inner = *inner_.at(&payload);
        const tlm::tlm_sync_enum answer = out->nb_transport_fw(inner, phase, delay);
        if (answer == tlm::TLM_COMPLETED) {
            payload.set_response_status(inner.get_response_status());
            end(payload);
        } else if (answer == tlm::TLM_UPDATED && phase == tlm::BEGIN_RESP) {
            payload.set_response_status(inner.get_response_status());
        }
        return answer;
    }
    tlm::tlm_sync_enum nb_transport_bw(Payload& inner, tlm::tlm_phase& phase,
                                       sc_core::sc_time& delay) override {
        Payload& payload = *outer_.at(&inner);
        if (phase == tlm::BEGIN_RESP) {
            payload.set_response_status(inner.get_response_status());
        }
        return in->nb_transport_bw(payload, phase, delay);
    }
    void end(Payload& payload) {
        Payload* const inner = inner_.at(&payload);
        inner_.erase(&payload);
        outer_.erase(inner);
        inner->release();
        payload.release();
    }
    void free(Payload* payload) override {
        payload->set_data_ptr(nullptr);
        payload->set_byte_enable_ptr(nullptr);
        delete payload; // with the clones of the extensions
    }

    static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
    std::map<Payload*, Payload*> inner_, outer_;
};

} // namespace degs::test
