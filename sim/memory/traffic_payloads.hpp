// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>
#include <tlm>

#include "tlm/memory.hpp"

namespace degs::sim {

/// Payloads of an AT initiator, used again once everybody has released them. They move no data.
class TrafficPayloads {
public:
    TrafficPayloads() = default;
    TrafficPayloads(const TrafficPayloads&) = delete;
    TrafficPayloads& operator=(const TrafficPayloads&) = delete;
    ~TrafficPayloads() = default;

    /// A payload that the caller must release; `date`: see date_of().
    tlm::tlm_generic_payload& acquire(const sc_core::sc_time& date) {
        if (manager_.free_list.empty()) {
            payloads_.push_back(std::make_unique<tlm::tlm_generic_payload>(&manager_));
            manager_.free_list.push_back(payloads_.back().get());
            payloads_.back()->set_extension(new Birth);
            payloads_.back()->set_extension(new TimingOnly);
        }
        tlm::tlm_generic_payload& payload = *manager_.free_list.back();
        manager_.free_list.pop_back();
        payload.acquire();
        payload.get_extension<Birth>()->date = date;
        return payload;
    }
    /// When the request of a payload was made.
    static const sc_core::sc_time& date_of(const tlm::tlm_generic_payload& payload) {
        return payload.get_extension<Birth>()->date;
    }

private:
    struct Manager : tlm::tlm_mm_interface {
        void free(tlm::tlm_generic_payload* payload) override {
            payload->reset(); // of extensions that belong to whoever it passed
            free_list.push_back(payload);
        }
        std::vector<tlm::tlm_generic_payload*> free_list;
    };
    struct Birth : tlm::tlm_extension<Birth> {
        sc_core::sc_time date;
        tlm_extension_base* clone() const override { return new Birth(*this); }
        void copy_from(const tlm_extension_base& other) override {
            *this = static_cast<const Birth&>(other);
        }
    };

    Manager manager_;
    std::vector<std::unique_ptr<tlm::tlm_generic_payload>> payloads_;
};

} // namespace degs::sim
