// SPDX-License-Identifier: Apache-2.0
// Models as gltfpack and glTF-Transform pack them look like the models themselves, within the quantisation.
#include "tests/filament_core/assets/NpmPackages.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Animator.h>
#include <filament_core/Gltf.h>

#include <array>
#include <memory>
#include <unistd.h>

namespace filament_core::packed_models {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 0.3; // a frame of gltfpack's, which resamples animations to 30 Hz

/// A packer with one choice of options.
struct Packer {
    const char* name;
    const char* script; ///< in the folder of npm's packages
    const char* before; ///< of the names of both files
    const char* between;
    const char* after;
};

// gltfpack: nodes and materials keep their names, so that nothing is merged.
constexpr std::array kPackers{
    Packer{ "gltfpack -c", "gltfpack/cli.js", "-c -kn -km -i", "-o", "" },
    Packer{ "gltfpack -cc", "gltfpack/cli.js", "-cc -kn -km -i", "-o", "" },
    Packer{ "gltfpack -cz", "gltfpack/cli.js", "-cz -kn -km -i", "-o", "" },
    Packer{ "gltfpack -cz -ce khr", "gltfpack/cli.js", "-cz -ce khr -kn -km -i", "-o", "" },
    Packer{ "gltf-transform meshopt", ".bin/gltf-transform", "meshopt", "", "" },
    Packer{ "gltf-transform draco", ".bin/gltf-transform", "draco", "", "" },
    Packer{ "gltf-transform optimize", ".bin/gltf-transform", "optimize", "",
            "--texture-compress false --simplify false" },
};

// Every attribute, morph targets, skins, instances, texture transforms, blending, several materials. Not those whose
// tangents only KHR_materials_anisotropy reads: both packers leave these out.
constexpr std::array kModels{
    "AlphaBlendModeTest/AlphaBlendModeTest.glb",
    "AttenuationTest/AttenuationTest.glb",
    "Fox/Fox.glb",
    "MorphStressTest/MorphStressTest.glb",
    "NormalTangentTest/NormalTangentTest.glb",
    "RiggedFigure/RiggedFigure.glb",
    "SheenChair/SheenChair.gltf",
    "SimpleInstancing/SimpleInstancing.glb",
    "TextureTransformTest/TextureTransformTest.gltf",
    "VertexColorTest/VertexColorTest.glb",
};

/// From where all of `seen` is in the image; an empty box becomes that of the model.
Image draw(fs::path const& file, Box& seen) {
    return test::onBothApis([&](test::MaterialStage& stage) {
        Result<Model> loaded = loadGltf(stage.engine, file);
        ASSERT_TRUE(loaded) << loaded.error().message;
        const auto model = std::make_shared<Model>(std::move(*loaded));
        stage.keep(model);
        const Node root = stage.scene.add(*model);
        if (model->animationCount() > 0) Animator(*model, stage.scene, root).apply(0, kSeconds);
        for (const float side : { -0.7f, 0.7f })
            stage.scene.add(SunLight{ .directionWorld = { side, -0.5f, -0.5f }, .illuminance = Lux{ 2 } });
        if (seen.empty()) seen = model->bounds();
        const double3 center = seen.center();
        const double distance = glm::length(seen.max - seen.min) * 1.3;
        stage.view.clearColor = float4(0.2f, 0.3f, 0.4f, 1);
        stage.view.size = { 160, 120 };
        stage.view.camera = Camera::lookAt(center + double3(0.3, 0.2, 0.93) * distance, center,
                                           { .verticalFovDegrees = 45, .nearMeters = float(distance) * 0.05f });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
    });
}

/// Of two images, clipped to [0, 1].
struct Difference {
    double mean = 0, share = 0; ///< share: of pixels that differ by more than 8/255
};

Difference between(Image const& a, Image const& b) {
    Difference difference;
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            const float3 one = glm::clamp(float3(test::halfPixel(a, x, y)), 0.0f, 1.0f);
            const float3 apart = glm::abs(one - glm::clamp(float3(test::halfPixel(b, x, y)), 0.0f, 1.0f));
            const double largest = std::max({ apart.x, apart.y, apart.z });
            difference.mean += largest;
            difference.share += largest > 8.0 / 255 ? 1 : 0;
        }
    }
    const double pixels = double(a.width) * a.height;
    return { difference.mean / pixels, difference.share / pixels };
}

bool pack(Packer const& packer, fs::path const& npm, fs::path const& from, fs::path const& to) {
    const std::string script = (npm / "node_modules" / packer.script).string();
    return assets::shell(fmt::format("node '{}' {} '{}' {} '{}' {} > /dev/null 2>&1", script, packer.before,
                                     from.string(), packer.between, to.string(), packer.after)) == 0;
}

struct PackedModels : testing::TestWithParam<const char*> {};

TEST_P(PackedModels, LookLikeTheirOriginals) {
    const fs::path original = tools::assetDir() / "models" / GetParam();
    if (tools::assetDir().empty() || !fs::exists(original)) GTEST_SKIP() << "needs FILAMENT_ASSET_DIR";
    const fs::path npm = assets::npmFolder("npm-packers", "gltfpack@1.3.0 @gltf-transform/cli@4.5.1");
    if (npm.empty()) GTEST_SKIP() << "needs node, npm and its registry for gltfpack and @gltf-transform/cli";
    Box seen;
    const Image reference = draw(original, seen);
    const fs::path packed = fs::path(testing::TempDir()) / fmt::format("packed-{}.glb", getpid());
    for (Packer const& packer : kPackers) {
        SCOPED_TRACE(packer.name);
        ASSERT_TRUE(pack(packer, npm, original, packed));
        const Difference difference = between(draw(packed, seen), reference);
        EXPECT_LT(difference.mean, 0.0008);
        EXPECT_LT(difference.share, 0.003);
        fs::remove(packed);
    }
}

std::string nameOf(testing::TestParamInfo<const char*> const& info) { return fs::path(info.param).stem().string(); }

INSTANTIATE_TEST_SUITE_P(Gltf, PackedModels, testing::ValuesIn(kModels), nameOf);

} // namespace
} // namespace filament_core::packed_models
