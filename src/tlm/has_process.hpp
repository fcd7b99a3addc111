// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

/// Stands at the head of a constructor that has SC_THREAD or SC_METHOD. SystemC 2.3 has to be told
/// the type of the module there; SystemC 3.0 (IEEE 1666-2023) knows it, and calls being told
/// deprecated.
#if IEEE_1666_SYSTEMC >= 202301L
#define DEGS_HAS_PROCESS(Module) static_assert(true, "SystemC knows the type of " #Module)
#else
#define DEGS_HAS_PROCESS(Module) SC_HAS_PROCESS(Module)
#endif
