// SPDX-License-Identifier: Apache-2.0
// The mip levels of materials' textures with temporal accumulation: those of the output resolution, against
// supersampling; and that nothing changes without accumulation.
#include "tests/filament_core/engine/Fan.h"

#include <algorithm>
#include <random>

namespace filament_core {
namespace {

using test::rmsBetween;

constexpr uint2 kPlaneSize(64, 48);

constexpr std::string_view kPhotoLookUp = "material.baseColor = texture(materialParams_photo, getUV0() * 2.0);";
constexpr std::string_view kOffset =
        "material.baseColor = textureOffset(materialParams_photo, getUV0() * 2.0, ivec2(1, -1));";
constexpr std::string_view kGradients =
        "vec2 uv = getUV0() * 2.0;\n"
        "material.baseColor = textureGrad(materialParams_photo, uv, dFdx(uv), dFdy(uv));";
constexpr std::string_view kBiased = "material.baseColor = texture(materialParams_photo, getUV0() * 2.0, -0.5);";
constexpr std::string_view kProjected =
        "material.baseColor = textureProj(materialParams_photo, vec3(getUV0() * 2.0, 1.0));";
constexpr std::string_view kLevel = "material.baseColor = textureLod(materialParams_photo, getUV0(), 1.0);";

/// A slanted square with noise of every frequency on it.
class Photo {
public:
    explicit Photo(Backend backend, std::string_view code = kPhotoLookUp, std::string_view properties = "")
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              renderer(engine), mSquare(engine),
              mMaterial(test::loadMaterial(
                      engine, test::text(fmt::format("shadingModel : unlit, requires : [ uv0 ], culling : none, "
                                                     "parameters : [ {{ type : sampler2d, name : photo }} ]{}",
                                                     properties),
                                         code))),
              mInstance(engine.own(engine.createInstance(mMaterial))), mTexture(noise()), scene(engine) {
        EXPECT_TRUE(engine.set(mInstance, "photo", mTexture,
                               Sampler{ Filter::Linear, Filter::Linear, MipFilter::Linear, WrapMode::ClampToEdge,
                                        WrapMode::ClampToEdge })
                            .ok());
        mSquare.add(scene, mInstance, glm::rotate(double4x4(1.5), -0.9, double3(1, 0.2, 0)));
        view.camera = Camera::lookAt({ 0, 0, 2 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 });
        view.size = kPlaneSize;
    }
    ~Photo() { test::expectNoErrors(engine); }

    Image draw() { return test::renderLinear(engine, renderer, scene, view); }
    Image gathered(float2 scale, MipBias bias, int frames) {
        view.quality.antiAliasing = AntiAliasing::Taa;
        view.quality.mipBias = bias;
        view.effects.resolution.scale = scale;
        Renderer fresh(engine);
        Image last;
        for (int frame = 0; frame < frames; ++frame) last = test::renderLinear(engine, fresh, scene, view);
        view.quality = {};
        view.effects.resolution = {};
        return last;
    }
    /// The mean of 8 x 8 samples a pixel, each with the mip levels of its own.
    Image supersampled() {
        constexpr uint32_t kSide = 8;
        view.size = kPlaneSize * kSide;
        const Image large = draw();
        view.size = kPlaneSize;
        Image small = draw();
        auto* halves = reinterpret_cast<uint16_t*>(small.pixels.data());
        for (uint32_t i = 0; i < kPlaneSize.x * kPlaneSize.y; ++i) {
            float4 sum(0);
            for (uint32_t s = 0; s < kSide * kSide; ++s)
                sum += test::halfPixel(large, i % kPlaneSize.x * kSide + s % kSide,
                                       i / kPlaneSize.x * kSide + s / kSide);
            for (int c = 0; c < 4; ++c) halves[4 * i + static_cast<uint32_t>(c)] = halfFromFloat(sum[c] / 64);
        }
        return small;
    }

    Engine engine;
    Renderer renderer;
    View view;

private:
    Owned<Texture> noise() {
        constexpr uint32_t kTexels = 256;
        std::mt19937 random(7);
        std::vector<float> sums(kTexels * kTexels * 4, 0.0f); // squares of every size, as strong as each other
        for (uint32_t square = 1; square <= 64; square *= 2) {
            std::vector<float> cells(kTexels / square * (kTexels / square) * 4);
            for (float& cell : cells) cell = static_cast<float>(random() % 256) / 7;
            for (uint32_t i = 0; i < sums.size(); ++i) {
                const uint32_t x = i / 4 % kTexels / square, y = i / 4 / kTexels / square;
                sums[i] += cells[(y * (kTexels / square) + x) * 4 + i % 4];
            }
        }
        std::vector<uint8_t> texels(sums.size());
        std::ranges::transform(sums, texels.begin(), [](float sum) { return static_cast<uint8_t>(sum); });
        return engine.own(engine.create(TextureDesc{ .format = Format::RGBA8,
                                                     .width = kTexels,
                                                     .height = kTexels,
                                                     .generateMips = true,
                                                     .pixels = std::as_bytes(std::span(texels)) }));
    }

