// SPDX-License-Identifier: Apache-2.0
// The streams that npm's meshoptimizer writes, beside what its own decoder makes of them (meshopt_streams.mjs): modes,
// filters, strides, counts, levels and versions. It is installed into the folder of the build, if npm and its registry
// are there.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/Meshopt.h"
#include "tests/filament_core/assets/NpmPackages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

namespace filament_core::assets {
namespace {

namespace fs = std::filesystem;

/// One unit of the result is allowed for filters that are not exact (appendix B).
int largestDifference(std::span<const std::byte> ours, std::span<const std::byte> theirs, size_t stride,
                      MeshoptFilter filter) {
    int largest = 0;
    const bool isExact = filter == MeshoptFilter::None || filter == MeshoptFilter::Exponential;
    if (isExact) return std::ranges::equal(ours, theirs) ? 0 : 1000; // both may be empty
    const auto component = [&](std::span<const std::byte> bytes, size_t i) {
        if (stride == 4) return static_cast<int>(static_cast<int8_t>(bytes[i]));
        int16_t value;
        std::memcpy(&value, &bytes[i * 2], 2);
        return static_cast<int>(value);
    };
    const int range = stride == 4 ? 256 : 65536;
    for (size_t i = 0; i < ours.size() / (stride / 4); ++i) {
        const int apart = std::abs(component(ours, i) - component(theirs, i));
        largest = std::max(largest, std::min(apart, range - apart)); // colours have no sign
    }
    return largest;
}

TEST(MeshoptLibrary, StreamsOfNpmsMeshoptimizerAreDecodedAsByItself) {
    const fs::path folder = npmFolder("npm", "meshoptimizer@1.3.0");
    if (folder.empty()) GTEST_SKIP() << "needs node, npm and its registry for the package meshoptimizer";
    const fs::path script = tools::sourceDir() / "tests/filament_core/assets/gltf/meshopt_streams.mjs";
    const fs::path output = fs::path(testing::TempDir()) / ("meshopt-" + std::to_string(getpid()));
    ASSERT_EQ(shell("node '" + script.string() + "' '" + folder.string() + "' '" + output.string() + "'"), 0);
    const Result<std::vector<std::byte>> read = readFileBytes(output);
    ASSERT_TRUE(read) << read.error().message;
    fs::remove(output);
    std::span<const std::byte> rest = *read;
    const auto take = [&](size_t size) {
        const std::span<const std::byte> bytes = rest.first(size);
        rest = rest.subspan(size);
        return bytes;
    };
    size_t streams = 0;
    while (!rest.empty()) {
        std::array<uint32_t, 7> head;
        std::memcpy(head.data(), take(sizeof head).data(), sizeof head);
        const MeshoptSource source{ .byteStride = head[3],
                                    .count = head[4],
                                    .mode = static_cast<MeshoptMode>(head[0]),
                                    .filter = static_cast<MeshoptFilter>(head[1]),
                                    .isKhr = head[2] > 0 };
        const std::span<const std::byte> stream = take(head[5]), expected = take(head[6]);
        Diagnostics diagnostics;
        const std::vector<std::byte> decoded = decodeMeshopt(source, stream, "bufferViews[0]", diagnostics);
        SCOPED_TRACE(fmt::format("stream {}: mode {}, filter {}, version {}, stride {}, count {}", streams, head[0],
                                 head[1], head[2], head[3], head[4]));
        ASSERT_TRUE(diagnostics.ok()) << diagnostics.error().message;
        ASSERT_EQ(decoded.size(), expected.size());
        ASSERT_LE(largestDifference(decoded, expected, source.byteStride, source.filter), 1);
        ++streams;
    }
    EXPECT_GE(streams, 700u);
}

} // namespace
} // namespace filament_core::assets
