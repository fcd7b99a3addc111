// SPDX-License-Identifier: Apache-2.0
// run_program ELF: runs a program on the core alone. A word that it stores at 0x20000000 is
// printed, one at 0x20000004 is the exit code.
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <vector>

#include "elf.hpp"
#include "rv32.hpp"

namespace {

class Machine : public rv32::Memory {
public:
    explicit Machine(const std::vector<unsigned char>& elf) : Machine(elf, 0x20000) {}
    /// The exit code of the program; 99 if it takes more than `steps` instructions.
    int run(std::uint64_t steps) {
        while (!ended_ && steps-- > 0) {
            core_.step();
        }
        return ended_ ? status_ : 99;
    }

private:
    Machine(const std::vector<unsigned char>& elf, std::uint32_t bytes) {
        const rv32::Program program = rv32::parse_elf(elf, "The program");
        memory_ = rv32::memory_image(program, bytes, "The program");
        memory_.resize(bytes);
        core_.set_pc(program.entry);
    }
    bool fetch(std::uint32_t address, std::uint32_t& word) override {
        return load(address, 4, word);
    }
    bool load(std::uint32_t address, unsigned bytes, std::uint32_t& value) override {
        value = 0;
        if (address >= memory_.size()) {
            return false;
        }
        std::memcpy(&value, &memory_[address], bytes);
        return true;
    }
    bool store(std::uint32_t address, unsigned bytes, std::uint32_t value) override {
        if (address < memory_.size()) {
            std::memcpy(&memory_[address], &value, bytes);
        } else if (address == 0x20000000) {
            std::printf("%08x\n", value);
        } else if (address == 0x20000004) {
            ended_ = true;
            status_ = static_cast<int>(value & 127U);
        } else {
            return false;
        }
        return true;
    }

    std::vector<unsigned char> memory_;
    rv32::Core core_{*this};
    bool ended_ = false;
    int status_ = 0;
};

} // namespace

int main(int argc, char* argv[]) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: run_program ELF\n");
        return 2;
    }
    std::ifstream in(argv[1], std::ios::binary);
    try {
        return Machine({std::istreambuf_iterator<char>(in), {}}).run(100'000'000);
    } catch (const std::exception& mistake) {
        std::fprintf(stderr, "%s\n", mistake.what());
        return 1;
    }
}
