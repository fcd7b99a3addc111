// SPDX-License-Identifier: Apache-2.0
// The register socket of degs::Accelerator: the map, its page, refused accesses, bad values.
#include <fstream>
#include <regex>

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

TEST(AcceleratorRegisters, AreAscendingAndInsideTheMap) {
    std::uint32_t end = 0;
    for (const RegisterInfo& info : register_map()) {
        const std::uint32_t offset = AcceleratorRegisters::offset_of(info.offset);
        EXPECT_GE(offset, end) << info.name;
        EXPECT_EQ(offset % (info.words == 1 ? 4 : 8), 0U) << info.name;
        EXPECT_EQ(AcceleratorRegisters::find(offset + 4 * info.words - 4), &info);
        end = offset + 4 * info.words;
    }
    EXPECT_EQ(end, kRegisterBytes);
    EXPECT_EQ(AcceleratorRegisters::find(kRegisterBytes), nullptr);
}

TEST(AcceleratorRegisters, AreThoseOfTheirPage) {
    std::ifstream page(std::string(DEGS_CONFIGS) + "/../docs/accelerator.md");
    ASSERT_TRUE(page);
    const std::regex row(R"(\| 0x([0-9A-F]{3}) \| ([A-Z_]+) \| (\d+) \| (r|rw|w1c|w) \|.*)");
    const std::vector<const char*> words{"r", "rw", "w1c", "w"};
    std::size_t next = 0;
    for (std::string line; std::getline(page, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, row)) {
            continue;
        }
        ASSERT_LT(next, register_map().size()) << line;
        const RegisterInfo& info = register_map()[next++];
        EXPECT_EQ(std::stoul(match[1], nullptr, 16), AcceleratorRegisters::offset_of(info.offset));
        EXPECT_EQ(match[2], info.name);
        EXPECT_EQ(std::stoul(match[3]), info.words);
        EXPECT_EQ(match[4], words[static_cast<std::size_t>(info.access)]);
    }
    EXPECT_EQ(next, register_map().size());
}

class SmallRunRegisters : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    Platform platform{"accelerator", DegsConfig(), cloud};

    void run(const std::function<void(Host&)>& script) {
        platform.host.script = script;
        sc_core::sc_start();
        EXPECT_TRUE(platform.host.finished);
    }
};