    test::SquareMesh mSquare;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Owned<Texture> mTexture;

public:
    Scene scene; ///< destroyed before what it shows
};

TEST(MipBias, MakesATemporallyUpscaledImageAsSharpAsAFullOne) {
    Photo photo(Backend::Vulkan);
    const Image exact = photo.supersampled();
    const double whole = rmsBetween(photo.draw(), exact);
    const double gathered = rmsBetween(photo.gathered(float2(1), MipBias::Off, 256), exact);
    for (const float scale : { 0.5f, 0.67f, 1.0f }) {
        const auto rms = [&](MipBias bias) { return rmsBetween(photo.gathered(float2(scale), bias, 256), exact); };
        const double off = rms(MipBias::Off), output = rms(MipBias::Output), sharp = rms(MipBias::Sharp);
        RecordProperty(
                fmt::format("rms at {}", scale),
                fmt::format("one frame {:.4f}; off {:.4f}, output {:.4f}, sharp {:.4f}", whole, off, output, sharp));
        EXPECT_LT(output, 1.03 * gathered) << scale << ": as frames of all pixels";
        EXPECT_GT(off, (scale < 1 ? 1.03 : 0.999) * output) << scale;
        EXPECT_LE(output, off);
        EXPECT_LT(sharp, 0.95 * output) << "many samples a pixel, as in supersampling";
    }
}

/// The image of a frame that is drawn at the output's mip levels: the bias equals that of the sampled levels.
TEST(MipBias, IsInEveryLookUpThatTakesItsLevelFromDerivatives) {
    for (const std::string_view code : { kPhotoLookUp, kOffset, kGradients, kBiased, kProjected, kLevel }) {
        std::vector<Image> images;
        for (const Backend backend : test::kBothApis) {
            Photo photo(backend, code);
            const Image off = photo.gathered(float2(0.5f), MipBias::Off, 2);
            images.push_back(photo.gathered(float2(0.5f), MipBias::Output, 2));
            if (code == kLevel)
                EXPECT_EQ(images.back().pixels, off.pixels) << "its level is named";
            else
                EXPECT_NE(images.back().pixels, off.pixels) << code;
        }
        EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << code;
    }
}

/// Gradients and derivatives select the same levels, with and without a bias.
TEST(MipBias, TurnsGradientsIntoThoseOfTheShownPixels) {
    Photo byDerivatives(Backend::Vulkan, kPhotoLookUp), byGradients(Backend::Vulkan, kGradients);
    const auto between = [&](MipBias bias) {
        return rmsBetween(byDerivatives.gathered(float2(0.5f), bias, 1), byGradients.gathered(float2(0.5f), bias, 1));
    };
    const double sharper = rmsBetween(byGradients.gathered(float2(0.5f), MipBias::Output, 1),
                                      byGradients.gathered(float2(0.5f), MipBias::Off, 1));
    EXPECT_GT(sharper, 0.005);
    EXPECT_LT(between(MipBias::Off), 0.2 * sharper);
    EXPECT_LT(between(MipBias::Output), 0.2 * sharper);
}

/// The depth that ambient occlusion reads has the visible holes.
TEST(MipBias, CutsTheSameHolesIntoDepths) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        Photo photo(backend, kPhotoLookUp, ", blending : masked");
        photo.view.quality.depthPrepass = DepthPrepass::On;
        photo.view.clearColor = float4(8, 0, 0, 1);
        photo.view.quality.antiAliasing = AntiAliasing::Taa;
        photo.view.effects.resolution.scale = float2(0.5f);
        const Image with = photo.draw();
        photo.view.quality.depthPrepass = DepthPrepass::Off;
        Renderer fresh(photo.engine);
        const Image without = test::renderLinear(photo.engine, fresh, photo.scene, photo.view);
        EXPECT_EQ(with.pixels, without.pixels);
        images.push_back(with);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

TEST(MipBias, CostsNothingWhereFramesHaveAllPixels) {
    for (const Backend backend : test::kBothApis) {
        Photo photo(backend);
        const Image plain = photo.draw();
        for (const MipBias bias : { MipBias::Off, MipBias::Sharp }) {
            photo.view.quality.mipBias = bias;
            EXPECT_EQ(photo.draw().pixels, plain.pixels) << "nothing is gathered";
        }
        EXPECT_NE(photo.renderer.explain().find("no frames are accumulated"), std::string::npos)
                << photo.renderer.explain();
        photo.view.quality = {};
        const Image output = photo.gathered(float2(1), MipBias::Output, 3);
        EXPECT_EQ(photo.gathered(float2(1), MipBias::Off, 3).pixels, output.pixels);
        photo.view.quality.antiAliasing = AntiAliasing::Taa;
        photo.view.effects.resolution.scale = float2(0.5f);
        (void)photo.draw();
        EXPECT_NE(photo.renderer.explain().find("textures are read 1.00 mip levels sharper"), std::string::npos)
                << photo.renderer.explain();
    }
}

} // namespace
} // namespace filament_core
