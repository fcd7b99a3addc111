// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "config/config.hpp"

namespace degs::config_test {

enum class Order { row_major, morton, hilbert };

struct MemoryKeys {
    double latency_ns = 100.5;
    int access_bytes = 64;
    bool refresh = true;
    void describe(ConfigVisitor& v) {
        v.real("latency_ns", latency_ns, 0.0, 1e6, "ns, request to last byte");
        v.integer("access_bytes", access_bytes, 1, 4096, "bytes, granularity");
        v.boolean("refresh", refresh, "whether | rows are refreshed");
    }
};

/// One key of every kind, and a section.
struct Keys {
    int banks = 8;
    std::int64_t seed = 1;
    Order order = Order::morton;
    std::string title = "default";
    MemoryKeys memory;
    void describe(ConfigVisitor& v) {
        v.integer("banks", banks, 1, 64, "Issue Banks");
        v.integer("seed", seed, INT64_MIN, INT64_MAX, "of the random numbers");
        v.choice("order", order, {"row-major", "morton", "hilbert"},
                 "of the tiles; morton: a Z curve; hilbert: a curve without jumps");
        v.text("title", title, "for the report");
        v.section("memory", memory, "the memory behind the accelerator");
        v.require(seed % banks != 5, {"seed", "must not leave 5 by banks", "12", {"banks"}});
        v.require_at_least("banks", banks, memory.access_bytes / 64, "to keep up",
                           {"memory.access_bytes", "memory.latency_ns"});
    }
};

/// The sentence of the InputError that `action` throws; "" if it throws none.
template <class Action>
std::string sentence_of(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// A folder of its own for each test, removed at the end.
class ConfigFolder : public ::testing::Test {
protected:
    ConfigFolder()
        : folder_(std::filesystem::temp_directory_path() /
                  ("degs_config_" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~ConfigFolder() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& yaml) const {
        const std::filesystem::path path = folder_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << yaml;
        return path.string();
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }

private:
    std::filesystem::path folder_;
};

} // namespace degs::config_test
