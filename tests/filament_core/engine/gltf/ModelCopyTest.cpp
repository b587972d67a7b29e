// SPDX-License-Identifier: Apache-2.0
// What one copy of a model consists of, and what changes of it without changing others.
#include "filament_core/engine/EngineImpl.h"
#include "tests/filament_core/engine/MisuseLine.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/ModelCopy.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace filament_core {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A blue body that is red in variant "race", and a white face of two primitives with morph targets; two lights, two
/// cameras, an animation.
constexpr const char* kCar = R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ],
    "extensionsUsed": [ "KHR_materials_unlit", "KHR_materials_variants", "KHR_lights_punctual" ],
    "extensions": { "KHR_materials_variants": { "variants": [ { "name": "race" } ] },
        "KHR_lights_punctual": { "lights": [ { "type": "point", "name": "lamp", "intensity": 3 },
            { "type": "directional" }, { "type": "spot", "name": "beam" } ] } },
    "nodes": [ { "mesh": 0, "name": "body", "children": [ 1, 2, 3, 4, 5, 6 ] },
        { "mesh": 1, "name": "head", "translation": [ 4, 0, 0 ] },
        { "name": "seat", "camera": 0, "translation": [ 0, 0, 5 ], "scale": [ 2, 2, 2 ] },
        { "name": "ceiling", "camera": 1, "translation": [ 0, 9, 0 ], "rotation": [ -0.70710678, 0, 0, 0.70710678 ] },
        { "name": "socket", "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "name": "sky", "extensions": { "KHR_lights_punctual": { "light": 1 } } },
        { "name": "front", "extensions": { "KHR_lights_punctual": { "light": 2 } } } ],
    "cameras": [ { "name": "driver", "type": "perspective", "perspective": { "yfov": 1, "znear": 0.25, "aspectRatio": 2 } },
        { "type": "orthographic", "orthographic": { "xmag": 3, "ymag": 2, "znear": 1, "zfar": 11 } } ],
    "materials": [
        { "name": "paint", "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 1, 1 ] },
          "extensions": { "KHR_materials_unlit": {} } },
        { "name": "race paint", "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0, 0, 1 ] },
          "extensions": { "KHR_materials_unlit": {} } },
        { "name": "skin", "extensions": { "KHR_materials_unlit": {} } } ],
    "meshes": [
        { "name": "shell", "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0, "extensions": {
            "KHR_materials_variants": { "mappings": [ { "material": 1, "variants": [ 0 ] } ] } } } ] },
        { "name": "face", "weights": [ 0, 0.25 ], "extras": { "targetNames": [ "smile", "blink" ] }, "primitives": [
            { "attributes": { "POSITION": 0 }, "material": 2, "targets": [ { "POSITION": 1 }, { "POSITION": 1 } ] },
            { "attributes": { "POSITION": 0 }, "material": 2, "targets": [ { "POSITION": 1 }, { "POSITION": 1 } ] } ] } ],
    "animations": [ { "name": "drive", "samplers": [ { "input": 2, "output": 3 } ],
        "channels": [ { "sampler": 0, "target": { "node": 0, "path": "translation" } } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 2, "type": "SCALAR" },
        { "bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 2, "type": "VEC3" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 104 } ],
    "buffers": [ { "byteLength": 104, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAA=" } ] })";

const float4 kBlue(0, 0, 1, 1), kRed(1, 0, 0, 1), kGreen(0, 1, 0, 1), kBlack(0, 0, 0, 1), kWhite(1);

template <class Items>
std::vector<std::string> names(Items const& items) {
    std::vector<std::string> found;
    for (auto const& item : items) found.push_back(item.name);
    return found;
}

Result<Model> loadCar(Engine& engine) {
    return loadGltf(engine, GltfMemory{ .file = std::as_bytes(std::span(kCar, std::strlen(kCar))), .name = "car" });
}

class ModelCopyTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        auto loaded = loadCar(*engine);
        ASSERT_TRUE(loaded) << loaded.error().message;
        model.emplace(std::move(*loaded));
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

    ModelCopy copy(Node root) { return ModelCopy::of(*scene, root).value(); }

    /// The colour at a point of the plane z = 0.
    float4 colorAt(double x, double y) {
        const View view{ .camera = Camera::lookAt({ x, y, 0.2 }, { x, y, 0 }, { .verticalFovDegrees = 10 }),
                         .size = { 1, 1 } };
        return test::halfPixel(test::renderLinear(*engine, *scene, view), 0, 0);
    }
    float4 body(double y = 0) { return colorAt(0.25, y + 0.25); }
    /// The face moved by so many metres.
    float4 head(double moved, double y = 0) { return colorAt(4.25 + moved, y + 0.25); }

    std::optional<Engine> engine;
    std::optional<Model> model;
    std::optional<Scene> scene;
    Node first, second;
};

TEST_P(ModelCopyTest, OfNodesOtherThanTheRootOfACopyFails) {
    EXPECT_EQ(copy(first).root(), first);
    const Node other = scene->add(NodeDesc{ .name = "other" });
    for (const Node node : { scene->findNode("body", first), other }) {
        const Result<ModelCopy> none = ModelCopy::of(*scene, node);
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(none.error().message, HasSubstr('\'' + scene->name(node) + "' is not the root of a copy"));
    }
}

TEST_P(ModelCopyTest, ListsNodesOfTheFile) {
    const ModelCopy car = copy(second);
    std::vector<std::string> found;
    for (const Node node : car.nodes()) found.push_back(scene->name(node));
    EXPECT_THAT(found, ElementsAre("body", "head", "seat", "ceiling", "socket", "sky", "front"));
    EXPECT_EQ(car.node("seat").value(), scene->findNode("seat", second));
    EXPECT_EQ(car.node("saet").error().message,
              "car has no node 'saet' among 'body', 'head', 'seat', 'ceiling', 'socket', 'sky', 'front'; did you mean "
              "'seat'?");
}

TEST_P(ModelCopyTest, ListsRenderablesByMeshAndByNode) {
    const ModelCopy car = copy(first);
    const std::vector<CopyRenderable> all = car.renderables();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].mesh, "shell");
    EXPECT_EQ(all[0].material, "paint");
    EXPECT_EQ(all[0].node, car.node("body").value());
    EXPECT_THAT(all[0].morphTargets, IsEmpty());
    EXPECT_THAT(all[2].morphTargets, ElementsAre("smile", "blink"));
    for (CopyRenderable const& each : all) EXPECT_EQ(scene->node(each.renderable), each.node);
    EXPECT_THAT(car.renderables("face").value(), ElementsAre(all[1].renderable, all[2].renderable));
    EXPECT_THAT(car.renderables("head").value(), ElementsAre(all[1].renderable, all[2].renderable));
    EXPECT_THAT(car.renderables("faces").error().message, HasSubstr("did you mean 'face'?"));
}

TEST_P(ModelCopyTest, ListsLights) {
    const ModelCopy car = copy(first);
    const std::vector<CopyLight> lights = car.lights();
    EXPECT_THAT(names(lights), ElementsAre("lamp", "sky", "beam"));
    EXPECT_EQ(lights[0].kind, LightKind::Point);
    EXPECT_EQ(lights[1].kind, LightKind::Sun);
    EXPECT_EQ(lights[2].kind, LightKind::Spot);
    EXPECT_EQ(car.light("beam").value(), lights[2].light);
    EXPECT_EQ(scene->node(lights[0].light), car.node("socket").value());
    EXPECT_THAT(car.light("Lamp2").error().message, HasSubstr("car has no light 'Lamp2' among 'lamp', 'sky', 'beam'"));
}

TEST_P(ModelCopyTest, CamerasStandWhereTheirNodesStandWithoutScale) {
    const ModelCopy car = copy(second);
    EXPECT_THAT(names(car.cameras()), ElementsAre("driver", "ceiling"));
    const Camera driver = car.camera("driver").value();
    EXPECT_EQ(driver.position(), double3(0, 5, 5));
    EXPECT_EQ(driver.worldFromView, Camera::lookAt({ 0, 5, 5 }, { 0, 5, 0 }).worldFromView);
    EXPECT_NEAR(driver.lens.verticalFovDegrees, 57.29578f, 1e-5f);
    EXPECT_EQ(driver.lens.nearMeters, 0.25f);
    EXPECT_EQ(driver.lens.aspect, 2);
    EXPECT_FALSE(driver.lens.isOrthographic());
    const Camera plan = car.camera("ceiling").value();
    EXPECT_EQ(plan.lens.orthographicHeight, 4);
    EXPECT_EQ(plan.lens.aspect, 1.5f);
    EXPECT_EQ(plan.lens.nearMeters, 1);
    EXPECT_EQ(plan.lens.farMeters, 11);
    EXPECT_NEAR(plan.worldFromView[2].y, 1, 1e-7) << "it looks down";
    EXPECT_THAT(car.camera("drivers").error().message, HasSubstr("did you mean 'driver'?"));
    scene->setTransform(second, double4x4(1.0));
    EXPECT_EQ(car.camera("driver").value().position(), double3(0, 0, 5)) << "where the node is now";
}

TEST_P(ModelCopyTest, AMaterialOfOneCopyChangesAloneAndKeepsTheOthers) {
    ModelCopy car = copy(first);
    EXPECT_THAT(names(car.materials()), ElementsAre("paint", "skin"));
    EXPECT_FALSE(car.materials()[0].isOwn);
    EXPECT_EQ(car.materials()[1].renderables, 2u);
    ASSERT_TRUE(car.set("paint", "baseColorFactor", kGreen));
    EXPECT_EQ(body(), kGreen);
    EXPECT_EQ(body(5), kBlue) << "the other copy";
    const std::vector<CopyMaterial> own = car.materials();
    EXPECT_THAT(names(own), ElementsAre("paint", "skin"));
    EXPECT_TRUE(own[0].isOwn);
    EXPECT_EQ(car.ownMaterials("paint").value(), std::vector{ own[0].instance }) << "made once";
    EXPECT_EQ(copy(second).materials()[0].material, own[0].material);
    EXPECT_EQ(copy(second).materials()[0].instance == own[0].instance, false);
    EXPECT_EQ(body(), kGreen);
    scene->add(*model, double4x4(1.0)); // a later copy is as the file says
    EXPECT_EQ(ModelCopy::of(*scene, second).value().materials()[0].isOwn, false);
}

TEST_P(ModelCopyTest, VariantsShowTheMaterialsOfTheCopy) {
    ModelCopy car = copy(first);
    EXPECT_THAT(car.variants(), ElementsAre("race"));
    EXPECT_EQ(car.variant(), "");
    ASSERT_TRUE(car.set("race paint", "baseColorFactor", kGreen));
    EXPECT_EQ(body(), kBlue) << "not shown yet";
    ASSERT_TRUE(car.setVariant("race"));
    EXPECT_EQ(car.variant(), "race");
    EXPECT_EQ(body(), kGreen);
    ASSERT_TRUE(copy(second).setVariant("race"));
    EXPECT_EQ(body(5), kRed);
    ASSERT_TRUE(car.setVariant(""));
    EXPECT_EQ(body(), kBlue);
    EXPECT_THAT(car.setVariant("rase").error().message, HasSubstr("did you mean 'race'?"));
    EXPECT_EQ(car.variant(), "");
}

TEST_P(ModelCopyTest, UnknownMaterialsAndParametersAreNamed) {
    ModelCopy car = copy(first);
    EXPECT_EQ(car.set("pain", "baseColorFactor", kGreen).error().message,
              "car has no material 'pain' among 'paint', 'skin', 'race paint'; did you mean 'paint'?");
    const Result<void> wrong = car.set("paint", "baseColourFactor", kGreen);
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message, HasSubstr("'baseColorFactor'"));
    EXPECT_EQ(car.set("paint", "baseColorFactor", ParameterValue(true)).error().code, ErrorCode::InvalidArgument);
}

TEST_P(ModelCopyTest, MorphTargetsHaveNamesAndChangeInOneCopy) {
    ModelCopy car = copy(first);
    const std::vector<CopyMorphTarget> targets = car.morphTargets();
    EXPECT_THAT(names(targets), ElementsAre("smile", "blink", "smile", "blink"));
    EXPECT_EQ(targets[1].weight, 0.25f);
    EXPECT_EQ(targets[3].target, 1u);
    ASSERT_TRUE(car.setMorphWeight("smile", 2));
    EXPECT_EQ(head(2.25), kWhite) << "the weight of the other target stays";
    EXPECT_EQ(head(0.25), kBlack);
    EXPECT_EQ(head(0.25, 5), kWhite) << "the other copy";
    EXPECT_EQ(car.morphTargets()[2].weight, 2);
    EXPECT_EQ(car.setMorphWeight("smle", 1).error().message,
              "car has no morph target 'smle' among 'smile', 'blink'; did you mean 'smile'?");
}

TEST_P(ModelCopyTest, AnimationsAreThoseOfTheModel) { EXPECT_THAT(copy(first).animations(), ElementsAre("drive")); }

TEST_P(ModelCopyTest, WhatWasRemovedIsLeftOut) {
    ModelCopy car = copy(first);
    scene->remove(scene->findNode("head", first));
    EXPECT_EQ(car.nodes().size(), 6u);
    EXPECT_EQ(car.renderables().size(), 1u);
    EXPECT_THAT(car.morphTargets(), IsEmpty());
    scene->remove(car.light("lamp").value());
    EXPECT_THAT(names(car.lights()), ElementsAre("sky", "beam"));
    scene->remove(car.renderables("shell").value()[0]);
    EXPECT_THAT(car.materials(), IsEmpty());
    EXPECT_TRUE(car.set("paint", "baseColorFactor", kGreen)) << "nothing shows it, but a variant could";
    EXPECT_THAT(car.setMorphWeight("smile", 1).error().message, HasSubstr("car has no morph target 'smile'"));
}

/// Instances that the program can see, with those of the engine.
size_t instancesOf(Engine& engine) {
    size_t count = 0;
    engine.impl().instances.forEach([&](auto const&) { ++count; });
    return count;
}

TEST_P(ModelCopyTest, MaterialsOfACopyEndWithIt) {
    const size_t before = instancesOf(*engine);
    ASSERT_TRUE(copy(first).set("paint", "baseColorFactor", kGreen));
    ASSERT_TRUE(copy(second).ownMaterials("skin"));
    EXPECT_EQ(instancesOf(*engine), before + 2);
    scene->remove(first);
    EXPECT_EQ(instancesOf(*engine), before + 1);
    scene.reset();
    EXPECT_EQ(instancesOf(*engine), before);
}

TEST_P(ModelCopyTest, FollowsASceneThatIsMoved) {
    ModelCopy car = copy(first);
    Scene moved(std::move(*scene));
    ASSERT_TRUE(car.set("paint", "baseColorFactor", kGreen));
    scene.emplace(std::move(moved));
    EXPECT_EQ(body(), kGreen);
}

INSTANTIATE_TEST_SUITE_P(BothApis, ModelCopyTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

// ---------------------------------------------------------------------------------------------- misuse

struct FunctionOfACopy {
    const char* line; ///< of the message, before the colon
    std::function<void(ModelCopy& car)> run;
};

std::vector<FunctionOfACopy> functionsOfACopy() {
    return {
        { "ModelCopy::nodes()", [](ModelCopy& car) { (void)car.nodes(); } },
        { "ModelCopy::node(string_view) of 'body'", [](ModelCopy& car) { (void)car.node("body"); } },
        { "ModelCopy::renderables()", [](ModelCopy& car) { (void)car.renderables(); } },
        { "ModelCopy::renderables(string_view) of 'face'", [](ModelCopy& car) { (void)car.renderables("face"); } },
        { "ModelCopy::materials()", [](ModelCopy& car) { (void)car.materials(); } },
        { "ModelCopy::ownMaterials(string_view) of 'paint'", [](ModelCopy& car) { (void)car.ownMaterials("paint"); } },
        { "ModelCopy::set(string_view, string_view, ParameterValue) of 'baseColorFactor'",
          [](ModelCopy& car) { (void)car.set("paint", "baseColorFactor", kGreen); } },
        { "ModelCopy::set(string_view, string_view, Texture, Sampler) of 'baseColorMap'",
          [](ModelCopy& car) { (void)car.set("paint", "baseColorMap", Texture{}); } },
        { "ModelCopy::lights()", [](ModelCopy& car) { (void)car.lights(); } },
        { "ModelCopy::light(string_view) of 'lamp'", [](ModelCopy& car) { (void)car.light("lamp"); } },
        { "ModelCopy::cameras()", [](ModelCopy& car) { (void)car.cameras(); } },
        { "ModelCopy::camera(string_view) of 'driver'", [](ModelCopy& car) { (void)car.camera("driver"); } },
        { "ModelCopy::morphTargets()", [](ModelCopy& car) { (void)car.morphTargets(); } },
        { "ModelCopy::setMorphWeight(string_view, float) of 'smile'",
          [](ModelCopy& car) { (void)car.setMorphWeight("smile", 1); } },
        { "ModelCopy::animations()", [](ModelCopy& car) { (void)car.animations(); } },
        { "ModelCopy::variants()", [](ModelCopy& car) { (void)car.variants(); } },
        { "ModelCopy::variant()", [](ModelCopy& car) { (void)car.variant(); } },
        { "ModelCopy::setVariant(string_view) of 'race'", [](ModelCopy& car) { (void)car.setVariant("race"); } },
    };
}

class ModelCopyDeathTest : public testing::TestWithParam<FunctionOfACopy> {
protected:
    ModelCopyDeathTest()
            : engine(std::move(*Engine::create({ .backend = Backend::Null, .workers = 0 }))),
              model(loadCar(engine).value()), scene(engine), root(scene->add(model)),
              car(ModelCopy::of(*scene, root).value()) {}

    std::string lineThatSays(const char* what) const {
        return test::misuseLine(fmt::format("{}: {}", GetParam().line, what));
    }

    Engine engine;
    Model model;
    std::optional<Scene> scene;
    Node root;
    ModelCopy car;
};

TEST_P(ModelCopyDeathTest, OfACopyThatWasRemoved) {
    scene->remove(root);
    EXPECT_DEATH(GetParam().run(car), lineThatSays("the copy of the model was removed from its scene"));
    for (int i = 0; i < 16; ++i) scene->add(NodeDesc{ .name = "in its place" });
    EXPECT_DEATH(GetParam().run(car), lineThatSays("the copy of the model was removed from its scene"));
}

TEST_P(ModelCopyDeathTest, OfASceneThatIsGone) {
    scene.reset();
    EXPECT_DEATH(GetParam().run(car), lineThatSays("its scene is gone"));
}

TEST_P(ModelCopyDeathTest, OnAnotherThread) {
    EXPECT_DEATH(std::thread([&] { GetParam().run(car); }).join(),
                 lineThatSays("called on another thread than the engine's, which is the one that created it, or that "
                              "called Engine::useOnThisThread() last"));
}

INSTANTIATE_TEST_SUITE_P(Functions, ModelCopyDeathTest, testing::ValuesIn(functionsOfACopy()));

// ---------------------------------------------------------------------------------------------- foreign models

using ModelCopyAssets = test::AssetTest;

void expectKnown(Scene& scene, Model const& model, ModelCopy car) {
    EXPECT_EQ(car.renderables().size(), model.renderableCount());
    for (const Node node : car.nodes()) EXPECT_EQ(scene.name(car.node(scene.name(node)).value()), scene.name(node));
    size_t shown = 0;
    for (CopyMaterial const& material : car.materials()) {
        shown += material.renderables;
        EXPECT_TRUE(material.instance && material.material);
    }
    EXPECT_EQ(shown, model.renderableCount());
    for (CopyRenderable const& each : car.renderables()) {
        const std::vector<Renderable> named = car.renderables(each.mesh).value();
        EXPECT_EQ(std::ranges::count(named, each.renderable), 1);
        EXPECT_EQ(scene.findNode(scene.name(each.node), car.root()) ? 1 : 0, 1);
    }
    for (CopyLight const& light : car.lights()) EXPECT_EQ(scene.node(light.light), light.node);
    for (CopyCamera const& camera : car.cameras()) EXPECT_TRUE(car.camera(camera.name));
    EXPECT_EQ(car.animations().size(), model.animationCount());
    EXPECT_EQ(car.variants(), model.variantNames());
    for (CopyMorphTarget const& target : car.morphTargets()) EXPECT_TRUE(car.setMorphWeight(target.name, 0.5f));
    for (CopyMorphTarget const& target : car.morphTargets()) EXPECT_EQ(target.weight, 0.5f);
    const std::set<std::string> materials = [&] {
        const std::vector<std::string> all = names(car.materials());
        return std::set<std::string>(all.begin(), all.end());
    }();
    for (std::string const& material : materials) {
        const Result<std::vector<MaterialInstance>> own = car.ownMaterials(material);
        ASSERT_TRUE(own) << own.error().message;
        EXPECT_FALSE(own->empty());
    }
    for (CopyMaterial const& material : car.materials()) EXPECT_TRUE(material.isOwn);
}

TEST_F(ModelCopyAssets, EveryAssetIsListedAndACopyOwnsItsMaterialsOnlyAfterAChange) {
    std::optional<Engine> engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    size_t models = 0, withCameras = 0, withTargets = 0, withLights = 0;
    for (auto const& file : std::filesystem::recursive_directory_iterator(tools::assetDir() / "models")) {
        if (file.path().extension() != ".gltf" && file.path().extension() != ".glb") continue;
        SCOPED_TRACE(file.path().filename());
        Result<Model> model = loadGltf(*engine, file.path());
        ASSERT_TRUE(model) << model.error().message;
        Scene scene(*engine);
        const Node one = scene.add(*model), other = scene.add(*model);
        expectKnown(scene, *model, ModelCopy::of(scene, one).value());
        const ModelCopy untouched = ModelCopy::of(scene, other).value();
        for (CopyMaterial const& material : untouched.materials()) EXPECT_FALSE(material.isOwn);
        ++models;
        withCameras += !untouched.cameras().empty();
        withTargets += !untouched.morphTargets().empty();
        withLights += !untouched.lights().empty();
    }
    EXPECT_GT(models, 30u);
    EXPECT_GE(withCameras, 1u);
    EXPECT_GE(withTargets, 2u);
    EXPECT_GE(withLights, 2u);
}

TEST_F(ModelCopyAssets, AMapOfOneCopyIsReplaced) {
    std::optional<Engine> engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    const Result<Model> model = loadGltf(*engine, tools::assetDir() / "models/Fox/Fox.glb");
    ASSERT_TRUE(model);
    const std::array<std::byte, 4> texel{};
    const Owned<Texture> black = engine->own(engine->create(TextureDesc{ .pixels = texel }));
    Scene scene(*engine);
    ModelCopy fox = ModelCopy::of(scene, scene.add(*model)).value();
    const std::string name = fox.materials().at(0).name;
    const MaterialInstance shared = fox.materials().at(0).instance;
    const auto mapOf = [&](MaterialInstance instance) {
        return engine->impl().instances.get(instance).textures.at(0).texture;
    };
    const auto before = mapOf(shared);
    ASSERT_TRUE(fox.set(name, "baseColorMap", black));
    EXPECT_EQ(mapOf(fox.materials().at(0).instance), engine->impl().textures.get(black).handle);
    EXPECT_EQ(mapOf(shared), before) << "other copies keep theirs";
    const Result<void> unknown = fox.set(name, "baseColourMap", black);
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().message, HasSubstr("'baseColorMap'"));
    EXPECT_EQ(fox.set("hound", "baseColorMap", black).error().code, ErrorCode::NotFound);
}

TEST_F(ModelCopyAssets, MorphStressTestNamesItsTargets) {
    std::optional<Engine> engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Result<Model> model = loadGltf(*engine, tools::assetDir() / "models/MorphStressTest/MorphStressTest.glb");
    ASSERT_TRUE(model);
    Scene scene(*engine);
    ModelCopy copy = ModelCopy::of(scene, scene.add(*model)).value();
    const std::vector<CopyMorphTarget> targets = copy.morphTargets();
    ASSERT_FALSE(targets.empty());
    EXPECT_EQ(std::ranges::count(targets, "", &CopyMorphTarget::name), 0);
    ASSERT_TRUE(copy.setMorphWeight(targets[3].name, 0.75f));
    EXPECT_EQ(copy.morphTargets()[3].weight, 0.75f);
}

} // namespace
} // namespace filament_core
