// SPDX-License-Identifier: Apache-2.0
// Motion among the AOVs of filament-render: from the frame before, of the animation and of the camera.
#include "toolkit/paths/Paths.h"
#include "tools/filament-render/BackendRun.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <vector>

namespace filament_core::tools {
namespace {

constexpr uint32_t kSide = 32;

/// A square of 4 metres in z = 0 that moves 0.6 metres to the right and 0.2 up in the second that its animation has.
std::filesystem::path movingSquare() {
    const std::filesystem::path folder = buildDir() / "motion-test";
    std::filesystem::create_directories(folder);
    constexpr std::array<float, 26> kNumbers{ -2, -2, 0, 2,    -2,   0, -2, 2, 0,
                                              -2, 2,  0, 2,    -2,   0, 2,  2, 0, // positions
                                              0,  1,                              // seconds
                                              0,  0,  0, 0.6f, 0.2f, 0 };         // places
    std::ofstream(folder / "square.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(kNumbers.data()), sizeof kNumbers);
    std::ofstream(folder / "square.gltf") << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":1,"output":2}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-2,-2,0],"max":[2,2,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":8},
{"buffer":0,"byteOffset":80,"byteLength":24}],"buffers":[{"byteLength":104,"uri":"square.bin"}]})";
    return folder / "square.gltf";
}

/// Of the middle of the image, where the square is. With --fit a metre of it is a quarter.
float2 motionOf(Backend backend, std::vector<const char*> words) {
    words.insert(words.begin(), { "filament-render", "--environment", "none", "--size", "32x32", "--fov", "90",
                                  "--aovs", "depth,motion", "--at", "0", "0", "0", "--eye", "0", "0", "2" });
    const auto parsed = parseOptions(static_cast<int>(words.size()), words.data());
    EXPECT_TRUE(parsed.ok() && parsed->has_value()) << (parsed.ok() ? "" : parsed.error().message);
    if (!parsed.ok()) return {};
    const Result<BackendRun> run = runBackend(**parsed, backend, movingSquare(), {});
    EXPECT_TRUE(run.ok()) << (run.ok() ? "" : run.error().message);
    if (!run.ok()) return {};
    EXPECT_TRUE(run->errors.empty());
    float4 motion(0);
    std::memcpy(&motion, run->aovs.at(1).pixels.data() + sizeof motion * (kSide / 2 * kSide + kSide / 2),
                sizeof motion);
    EXPECT_EQ(motion.w, 1);
    return float2(motion);
}

void expectMotion(std::vector<const char*> const& words, double2 expected) {
    const float2 motion = motionOf(Backend::Vulkan, words);
    EXPECT_NEAR(motion.x, expected.x, 2e-4);
    EXPECT_NEAR(motion.y, expected.y, 2e-4);
    EXPECT_EQ(motionOf(Backend::Gles, words), motion);
}

/// Pixels of a metre at the square: half the image is 2 m there.
constexpr double kPixels = kSide / 4.0;

TEST(Motion, IsThatOfTheAnimationSinceTheFrameBefore) {
    const double2 aSecond = double2(0.6, -0.2) * 0.25 * kPixels;
    expectMotion({ "--time", "0.25" }, aSecond / 24.0);
    expectMotion({ "--time", "0.25", "--frame-rate", "10" }, aSecond / 10.0);
}

TEST(Motion, RestsWhereNothingMoves) {
    expectMotion({}, double2(0));
    expectMotion({ "--time", "0" }, double2(0)); // the first key is as the time before it
    expectMotion({ "--time", "3" }, double2(0)); // after the last
}

TEST(Motion, IsThatOfTheCamera) {
    expectMotion({ "--previous-eye", "0.125", "0", "2", "--previous-at", "0.125", "0", "0" },
                 double2(0.125, 0) * kPixels);
}

} // namespace
} // namespace filament_core::tools
