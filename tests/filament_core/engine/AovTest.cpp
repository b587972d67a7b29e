// SPDX-License-Identifier: Apache-2.0
// Numbers of surfaces, on both APIs, beside their closed forms.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/RenderAovs.h>

#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace filament_core {
namespace {

constexpr uint32_t kAovSide = 24;
constexpr auto kAllAovs = [] {
    std::array<Aov, kAovCount - 1> all{};
    for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Aov>(i + 1);
    return all;
}();

constexpr const char* kPainted = R"(material { name : painted, requires : [ uv0, tangents ], parameters : [] }
fragment { void material(inout MaterialInputs material) {
    material.normal = vec3(0.6, 0.0, 0.8);
    prepareMaterial(material);
    material.baseColor = vec4(0.1, 0.5, 0.9, 1.0);
    material.roughness = 0.3;
    material.metallic = 0.6;
    material.ambientOcclusion = 0.75;
    material.emissive = vec4(2.0, 0.003, 70000.0, 0.0);
} })";
constexpr const char* kFlat = R"(material { name : flat_color, shadingModel : unlit }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = vec4(0.25, 0.5, 0.75, 1.0);
} })";

/// A square of 2 x 2 m, turned, before a camera that looks from a place and a direction of its own.
class AovStage {
public:
    explicit AovStage(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), mSquare(engine) {
        view.camera = Camera::lookAt(kEye, kEye + double3(0.3, -0.2, -1), { .verticalFovDegrees = 70 });
        view.size = uint2(kAovSide);
    }
    ~AovStage() { test::expectNoErrors(engine); }

    void add(const char* material, double4x4 const& world) {
        mMaterials.push_back(test::loadMaterial(engine, material, {}, test::kNoLights));
        mInstances.push_back(engine.own(engine.createInstance(mMaterials.back())));
        mSquare.add(scene, mInstances.back(), world);
    }
    std::vector<Image> draw(std::span<const Aov> aovs = kAllAovs) {
        Result<std::vector<Image>> images = renderAovs(engine, scene, view, aovs);
        if (images) return std::move(*images);
        ADD_FAILURE() << images.error().message;
        return {};
    }

    static constexpr double3 kEye{ 7, -3, 11 };
    Engine engine;
    Scene scene;
    View view;

private:
    test::SquareMesh mSquare;
    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
};

double4x4 turned(double3 center) {
    return glm::rotate(glm::translate(double4x4(1), center), 0.7, glm::normalize(double3(1, 2, 0.3)));
}

float4 numbersAt(Image const& image, uint32_t x, uint32_t y) {
    float4 pixel;
    std::memcpy(&pixel, image.pixels.data() + (size_t{ y } * image.width + x) * sizeof(pixel), sizeof(pixel));
    return pixel;
}

Image const& of(std::vector<Image> const& images, Aov aov) { return images[static_cast<size_t>(aov) - 1]; }

/// Where the ray of a pixel's centre meets the square; the point relative to the eye, and the distance along the view.
struct SquareHit {
    bool isInside = false, isNearEdge = false;
    double3 place{ 0 };
    double depth = 0;
};

SquareHit squareHit(View const& view, double4x4 const& world, uint32_t x, uint32_t y) {
    const double3x3 axes(view.camera.worldFromView);
    const double3 eye(view.camera.worldFromView[3]);
    const double2 at = (double2(x, y) + 0.5) / double(kAovSide) * 2.0 - 1.0;
    const double4x4 clipFromView(view.camera.clipFromView(1));
    const bool isParallel = clipFromView[3].w != 0;
    const double2 scale(1 / clipFromView[0].x, 1 / std::abs(clipFromView[1].y));
    const double2 across = double2(at.x, -at.y) * scale;
    const double3 origin = isParallel ? eye + axes * double3(across, 0) : eye;
    const double3 ray = axes * (isParallel ? double3(0, 0, -1) : double3(across, -1));
    const double4x4 objectFromWorld = glm::inverse(world);
    const double3 from(objectFromWorld * double4(origin, 1)), along(objectFromWorld * double4(ray, 0));
    const double t = -from.z / along.z;
    const double2 inside = glm::abs(double2(from + along * t));
    const double outermost = std::max(inside.x, inside.y);
    return { t > 0 && outermost < 1, std::abs(outermost - 1) < 1e-3, origin + ray * t - eye, t };
}

/// Reversed depths of a perspective lens are as exact as floats; others end at 2^-24 of the range.
void expectGeometry(std::vector<Image> const& images, View const& view, double4x4 const& world) {
    const bool isExact = view.quality.depthRange == DepthRange::Reversed && !view.camera.lens.isOrthographic();
    const double coarse = isExact ? 0 : 1.5e-4; // metres
    const double3 normal(world * double4(0, 0, 1, 0)), tangent(world * double4(1, 0, 0, 0));
    const double3 bumped = 0.6 * tangent + 0.8 * normal;
    size_t hits = 0;
    for (uint32_t y = 0; y < kAovSide; ++y) {
        for (uint32_t x = 0; x < kAovSide; ++x) {
            const SquareHit hit = squareHit(view, world, x, y);
            if (hit.isNearEdge) continue;
            for (const Aov aov : kAllAovs)
                ASSERT_EQ(numbersAt(of(images, aov), x, y).w, hit.isInside ? 1.0f : 0.0f) << toString(aov);
            if (!hit.isInside) continue;
            ++hits;
            const auto near = [&](Aov aov, double3 expected, double most) {
                const double3 found(numbersAt(of(images, aov), x, y));
                EXPECT_LT(glm::length(found - expected), most) << toString(aov) << ' ' << x << ", " << y;
            };
            near(Aov::Depth, double3(hit.depth, 0, 0), 2e-6 * hit.depth + coarse);
            near(Aov::Position, hit.place, 4e-6 * glm::length(hit.place) + 2 * coarse);
            near(Aov::GeometricNormal, normal, 1e-6);
            near(Aov::Normal, bumped, 1e-6);
            near(Aov::Tangent, tangent, 1e-6);
            const double2 on =
                    double2(glm::inverse(world) * double4(hit.place + double3(view.camera.worldFromView[3]), 1));
            near(Aov::TextureCoordinates, double3((on.x + 1) / 2, (1 + on.y) / 2, 0), 2e-5);
            near(Aov::BaseColor, double3(0.1, 0.5, 0.9), 1e-7);
            near(Aov::Roughness, double3(0.3), 1e-7);
            near(Aov::Metallic, double3(0.6), 1e-7);
            near(Aov::Occlusion, double3(0.75), 1e-7);
            near(Aov::Emissive, double3(2, 0.003, 70000), 1e-3);
        }
    }
    EXPECT_GT(hits, 40u);
}

