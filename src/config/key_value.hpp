// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config_words.hpp"
#include "config/written_values.hpp"
#include "degs/error.hpp"

namespace degs {

/// Looks up the value of one key, as a file would say it.
class KeyValue : public WrittenValues {
public:
    explicit KeyValue(const std::string& path) : wanted_(path) {}

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
    void see(const std::string& path, const std::string& value) override {
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
