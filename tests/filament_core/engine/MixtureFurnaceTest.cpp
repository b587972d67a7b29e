// SPDX-License-Identifier: Apache-2.0
// White furnace of partly metallic glTF materials with every combination of layers, with and without transmission:
// white matter that absorbs nothing is invisible, whatever part of its light is reflected, scattered or let through.
#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

namespace filament_core {
namespace {

constexpr float kMixtureBackground = 0.25f; // exact in half floats
constexpr uint32_t kPixels = 24;

/// A sphere that fills the middle of the image, in a white environment before a grey background.
class MixtureFurnace {
public:
    explicit MixtureFurnace(Engine& engine)
            : mEngine(engine), mEnvironment(engine), mSphere(engine, scenes::makeSphere()), mScene(engine) {
        mEnvironment.light(mScene, mView.camera);
        mView.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        mView.size = { kPixels, kPixels };
        mView.clearColor = float4(kMixtureBackground);
    }

    /// Draws the materials, which differ in nothing but parameters, one after another.
    template <class Visit>
    void draw(std::span<const assets::MaterialData> materials, Visit const& visit) {
        const GltfMaterialSettings shared = settingsOf(materials[0], {});
        const auto material = mEngine.own(*mEngine.create(
                MaterialDesc{ .package = shader::engineMaterial(shared.package), .constants = shared.constants }));
        const auto instance = mEngine.own(mEngine.createInstance(material, "white"));
        EXPECT_TRUE(mEngine.setDoubleSided(instance, false));
        const auto node = mScene.add(mSphere.renderable(instance));
        for (assets::MaterialData const& data : materials) {
            const GltfMaterialSettings settings = settingsOf(data, {});
            EXPECT_EQ(settings.package, shared.package);
            for (auto const& [name, value] : settings.parameters) EXPECT_TRUE(mEngine.set(instance, name, value));
            visit(data, test::renderLinear(mEngine, mScene, mView));
        }
        mScene.remove(node);
    }

private:
    Engine& mEngine;
    View mView;
    WhiteEnvironment mEnvironment;
    scenes::Sphere mSphere;
    Scene mScene;
};

assets::MaterialData whiteMatter(bool isSolid, uint32_t layers, assets::AlphaMode mode) {
    assets::MaterialData data;
    data.roughnessFactor = 0.5f;
    data.alphaMode = mode;
    data.transmission.thicknessMeters = isSolid ? 1.0f : 0.0f;
    if ((layers & 1) != 0) data.clearCoat = { .factor = 1, .roughness = 0.3f };
    if ((layers & 2) != 0) data.sheen = { .color = float3(1), .roughness = 0.5f };
    if ((layers & 4) != 0) data.iridescence = { .factor = 1, .ior = 1.6f, .thicknessMaxNanometers = 450 };
    return data;
}

std::vector<assets::MaterialData> mixturesOf(assets::MaterialData const& base) {
    std::vector<assets::MaterialData> materials;
    for (const float transmission : { 0.0625f, 0.5f, 1.0f }) {
        for (const float metallic : { 0.0f, 0.25f, 0.5f, 1.0f }) {
            assets::MaterialData& data = materials.emplace_back(base);
            data.transmission.factor = transmission;
            data.metallicFactor = metallic;
        }
    }
    return materials;
}

/// The mean of each component where the sphere is seen from up to 60 degrees off its normals.
float3 meanOfMiddle(Image const& image) {
    float3 sum(0);
    int count = 0;
    for (uint32_t y = kPixels / 2 - 6; y < kPixels / 2 + 6; ++y) {
        for (uint32_t x = kPixels / 2 - 6; x < kPixels / 2 + 6; ++x, ++count)
            sum += float3(test::halfPixel(image, x, y));
    }
    return sum / static_cast<float>(count);
}

std::string describe(assets::MaterialData const& data) {
    return fmt::format("{} transmission {} metallic {} coat {} sheen {} film {} alpha {}",
                       data.transmission.isSolid() ? "solid" : "thin", data.transmission.factor, data.metallicFactor,
                       data.clearCoat.factor, data.sheen.color.x, data.iridescence.factor, data.baseColorFactor.w);
}

class MixtureFurnaceTest : public testing::TestWithParam<Backend> {};

TEST_P(MixtureFurnaceTest, WhiteMatterIsInvisibleInEveryCombinationOfLayers) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    MixtureFurnace furnace(*engine);
    for (const bool isSolid : { false, true }) {
        for (uint32_t layers = 0; layers < 8; ++layers) {
            const auto base = whiteMatter(isSolid, layers, assets::AlphaMode::Opaque);
            furnace.draw(mixturesOf(base), [](assets::MaterialData const& data, Image const& image) {
                const float3 mean = meanOfMiddle(image);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 1, 0.005f) << describe(data) << ", component " << c;
            });
        }
    }
    test::expectNoErrors(*engine);
}

TEST_P(MixtureFurnaceTest, WhiteMatterThatTransmitsNothingIsInvisibleHoweverMetallicAndRough) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    MixtureFurnace furnace(*engine);
    for (uint32_t layers = 0; layers < 8; ++layers) {
        std::vector<assets::MaterialData> materials;
        for (const float roughness : { 0.2f, 0.5f, 1.0f }) {
            for (const float metallic : { 0.0f, 0.25f, 0.5f, 0.75f, 1.0f }) {
                assets::MaterialData& data =
                        materials.emplace_back(whiteMatter(false, layers, assets::AlphaMode::Opaque));
                data.roughnessFactor = roughness;
                data.metallicFactor = metallic;
            }
        }
        furnace.draw(materials, [](assets::MaterialData const& data, Image const& image) {
            const float3 mean = meanOfMiddle(image);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(mean[c], 1, 0.005f) << describe(data) << " roughness " << data.roughnessFactor;
        });
    }
    test::expectNoErrors(*engine);
}

TEST_P(MixtureFurnaceTest, AlphaCoversEveryCombinationAlike) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    MixtureFurnace furnace(*engine);
    for (const bool isSolid : { false, true }) {
        for (const uint32_t layers : { 0u, 7u }) {
            assets::MaterialData base = whiteMatter(isSolid, layers, assets::AlphaMode::Blend);
            base.baseColorFactor.w = 0.25f;
            furnace.draw(mixturesOf(base), [](assets::MaterialData const& data, Image const& image) {
                const float3 mean = meanOfMiddle(image);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(mean[c], 0.25f + 0.75f * kMixtureBackground, 0.002f)
                            << describe(data) << ", component " << c;
            });
        }
    }
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, MixtureFurnaceTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
