// SPDX-License-Identifier: Apache-2.0
#include "degs/lpddr5.hpp"

#include <stdexcept>

#include "config/config_source.hpp"
#include "degs/error.hpp"
#include "dram/lpddr5.hpp"

namespace degs {

namespace {

constexpr std::size_t kMostInitiators = 1024;

} // namespace

Lpddr5::Lpddr5(const sc_core::sc_module_name& name, const std::string& file, std::size_t initiators)
    : sc_core::sc_module(name) {
    dram::Config config;
    if (!file.empty()) {
        ConfigSource::from_file(file).load(config);
    }
    if (initiators == 0 || initiators > kMostInitiators) {
        throw InputError(std::string(this->name()) + ": " + std::to_string(initiators) +
                         " initiators; the memory has a socket for each of 1 to " +
                         std::to_string(kMostInitiators) + ".");
    }
    if (const std::string problem = dram::Lpddr5::time_problem(config, Timebase{});
        !problem.empty()) {
        throw InputError(std::string(this->name()) + ": " + problem + ".");
    }
    peak_gb_per_s_ = config.peak_gb_per_s();
    model_ = std::make_unique<dram::Lpddr5>("dram", config, Timebase{}, initiators);
}

Lpddr5::~Lpddr5() = default;

std::size_t Lpddr5::checked(std::size_t initiator) const {
    if (initiator >= model_->in.size()) {
        throw std::out_of_range(std::string(name()) + ": there is no initiator " +
                                std::to_string(initiator) + "; the last one is " +
                                std::to_string(model_->in.size() - 1) + ".");
    }
    return initiator;
}

tlm::tlm_target_socket<>& Lpddr5::in(std::size_t initiator) {
    return model_->in[checked(initiator)];
}

std::uint64_t Lpddr5::capacity() const {
    return model_->channels().mapping().capacity();
}

double Lpddr5::peak_gb_per_s() const {
    return peak_gb_per_s_;
}

std::uint64_t Lpddr5::bytes_read(std::size_t initiator) const {
    return model_->stats(checked(initiator)).bytes_read;
}

std::uint64_t Lpddr5::bytes_written(std::size_t initiator) const {
    return model_->stats(checked(initiator)).bytes_written;
}

} // namespace degs
