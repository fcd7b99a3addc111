// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "degs/keys.hpp"

namespace degs {

/// Looks up the value of one key, as a file would say it.
class KeyValue : public KeyVisitor {
public:
    explicit KeyValue(const std::string& path) : wanted_(path) {}

    void integer(const std::string& path, std::int64_t& value, std::int64_t /*low*/,
                 std::int64_t /*high*/, const std::string& /*doc*/) override {
        see(path, config_words::number(value));
    }
    void real(const std::string& path, double& value, double /*low*/, double /*high*/,
              const std::string& /*doc*/) override {
        see(path, config_words::number(value));
    }
    void boolean(const std::string& path, bool& value, const std::string& /*doc*/) override {
        see(path, value ? "true" : "false");
    }
    void text(const std::string& path, std::string& value, const std::string& /*doc*/) override {
        see(path, value);
    }
    void choice(const std::string& path, int& value, const std::vector<std::string>& names,
                const std::string& /*doc*/) override {
        see(path, names.at(value));
    }

    /// Throws InputError, which suggests a key, if nobody has described the wanted one.
    const std::string& value() const {
        if (!found_) {
            const std::string near = config_words::nearest(wanted_, paths_);
            throw InputError(
                "key " + config_words::quote(wanted_) + " is unknown" +
                (near.empty() ? "" : ", did you mean " + config_words::quote(near) + "?") +
                (near.empty() ? "." : ""));
        }
        return value_;
    }

private:
    void see(const std::string& path, const std::string& value) {
        paths_.push_back(path);
        if (path == wanted_) {
            found_ = true;
            value_ = value;
        }
    }

    std::string wanted_, value_;
    bool found_ = false;
    std::vector<std::string> paths_;
};

} // namespace degs
