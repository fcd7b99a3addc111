// SPDX-License-Identifier: Apache-2.0
#include "sim/registers/register_formats.hpp"
#include "sim/registers/xml_writer.hpp"

namespace degs::sim {
namespace {

using Node = pugi::xml_node;

void ip_xact_field(const XmlWriter& xml, Node each, const RegisterInfo& info,
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

void ip_xact_register(const XmlWriter& xml, Node block, const RegisterInfo& info) {
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

/// The vendor, library, name and version of what degs-tlm2-*.xml define.
void refer(Node node, const char* name) {
    node.append_attribute("vendor") = "degs";
    node.append_attribute("library") = "platform";
    node.append_attribute("name") = name;
    node.append_attribute("version") = "1.0";
}

/// A socket as a bus interface; the caller adds its mode.
Node ip_xact_bus(const XmlWriter& xml, Node interfaces, const char* socket, const char* meaning) {
    Node bus = xml.add(interfaces, "busInterface");
    xml.name(bus, socket, meaning);
    refer(xml.add(bus, "busType"), "tlm2");
    Node type = xml.add(xml.add(bus, "abstractionTypes"), "abstractionType");
    refer(xml.add(type, "abstractionRef"), "tlm2_tlm");
    Node map = xml.add(xml.add(type, "portMaps"), "portMap");
    xml.text(xml.add(map, "logicalPort"), "name", "SOCKET");
    xml.text(xml.add(map, "physicalPort"), "name", socket);
    return bus;
}

constexpr const char* kRegistersSocket = "32-bit words, little-endian, LT and debug";
constexpr const char* kMemorySocket = "scene, workspace and frame buffer; LT, or AT by an option";

void ip_xact_interfaces(const XmlWriter& xml, Node component) {
    Node interfaces = xml.add(component, "busInterfaces");
    Node registers = ip_xact_bus(xml, interfaces, "registers", kRegistersSocket);
    xml.add(xml.add(registers, "target"), "memoryMapRef").append_attribute("memoryMapRef") =
        "registers";
    Node memory = ip_xact_bus(xml, interfaces, "mem", kMemorySocket);
    xml.add(xml.add(memory, "initiator"), "addressSpaceRef").append_attribute("addressSpaceRef") =
        "memory";
}

void ip_xact_address_space(const XmlWriter& xml, Node component) {
    Node space = xml.add(xml.add(component, "addressSpaces"), "addressSpace");
    xml.name(space, "memory", "addresses of 64 bits");
    constexpr std::uint64_t kHalf = std::uint64_t{1} << 63U; // the whole does not fit 64 bits
    xml.number(space, "range", kHalf);
    xml.number(space, "width", 32);
    xml.text(space, "addressUnitBits", "8");
}

void ip_xact_socket(const XmlWriter& xml, Node ports, const char* socket, const char* meaning,
                    bool provides) {
    Node port = xml.add(ports, "port");
    xml.name(port, socket, meaning);
    Node transactional = xml.add(port, "transactional");
    xml.text(transactional, "initiative", provides ? "provides" : "requires");
    xml.text(transactional, "kind", provides ? "simple_socket" : "tlm_socket");
    xml.text(transactional, "busWidth", "32");
    Node protocol = xml.add(transactional, "protocol");
    xml.text(protocol, "protocolType", "tlm");
    Node payload = xml.add(protocol, "payload");
    xml.text(payload, "name", "TLM2");
    xml.text(payload, "type", "generic");
}

void ip_xact_wire(const XmlWriter& xml, Node ports, const char* name, const char* meaning,
                  const char* direction, const char* qualifier) {
    Node port = xml.add(ports, "port");
    xml.name(port, name, meaning);
    Node wire = xml.add(port, "wire");
    xml.text(wire, "direction", direction);
    Node kind = xml.add(xml.add(wire, "qualifier"), qualifier);
    kind.text().set("true");
    if (std::string(qualifier) == "isReset") {
        kind.append_attribute("level") = "low";
    }
}

void ip_xact_ports(const XmlWriter& xml, Node component) {
    Node ports = xml.add(xml.add(component, "model"), "ports");
    ip_xact_socket(xml, ports, "registers", kRegistersSocket, true);
    ip_xact_socket(xml, ports, "mem", kMemorySocket, false);
    ip_xact_wire(xml, ports, "irq", "high while an enabled interrupt is pending; may stay unbound",
                 "out", "isInterrupt");
    ip_xact_wire(xml, ports, "reset_n", "low: reset; may stay unbound", "in", "isReset");
    ip_xact_wire(xml, ports, "clk", "clock in place of clock_ghz; may stay unbound", "in",
                 "isClock");
}

} // namespace

std::string registers_ip_xact() {
    pugi::xml_document document;
    start_xml(document, "ip-xact");
    const XmlWriter xml("ipxact:", "'h");
    const std::string space = "http://www.accellera.org/XMLSchema/IPXACT/1685-2022";
    Node component = xml.add(document, "component");
    component.append_attribute("xmlns:ipxact") = space.c_str();
    component.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
    component.append_attribute("xsi:schemaLocation") = (space + " " + space + "/index.xsd").c_str();
    xml.text(component, "vendor", "degs");
    xml.text(component, "library", "platform");
    xml.text(component, "name", "accelerator");
    xml.text(component, "version", "1.0");
    xml.text(component, "description", kRegistersAre);
    ip_xact_interfaces(xml, component);
    ip_xact_address_space(xml, component);
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
    ip_xact_ports(xml, component);
    return xml_text(document);
}

} // namespace degs::sim
