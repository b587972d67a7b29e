// SPDX-License-Identifier: Apache-2.0
// A box that an environment lights through its open front: the engine's image with a lightmap is nearer to the path
// tracer's than without, and both APIs draw the same bits.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/interiors/Interiors.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

namespace filament_core::bake {
namespace {

class CornellTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(mFolder);
        const auto bytes = assets::writeGlb(interiors::cornellBox(0).model);
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(assets::replaceFile(mFolder / "box.glb", *bytes));
        assets::HdrImage sky{ .width = 64, .height = 32 };
        for (uint32_t y = 0; y < sky.height; ++y) {
            const float up = 1 - 2 * (static_cast<float>(y) + 0.5f) / 32;
            const float3 color =
                    up > 0 ? float3(0.4f, 0.5f, 0.7f) + up * float3(0.2f, 0.3f, 0.5f) : float3(0.15f, 0.13f, 0.1f);
            for (uint32_t x = 0; x < sky.width; ++x) sky.pixels.push_back(color);
        }
        ASSERT_TRUE(assets::writeHdr(mFolder / "sky.hdr", sky));
    }
    void TearDown() override { std::filesystem::remove_all(mFolder); }

    void run(std::string const& program, std::string const& arguments) const {
        const std::string command = "cd '" + mFolder.string() + "' && '" +
                                    (tools::buildDir() / "bin" / program).string() + "' " + arguments + " 2>&1";
        std::FILE* const pipe = ::popen(command.c_str(), "r");
        std::string text;
        std::array<char, 512> buffer{};
        while (std::fgets(buffer.data(), buffer.size(), pipe)) text += buffer.data();
        ASSERT_EQ(WEXITSTATUS(::pclose(pipe)), 0) << text;
    }

    /// Means of blocks of 8 x 8 pixels.
    std::vector<double3> blocksOf(char const* file) const {
        Result<assets::HdrImage> image = assets::readHdrImage(mFolder / file);
        EXPECT_TRUE(image) << image.error().message;
        std::vector<double3> blocks(size_t(image->width / 8) * (image->height / 8), double3(0.0));
        for (uint32_t y = 0; y < image->height; ++y) {
            for (uint32_t x = 0; x < image->width; ++x)
                blocks[size_t(y / 8) * (image->width / 8) + x / 8] +=
                        double3(image->pixels[size_t(y) * image->width + x]) / 64.0;
        }
        return blocks;
    }

    static double distance(std::vector<double3> const& a, std::vector<double3> const& b) {
        double squares = 0, level = 0;
        for (size_t i = 0; i < a.size(); ++i) {
            squares += glm::dot(a[i] - b[i], a[i] - b[i]);
            level += glm::dot(b[i], b[i]);
        }
        return std::sqrt(squares / level);
    }

    std::filesystem::path mFolder =
            std::filesystem::temp_directory_path() / ("filament-cornell-" + std::to_string(::getpid()));
};

TEST_F(CornellTest, ALightmapIsFourTimesNearerToThePathTracer) {
    const std::string view =
            " --environment sky.hdr --no-fit --eye 0 1 4 --at 0 1 0 --fov 38 --size 96x96 --skybox off ";
    run("filament-bake", "box.glb --environment sky.hdr --density 16 --samples 64 --out bake");
    run("filament-reference", "box.glb" + view + "--spp 64 --out traced");
    run("filament-render", "box.glb" + view + "--format exr --out without");
    run("filament-render", "bake/baked.glb" + view + "--format exr --out with"); // fails if bits differ
    if (HasFatalFailure()) return;
    const std::vector<double3> traced = blocksOf("traced/reference.exr");
    const double without = distance(blocksOf("without/vulkan.exr"), traced);
    const double with = distance(blocksOf("with/vulkan.exr"), traced);
    RecordProperty("without", std::to_string(without));
    RecordProperty("with", std::to_string(with));
    EXPECT_LT(with * 4, without) << with << " with, " << without << " without";
}

// BC6H is decoded by the loader, or by the device on request: its bits are the same.
TEST_F(CornellTest, BlocksOfLightHaveTheBitsOfTheirTexels) {
    const std::string view =
            " --environment sky.hdr --no-fit --eye 0 1 4 --at 0 1 0 --fov 38 --size 64x64 --skybox off ";
    run("filament-bake",
        "box.glb --environment sky.hdr --density 8 --samples 32 --held-out 0 --store bc6h --openness off --out bake");
    run("filament-render", "bake/baked.glb" + view + "--format exr --out texels");
    run("filament-render", "bake/baked.glb" + view + "--format exr --set model.compressedTextures=on --out blocks");
    if (HasFatalFailure()) return;
    const auto read = [&](char const* file) { return assets::readFileBytes(mFolder / file); };
    for (char const* image : { "vulkan.exr", "gles.exr" }) {
        const auto texels = read((std::string("texels/") + image).c_str());
        const auto blocks = read((std::string("blocks/") + image).c_str());
        ASSERT_TRUE(texels && blocks);
        EXPECT_EQ(*texels, *blocks) << image;
    }
}

} // namespace
} // namespace filament_core::bake
