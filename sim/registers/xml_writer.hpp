// SPDX-License-Identifier: Apache-2.0
// Elements and words that both XML formats of the register map use.
#pragma once

#include <cstdint>
#include <string>

#include <pugixml.hpp>

#include "platform/accelerator_registers.hpp"

namespace degs::sim {

constexpr const char* kRegistersAre =
    "Accelerator for 3D Gaussian Splatting: registers of the SystemC model";

/// The declaration and the comments at the top; `format`: of `degs registers`.
void start_xml(pugi::xml_document& document, const char* format);
std::string xml_text(const pugi::xml_document& document);
/// "read-only", "write-only" or "read-write", the words of both formats.
const char* access_name(Access access);

/// Elements of one document, whose names may need a prefix.
class XmlWriter {
public:
    using Node = pugi::xml_node;

    /// `number`: what stands before a hexadecimal number.
    XmlWriter(const char* prefix, const char* number) : prefix_(prefix), number_(number) {}
    Node add(Node parent, const char* name) const {
        return parent.append_child((prefix_ + name).c_str());
    }
    /// Without back quotes, which mark code in the pages.
    void text(Node parent, const char* name, const std::string& value) const;
    void number(Node parent, const char* name, std::uint64_t value) const;
    void name(Node parent, const std::string& name, const std::string& description) const {
        text(parent, "name", name);
        text(parent, "description", description);
    }
    /// The names of values, if there are any.
    void values(Node field, const RegisterInfo& info) const;

private:
    std::string prefix_;
    const char* number_;
};

} // namespace degs::sim
