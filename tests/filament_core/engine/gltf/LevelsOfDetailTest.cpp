// SPDX-License-Identifier: Apache-2.0
// MSFT_lod in scenes: the finest level alone, at any distance, or the one that a view selects. A scene with it has the
// bits of one that has nothing else.
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/Animator.h>
#include <filament_core/ModelCopy.h>

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>

namespace filament_core {
namespace {

/// A green square, and before it two larger ones, red and blue, which `extension` may make its coarser levels.
/// `roots`: of the scene.
std::string squares(std::string const& extension, std::string const& roots) {
    return R"({ "asset": { "version": "2.0" }, "scenes": [ { "nodes": )" + roots + R"( } ],
    "extensionsUsed": [ "KHR_materials_unlit", "MSFT_lod" ],
    "nodes": [ { "name": "fine", "mesh": 0 )" +
           extension + R"( },
        { "name": "medium", "mesh": 1, "translation": [ 0, 0, 0.1 ], "scale": [ 1.5, 1.5, 1 ] },
        { "name": "coarse", "mesh": 2, "translation": [ 0, 0, 0.2 ], "scale": [ 2, 2, 1 ] } ],
    "materials": [
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 1, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 1, 1 ] }, "extensions": { "KHR_materials_unlit": {} } } ],
    "meshes": [ { "primitives": [ { "mode": 5, "material": 0, "attributes": { "POSITION": 0 } } ] },
                { "primitives": [ { "mode": 5, "material": 1, "attributes": { "POSITION": 0 } } ] },
                { "primitives": [ { "mode": 5, "material": 2, "attributes": { "POSITION": 0 } } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 48 } ], "buffers": [ { "byteLength": 48, "uri":
        "data:application/octet-stream;base64,AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAvwAAAD8AAAAAAAAAPwAAAD8AAAAA" } ] })";
}

constexpr const char* kLevels =
        R"(, "extensions": { "MSFT_lod": { "ids": [ 1, 2 ] } }, "extras": { "MSFT_screencoverage": [ 0.5, 0.1, 0.01 ] })";

/// From near, and from where the squares cover a thousandth of the screen.
std::vector<Image> draw(Backend backend, std::string const& file) {
    auto engine = test::makeEngine(backend);
    if (!engine) return {};
    std::vector<Image> images;
    {
        const auto model = loadGltf(*engine, GltfMemory{ .file = std::as_bytes(std::span(file)) });
        if (!model) {
            ADD_FAILURE() << model.error().message;
            return {};
        }
        EXPECT_THAT(model->warnings(), testing::IsEmpty());
        Scene scene(*engine);
        scene.add(*model);
        for (const double meters : { 2.0, 30.0 }) {
            const View view{ .camera = Camera::lookAt({ 0, 0, meters }, { 0, 0, 0 }), .size = { 64, 48 } };
            images.push_back(test::renderLinear(*engine, scene, view));
        }
    }
    test::expectNoErrors(*engine);
    return images;
}

TEST(LevelsOfDetail, OnlyTheFinestIsDrawn) {
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        const std::vector<Image> levels = draw(backend, squares(kLevels, "[ 0, 1, 2 ]"));
        const std::vector<Image> fine = draw(backend, squares("", "[ 0 ]"));
        const std::vector<Image> all = draw(backend, squares("", "[ 0, 1, 2 ]"));
        ASSERT_EQ(levels.size(), 2u);
        ASSERT_EQ(fine.size(), levels.size());
        ASSERT_EQ(all.size(), levels.size());
        for (size_t i = 0; i < levels.size(); ++i) {
            EXPECT_EQ(levels[i].pixels, fine[i].pixels) << "distance " << i;
            EXPECT_NE(levels[i].pixels, all[i].pixels) << "distance " << i;
            const float4 middle = test::halfPixel(levels[i], 32, 24);
            EXPECT_GT(middle.y, middle.x) << "the finest is green";
        }
    }
}

