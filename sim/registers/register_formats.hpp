// SPDX-License-Identifier: Apache-2.0
// The register map of degs::Accelerator in the formats of its readers. All of them come from
// register_map().
#pragma once

#include <string>

namespace degs::sim {

/// The table of docs/accelerator.md.
std::string registers_markdown();
/// The table of the same page of an entry of the table of views.
std::string view_entry_markdown();
/// A header of C11: offsets, bits and values as macros, those of an entry likewise.
std::string registers_c();
/// CMSIS-SVD 1.3: a device of one peripheral at address 0. Registers of several words are arrays.
std::string registers_svd();
/// An IP-XACT component (IEEE 1685-2022) with a memory map, likewise.
std::string registers_ip_xact();

} // namespace degs::sim
