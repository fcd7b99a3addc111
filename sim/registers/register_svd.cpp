// SPDX-License-Identifier: Apache-2.0
#include "sim/registers/register_formats.hpp"
#include "sim/registers/xml_writer.hpp"

namespace degs::sim {
namespace {

using Node = pugi::xml_node;

void svd_field(const XmlWriter& svd, Node fields, const RegisterField& field) {
    Node each = svd.add(fields, "field");
    svd.name(each, field.name, field.meaning);
    svd.number(each, "bitOffset", field.bit);
    svd.number(each, "bitWidth", 1);
}

void svd_register(const XmlWriter& svd, Node registers, const RegisterInfo& info) {
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

} // namespace

std::string registers_svd() {
    pugi::xml_document document;
    start_xml(document, "svd");
    const XmlWriter svd("", "0x");
    Node device = svd.add(document, "device");
    device.append_attribute("schemaVersion") = "1.3";
    device.append_attribute("xmlns:xs") = "http://www.w3.org/2001/XMLSchema-instance";
    device.append_attribute("xs:noNamespaceSchemaLocation") = "CMSIS-SVD.xsd";
    svd.text(device, "name", "DeGS");
    svd.text(device, "version", "1.0");
    svd.text(device, "description", kRegistersAre);
    svd.text(device, "addressUnitBits", "8");
    svd.text(device, "width", "32");
    svd.text(device, "size", "32");
    Node peripheral = svd.add(svd.add(device, "peripherals"), "peripheral");
    svd.name(peripheral, "DEGS", kRegistersAre);
    svd.number(peripheral, "baseAddress", 0);
    Node block = svd.add(peripheral, "addressBlock");
    svd.number(block, "offset", 0);
    svd.number(block, "size", kRegisterBytes);
    svd.text(block, "usage", "registers");
    Node registers = svd.add(peripheral, "registers");
    for (const RegisterInfo& info : register_map()) {
        svd_register(svd, registers, info);
    }
    return xml_text(document);
}

} // namespace degs::sim
