// SPDX-License-Identifier: Apache-2.0
// Models as gltfpack and glTF-Transform pack them look like the models themselves, within the quantisation.
#include "tests/filament_core/assets/NpmPackages.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/Animator.h>
#include <filament_core/Gltf.h>

#include <array>
#include <memory>
#include <optional>
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

/// An engine of each API, which keep what they compiled from model to model.
class Studio {
public:
    /// From where all of `seen` is in the image; an empty box becomes that of the model. The same bits on both APIs.
    Image draw(fs::path const& file, Box& seen) {
        std::array<Image, 2> images;
        for (size_t i = 0; i < images.size(); ++i) images[i] = drawOn(*mEngines[i], *mRenderers[i], file, seen);
        EXPECT_FALSE(images[0].pixels.empty());
        EXPECT_EQ(images[0].pixels, images[1].pixels) << "not the same bits on both APIs";
        return std::move(images[0]);
    }

    static std::unique_ptr<Studio> open() {
        auto studio = std::make_unique<Studio>();
        for (size_t i = 0; i < studio->mEngines.size(); ++i) {
            studio->mEngines[i] = test::makeEngine(test::kBothApis[i]);
            if (!studio->mEngines[i]) return nullptr;
            studio->mRenderers[i].emplace(*studio->mEngines[i]);
        }
        return studio;
    }

private:
    static Image drawOn(Engine& engine, Renderer& renderer, fs::path const& file, Box& seen) {
        Result<Model> model = loadGltf(engine, file);
        if (!model) {
            ADD_FAILURE() << model.error().message;
            return {};
        }
        Scene scene(engine);
        const Node root = scene.add(*model);
        if (model->animationCount() > 0) Animator(*model, scene, root).apply(0, kSeconds);
        for (const float side : { -0.7f, 0.7f })
            scene.add(SunLight{ .directionWorld = { side, -0.5f, -0.5f }, .illuminance = Lux{ 2 } });
        if (seen.empty()) seen = model->bounds();
        const double3 center = seen.center();
        const double distance = glm::length(seen.max - seen.min) * 1.3;
        View view{ .size = { 160, 120 } };
        view.clearColor = float4(0.2f, 0.3f, 0.4f, 1);
        view.camera = Camera::lookAt(center + double3(0.3, 0.2, 0.93) * distance, center,
                                     { .verticalFovDegrees = 45, .nearMeters = float(distance) * 0.05f });
        view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        Image image = test::renderLinear(engine, renderer, scene, view);
        test::expectNoErrors(engine);
        return image;
    }

    std::array<std::optional<Engine>, 2> mEngines;
    std::array<std::optional<Renderer>, 2> mRenderers; // destroyed before the engines
};

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
    const std::unique_ptr<Studio> studio = Studio::open();
    ASSERT_TRUE(studio);
    Box seen;
    const Image reference = studio->draw(original, seen);
    const fs::path packed = fs::path(testing::TempDir()) / fmt::format("packed-{}.glb", getpid());
    for (Packer const& packer : kPackers) {
        SCOPED_TRACE(packer.name);
        ASSERT_TRUE(pack(packer, npm, original, packed));
        const Difference difference = between(studio->draw(packed, seen), reference);
        EXPECT_LT(difference.mean, 0.0008);
        EXPECT_LT(difference.share, 0.003);
        fs::remove(packed);
    }
}

std::string nameOf(testing::TestParamInfo<const char*> const& info) { return fs::path(info.param).stem().string(); }

INSTANTIATE_TEST_SUITE_P(Gltf, PackedModels, testing::ValuesIn(kModels), nameOf);

} // namespace
} // namespace filament_core::packed_models
