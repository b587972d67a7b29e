// SPDX-License-Identifier: Apache-2.0
/// Two spheres that intersect, under a sun with shadows: a frame of a few draws, in which the depth test decides
/// pixels.
#pragma once

#include "shaders/package/EngineMaterials.h"
#include "tests/scenes/Sphere.h"
#include "toolkit/record/SavedFrame.h"

#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace filament_core::test {

/// A folder of this test, removed with it.
class FrameFolder {
public:
    FrameFolder() {
        const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
        mPath = std::filesystem::temp_directory_path() /
                (std::string("frame-") + test->name() + "-" + std::to_string(getpid()));
        std::filesystem::remove_all(mPath);
    }
    ~FrameFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    std::filesystem::path const& path() const { return mPath; }

private:
    std::filesystem::path mPath;
};

inline std::string bytesOf(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(in), {} };
}

inline void writeBytes(std::filesystem::path const& path, std::string const& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// `red`: of the first sphere.
inline Result<Image> drawSpheres(Engine& engine, float red, Format format = Format::RGBA8) {
    scenes::Sphere sphere(engine, scenes::makeSphere(8, 16));
    auto material = engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") });
    if (!material) return material.error();
    const Owned<Material> opaque = engine.own(*material);
    Owned<MaterialInstance> colors[2];
    Scene scene(engine);
    for (int i = 0; i < 2; ++i) {
        colors[i] = engine.own(engine.createInstance(opaque));
        const float4 color(i == 0 ? red : 0.1f, 0.3f, i == 0 ? 0.1f : 0.8f, 1);
        if (Result<void> set = engine.set(colors[i], "baseColorFactor", color); !set) return set.error();
        double4x4 world(0.6);
        world[3] = double4(0.5 * i - 0.25, 0, 0.2 * i, 1);
        scene.add(sphere.renderable(colors[i], world));
    }
    scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f } });
    View view{ .camera = Camera::lookAt({ 0, 0.8, 2.2 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 }),
               .size = { 96, 64 } };
    Renderer renderer(engine);
    const Owned<SwapChain> target = engine.own(
            engine.create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = format, .name = "pixels" }));
    renderer.render(scene, view, target);
    return renderer.waitPixels(renderer.readPixels(target));
}

inline record::FrameRecipe spheresRecipe(float red = 0.8f, Format format = Format::RGBA8) {
    return [=](Engine& engine) -> Result<std::vector<record::FramePicture>> {
        Result<Image> image = drawSpheres(engine, red, format);
        if (!image) return image.error();
        std::vector<record::FramePicture> pictures(1);
        pictures[0].image = std::move(*image);
        return pictures;
    };
}

inline record::SaveRequest spheresRequest(FrameFolder const& folder) {
    record::SaveRequest request;
    request.folder = folder.path();
    request.recipe = spheresRecipe();
    request.engine.workers = 0;
    request.program = "test";
    request.settings = R"({"scene":"spheres"})";
    return request;
}

} // namespace filament_core::test