TEST_F(SmallRunRegisters, AccessesThatAreNoWholeWordAreRefused) {
    run([](Host& host) {
        std::array<unsigned char, 8> data{};
        const auto read = [&](std::uint64_t at, unsigned int length) {
            return host.access(tlm::TLM_READ_COMMAND, at, data.data(), length);
        };
        EXPECT_EQ(read(0, 4), tlm::TLM_OK_RESPONSE);
        EXPECT_EQ(std::string(data.begin(), data.begin() + 4), "DeGS");
        EXPECT_EQ(read(2, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
        EXPECT_EQ(read(0, 8), tlm::TLM_BURST_ERROR_RESPONSE);
        EXPECT_EQ(read(0, 2), tlm::TLM_BURST_ERROR_RESPONSE);
        EXPECT_EQ(read(0, 0), tlm::TLM_BURST_ERROR_RESPONSE);
        EXPECT_EQ(read(kRegisterBytes, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
        EXPECT_EQ(read(std::uint64_t{1} << 32U, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
        EXPECT_EQ(host.access(tlm::TLM_IGNORE_COMMAND, 0, data.data(), 4),
                  tlm::TLM_COMMAND_ERROR_RESPONSE);
        // Read-only and reserved words.
        EXPECT_EQ(host.access(tlm::TLM_WRITE_COMMAND, 0, data.data(), 4),
                  tlm::TLM_COMMAND_ERROR_RESPONSE);
        EXPECT_EQ(host.access(tlm::TLM_WRITE_COMMAND, 0x5C, data.data(), 4),
                  tlm::TLM_COMMAND_ERROR_RESPONSE);
        EXPECT_EQ(read(0x5C, 4), tlm::TLM_OK_RESPONSE);
        EXPECT_EQ(host.read(Register::Status), 0U);
    });
}

TEST_F(SmallRunRegisters, ByteEnablesAreRefused) {
    run([](Host& host) {
        tlm::tlm_generic_payload payload;
        unsigned char data[4] = {};
        unsigned char enable[4] = {0xFF, 0, 0, 0};
        payload.set_write();
        payload.set_address(AcceleratorRegisters::offset_of(Register::Width));
        payload.set_data_ptr(data);
        payload.set_data_length(4);
        payload.set_streaming_width(4);
        payload.set_byte_enable_ptr(enable);
        payload.set_byte_enable_length(4);
        sc_core::sc_time delay;
        host.out->b_transport(payload, delay);
        EXPECT_EQ(payload.get_response_status(), tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    });
}

TEST_F(SmallRunRegisters, DebugAccessesMoveWordsAndStartNothing) {
    run([](Host& host) {
        std::array<std::uint32_t, 2> words{7, 8};
        tlm::tlm_generic_payload payload;
        payload.set_write();
        payload.set_address(AcceleratorRegisters::offset_of(Register::Width));
        payload.set_data_ptr(reinterpret_cast<unsigned char*>(words.data()));
        payload.set_data_length(8);
        EXPECT_EQ(host.out->transport_dbg(payload), 8U);
        EXPECT_EQ(host.read(Register::Width), 7U);
        EXPECT_EQ(host.read(Register::Height), 8U);
        words[0] = kControlStart;
        payload.set_address(AcceleratorRegisters::offset_of(Register::Control));
        EXPECT_EQ(host.out->transport_dbg(payload), 0U);
        EXPECT_EQ(host.read(Register::Status), 0U);
        payload.set_read();
        payload.set_address(kRegisterBytes - 4);
        EXPECT_EQ(host.out->transport_dbg(payload), 4U);
    });
}

TEST_F(SmallRunRegisters, BadValuesEndInTheirErrorAndNameTheirRegister) {
    run([&](Host& host) {
        const auto expect = [&](AcceleratorError error, Register which) {
            EXPECT_FALSE(host.render());
            EXPECT_EQ(host.error(), error) << static_cast<std::uint32_t>(which);
            EXPECT_EQ(host.read(Register::ErrorDetail), AcceleratorRegisters::offset_of(which));
            program(host, cloud, camera);
            host.write(Register::Format, 0);
        };
        expect(AcceleratorError::BadSize, Register::Width); // nothing has been programmed
        const auto word = [&](Register which, std::uint32_t value, AcceleratorError error) {
            host.write(which, value);
            expect(error, which);
        };
        const auto pair = [&](Register which, std::uint64_t value, AcceleratorError error) {
            host.write_pair(which, value);
            expect(error, which);
        };
        const auto real = [&](Register which, double value, AcceleratorError error) {
            host.write_double(which, value);
            expect(error, which);
        };
        word(Register::Width, 0, AcceleratorError::BadSize);
        word(Register::Width, 65537, AcceleratorError::BadSize);
        word(Register::Height, 0, AcceleratorError::BadSize);
        word(Register::Height, 0xFFFFFFFF, AcceleratorError::BadSize);
        word(Register::Count, 0, AcceleratorError::BadCount);
        word(Register::Count, 0xFFFFFFFF, AcceleratorError::BadCount);
        word(Register::ShDegree, 4, AcceleratorError::BadDegree);
        word(Register::Format, 2, AcceleratorError::BadFormat);
        pair(Register::Geometry, 32, AcceleratorError::Misaligned);
        pair(Register::FrameBuffer, kFrame + 4, AcceleratorError::Misaligned);
        pair(Register::FrameBuffer, kWorkspace + kWorkspaceBytes - 64, AcceleratorError::Overlap);
        pair(Register::Sh, 64, AcceleratorError::Overlap);
        pair(Register::FrameBuffer, ~std::uint64_t{0} - 63, AcceleratorError::Overlap);
        pair(Register::WorkspaceBytes, 0x1000, AcceleratorError::SmallWorkspace);
        real(Register::FocalX, 0, AcceleratorError::BadCamera);
        real(Register::FocalY, std::nan(""), AcceleratorError::BadCamera);
        real(Register::Axes, 0.5, AcceleratorError::BadCamera);
        real(Register::Position, std::numeric_limits<double>::infinity(),
             AcceleratorError::BadCamera);
        EXPECT_EQ(host.read(Register::Frames), 0U);
        host.write_pair(Register::WorkspaceBytes, 0);
        EXPECT_FALSE(host.render());
        host.write_pair(Register::WorkspaceBytes, host.read_pair(Register::WorkspaceNeeded));
        EXPECT_TRUE(host.render()); // just enough, and nothing of the errors is left
    });
}

} // namespace
} // namespace degs::test
