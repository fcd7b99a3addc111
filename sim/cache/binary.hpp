// SPDX-License-Identifier: Apache-2.0
// Values as the bytes that this program keeps them in, for files that only this program reads.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace degs::sim {

/// Appends values to its bytes. pass() takes several of them, so that one list of members can serve
/// both directions.
class BinaryWriter {
public:
    template <class... Values>
    void pass(const Values&... values) {
        (put(values), ...);
    }
    template <class Value>
    void put(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class Value>
    void put(const std::vector<Value>& values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        put(std::uint64_t{values.size()});
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
    }
    void put(const std::string& text) {
        put(std::uint64_t{text.size()});
        bytes += text;
    }

    std::string bytes;
};

/// Reads them in the same order. What does not fit into the bytes leaves values as they are, and
/// then good() is false.
class BinaryReader {
public:
    BinaryReader(const char* at, std::size_t bytes) : at_(at), left_(bytes) {}

    template <class... Values>
    void pass(Values&... values) {
        (get(values), ...);
    }
    template <class Value>
    void get(Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        take(&value, sizeof value);
    }
    template <class Value>
    void get(std::vector<Value>& values) {
        std::uint64_t count = 0;
        get(count);
        if (good_ && count <= left_ / sizeof(Value)) {
            const auto* const first = reinterpret_cast<const Value*>(at_);
            if (reinterpret_cast<std::uintptr_t>(at_) % alignof(Value) == 0) {
                values.assign(first, first + count); // without setting them to zero before
                skip(count * sizeof(Value));
            } else {
                values.resize(count);
                take(values.data(), count * sizeof(Value));
            }
        } else {
            good_ = false;
        }
    }
    void get(std::string& text) {
        std::uint64_t count = 0;
        get(count);
        if (good_ && count <= left_) {
            text.assign(at_, count);
            skip(count);
        } else {
            good_ = false;
        }
    }
    /// True if no byte was missing.
    bool good() const { return good_; }
    /// True if no byte was missing and none is left over.
    bool complete() const { return good_ && left_ == 0; }

private:
    void take(void* to, std::size_t bytes) {
        good_ = good_ && bytes <= left_;
        if (good_ && bytes > 0) {
            std::memcpy(to, at_, bytes);
            skip(bytes);
        }
    }
    void skip(std::size_t bytes) {
        at_ += bytes;
        left_ -= bytes;
    }

    const char* at_;
    std::size_t left_;
    bool good_ = true;
};

} // namespace degs::sim
