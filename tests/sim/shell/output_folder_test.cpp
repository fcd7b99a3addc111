// SPDX-License-Identifier: Apache-2.0
// Folders of results that several processes use at the same time.
#include <atomic>
#include <fstream>
#include <thread>

#include "degs/error.hpp"
#include "sim/shell/output_folder.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

// Parts of a search share a folder, and one of them takes results away and writes them anew.
TEST(OutputFolder, OpensWhileAnotherReplacesItsFiles) {
    const Folder folder;
    const std::string file = folder / "results.csv";
    std::atomic<bool> over{false};
    std::thread other([&] {
        while (!over) {
            std::ofstream(file) << "1";
            fs::remove(file);
        }
    });
    int refused = 0;
    for (int k = 0; k < 500; ++k) {
        try {
            const sim::OutputFolder opened(folder / "", {"results.csv"});
        } catch (const InputError&) {
            ++refused;
        }
    }
    over = true;
    other.join();
    EXPECT_EQ(refused, 0);
}

TEST(OutputFolder, RefusesAFolderInPlaceOfAFile) {
    const Folder folder;
    fs::create_directory(folder / "results.csv");
    EXPECT_THROW(sim::OutputFolder(folder / "", {"results.csv"}), InputError);
}

} // namespace
} // namespace degs::sim_test
