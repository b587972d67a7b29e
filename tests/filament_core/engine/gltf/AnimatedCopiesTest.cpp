// SPDX-License-Identifier: Apache-2.0
// KHR_animation_pointer in scenes: materials, textures, lights, cameras and visibility of a copy have the values that
// interpolation gives them, on both devices, and other copies have theirs.
#include "filament_core/engine/SceneImpl.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/ModelCopy.h>

#include <gmock/gmock.h>

#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace filament_core {
namespace {

using testing::IsEmpty;

/// Four quads in a row: an unlit panel; one that is hidden at rest, with a lamp; one with a texture that is red on its
/// left and green on its right; one with layers that appear. A spot in front of the last one, and a camera.
constexpr const char* kMovingModel =
        R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1, 2, 3, 4, 6 ] } ],
    "extensionsUsed": [ "KHR_animation_pointer", "KHR_materials_unlit", "KHR_lights_punctual", "KHR_node_visibility" ],
    "extensions": { "KHR_lights_punctual": { "lights": [ { "type": "spot", "name": "beam", "spot": {} },
        { "type": "point", "name": "lamp", "intensity": 3 } ] } },
    "nodes": [ { "mesh": 0, "name": "panel" },
        { "mesh": 1, "name": "blinker", "translation": [ 4, 0, 0 ], "children": [ 5 ],
          "extensions": { "KHR_node_visibility": { "visible": false } } },
        { "mesh": 2, "name": "belt", "translation": [ 8, 0, 0 ] },
        { "mesh": 3, "name": "layers", "translation": [ 12, 0, 0 ], "rotation": [ 0, 0.17364818, 0, 0.98480775 ] },
        { "name": "front", "translation": [ 12, 0, 2 ], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "name": "socket", "translation": [ 8, 0.3, 1 ], "extensions": { "KHR_lights_punctual": { "light": 1 } } },
        { "name": "eye", "camera": 0, "translation": [ 0, 0, 5 ] } ],
    "cameras": [ { "name": "eye", "type": "perspective", "perspective": { "yfov": 0.75, "znear": 0.25 } } ],
    "materials": [
        { "name": "panel", "pbrMetallicRoughness": { "baseColorFactor": [ 0, 1, 0, 1 ] },
          "extensions": { "KHR_materials_unlit": {} } },
        { "name": "white", "extensions": { "KHR_materials_unlit": {} } },
        { "name": "belt", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0,
          "extensions": { "KHR_texture_transform": {} } } }, "extensions": { "KHR_materials_unlit": {} } },
        { "name": "layers", "pbrMetallicRoughness": { "metallicFactor": 0.5, "roughnessFactor": 0.25 }, "extensions": {
          "KHR_materials_clearcoat": {}, "KHR_materials_sheen": { "sheenRoughnessFactor": 0.4 },
          "KHR_materials_iridescence": {}, "KHR_materials_anisotropy": { "anisotropyStrength": 0.8 } } } ],
    "textures": [ { "source": 0, "sampler": 0 } ], "samplers": [ { "magFilter": 9728, "minFilter": 9728 } ],
    "images": [ { "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP4z8DA8J8BAAf/Af+4BDXgAAAAAElFTkSuQmCC" } ],
    "meshes": [
        { "primitives": [ { "mode": 5, "material": 0, "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 } } ] },
        { "primitives": [ { "mode": 5, "material": 1, "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 } } ] },
        { "primitives": [ { "mode": 5, "material": 2, "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 } } ] },
        { "primitives": [ { "mode": 5, "material": 3, "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 } } ] } ],
    "animations": [
        { "name": "play", "samplers": [
            { "input": 3, "output": 5, "interpolation": "LINEAR" },
            { "input": 4, "output": 6, "interpolation": "STEP" },
            { "input": 3, "output": 7, "interpolation": "LINEAR" },
            { "input": 3, "output": 8, "interpolation": "CUBICSPLINE" },
            { "input": 3, "output": 9, "interpolation": "LINEAR" },
            { "input": 3, "output": 10, "interpolation": "LINEAR" },
            { "input": 3, "output": 11, "interpolation": "LINEAR" },
            { "input": 3, "output": 12, "interpolation": "LINEAR" } ], "channels": [
            { "sampler": 0, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/0/pbrMetallicRoughness/baseColorFactor" } } } },
            { "sampler": 1, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/nodes/1/extensions/KHR_node_visibility/visible" } } } },
            { "sampler": 2, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/extensions/KHR_lights_punctual/lights/0/intensity" } } } },
            { "sampler": 6, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/extensions/KHR_lights_punctual/lights/1/color" } } } },
            { "sampler": 7, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle" } } } },
            { "sampler": 3, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/cameras/0/perspective/yfov" } } } },
            { "sampler": 4, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/2/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset" } } } },
            { "sampler": 5, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/3/extensions/KHR_materials_clearcoat/clearcoatFactor" } } } },
            { "sampler": 6, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/3/extensions/KHR_materials_sheen/sheenColorFactor" } } } },
            { "sampler": 5, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/3/extensions/KHR_materials_iridescence/iridescenceFactor" } } } },
            { "sampler": 5, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/3/extensions/KHR_materials_anisotropy/anisotropyRotation" } } } },
            { "sampler": 6, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/3/emissiveFactor" } } } },
            { "sampler": 5, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/3/pbrMetallicRoughness/roughnessFactor" } } } } ] },
        { "name": "green", "samplers": [
            { "input": 3, "output": 13, "interpolation": "STEP" } ], "channels": [
            { "sampler": 0, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
              "pointer": "/materials/0/pbrMetallicRoughness/baseColorFactor" } } } } ] } ],
    "accessors": [
        { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
        { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3" },
        { "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" },
        { "bufferView": 3, "componentType": 5126, "count": 2, "type": "SCALAR" },
        { "bufferView": 4, "componentType": 5126, "count": 2, "type": "SCALAR" },
        { "bufferView": 5, "componentType": 5126, "count": 2, "type": "VEC4" },
        { "bufferView": 6, "componentType": 5121, "count": 2, "type": "SCALAR" },
        { "bufferView": 7, "componentType": 5126, "count": 2, "type": "SCALAR" },
        { "bufferView": 8, "componentType": 5126, "count": 6, "type": "SCALAR" },
        { "bufferView": 9, "componentType": 5126, "count": 2, "type": "VEC2" },
        { "bufferView": 10, "componentType": 5126, "count": 2, "type": "SCALAR" },
        { "bufferView": 11, "componentType": 5126, "count": 2, "type": "VEC3" },
        { "bufferView": 12, "componentType": 5126, "count": 2, "type": "SCALAR" },
        { "bufferView": 13, "componentType": 5126, "count": 2, "type": "VEC4" } ],
    "bufferViews": [
        { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
        { "buffer": 0, "byteOffset": 48, "byteLength": 48 },
        { "buffer": 0, "byteOffset": 96, "byteLength": 32 },
        { "buffer": 0, "byteOffset": 128, "byteLength": 8 },
        { "buffer": 0, "byteOffset": 136, "byteLength": 8 },
        { "buffer": 0, "byteOffset": 144, "byteLength": 32 },
        { "buffer": 0, "byteOffset": 176, "byteLength": 2 },
        { "buffer": 0, "byteOffset": 180, "byteLength": 8 },
        { "buffer": 0, "byteOffset": 188, "byteLength": 24 },
        { "buffer": 0, "byteOffset": 212, "byteLength": 16 },
        { "buffer": 0, "byteOffset": 228, "byteLength": 8 },
        { "buffer": 0, "byteOffset": 236, "byteLength": 24 },
        { "buffer": 0, "byteOffset": 260, "byteLength": 8 },
        { "buffer": 0, "byteOffset": 268, "byteLength": 32 } ],
    "buffers": [ { "byteLength": 300, "uri": "data:application/octet-stream;base64,AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAvwAAAD8AAAAAAAAAPwAAAD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAQAAAAAAAAIA/AAAAAAAAAAAAAIA/AACAPwAAgD8AAAAAAAAAAAAAgD8AAQAAAAAgQQAA8EEAAAAAAAAAPwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAADNzEw/zczMPs3MTD7NzEw+mpkZPwAAAAAAAIA/AAAAAAAAgD8AAAAAAACAPwAAAAAAAIA/" } ] })";

const float4 kCopyBlue(0, 0, 1, 1), kCopyRed(1, 0, 0, 1), kCopyGreen(0, 1, 0, 1), kCopyWhite(1), kCopyBlack(0, 0, 0, 1);
constexpr double kBlinkerX = 4, kBeltX = 8, kLayersX = 12;

class AnimatedCopiesTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        auto loaded =
                loadGltf(*engine, GltfMemory{ .file = std::as_bytes(std::span(kMovingModel, std::strlen(kMovingModel))),
                                              .name = "row" });
        ASSERT_TRUE(loaded) << loaded.error().message;
        model.emplace(std::move(*loaded));
        EXPECT_THAT(model->warnings(), IsEmpty());
        scene.emplace(*engine);
        first = scene->add(*model);
        double4x4 above(1.0);
        above[3].y = 5;
        second = scene->add(*model, above);
    }
    void TearDown() override {
        scene.reset();
        model.reset();
        if (engine) test::expectNoErrors(*engine);
    }

    /// The colour at a point of the plane z = 0.
    float4 colorAt(double x, double y = 0) {
        const View view{ .camera = Camera::lookAt({ x, y, 0.2 }, { x, y, 0 }, { .verticalFovDegrees = 10 }),
                         .size = { 1, 1 } };
        return test::halfPixel(test::renderLinear(*engine, *scene, view), 0, 0);
    }
    scene::LightRecord const& light(Node root, const char* name) {
        scene::Lights const& lights = scene->impl().data.lights;
        return lights.records[lights.index.at(ModelCopy::of(*scene, root)->light(name).value())];
    }
    double fovRadians(Node root) {
        return glm::radians(double{ ModelCopy::of(*scene, root)->camera("eye").value().lens.verticalFovDegrees });
    }

    std::optional<Engine> engine;
    std::optional<Model> model;
    std::optional<Scene> scene;
    Node first, second;
};

TEST_P(AnimatedCopiesTest, FactorsAreInterpolatedAndRestIsThatOfTheFile) {
    EXPECT_EQ(colorAt(0), kCopyGreen);
    Animator animator(*model, *scene, first);
    for (const double seconds : { 0.0, 0.5, 1.0, 1.5, 2.0, 9.0 }) {
        animator.apply(0, seconds);
        const auto s = static_cast<float>(std::min(seconds / 2, 1.0));
        EXPECT_EQ(colorAt(0), float4(s, 0, 1 - s, 1)) << seconds;
    }
    animator.rest();
    EXPECT_EQ(colorAt(0), kCopyGreen);
}

TEST_P(AnimatedCopiesTest, CopiesHaveTimesOfTheirOwn) {
    Animator one(*model, *scene, first), other(*model, *scene, second);
    one.apply(0, 0);
    EXPECT_EQ(colorAt(0, 5), kCopyGreen) << "nothing was applied to it";
    other.apply(0, 2);
    EXPECT_EQ(colorAt(0), kCopyBlue);
    EXPECT_EQ(colorAt(0, 5), kCopyRed);
    EXPECT_EQ(colorAt(kBlinkerX), kCopyBlack);
    EXPECT_EQ(colorAt(kBlinkerX, 5), kCopyWhite);
    EXPECT_EQ(light(first, "beam").intensity, 10);
    EXPECT_EQ(light(second, "beam").intensity, 30);
    EXPECT_NE(fovRadians(first), fovRadians(second));
    const Node third = scene->add(*model);
    EXPECT_NEAR(fovRadians(third), 0.75, 1e-6) << "a new copy is at rest";
}

TEST_P(AnimatedCopiesTest, NodesAppearWithTheirLights) {
    EXPECT_EQ(colorAt(kBlinkerX), kCopyBlack) << "hidden in the file";
    EXPECT_EQ(light(first, "lamp").intensity, 0);
    Animator animator(*model, *scene, first);
    animator.apply(0, 0.99);
    EXPECT_EQ(colorAt(kBlinkerX), kCopyBlack) << "a step, not a line";
    animator.apply(0, 1);
    EXPECT_EQ(colorAt(kBlinkerX), kCopyWhite);
    EXPECT_EQ(light(first, "lamp").intensity, 3);
    animator.rest();
    EXPECT_EQ(colorAt(kBlinkerX), kCopyBlack);
    EXPECT_EQ(light(first, "lamp").intensity, 0);
}

TEST_P(AnimatedCopiesTest, TexturesSlide) {
    Animator animator(*model, *scene, first);
    const auto left = [&](double seconds) {
        animator.apply(0, seconds);
        return colorAt(kBeltX - 0.25);
    };
    EXPECT_EQ(left(0), kCopyRed);
    EXPECT_EQ(left(1), kCopyGreen) << "by half its width";
    EXPECT_EQ(left(2), kCopyRed) << "around";
}

TEST_P(AnimatedCopiesTest, LightsAndCamerasFollowTheirKeys) {
    Animator animator(*model, *scene, first);
    for (const double seconds : { 0.0, 0.25, 1.0, 1.75, 2.0 }) {
        animator.apply(0, seconds);
        const double s = seconds / 2;
        EXPECT_NEAR(light(first, "beam").intensity, 10 + 20 * s, 1e-5);
        EXPECT_NEAR(light(first, "beam").outerConeRadians, 0.2 + 0.4 * s, 1e-6);
        EXPECT_NEAR(light(first, "lamp").color.x, 0.8 * s, 1e-6);
        EXPECT_NEAR(light(first, "lamp").color.z, 0.2 * s, 1e-6);
        EXPECT_NEAR(fovRadians(first), 0.5 + 0.5 * (3 - 2 * s) * s * s, 1e-6) << "Hermite, without slopes at the ends";
    }
}

TEST_P(AnimatedCopiesTest, CrossFadesMixValuesAndChooseWhatIsVisible) {
    Animator animator(*model, *scene, first);
    animator.crossFade(0, 2, 1, 0, 0.25);
    EXPECT_EQ(colorAt(0), float4(0.75f, 0.25f, 0, 1));
    EXPECT_EQ(colorAt(kBlinkerX), kCopyWhite) << "nearer to the first";
    EXPECT_NEAR(fovRadians(first), 0.75 * 1 + 0.25 * 0.75, 1e-6) << "the second one leaves it at rest";
    animator.crossFade(0, 2, 1, 0, 0.75);
    EXPECT_EQ(colorAt(kBlinkerX), kCopyBlack);
}

TEST_P(AnimatedCopiesTest, WhatTheProgramSetBesidesStays) {
    ModelCopy copy = ModelCopy::of(*scene, first).value();
    ASSERT_TRUE(copy.set("white", "baseColorFactor", kCopyBlue));
    SpotLight spot{ .directionWorld = { 0, 0, -1 }, .intensity = Candela{ 1 } };
    spot.rangeMeters = 7;
    scene->set(copy.light("beam").value(), spot);
    Animator animator(*model, *scene, first);
    animator.apply(0, 1);
    EXPECT_EQ(colorAt(kBlinkerX), kCopyBlue);
    EXPECT_EQ(light(first, "beam").rangeMeters, 7);
    EXPECT_EQ(light(first, "beam").intensity, 20);
}

TEST_P(AnimatedCopiesTest, PartsThatAreGoneAreLeftOut) {
    Animator animator(*model, *scene, first);
    ModelCopy copy = ModelCopy::of(*scene, first).value();
    for (CopyRenderable const& part : copy.renderables()) scene->remove(part.renderable);
    for (CopyLight const& part : copy.lights()) scene->remove(part.light);
    animator.apply(0, 1);
    EXPECT_EQ(colorAt(0), kCopyBlack);
    EXPECT_EQ(colorAt(0, 5), kCopyGreen);
}

INSTANTIATE_TEST_SUITE_P(Apis, AnimatedCopiesTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

/// Layers that grow, at several times.
std::vector<Image> playOn(Backend backend) {
    auto engine = test::makeEngine(backend);
    if (!engine) return {};
    std::vector<Image> images;
    {
        auto model =
                loadGltf(*engine, GltfMemory{ .file = std::as_bytes(std::span(kMovingModel, std::strlen(kMovingModel))),
                                              .name = "row" });
        EXPECT_TRUE(model.ok());
        if (!model) return {};
        Scene scene(*engine);
        Animator animator(*model, scene, scene.add(*model));
        scene.add(SunLight{ .directionWorld = { -0.3f, -0.2f, -1 }, .illuminance = Lux{ 60'000 } });
        const View view{ .camera = Camera::lookAt({ kLayersX, 0, 2 }, { kLayersX, 0, 0 }, { .verticalFovDegrees = 35 }),
                         .size = { 64, 64 } };
        Renderer renderer(*engine);
        for (const double seconds : { 0.0, 0.7, 1.3, 2.0 }) {
            animator.apply(0, seconds);
            images.push_back(test::renderLinear(*engine, renderer, scene, view));
        }
    }
    test::expectNoErrors(*engine);
    return images;
}

TEST(AnimatedCopies, LayersGrowWithTheSameBitsOnBothApis) {
    const std::vector<Image> vulkan = playOn(Backend::Vulkan), gles = playOn(Backend::Gles);
    ASSERT_EQ(vulkan.size(), 4u);
    ASSERT_EQ(gles.size(), vulkan.size());
    for (size_t i = 0; i < vulkan.size(); ++i) {
        EXPECT_EQ(vulkan[i].pixels, gles[i].pixels) << i;
        if (i == 0) continue;
        EXPECT_GT(test::differingPixels(vulkan[i], vulkan[i - 1]), 500u) << i;
    }
}

} // namespace
} // namespace filament_core
