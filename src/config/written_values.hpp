// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config_words.hpp"
#include "degs/keys.hpp"

namespace degs {

/// Sees the value of every key as a file would say it.
class WrittenValues : public KeyVisitor {
public:
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

private:
    virtual void see(const std::string& path, const std::string& value) = 0;
};

} // namespace degs
