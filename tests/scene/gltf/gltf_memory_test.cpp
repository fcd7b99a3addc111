// SPDX-License-Identifier: Apache-2.0
// What a glTF may cost: memory in proportion to its size. Not a Hostile suite, because the address sanitizer keeps what
// has been freed.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

/// Bytes of memory that reading the file takes, accepted or refused; in a process of its own, whose peak
/// begins at what this one has.
long bytes_to_read(const std::string& path) {
    const auto peak_bytes = [] {
        rusage usage{};
        ::getrusage(RUSAGE_SELF, &usage);
        return usage.ru_maxrss * 1024;
    };
    int ends[2] = {-1, -1};
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const long before = peak_bytes();
        try {
            read_gltf(path);
        } catch (const InputError&) {
        }
        const long grown = peak_bytes() - before;
        ::_exit(::write(ends[1], &grown, sizeof grown) == sizeof grown ? 0 : 1);
    }
    ::close(ends[1]);
    long grown = -1;
    EXPECT_EQ(::read(ends[0], &grown, sizeof grown), long{sizeof grown});
    ::close(ends[0]);
    int status = -1;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    return grown;
}

GaussianCloud many_gaussians(std::size_t count, int degree) {
    GaussianCloud cloud;
    cloud.sh_degree = degree;
    cloud.means.assign(count, {1, 2, 3});
    cloud.scales.assign(count, {1, 1, 1});
    cloud.rotations.assign(count, {1, 0, 0, 0});
    cloud.opacities.assign(count, 0.5F);
    cloud.sh.assign(count * cloud.sh_coefficients() * 3, 0.25F);
    return cloud;
}

TEST(GltfMemory, IsTwiceTheFileOrTheFileAndItsGaussians) {
    for (const int degree : {0, 3}) {
        const test::Folder folder;
        const std::string path = folder.path("scene.glb");
        write_glb(many_gaussians(degree == 0 ? 800000 : 200000, degree), {}, {}, path);
        const auto bytes = static_cast<double>(std::filesystem::file_size(path));
        ASSERT_GT(bytes, 40e6);
        const double multiple = static_cast<double>(bytes_to_read(path)) / bytes;
        EXPECT_LT(multiple, degree == 0 ? 2.3 : 2.1);
        EXPECT_GT(multiple, 1); // it measures something
    }
}

/// The costliest values: objects of a few bytes that the library turns into large structures.
TEST(GltfMemory, IsBoundedForJsonAlone) {
    for (const char* const list : {"nodes", "materials", "accessors", "meshes", "animations"}) {
        std::string text = "{\"asset\":{\"version\":\"2.0\"},\"" + std::string(list) + "\":[{}";
        for (int i = 0; i < 262000; ++i) {
            text += ",{}";
        }
        const test::Folder folder;
        const std::string path = folder.write("scene.gltf", text + "]}");
        EXPECT_LT(bytes_to_read(path), 1L << 30) << list;
    }
}

} // namespace
} // namespace degs