/// What a scene with one copy of all levels shows, before and after its levels are chosen.
class ChosenLevels : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        renderer.emplace(*engine);
    }
    void TearDown() override {
        if (engine) test::expectNoErrors(*engine);
    }
    Model load(std::string const& file, bool allLevels = true) {
        auto model =
                loadGltf(*engine, GltfMemory{ .file = std::as_bytes(std::span(file)) }, { .allLevels = allLevels });
        EXPECT_TRUE(model.ok()) << (model ? "" : model.error().message);
        return std::move(*model);
    }
    static View from(double meters) {
        return { .camera = Camera::lookAt({ 0, 0, meters }, { 0, 0, 0 }, { .verticalFovDegrees = 90 }),
                 .size = { 64, 48 } };
    }
    /// Of one of the squares alone; none: of nothing.
    Image pictureOf(std::optional<uint32_t> square, View const& view) {
        const Model model = load(squares("", square ? fmt::format("[ {} ]", *square) : "[ 0 ]"), false);
        Scene scene(*engine);
        const Node root = scene.add(model);
        if (!square) scene.remove(root);
        return test::renderLinear(*engine, *renderer, scene, view);
    }
    std::optional<Engine> engine;
    std::optional<Renderer> renderer;
};
INSTANTIATE_TEST_SUITE_P(Apis, ChosenLevels, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& api) { return std::string(toString(api.param)); });

/// The sphere around the finest square has R^2 = 1/2 m^2, and the screen 2 x 8/3 m^2 at 1 m.
double coverageFrom(double meters) { return 3.14159265358979 * 0.5 / (2 * 8.0 / 3 * meters * meters); }

TEST_P(ChosenLevels, AreSelectedByCoverage) {
    const Model model = load(squares(kLevels, "[ 0 ]")); // the others are in no scene
    Scene scene(*engine);
    ModelCopy copy = *ModelCopy::of(scene, scene.add(model));
    ASSERT_EQ(copy.levels().size(), 1u);
    EXPECT_EQ(copy.levels()[0].shown, 0u) << "until the first call";
    EXPECT_EQ(copy.levels()[0].nodes[1], *copy.node("medium"));
    EXPECT_EQ(copy.levels()[0].leastCoverage, (std::vector<double>{ 0.5, 0.1, 0.01 }));
    const auto nearest = [](double least) { return std::sqrt(coverageFrom(1) / least); };
    for (const double meters : { 0.6, nearest(0.5) - 1e-4, nearest(0.5) + 1e-4, 1.0, nearest(0.1) - 1e-4,
                                 nearest(0.1) + 1e-4, 4.0, nearest(0.01) - 1e-3, nearest(0.01) + 1e-3, 20.0, 0.1 }) {
        const View view = from(meters);
        copy.chooseLevels(view);
        const double coverage = meters * meters <= 0.5 ? 1e9 : coverageFrom(meters);
        const std::optional<uint32_t> expected = coverage >= 0.5    ? std::optional(0u)
                                                 : coverage >= 0.1  ? std::optional(1u)
                                                 : coverage >= 0.01 ? std::optional(2u)
                                                                    : std::nullopt;
        EXPECT_EQ(copy.levels()[0].shown, expected) << meters;
        const Image picture = test::renderLinear(*engine, *renderer, scene, view);
        EXPECT_EQ(picture.pixels, pictureOf(expected, view).pixels) << meters;
    }
}

TEST_P(ChosenLevels, FollowTheBiasTheLensAndTheScaleOfTheCopyAndNotTheDirection) {
    const Model model = load(squares(kLevels, "[ 0, 1, 2 ]"));
    Scene scene(*engine);
    const Node root = scene.add(model);
    ModelCopy copy = *ModelCopy::of(scene, root);
    const auto shown = [&](View const& view, float bias = 1) {
        copy.chooseLevels(view, bias);
        return copy.levels()[0].shown;
    };
    EXPECT_EQ(shown(from(2)), 2u);
    EXPECT_EQ(shown(from(2), 2), 1u);
    EXPECT_EQ(shown(from(2), 1000), 0u);
    EXPECT_EQ(shown(from(2), 0.01f), std::nullopt);
    View view = from(2);
    view.camera = Camera::lookAt({ 0, 0, 2 }, { 0, 0, 0 }, { .verticalFovDegrees = 30 });
    EXPECT_EQ(shown(view), 0u) << "a longer lens";
    view.camera = Camera::lookAt({ 0, 0, 2 }, { 0, 0, 4 }, { .verticalFovDegrees = 90 });
    EXPECT_EQ(shown(view), 2u) << "behind the camera: where shadows fall, the level matters as well";
    view.camera = Camera::lookAt({ 0, 0, 50 }, { 0, 0, 0 }, { .orthographicHeight = 2 });
    EXPECT_EQ(shown(view), 1u) << "a parallel lens: pi / 2 of 2 x 8/3 square metres";
    scene.setTransform(root, glm::scale(double4x4(1.0), double3(10.0)));
    EXPECT_EQ(shown(from(20)), 2u);
    EXPECT_EQ(shown(from(5)), 0u) << "in the sphere around it";
}

