// SPDX-License-Identifier: Apache-2.0
// What BaseProtocolMonitor remembers of a payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <tlm>

namespace degs::test {

/// The attributes that stay as the initiator set them, with the bytes that it writes and enables.
class PayloadRecord {
public:
    explicit PayloadRecord(const tlm::tlm_generic_payload& payload)
        : command_(payload.get_command()), address_(payload.get_address()),
          data_(payload.get_data_ptr()), enables_(payload.get_byte_enable_ptr()),
          length_(payload.get_data_length()), enable_length_(payload.get_byte_enable_length()),
          width_(payload.get_streaming_width()) {
        if (command_ == tlm::TLM_WRITE_COMMAND && data_ != nullptr) {
            written_.assign(data_, data_ + length_);
        }
        if (enables_ != nullptr) {
            enabled_.assign(enables_, enables_ + enable_length_);
        }
    }
    bool is_of(const tlm::tlm_generic_payload& payload) const {
        const PayloadRecord now(payload);
        return command_ == now.command_ && address_ == now.address_ && data_ == now.data_ &&
               enables_ == now.enables_ && length_ == now.length_ &&
               enable_length_ == now.enable_length_ && width_ == now.width_ &&
               written_ == now.written_ && enabled_ == now.enabled_;
    }

private:
    tlm::tlm_command command_;
    std::uint64_t address_;
    const unsigned char *data_, *enables_;
    unsigned int length_, enable_length_, width_;
    std::vector<unsigned char> written_, enabled_;
};

/// Takes the extensions of a payload away while it lives.
class HiddenExtensions {
public:
    explicit HiddenExtensions(tlm::tlm_generic_payload& payload) : payload_(payload) {
        for (unsigned int i = 0; i < tlm::max_num_extensions(); ++i) {
            extensions_.push_back(payload.set_extension(i, nullptr));
        }
    }
    HiddenExtensions(const HiddenExtensions&) = delete;
    HiddenExtensions& operator=(const HiddenExtensions&) = delete;
    ~HiddenExtensions() {
        for (unsigned int i = 0; i < extensions_.size(); ++i) {
            payload_.set_extension(i, extensions_[i]);
        }
    }

private:
    tlm::tlm_generic_payload& payload_;
    std::vector<tlm::tlm_extension_base*> extensions_;
};

/// Payloads whose references have not all been given back since they were last seen.
struct PayloadLives {
    std::map<const tlm::tlm_generic_payload*, bool> held; ///< true: the transaction is under way
    std::size_t early = 0;                                ///< given back under way
};

/// An extension of nobody else, which goes with the last reference.
class PayloadLifetime : public tlm::tlm_extension<PayloadLifetime> {
public:
    PayloadLifetime(const tlm::tlm_generic_payload* payload, std::shared_ptr<PayloadLives> lives)
        : payload_(payload), lives_(std::move(lives)) {}
    tlm_extension_base* clone() const override { return nullptr; }
    void copy_from(const tlm_extension_base& /*other*/) override {}
    void free() override {
        const auto held = lives_->held.find(payload_);
        if (held != lives_->held.end()) {
            lives_->early += held->second ? 1 : 0;
            lives_->held.erase(held);
        }
        delete this;
    }

private:
    const tlm::tlm_generic_payload* payload_;
    std::shared_ptr<PayloadLives> lives_;
};

/// False if the payload still has one.
inline bool attach_lifetime(tlm::tlm_generic_payload& payload,
                            const std::shared_ptr<PayloadLives>& lives) {
    if (payload.get_extension<PayloadLifetime>() != nullptr) {
        return false;
    }
    payload.set_auto_extension(new PayloadLifetime(&payload, lives));
    return true;
}

} // namespace degs::test
