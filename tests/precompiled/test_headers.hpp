// SPDX-License-Identifier: Apache-2.0
// What most tests include anyway. Saves time, not lines: tests compile without it, too.
// No guard, because it is compiled as a main file.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm>