/// Each copy of many, at random places: the coverage that the formula of the header gives decides.
TEST_P(ChosenLevels, OfManyCopiesAreEachItsOwn) {
    const Model model = load(squares(kLevels, "[ 0, 1, 2 ]"));
    Scene scene(*engine);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-15, 15), size(0.1, 8);
    std::vector<ModelCopy> copies;
    std::vector<std::pair<double3, double>> spheres;
    for (int i = 0; i < 200; ++i) {
        const double3 at(place(random), place(random), place(random));
        const double scale = size(random);
        const double4x4 world = glm::scale(glm::translate(double4x4(1.0), at), double3(scale));
        copies.push_back(*ModelCopy::of(scene, scene.add(model, world)));
        spheres.emplace_back(at, scale * std::sqrt(0.5));
    }
    std::array<uint32_t, 4> counts{};
    for (int trial = 0; trial < 10; ++trial) {
        const double3 eye(place(random), place(random), place(random));
        View view = from(1);
        view.camera =
                Camera::lookAt(eye, { place(random), place(random), place(random) }, { .verticalFovDegrees = 90 });
        for (size_t i = 0; i < copies.size(); ++i) {
            copies[i].chooseLevels(view);
            const double distance = glm::distance(eye, spheres[i].first), radius = spheres[i].second;
            const double coverage = distance <= radius ? 1e9 : coverageFrom(distance) * 2 * radius * radius;
            const uint32_t expected = coverage >= 0.5 ? 0 : coverage >= 0.1 ? 1 : coverage >= 0.01 ? 2 : 3;
            EXPECT_EQ(copies[i].levels()[0].shown.value_or(3), expected) << trial << " " << i;
            ++counts[expected];
        }
    }
    for (const uint32_t count : counts) EXPECT_GT(count, 10u);
}

TEST_P(ChosenLevels, OfTwoViewsOfOneFrameDiffer) {
    const Model model = load(squares(kLevels, "[ 0, 1, 2 ]"));
    Scene scene(*engine);
    ModelCopy copy = *ModelCopy::of(scene, scene.add(model));
    std::vector<std::vector<std::byte>> pictures;
    for (int round = 0; round < 2; ++round) {
        for (const double meters : { 1.0, 4.0 }) {
            copy.chooseLevels(from(meters));
            pictures.push_back(test::renderLinear(*engine, *renderer, scene, from(meters)).pixels);
        }
    }
    EXPECT_EQ(pictures[0], pictureOf(1, from(1)).pixels);
    EXPECT_EQ(pictures[1], pictureOf(2, from(4)).pixels);
    EXPECT_EQ(pictures[2], pictures[0]);
    EXPECT_EQ(pictures[3], pictures[1]);
}

