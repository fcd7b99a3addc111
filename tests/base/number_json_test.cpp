// SPDX-License-Identifier: Apache-2.0
#include "base/number_json.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace degs {
namespace {

// Readers of JSON know neither infinities nor NaN as numbers.
TEST(NumberJson, EveryReaderTakesIt) {
    EXPECT_EQ(number_json(0.5).dump(), "0.5");
    EXPECT_EQ(number_json(INFINITY).dump(), "\"inf\"");
    EXPECT_EQ(number_json(-INFINITY).dump(), "\"-inf\"");
    EXPECT_EQ(number_json(NAN).dump(), "null");
}

TEST(NumberJson, WhatDoesNotExistIsNull) {
    EXPECT_EQ(value_or_null(std::optional<double>()).dump(), "null");
    EXPECT_EQ(value_or_null(std::optional<double>(INFINITY)).dump(), "\"inf\"");
    EXPECT_EQ(value_or_null(std::optional<int>()).dump(), "null");
    EXPECT_EQ(value_or_null(std::optional<int>(3)).dump(), "3");
}

} // namespace
} // namespace degs
