// SPDX-License-Identifier: Apache-2.0
// The register map of degs::Accelerator. `degs registers` prints it in the formats of its readers:
// docs/accelerator.md has the table, degs_registers.h is the header for programs in C, and driver/
// has the XML of tools.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "degs/registers.hpp"

namespace degs {

enum class Access { Read, ReadWrite, WriteOneToClear, Command };

/// One bit with a meaning of its own. The bits that no field names are reserved: they read as 0,
/// and what is written to them is lost.
struct RegisterField {
    const char* name;
    std::uint32_t bit;
    std::string meaning;
};
/// One value of a word with a name.
struct RegisterValue {
    const char* name;
    std::uint32_t value;
    std::string meaning;
};

/// One row of the map. Without fields, all bits of a register are one number; `values` names some
/// of them.
struct RegisterInfo {
    Register offset;
    std::uint32_t words;
    const char* name;
    Access access;
    std::string meaning; ///< half a sentence, in the words of docs/accelerator.md
    std::vector<RegisterField> fields{};
    std::vector<RegisterValue> values{};
    std::uint32_t reset = 0; ///< value of each word before anything is written

    /// A mask of the bits of the register that exist.
    std::uint32_t bits() const;
};
/// A row of the layout of an entry of the table of views.
struct ViewFieldInfo {
    ViewField offset;
    std::uint32_t words;
    const char* name;
    std::string meaning;
    std::vector<RegisterValue> values{};
    Register same{}; ///< the register with the same meaning; Id: there is none
};
/// The whole layout, by ascending offset. What lies in between is reserved and not looked at.
const std::vector<ViewFieldInfo>& view_layout();

/// All registers, by ascending offset. Offsets in between are reserved: they read as 0, and writing
/// them is an error.
const std::vector<RegisterInfo>& register_map();

/// The words behind the map, without time and bus.
class AcceleratorRegisters {
public:
    AcceleratorRegisters();
    std::uint32_t word(std::uint32_t offset) const { return words_[offset / 4]; }
    void set_word(std::uint32_t offset, std::uint32_t value) { words_[offset / 4] = value; }
    std::uint32_t get(Register which) const { return word(offset_of(which)); }
    void set(Register which, std::uint32_t value) { set_word(offset_of(which), value); }
    /// The place where the low word of a register is kept, for tracing.
    const std::uint32_t& low_word(Register which) const { return words_[offset_of(which) / 4]; }
    std::uint64_t get_pair(Register which, std::uint32_t index = 0) const;
    void set_pair(Register which, std::uint64_t value);
    /// The value of a pair of registers that holds an IEEE 754 double.
    double get_double(Register which, std::uint32_t index = 0) const;

    /// The row that holds this word, or nullptr if the word is reserved.
    static const RegisterInfo* find(std::uint32_t offset);
    static std::uint32_t offset_of(Register which) { return static_cast<std::uint32_t>(which); }

private:
    std::array<std::uint32_t, kRegisterBytes / 4> words_{};
};

} // namespace degs
