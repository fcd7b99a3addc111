// SPDX-License-Identifier: Apache-2.0
// The latencies of the links back: words about free contexts, requests for tiles and grants.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

struct Link {
    const char* design;
    const char* key;
    std::vector<std::string> more = {};
};
std::ostream& operator<<(std::ostream& out, const Link& link) {
    return out << link.design << ' ' << link.key;
}

class ShapeBackLinks : public testing::TestWithParam<Link> {
public:
    static std::int64_t cycles(int latency, const std::string& fidelity) {
        const Link& link = GetParam();
        const Folder folder;
        std::vector<std::string> arguments{
            "run",           config(link.design),
            "--scene",       "synthetic:object,gaussians=2000",
            "--width",       "200",
            "--out",         folder / "out",
            "--fidelity",    fidelity,
            "--set",         link.key + ("=" + std::to_string(latency)),
            "--no-reference"};
        for (const std::string& key : link.more) {
            arguments.insert(arguments.end(), {"--set", key});
        }
        expect_success(degs(arguments));
        return report_in(folder / "out")["timing"]["cycles"];
    }
};

TEST_P(ShapeBackLinks, ALongerWayTakesLonger) {
    const std::int64_t near = cycles(1, "exact");
    const std::int64_t far = cycles(400, "exact");
    EXPECT_GT(far, near);
    EXPECT_EQ(far, cycles(400, "strict"));
}

INSTANTIATE_TEST_SUITE_P(All, ShapeBackLinks,
                         testing::Values(Link{"degs-64", "pixel_buffer.free_cycles"},
                                         Link{"gscore-64", "pixel_buffer.free_cycles"},
                                         Link{"gbu-64", "pixel_buffer.free_cycles"},
                                         Link{"gcc-64", "image_buffer.free_cycles"},
                                         Link{"orange-o1", "pixel_buffer.free_cycles"},
                                         Link{"degs-64-tuned", "grant_cycles"},
                                         Link{"gbu-64", "grant_cycles"},
                                         Link{"gcc-64", "grant_cycles", {"clusters=2"}},
                                         Link{"degs-x-256", "front.request_cycles"}));

} // namespace
} // namespace degs::sim_test
