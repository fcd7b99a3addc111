// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace degs {

/// Walks over the keys of a Design or of AcceleratorOptions, in the order of the manual. `path` is
/// the name of a key in `--set` and in files, "scheduler.banks". Every function may change the
/// value; a choice decides which keys follow. `doc` starts with the unit and gives the reason of
/// the default.
class KeyVisitor {
public:
    KeyVisitor() = default;
    KeyVisitor(const KeyVisitor&) = delete;
    KeyVisitor& operator=(const KeyVisitor&) = delete;
    virtual ~KeyVisitor() = default;
    /// Both bounds belong to the range.
    virtual void integer(const std::string& path, std::int64_t& value, std::int64_t low,
                         std::int64_t high, const std::string& doc) = 0;
    virtual void real(const std::string& path, double& value, double low, double high,
                      const std::string& doc) = 0;
    virtual void boolean(const std::string& path, bool& value, const std::string& doc) = 0;
    virtual void text(const std::string& path, std::string& value, const std::string& doc) = 0;
    /// `value` is an index into `names`; one outside of them is refused with an InputError.
    virtual void choice(const std::string& path, int& value, const std::vector<std::string>& names,
                        const std::string& doc) = 0;
};

} // namespace degs
