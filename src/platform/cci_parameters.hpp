// SPDX-License-Identifier: Apache-2.0
// An accelerator whose keys are SystemC CCI parameters. Only for platforms that have CCI: no other file
// of this project includes it, and the library does not need CCI.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <cci_configuration>

#include "platform/accelerator.hpp"
#include "platform/accelerator_reports.hpp"

namespace degs {

/// Makes an immutable CCI parameter of every key of an accelerator, NAME.scheduler.banks for one of its
/// configuration and NAME.options.memory.transport for one of Accelerator::Options, whose value is
/// what a broker has preset, else the default. Numbers are std::int64_t and double, choices and texts
/// std::string. Lives as long as tools shall see the parameters.
///
///     degs::CciParameters parameters(cci::cci_get_broker(), std::string(name()) + ".gpu", defaults);
///     degs::Accelerator gpu("gpu", parameters.config(), parameters.options());
///
/// Outside of modules, where there is no such broker, the first argument is cci_get_global_broker().
/// A value out of its range and a choice that does not exist are refused as reports::kConfig, and a
/// preset below NAME that is no parameter is a warning of this type; what else is wrong with a
/// configuration, Accelerator reports.
class CciParameters {
public:
    /// `name`: hierarchical name of the accelerator to be built.
    CciParameters(const cci::cci_broker_handle& broker, const std::string& name,
                  const AcceleratorConfig& defaults, const Accelerator::Options& options = {})
        : config_(defaults.clone()), options_(options) {
        Reader reader(broker, name, parameters_);
        config_->describe(reader);
        reader.section("options", options_, "of the accelerator on its platform");
        for (const auto& preset : broker.get_unconsumed_preset_values()) {
            if (preset.first.compare(0, name.size() + 1, name + ".") == 0) {
                const std::string text = preset.first + ": the accelerator has no such parameter";
                SC_REPORT_WARNING(reports::kConfig, text.c_str());
            }
        }
    }

    const AcceleratorConfig& config() const { return *config_; }
    const Accelerator::Options& options() const { return options_; }
    std::size_t size() const { return parameters_.size(); }

private:
    using Parameters = std::vector<std::shared_ptr<void>>; // of several types

    class Reader : public ConfigVisitor {
    public:
        Reader(const cci::cci_broker_handle& broker, const std::string& name,
               Parameters& parameters)
            : broker_(broker), origin_(name), path_{name}, parameters_(parameters) {}

        using ConfigVisitor::choice;
        using ConfigVisitor::integer;
        void begin_section(const char* key, const char* /*doc*/) override {
            path_.push_back(full(key));
        }
        void end_section() override { path_.pop_back(); }
        void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                     const char* doc) override {
            number(key, value, low, high, doc);
        }
        void real(const char* key, double& value, double low, double high,
                  const char* doc) override {
            number(key, value, low, high, doc);
        }
        void boolean(const char* key, bool& value, const char* doc) override {
            value = parameter(key, value, doc);
        }
        void text(const char* key, std::string& value, const char* doc) override {
            value = parameter(key, value, doc);
        }
        void choice(const char* key, int& value, const std::vector<const char*>& names,
                    const char* doc) override {
            const std::string chosen = parameter(key, std::string(names.at(value)), doc);
            std::string all;
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (chosen == names[i]) {
                    value = static_cast<int>(i);
                    return;
                }
                all += std::string(i == 0 ? "" : ", ") + names[i];
            }
            refuse(reports::kConfig, full(key), "'" + chosen + "' is none of " + all);
        }

    private:
        std::string full(const char* key) const { return path_.back() + "." + key; }
        template <class Value>
        Value parameter(const char* key, const Value& value, const char* doc) {
            auto made = std::make_shared<cci::cci_param<Value, cci::CCI_IMMUTABLE_PARAM>>(
                full(key), value, broker_, doc, cci::CCI_ABSOLUTE_NAME, origin_);
            parameters_.push_back(made);
            return made->get_value();
        }
        template <class Number>
        void number(const char* key, Number& value, Number low, Number high, const char* doc) {
            value = parameter(key, value, doc);
            if (!(value >= low && value <= high)) {
                refuse(reports::kConfig, full(key),
                       std::to_string(value) + " is not between " + std::to_string(low) + " and " +
                           std::to_string(high));
            }
        }

        cci::cci_broker_handle broker_;
        cci::cci_originator origin_;
        std::vector<std::string> path_;
        Parameters& parameters_;
    };

    std::unique_ptr<AcceleratorConfig> config_;
    Accelerator::Options options_;
    Parameters parameters_;
};

} // namespace degs
