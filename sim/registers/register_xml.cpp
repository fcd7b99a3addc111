// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include <pugixml.hpp>

#include "platform/accelerator_registers.hpp"
#include "sim/registers/register_formats.hpp"

namespace degs::sim {
namespace {

using Node = pugi::xml_node;

constexpr const char* kWhat =
    "Accelerator for 3D Gaussian Splatting: registers of the SystemC model";

std::string text_of(const pugi::xml_document& document) {
    std::ostringstream out;
    document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
    return out.str();
}

void start(pugi::xml_document& document, const char* format) {
    Node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    document.append_child(pugi::node_comment).set_value(" SPDX-License-Identifier: Apache-2.0 ");
    document.append_child(pugi::node_comment)
        .set_value((std::string(" Written by degs registers --format ") + format + " ").c_str());
}

std::string hex(std::uint64_t value, const char* prefix) {
    std::ostringstream out;
    out << prefix << std::hex << std::uppercase << value;
    return out.str();
}

std::string plain(std::string text) {
    text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
    return text;
}

/// Elements of one document, whose names may need a prefix.
class Writer {
public:
    Writer(const char* prefix, const char* number) : prefix_(prefix), number_(number) {}
    Node add(Node parent, const char* name) const {
        return parent.append_child((prefix_ + name).c_str());
    }
    void text(Node parent, const char* name, const std::string& value) const {
        add(parent, name).text().set(plain(value).c_str());
    }
    void number(Node parent, const char* name, std::uint64_t value) const {
        add(parent, name).text().set(hex(value, number_).c_str());
    }
    void name(Node parent, const std::string& name, const std::string& description) const {
        text(parent, "name", name);
        text(parent, "description", description);
    }
    /// The names of values, if there are any.
    void values(Node field, const RegisterInfo& info) const {
        if (info.values.empty()) {
            return;
        }
        Node values = add(field, "enumeratedValues");
        for (const RegisterValue& value : info.values) {
            Node each = add(values, "enumeratedValue");
            name(each, value.name, value.meaning);
            number(each, "value", value.value);
        }
    }

private:
    std::string prefix_;
    const char* number_;
};

const char* access_name(Access access) {
    return access == Access::Read      ? "read-only"
           : access == Access::Command ? "write-only"
                                       : "read-write";
}

void svd_field(const Writer& svd, Node fields, const RegisterField& field) {
    Node each = svd.add(fields, "field");
    svd.name(each, field.name, field.meaning);
    svd.number(each, "bitOffset", field.bit);
    svd.number(each, "bitWidth", 1);
}

void svd_register(const Writer& svd, Node registers, const RegisterInfo& info) {
    Node each = svd.add(registers, "register");
    if (info.words > 1) {
        svd.number(each, "dim", info.words);
        svd.number(each, "dimIncrement", 4);
    }
    svd.name(each, info.words > 1 ? std::string(info.name) + "[%s]" : info.name, info.meaning);
    svd.number(each, "addressOffset", static_cast<std::uint32_t>(info.offset));
    svd.text(each, "access", access_name(info.access));
    svd.number(each, "resetValue", info.reset);
    if (info.access == Access::WriteOneToClear) {
        svd.text(each, "modifiedWriteValues", "oneToClear");
    }
    if (info.fields.empty() && info.values.empty()) {
        return;
    }
    Node fields = svd.add(each, "fields");
    for (const RegisterField& field : info.fields) {
        svd_field(svd, fields, field);
    }
    if (!info.values.empty()) {
        Node field = svd.add(fields, "field");
        svd.name(field, info.name, info.meaning);
        svd.number(field, "bitOffset", 0);
        svd.number(field, "bitWidth", 32);
        svd.values(field, info);
    }
}

void ip_xact_field(const Writer& xml, Node each, const RegisterInfo& info,
                   const RegisterField& field, std::uint32_t bits) {
    Node node = xml.add(each, "field");
    xml.name(node, field.name, field.meaning);
    xml.number(node, "bitOffset", field.bit);
    xml.number(node, "bitWidth", bits);
    const bool volatile_value = info.access != Access::ReadWrite;
    xml.text(node, "volatile", volatile_value ? "true" : "false");
    const std::uint32_t reset = bits == 32 ? info.reset : info.reset >> field.bit & 1U;
    xml.number(xml.add(xml.add(node, "resets"), "reset"), "value", reset);
    Node policy = xml.add(xml.add(node, "fieldAccessPolicies"), "fieldAccessPolicy");
    xml.text(policy, "access", access_name(info.access));
    if (info.access == Access::WriteOneToClear) {
        xml.text(policy, "modifiedWriteValue", "oneToClear");
    }
    if (bits == 32) {
        xml.values(node, info);
    }
}

void ip_xact_register(const Writer& xml, Node block, const RegisterInfo& info) {
    Node each = xml.add(block, "register");
    xml.name(each, info.name, info.meaning);
    if (info.words > 1) {
        xml.number(xml.add(each, "array"), "dim", info.words);
    }
    xml.number(each, "addressOffset", static_cast<std::uint32_t>(info.offset));
    xml.number(each, "size", 32);
    for (const RegisterField& field : info.fields) {
        ip_xact_field(xml, each, info, field, 1);
    }
    if (info.fields.empty()) {
        ip_xact_field(xml, each, info, {"VALUE", 0, info.meaning}, 32);
    }
}

} // namespace

std::string registers_svd() {
    pugi::xml_document document;
    start(document, "svd");
    const Writer svd("", "0x");
    Node device = svd.add(document, "device");
    device.append_attribute("schemaVersion") = "1.3";
    device.append_attribute("xmlns:xs") = "http://www.w3.org/2001/XMLSchema-instance";
    device.append_attribute("xs:noNamespaceSchemaLocation") = "CMSIS-SVD.xsd";
    svd.text(device, "name", "DeGS");
    svd.text(device, "version", "1.0");
    svd.text(device, "description", kWhat);
    svd.text(device, "addressUnitBits", "8");
    svd.text(device, "width", "32");
    svd.text(device, "size", "32");
    Node peripheral = svd.add(svd.add(device, "peripherals"), "peripheral");
    svd.name(peripheral, "DEGS", kWhat);
    svd.number(peripheral, "baseAddress", 0);
    Node block = svd.add(peripheral, "addressBlock");
    svd.number(block, "offset", 0);
    svd.number(block, "size", kRegisterBytes);
    svd.text(block, "usage", "registers");
    Node registers = svd.add(peripheral, "registers");
    for (const RegisterInfo& info : register_map()) {
        svd_register(svd, registers, info);
    }
    return text_of(document);
}

std::string registers_ip_xact() {
    pugi::xml_document document;
    start(document, "ip-xact");
    const Writer xml("ipxact:", "'h");
    const std::string space = "http://www.accellera.org/XMLSchema/IPXACT/1685-2022";
    Node component = xml.add(document, "component");
    component.append_attribute("xmlns:ipxact") = space.c_str();
    component.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
    component.append_attribute("xsi:schemaLocation") = (space + " " + space + "/index.xsd").c_str();
    xml.text(component, "vendor", "degs");
    xml.text(component, "library", "platform");
    xml.text(component, "name", "accelerator");
    xml.text(component, "version", "1.0");
    xml.text(component, "description", kWhat);
    Node map = xml.add(xml.add(component, "memoryMaps"), "memoryMap");
    xml.text(map, "name", "registers");
    Node block = xml.add(map, "addressBlock");
    xml.text(block, "name", "registers");
    xml.number(block, "baseAddress", 0);
    xml.number(block, "range", kRegisterBytes);
    xml.number(block, "width", 32);
    xml.text(block, "usage", "register");
    for (const RegisterInfo& info : register_map()) {
        ip_xact_register(xml, block, info);
    }
    xml.text(map, "addressUnitBits", "8");
    return text_of(document);
}

} // namespace degs::sim
