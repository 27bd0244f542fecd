// SPDX-License-Identifier: MIT
// What Embree cannot do is said by an error with its own words, never by a null pointer that is written to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

#include "scenes/error.h"
#include "verifier/tracer/embree_world.h"

namespace threefold::tracer {
namespace {

using testing::HasSubstr;

Mesh mesh_of(std::size_t vertices) {
    Mesh mesh;
    mesh.vertices_mm.assign(vertices, Vec3(1, 2, 3));
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

/// Of address space, from now on.
void allow_no_more_than(rlim_t more_bytes) {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more_bytes;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
}

TEST(EmbreeWorldDeathTest, SaysThatMemoryDoesNotSufficeForAMesh) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "AddressSanitizer needs more address space than a limit leaves";
#endif
    EXPECT_EXIT(
        {
            EmbreeWorld world(Vec3(0));
            const Mesh mesh = mesh_of(4000000); // 48 MB of corners in single precision
            allow_no_more_than(16 << 20);
            try {
                world.add(0, mesh);
            } catch (const Error &error) {
                std::fputs(error.what(), stderr);
                _exit(static_cast<int>(error.code()));
            }
            _exit(0);
        },
        testing::ExitedWithCode(65), "not enough memory for the scene's surfaces");
}

TEST(EmbreeWorld, SaysInEmbreesWordsWhatItRefuses) {
    EmbreeWorld world(Vec3(0));
    world.add(3, mesh_of(3));
    try {
        world.add(3, mesh_of(3)); // a name that is taken
        FAIL() << "nothing was said";
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::internal);
        EXPECT_THAT(error.what(), HasSubstr("invalid operation"));
    }
    world.commit(); // the error was said once, and the rest stands
    EXPECT_FALSE(world.blocks({{0, 0, 0}, {1, 0, 0}}, {}));
}

} // namespace
} // namespace threefold::tracer
