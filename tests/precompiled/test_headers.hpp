// SPDX-License-Identifier: Apache-2.0
// Headers that most tests include. They save time only: tests compile without them as well. No
// guard, because it is compiled as a main file.

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
