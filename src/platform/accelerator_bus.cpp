// SPDX-License-Identifier: Apache-2.0
// The register socket of degs::Accelerator; the other half of accelerator.cpp.
#include "platform/accelerator_core.hpp"

namespace degs {
namespace {

std::uint32_t word_from(const unsigned char* data) {
    std::uint32_t value = 0;
    for (unsigned int i = 4; i-- > 0;) {
        value = value << 8U | data[i];
    }
    return value;
}

void word_to(std::uint32_t value, unsigned char* data) {
    for (unsigned int i = 0; i < 4; ++i, value >>= 8U) {
        data[i] = value & 0xFFU;
    }
}

} // namespace

// Checks that an access is to one word, whole and aligned.
tlm::tlm_response_status AcceleratorCore::check_access(const tlm::tlm_generic_payload& payload) {
    if (!payload.is_read() && !payload.is_write()) {
        return tlm::TLM_COMMAND_ERROR_RESPONSE;
    }
    if (payload.get_address() % 4 != 0 || payload.get_address() >= kRegisterBytes) {
        return tlm::TLM_ADDRESS_ERROR_RESPONSE;
    }
    if (payload.get_byte_enable_ptr() != nullptr) {
        return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
    }
    if (payload.get_data_length() != 4 || payload.get_streaming_width() < 4) {
        return tlm::TLM_BURST_ERROR_RESPONSE;
    }
    return tlm::TLM_OK_RESPONSE;
}

void AcceleratorCore::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    tlm::tlm_response_status status = check_access(payload);
    if (status == tlm::TLM_OK_RESPONSE) {
        const auto offset = static_cast<std::uint32_t>(payload.get_address());
        if (payload.is_read()) {
            word_to(read(offset), payload.get_data_ptr());
        } else {
            status = write(offset, word_from(payload.get_data_ptr()), delay);
        }
        delay += time_.clock.period();
    }
    payload.set_response_status(status);
}

// The energy of a frame is worked out anew with its low word.
std::uint32_t AcceleratorCore::read(std::uint32_t offset) {
    if (offset == AcceleratorRegisters::offset_of(Register::FrameEnergy) &&
        (registers_.get(Register::Status) & kStatusBusy) == 0) {
        show_energy();
    }
    return registers_.word(offset);
}

// Writes a register. The value can be read at once; what the write starts happens from its date on.
tlm::tlm_response_status AcceleratorCore::write(std::uint32_t offset, std::uint32_t value,
                                                const sc_core::sc_time& delay) {
    const RegisterInfo* const info = AcceleratorRegisters::find(offset);
    if (info == nullptr || info->access == Access::Read) {
        return tlm::TLM_COMMAND_ERROR_RESPONSE;
    }
    if (held_in_reset()) {
        return tlm::TLM_OK_RESPONSE;
    }
    if (info->access == Access::Command) {
        command(value, delay);
    } else {
        const bool clears = info->access == Access::WriteOneToClear;
        registers_.set_word(offset,
                            clears ? registers_.word(offset) & ~value : value & info->bits());
        written(offset, delay);
    }
    return tlm::TLM_OK_RESPONSE;
}

// What follows from a new value of a register. The supply of a frame is not gated.
void AcceleratorCore::written(std::uint32_t offset, const sc_core::sc_time& delay) {
    show_view();
    irq_changed_.notify(delay);
    if (offset == AcceleratorRegisters::offset_of(Register::Power) && !started_) {
        meter_.gate(gates_idle(), sc_core::sc_time_stamp() + delay);
    }
}

void AcceleratorCore::command(std::uint32_t bits, const sc_core::sc_time& delay) {
    if ((bits & kControlReset) != 0) {
        request_stop(Stop::Reset, delay);
        stop_requested_.notify(delay);
        irq_changed_.notify(delay);
        return;
    }
    const std::uint32_t status = registers_.get(Register::Status);
    const bool busy = (status & (kStatusBusy | kStatusInReset)) != 0;
    if ((bits & kControlAbort) != 0 && (status & kStatusBusy) != 0) {
        request_stop(Stop::Abort, delay);
        stop_requested_.notify(delay);
    } else if ((bits & kControlResume) != 0 && (status & kStatusFaulted) != 0) {
        set_status(0, kStatusFaulted);
        resume_requested_.notify(delay);
    }
    if ((bits & kControlClearError) != 0) {
        set_status(0, kStatusError | kStatusStartIgnored | kStatusAborted);
        if (!busy) {
            registers_.set(Register::ErrorCode, 0);
            registers_.set(Register::ErrorDetail, 0);
        }
    }
    if ((bits & kControlStart) != 0 && busy) {
        set_status(kStatusStartIgnored, 0);
    } else if ((bits & kControlStart) != 0) {
        start(delay);
    }
}

// A start samples the registers here and not at its date: a decoupled processor may write those of
// the next frame in the same quantum. A gated supply comes back first.
void AcceleratorCore::start(const sc_core::sc_time& delay) {
    const bool faulted = (registers_.get(Register::Status) & kStatusFaulted) != 0;
    set_status(kStatusBusy, kStatusDone | kStatusError | kStatusAborted);
    registers_.set(Register::ErrorCode, 0);
    registers_.set(Register::ErrorDetail, 0);
    if (!faulted) { // else a read that the frame before did not wait for
        clear_fault();
    }
    request_ = AcceleratorRequest::read(registers_, options_.limits);
    started_ = true;
    start_date_ = sc_core::sc_time_stamp() + delay;
    meter_.gate(false, start_date_);
    if (gates_idle()) {
        start_date_ += sc_core::sc_time(options_.power.wake_ns, sc_core::SC_NS);
    }
    work_.notify(sc_core::SC_ZERO_TIME);
}

// Moves whole words. Reads every register, and writes those that start nothing.
unsigned int AcceleratorCore::debug(tlm::tlm_generic_payload& payload) {
    const std::uint64_t first = payload.get_address();
    const unsigned int bytes = payload.get_data_length();
    if (first % 4 != 0 || bytes % 4 != 0 || (payload.is_write() && held_in_reset())) {
        return 0;
    }
    unsigned int done = 0;
    for (; done < bytes && first + done < kRegisterBytes; done += 4) {
        const auto offset = static_cast<std::uint32_t>(first + done);
        if (payload.is_read()) {
            word_to(read(offset), payload.get_data_ptr() + done);
            continue;
        }
        const RegisterInfo* const info = AcceleratorRegisters::find(offset);
        if (!payload.is_write() || info == nullptr || info->access != Access::ReadWrite) {
            break;
        }
        registers_.set_word(offset, word_from(payload.get_data_ptr() + done) & info->bits());
        written(offset, sc_core::SC_ZERO_TIME);
    }
    return done;
}

} // namespace degs
