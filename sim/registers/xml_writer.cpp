// SPDX-License-Identifier: Apache-2.0
#include "sim/registers/xml_writer.hpp"

#include <algorithm>
#include <sstream>

namespace degs::sim {
namespace {

std::string hex(std::uint64_t value, const char* prefix) {
    std::ostringstream out;
    out << prefix << std::hex << std::uppercase << value;
    return out.str();
}

std::string plain(std::string text) {
    text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
    return text;
}

} // namespace

std::string xml_text(const pugi::xml_document& document) {
    std::ostringstream out;
    document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
    return out.str();
}

void start_xml(pugi::xml_document& document, const char* format) {
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    document.append_child(pugi::node_comment).set_value(" SPDX-License-Identifier: Apache-2.0 ");
    document.append_child(pugi::node_comment)
        .set_value((std::string(" Written by degs registers --format ") + format + " ").c_str());
}

const char* access_name(Access access) {
    return access == Access::Read      ? "read-only"
           : access == Access::Command ? "write-only"
                                       : "read-write";
}

void XmlWriter::text(Node parent, const char* name, const std::string& value) const {
    add(parent, name).text().set(plain(value).c_str());
}

void XmlWriter::number(Node parent, const char* name, std::uint64_t value) const {
    add(parent, name).text().set(hex(value, number_).c_str());
}

void XmlWriter::values(Node field, const RegisterInfo& info) const {
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

} // namespace degs::sim
