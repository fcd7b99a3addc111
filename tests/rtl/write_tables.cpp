// SPDX-License-Identifier: Apache-2.0
// degs_rtl_tables FOLDER: writes the entries of the model's tables for $readmemh, one file for the
// values and one for the differences of the cells: paper_root_values.hex and so on.
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "splat/numbers/number_set.hpp"
#include "tests/rtl/number_code.hpp"

namespace degs::rtl_test {
namespace {

void write(const std::string& path, const NumberFormat& format, const std::vector<float>& values) {
    std::ofstream file(path);
    file << std::hex << std::setfill('0');
    for (const float value : values) {
        file << std::setw(4) << code_of(format, value) << '\n';
    }
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + path);
    }
}

void write(const std::string& start, const TableSpec& spec, const char* differences) {
    const LookupTable table(spec);
    write(start + "_values.hex", spec.values, table.lane_values());
    if (spec.interpolation == Interpolation::Linear) {
        write(start + differences, spec.values, table.lane_falls());
    }
}

} // namespace
} // namespace degs::rtl_test

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: degs_rtl_tables FOLDER\n";
        return 2;
    }
    for (const char* name : {"paper", "tuned"}) {
        const degs::NumberSet set = degs::number_set(name);
        const std::string start = std::string(argv[1]) + "/" + name;
        degs::rtl_test::write(start + "_root", set.sqrt, "_rises.hex");
        degs::rtl_test::write(start + "_exponential", set.exp, "_falls.hex");
    }
    return 0;
}
