// SPDX-License-Identifier: Apache-2.0
#include "degs/lpddr5.hpp"

#include "config/config_source.hpp"
#include "dram/lpddr5.hpp"

namespace degs {

Lpddr5::Lpddr5(const sc_core::sc_module_name& name, const std::string& file, std::size_t initiators)
    : sc_core::sc_module(name) {
    dram::Config config;
    if (!file.empty()) {
        ConfigSource::from_file(file).load(config);
    }
    memory_name_ = config.name;
    peak_gb_per_s_ = config.peak_gb_per_s();
    model_ = std::make_unique<dram::Lpddr5>("dram", config, Timebase{}, initiators);
}

Lpddr5::~Lpddr5() = default;

tlm::tlm_target_socket<>& Lpddr5::in(std::size_t initiator) {
    return model_->in.at(initiator);
}

const std::string& Lpddr5::memory_name() const {
    return memory_name_;
}

std::uint64_t Lpddr5::capacity() const {
    return model_->channels().mapping().capacity();
}

double Lpddr5::peak_gb_per_s() const {
    return peak_gb_per_s_;
}

std::uint64_t Lpddr5::bytes_read(std::size_t initiator) const {
    return model_->stats(initiator).bytes_read;
}

std::uint64_t Lpddr5::bytes_written(std::size_t initiator) const {
    return model_->stats(initiator).bytes_written;
}

} // namespace degs
