// SPDX-License-Identifier: Apache-2.0
#include "degs/lpddr5.hpp"

#include <stdexcept>

#include "config/config_source.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "dram/lpddr5.hpp"
#include "stats/statistics_document.hpp"

namespace degs {

namespace {

constexpr std::size_t kMostInitiators = 1024;

/// The counts and real numbers of a description.
std::vector<Lpddr5::Statistic> numbers(const DescribeStats& describe) {
    std::vector<Lpddr5::Statistic> all;
    for (const Statistic& row : list_statistics(describe)) {
        if (const auto* const count = std::get_if<std::uint64_t>(&row.value)) {
            all.push_back({row.path, row.unit, row.sentence, static_cast<double>(*count)});
        } else if (const auto* const real = std::get_if<double>(&row.value)) {
            all.push_back({row.path, row.unit, row.sentence, *real});
        }
    }
    return all;
}

double value_of(const std::string& name, const std::vector<Lpddr5::Statistic>& all,
                const std::string& owner) {
    std::vector<std::string> names;
    for (const Lpddr5::Statistic& each : all) {
        if (each.name == name) {
            return each.value;
        }
        names.push_back(each.name);
    }
    const std::string near = config_words::nearest(name, names);
    throw InputError(owner + ": there is no statistic " + config_words::quote(name) +
                     (near.empty() ? "; statistics() lists them."
                                   : ", did you mean " + config_words::quote(near) + "?"));
}

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

std::vector<Lpddr5::Statistic> Lpddr5::statistics() {
    return numbers([this](StatsVisitor& v) { model_->describe(v); });
}

std::vector<Lpddr5::Statistic> Lpddr5::statistics(std::size_t initiator) const {
    checked(initiator);
    return numbers([this, initiator](StatsVisitor& v) { model_->describe(initiator, v); });
}

double Lpddr5::statistic(const std::string& name) {
    return value_of(name, statistics(), this->name());
}

double Lpddr5::statistic(const std::string& name, std::size_t initiator) const {
    return value_of(name, statistics(initiator),
                    this->name() + (" of initiator " + std::to_string(initiator)));
}

} // namespace degs
