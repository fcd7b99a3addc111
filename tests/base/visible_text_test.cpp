// SPDX-License-Identifier: Apache-2.0
#include "base/visible_text.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(HostileText, ControlsAreEscaped) {
    EXPECT_EQ(visible("a\x1b[31mb"), "a\\x1b[31mb");
    EXPECT_EQ(visible("a\r\nb\tc\x7f"), "a\\r\\nb\\tc\\x7f");
    EXPECT_EQ(visible(std::string("\0\x01", 2)), "\\x00\\x01");
    EXPECT_EQ(visible("\xc2\x9b"
                      "31m"),
              "\\xc2\\x9b31m"); // CSI as one character
    EXPECT_EQ(visible("\xe2\x80\xae"
                      "gnp.exe"),
              "\\xe2\\x80\\xaegnp.exe");                   // right to left
    EXPECT_EQ(visible("\xe2\x80\xa8"), "\\xe2\\x80\\xa8"); // line separator
}

TEST(HostileText, WhatIsNoUtf8IsEscapedByteByByte) {
    EXPECT_EQ(visible("\x9b"
                      "31m\xff"),
              "\\x9b31m\\xff");
    EXPECT_EQ(visible("\xc3"), "\\xc3");                            // ends too early
    EXPECT_EQ(visible("\xc3(\xe2\x82"), "\\xc3(\\xe2\\x82");        // goes on wrongly
    EXPECT_EQ(visible("\xc0\x9b"), "\\xc0\\x9b");                   // longer than needed
    EXPECT_EQ(visible("\xed\xa0\x80"), "\\xed\\xa0\\x80");          // half of a UTF-16 pair
    EXPECT_EQ(visible("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80"); // beyond U+10FFFF
}

TEST(VisibleText, WordsStayAsTheyAre) {
    const std::string text = "1920×1080 · é 漢字 🙂 \\x1b 'quoted'";
    EXPECT_EQ(visible(text), text);
    EXPECT_EQ(visible_lines("a\nb\n\x1b"), "a\nb\n\\x1b");
    EXPECT_EQ(visible(""), "");
}

} // namespace
} // namespace degs
