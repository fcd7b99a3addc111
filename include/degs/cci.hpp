// SPDX-License-Identifier: Apache-2.0
// An accelerator whose keys are SystemC CCI parameters. Only for platforms that have CCI: no other
// file of this project includes it, and the library does not need CCI.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <cci_configuration>

#include "degs/design.hpp"
#include "degs/messages.hpp"
#include "degs/options.hpp"

namespace degs {

/// Makes an immutable CCI parameter of every key of an accelerator, NAME.scheduler.banks for one of
/// its design and NAME.options.memory.transport for one of AcceleratorOptions, whose value is what
/// a broker has preset, else the default. Numbers are std::int64_t and double, choices and texts
/// std::string. Lives as long as tools shall see the parameters.
///
///     const std::string path = std::string(name()) + ".gpu";
///     degs::CciParameters parameters(cci::cci_get_broker(), path, defaults);
///     degs::Accelerator gpu("gpu", parameters.design(), parameters.options());
///
/// Outside of modules, where there is no such broker, the first argument is
/// cci_get_global_broker(). A value out of its range and a choice that does not exist are refused
/// as reports::kConfig, and a preset below NAME that is no parameter is a warning of this type;
/// what else is wrong with a design, Accelerator reports.
class CciParameters {
public:
    /// `name`: hierarchical name of the accelerator to be built.
    CciParameters(const cci::cci_broker_handle& broker, const std::string& name,
                  const Design& defaults, const AcceleratorOptions& options = {})
        : design_(defaults), options_(options) {
        Reader keys(broker, name, name + ".", parameters_);
        design_.visit(keys);
        Reader more(broker, name, name + ".options.", parameters_);
        options_.visit(more);
        for (const auto& preset : broker.get_unconsumed_preset_values()) {
            if (preset.first.compare(0, name.size() + 1, name + ".") == 0) {
                const std::string text = preset.first + ": the accelerator has no such parameter";
                SC_REPORT_WARNING(reports::kConfig, text.c_str());
            }
        }
    }

    const Design& design() const { return design_; }
    const AcceleratorOptions& options() const { return options_; }
    std::size_t size() const { return parameters_.size(); }

private:
    using Parameters = std::vector<std::shared_ptr<void>>; // of several types

    class Reader : public KeyVisitor {
    public:
        Reader(const cci::cci_broker_handle& broker, const std::string& name,
               const std::string& prefix, Parameters& parameters)
            : broker_(broker), origin_(name), prefix_(prefix), parameters_(parameters) {}

        void integer(const std::string& path, std::int64_t& value, std::int64_t low,
                     std::int64_t high, const std::string& doc) override {
            number(path, value, low, high, doc);
        }
        void real(const std::string& path, double& value, double low, double high,
                  const std::string& doc) override {
            number(path, value, low, high, doc);
        }
        void boolean(const std::string& path, bool& value, const std::string& doc) override {
            value = parameter(path, value, doc);
        }
        void text(const std::string& path, std::string& value, const std::string& doc) override {
            value = parameter(path, value, doc);
        }
        void choice(const std::string& path, int& value, const std::vector<std::string>& names,
                    const std::string& doc) override {
            const std::string chosen = parameter(path, names.at(value), doc);
            std::string all;
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (chosen == names[i]) {
                    value = static_cast<int>(i);
                    return;
                }
                all += (i == 0 ? "" : ", ") + names[i];
            }
            refuse(path, "'" + chosen + "' is none of " + all);
        }

    private:
        template <class Value>
        Value parameter(const std::string& path, const Value& value, const std::string& doc) {
            auto made = std::make_shared<cci::cci_param<Value, cci::CCI_IMMUTABLE_PARAM>>(
                prefix_ + path, value, broker_, doc, cci::CCI_ABSOLUTE_NAME, origin_);
            parameters_.push_back(made);
            return made->get_value();
        }
        template <class Number>
        void number(const std::string& path, Number& value, Number low, Number high,
                    const std::string& doc) {
            value = parameter(path, value, doc);
            if (!(value >= low && value <= high)) {
                refuse(path, std::to_string(value) + " is not between " + std::to_string(low) +
                                 " and " + std::to_string(high));
            }
        }
        [[noreturn]] void refuse(const std::string& path, const std::string& why) const {
            const std::string text = prefix_ + path + ": " + why;
            SC_REPORT_ERROR(reports::kConfig, text.c_str());
            throw std::invalid_argument(std::string(reports::kConfig) + ": " + text);
        }

        cci::cci_broker_handle broker_;
        cci::cci_originator origin_;
        std::string prefix_;
        Parameters& parameters_;
    };

    Design design_;
    AcceleratorOptions options_;
    Parameters parameters_;
};

} // namespace degs