/// An animation hides the medium level for its first second, and shows it then.
TEST_P(ChosenLevels, ShowNothingThatAnAnimationHides) {
    std::string file = squares(kLevels, "[ 0, 1, 2 ]");
    file.insert(file.find("\"nodes\": [ { \"name\""), R"("animations": [ { "channels": [ { "sampler": 0, "target": {
        "path": "pointer", "extensions": { "KHR_animation_pointer": {
        "pointer": "/nodes/1/extensions/KHR_node_visibility/visible" } } } } ],
        "samplers": [ { "input": 1, "output": 2, "interpolation": "STEP" } ] } ], )");
    file.insert(file.find("\"mesh\": 1"), R"("extensions": { "KHR_node_visibility": { "visible": true } }, )");
    // Times 0 and 1, then the bytes 0 and 1.
    file.insert(file.find(" ],\n    \"bufferViews\""),
                R"(, { "bufferView": 1, "componentType": 5126, "count": 2, "type":
        "SCALAR", "min": [ 0 ], "max": [ 1 ] }, { "bufferView": 1, "byteOffset": 8, "componentType": 5121, "count": 2,
        "type": "SCALAR" })");
    file.insert(file.find(" ], \"buffers\""), R"(, { "buffer": 1, "byteLength": 10 })");
    file.insert(file.rfind(" ] }"),
                R"(, { "byteLength": 10, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAQ==" })");
    file.insert(file.find("\"MSFT_lod\" ],"), "\"KHR_animation_pointer\", \"KHR_node_visibility\", ");
    const Model model = load(file);
    EXPECT_THAT(model.warnings(), testing::IsEmpty());
    Scene scene(*engine);
    const Node root = scene.add(model);
    ModelCopy copy = *ModelCopy::of(scene, root);
    Animator animator(model, scene, root);
    const auto picture = [&](double meters) {
        return test::renderLinear(*engine, *renderer, scene, from(meters)).pixels;
    };
    const auto medium = pictureOf(1, from(1)).pixels, nothing = pictureOf({}, from(1)).pixels;
    copy.chooseLevels(from(1));
    EXPECT_EQ(picture(1), medium) << "at rest it is visible";
    animator.apply(0, 0.5);
    EXPECT_EQ(picture(1), nothing);
    copy.chooseLevels(from(4));
    EXPECT_EQ(picture(4), pictureOf(2, from(4)).pixels) << "the coarse one is not animated";
    animator.apply(0, 1);
    EXPECT_EQ(picture(4), pictureOf(2, from(4)).pixels) << "visible, but not chosen";
    copy.chooseLevels(from(1));
    EXPECT_EQ(picture(1), medium);
}

TEST_P(ChosenLevels, OutliveWhatTheProgramRemoves) {
    const Model model = load(squares(kLevels, "[ 0, 1, 2 ]"));
    Scene scene(*engine);
    ModelCopy copy = *ModelCopy::of(scene, scene.add(model));
    scene.remove(copy.renderables("fine")->front());
    copy.chooseLevels(from(1));
    EXPECT_EQ(copy.levels()[0].shown, std::nullopt) << "what is not there covers nothing";
    for (const Node node : copy.levels()[0].nodes) scene.remove(node);
    copy.chooseLevels(from(1));
    EXPECT_EQ(test::renderLinear(*engine, *renderer, scene, from(1)).pixels, pictureOf({}, from(1)).pixels);
}

TEST_P(ChosenLevels, ChangeNothingWithoutLevels) {
    const Model model = load(squares("", "[ 0, 1, 2 ]"));
    Scene scene(*engine);
    ModelCopy copy = *ModelCopy::of(scene, scene.add(model));
    EXPECT_TRUE(copy.levels().empty());
    const auto before = test::renderLinear(*engine, *renderer, scene, from(2)).pixels;
    copy.chooseLevels(from(2));
    EXPECT_EQ(test::renderLinear(*engine, *renderer, scene, from(2)).pixels, before);
}

TEST(ChosenLevelsDeathTest, NeedABiasAndPixels) {
    const std::string file = squares(kLevels, "[ 0 ]");
    Engine engine = std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }));
    const Model model = std::move(*loadGltf(engine, GltfMemory{ .file = std::as_bytes(std::span(file)) }));
    Scene scene(engine);
    ModelCopy copy = *ModelCopy::of(scene, scene.add(model));
    const View view{ .size = { 4, 4 } };
    for (const float bias : { 0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN() })
        EXPECT_DEATH(copy.chooseLevels(view, bias),
                     "chooseLevels\\(View, float\\): the bias is .*; it must be above 0");
    EXPECT_DEATH(copy.chooseLevels(View{ .size = { 0, 4 } }), "chooseLevels\\(View, float\\): the view has no pixels");
}

TEST(LevelsOfDetail, HaveTheSameBitsOnBothApis) {
    const std::string file = squares(kLevels, "[ 0, 1, 2 ]");
    const std::vector<Image> vulkan = draw(Backend::Vulkan, file), gles = draw(Backend::Gles, file);
    ASSERT_EQ(vulkan.size(), 2u);
    ASSERT_EQ(gles.size(), vulkan.size());
    for (size_t i = 0; i < vulkan.size(); ++i) EXPECT_EQ(vulkan[i].pixels, gles[i].pixels) << "distance " << i;
}

} // namespace
} // namespace filament_core
