// SPDX-License-Identifier: Apache-2.0
#include "base/shared_bytes.hpp"

#include <cstdint>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace degs {
namespace {

std::string text_of(std::size_t i) {
    return std::string(i % 40 + 1, static_cast<char>('a' + i % 26)) + std::to_string(i);
}

TEST(SharedBytes, GivesWhatWasPutFirst) {
    SharedBytes bytes(1 << 16);
    EXPECT_EQ(bytes.find("key").data(), nullptr);
    bytes.put("key", "value");
    bytes.put("key", "another");
    bytes.put("empty", "");
    EXPECT_EQ(bytes.find("key"), "value");
    ASSERT_NE(bytes.find("empty").data(), nullptr);
    EXPECT_TRUE(bytes.find("empty").empty());
    EXPECT_EQ(bytes.find("ke").data(), nullptr);
    EXPECT_EQ(bytes.find("").data(), nullptr);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes.find("key").data()) % 8, 0U);
}

TEST(SharedBytes, KeepsNoMoreThanItHasRoomFor) {
    SharedBytes bytes(100);
    bytes.put("large", std::string(200, 'x'));
    EXPECT_EQ(bytes.find("large").data(), nullptr);
    bytes.put("small", std::string(50, 'x'));
    EXPECT_EQ(bytes.find("small").size(), 50U);
    bytes.put("too much", std::string(60, 'x'));
    EXPECT_EQ(bytes.find("too much").data(), nullptr);
    EXPECT_LE(bytes.used(), 100U);
}

TEST(SharedBytes, KeepsNothingWhereTheSystemHasNoMemory) {
    SharedBytes bytes(~std::size_t{0} / 4);
    bytes.put("key", "value");
    EXPECT_EQ(bytes.find("key").data(), nullptr);
    EXPECT_EQ(bytes.used(), 0U);
}

// Four processes put the same and other keys at the same time; one of them is killed on the way.
TEST(SharedBytes, ForksShareIt) {
    constexpr std::size_t kKeys = 20000;
    SharedBytes bytes(1 << 23);
    for (std::size_t child = 0; child < 4; ++child) {
        const pid_t pid = ::fork();
        ASSERT_GE(pid, 0);
        if (pid == 0) {
            for (std::size_t i = child % 2; i < kKeys; ++i) {
                bytes.put(text_of(i), "value of " + text_of(i));
                if (child == 3 && i == kKeys / 2) {
                    ::_exit(1);
                }
            }
            ::_exit(0);
        }
    }
    while (::wait(nullptr) > 0) {
    }
    for (std::size_t i = 0; i < kKeys; ++i) {
        ASSERT_EQ(bytes.find(text_of(i)), "value of " + text_of(i)) << i;
    }
}

} // namespace
} // namespace degs