TEST(Aovs, AreTheClosedFormsOfTheSurfaceAtThePixelsCenter) {
    const double3 ahead = AovStage::kEye + 2.2 * glm::normalize(double3(0.3, -0.2, -1));
    for (const bool isParallel : { false, true }) {
        for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
            View view;
            const auto images = test::sameOnBothApis<AovStage>([&](AovStage& stage) {
                stage.add(kPainted, turned(ahead));
                if (isParallel) stage.view.camera.lens = Lens{ .orthographicHeight = 3 };
                stage.view.quality.depthRange = range;
                view = stage.view;
                return stage.draw();
            });
            if (!images.empty()) expectGeometry(images, view, turned(ahead));
        }
    }
}

TEST(Aovs, FarFromTheOriginTheNumbersAreTheSame) {
    const double3 away(3e7, -2e7, 5e6), ahead = AovStage::kEye + 2.2 * glm::normalize(double3(0.3, -0.2, -1));
    test::sameOnBothApis<AovStage>([&](AovStage& stage) {
        stage.add(kPainted, turned(ahead));
        const std::vector<Image> here = stage.draw();
        stage.view.camera.worldFromView[3] += double4(away, 0);
        stage.add(kPainted, turned(ahead + away));
        const std::vector<Image> there = stage.draw();
        for (const Aov aov : kAllAovs) {
            const bool isOfAnother = aov >= Aov::ObjectId && aov <= Aov::MaterialInstanceId;
            EXPECT_EQ(of(here, aov).pixels == of(there, aov).pixels, !isOfAnother) << toString(aov);
        }
        return there;
    });
}

TEST(Aovs, WhatAMaterialDoesNotHaveIsHalfThere) {
    const auto images = test::sameOnBothApis<AovStage>([&](AovStage& stage) {
        stage.add(kFlat, turned(AovStage::kEye + 2.2 * glm::normalize(double3(0.3, -0.2, -1))));
        return stage.draw();
    });
    constexpr uint32_t kMiddle = kAovSide / 2;
    EXPECT_EQ(numbersAt(of(images, Aov::BaseColor), kMiddle, kMiddle), float4(0.25f, 0.5f, 0.75f, 1));
    EXPECT_EQ(numbersAt(of(images, Aov::Depth), kMiddle, kMiddle).w, 1);
    for (const Aov aov : { Aov::Roughness, Aov::Metallic, Aov::Occlusion, Aov::Tangent })
        EXPECT_EQ(numbersAt(of(images, aov), kMiddle, kMiddle), float4(0, 0, 0, 0.5f)) << toString(aov);
    EXPECT_EQ(numbersAt(of(images, Aov::Depth), 0, 0), float4(0)) << "nothing is there";
}

// A frame without them has the same bits before and after.
TEST(Aovs, LeaveTheFramesOfOtherRenderersAsTheyAre) {
    test::sameOnBothApis<AovStage>([&](AovStage& stage) {
        stage.add(kPainted, turned(AovStage::kEye + 2.2 * glm::normalize(double3(0.3, -0.2, -1))));
        Renderer renderer(stage.engine);
        stage.view.quality.antiAliasing = AntiAliasing::Taa;
        std::vector<Image> frames;
        for (int i = 0; i < 2; ++i) {
            Renderer other(stage.engine);
            Result<Image> first = renderer.renderToImage(stage.scene, stage.view);
            if (i == 1) stage.draw();
            frames.push_back(*renderer.renderToImage(stage.scene, stage.view));
            Result<Image> again = other.renderToImage(stage.scene, stage.view);
            EXPECT_TRUE(first && again);
        }
        return frames;
    });
}

TEST(Aovs, AreLayersOfAnExrFile) {
    const std::filesystem::path file = test::folderOfThisTest() / "aovs.exr";
    AovStage stage(Backend::Gles);
    stage.add(kPainted, turned(AovStage::kEye + 2.2 * glm::normalize(double3(0.3, -0.2, -1))));
    const std::vector<Image> images = stage.draw();
    std::vector<ExrLayer> layers;
    for (const Aov aov : kAllAovs) layers.push_back(layerOf(aov, of(images, aov)));
    const Result<void> saved = saveExr(file, layers);
    ASSERT_TRUE(saved) << saved.error().message;
    layers.push_back(layers.front());
    EXPECT_EQ(saveExr(file, layers).error().message, "an EXR has channel 'depth.Z' once only");
}

TEST(AovsDeathTest, NeedATargetOfFullFloats) {
    AovStage stage(Backend::Null);
    stage.view.aov = Aov::Depth;
    Renderer renderer(stage.engine);
    EXPECT_DEATH((void)renderer.renderToImage(stage.scene, stage.view), "drawn to a render target of RGBA32F");
}

} // namespace
} // namespace filament_core
