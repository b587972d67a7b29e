// SPDX-License-Identifier: Apache-2.0
// Scenes as glTF files: what is saved and loaded again has the same bits, and what glTF does not have is a warning.
#include "tests/filament_core/assets/gltf/GltfSpecimens.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/ModelCopy.h>
#include <filament_core/SaveGltf.h>

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>

namespace filament_core {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// Draws scenes on one API, and files that were made of them.
class SavedGltfTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        fs::remove_all(test::folderOfThisTest()); // of the last run
        folder = test::folderOfThisTest();
    }
    void TearDown() override {
        if (engine) test::expectNoErrors(*engine);
    }

    Image draw(Scene const& scene, Camera const& camera) {
        const View view{ .camera = camera, .size = { 80, 60 } };
        return test::renderLinear(*engine, scene, view);
    }
    /// In front of the model, with all of it in view.
    static Camera cameraFor(Box const& bounds) {
        const double3 at = bounds.center();
        const double size = std::max(0.5 * glm::distance(bounds.min, bounds.max), 1e-3);
        return Camera::lookAt(at + double3(0.9, 0.7, 2.4) * size, at, { .verticalFovDegrees = 45 });
    }
    void addLight(Scene& scene) {
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
    }
    SavedGltf save(Scene const& scene, fs::path const& file, GltfSaveOptions const& options = {}) {
        auto saved = saveGltf(scene, file, options);
        if (saved) return std::move(*saved);
        ADD_FAILURE() << saved.error().message;
        return {};
    }
    /// The picture of a saved file, which has its own lights.
    std::optional<Image> drawFile(fs::path const& file, Camera const& camera, GltfLoadOptions const& options = {}) {
        auto model = loadGltf(*engine, file, options);
        if (!model) {
            ADD_FAILURE() << model.error().message;
            return std::nullopt;
        }
        EXPECT_THAT(model->warnings(), IsEmpty());
        Scene scene(*engine);
        scene.add(*model);
        return draw(scene, camera);
    }

    std::optional<Engine> engine;
    fs::path folder;
};

class SaveModels : public SavedGltfTest {
protected:
    void SetUp() override {
        if (tools::assetDir().empty()) GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set";
        SavedGltfTest::SetUp();
    }
};
INSTANTIATE_TEST_SUITE_P(Apis, SaveModels, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return toString(test.param); });

/// With and without lights of their own, skins, morph targets, instances, compressed meshes, and extensions.
TEST_P(SaveModels, OfFilesHaveTheSameBits) {
    for (const char* const file :
         { "BoxAnimated/BoxAnimated.glb", "Box-Draco/Box.gltf", "BoxMeshopt/BoxMeshopt.glb",
           "AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf", "RiggedFigure/RiggedFigure.glb",
           "SimpleInstancing/SimpleInstancing.glb", "LightsPunctualLamp/LightsPunctualLamp.gltf" }) {
        SCOPED_TRACE(file);
        const fs::path source = tools::assetDir() / "models" / file;
        if (!fs::exists(source)) continue;
        const auto model = loadGltf(*engine, source);
        ASSERT_TRUE(model) << model.error().message;
        Scene scene(*engine);
        const Node root = scene.add(*model);
        const Camera camera = cameraFor(model->bounds());
        const Image before = draw(scene, camera);
        const fs::path saved = folder / fs::path(file).filename();
        EXPECT_THAT(save(scene, saved).warnings, IsEmpty());
        const std::optional<Image> after = drawFile(saved, camera);
        ASSERT_TRUE(after);
        EXPECT_EQ(test::differingPixels(before, *after), 0u);
        EXPECT_EQ(model->animationCount(), loadGltf(*engine, saved)->animationCount());
        scene.remove(root);
    }
}

TEST_P(SaveModels, ChangesOfInstancesAndMorphTargetsAreWritten) {
    const auto boxes = loadGltf(*engine, tools::assetDir() / "models/SimpleInstancing/SimpleInstancing.glb");
    const auto cube = loadGltf(*engine, tools::assetDir() / "models/AnimatedMorphCube/AnimatedMorphCube.glb");
    ASSERT_TRUE(boxes && cube);
    Scene scene(*engine);
    ModelCopy some = *ModelCopy::of(scene, scene.add(*boxes));
    const std::vector<CopyRenderable> all = some.renderables();
    ASSERT_EQ(all.size(), 125u);
    double4x4 moved = scene.parentFromNode(all[7].node);
    moved[3].y += 3.25;
    scene.setTransform(all[7].node, moved);
    scene.remove(all[60].node);
    scene.setVisible(all[100].renderable, false);
    ModelCopy morphed = *ModelCopy::of(scene, scene.add(*cube));
    ASSERT_FALSE(morphed.morphTargets().empty());
    ASSERT_TRUE(morphed.setMorphWeight(morphed.morphTargets()[0].name, 0.75f));
    const Camera camera = cameraFor(scene.bounds());
    const Image before = draw(scene, camera);
    EXPECT_THAT(save(scene, folder / "changed.glb").warnings, IsEmpty());
    const std::optional<Image> after = drawFile(folder / "changed.glb", camera);
    ASSERT_TRUE(after);
    EXPECT_EQ(test::differingPixels(before, *after), 0u);
}

TEST_P(SaveModels, AnotherImageOfAMapIsWritten) {
    const auto model = loadGltf(*engine, tools::assetDir() / "models/TextureCoordinateTest/TextureCoordinateTest.glb");
    ASSERT_TRUE(model) << model.error().message;
    Scene scene(*engine);
    ModelCopy copy = *ModelCopy::of(scene, scene.add(*model));
    const std::array<uint8_t, 16> texels{ 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255 };
    const auto texture = engine->own(engine->create(TextureDesc{
            .format = Format::RGBA8Srgb, .width = 2, .height = 2, .pixels = std::as_bytes(std::span(texels)) }));
    size_t changed = 0;
    for (CopyMaterial const& material : copy.materials())
        changed += copy.set(material.name, "baseColorMap", texture,
                            { .magFilter = Filter::Nearest, .mipFilter = MipFilter::None })
                           .ok();
    EXPECT_GT(changed, 0u);
    scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 60'000 } }); // no rotation rounds
    const Camera camera = cameraFor(scene.bounds());
    const Image before = draw(scene, camera);
    EXPECT_THAT(save(scene, folder / "image.glb").warnings, IsEmpty());
    const std::optional<Image> after = drawFile(folder / "image.glb", camera);
    ASSERT_TRUE(after);
    EXPECT_EQ(test::differingPixels(before, *after), 0u);
    EXPECT_GT(test::extremesOf(before).most, 0.1f);
}

TEST_P(SaveModels, DifferentModelsShareAFile) {
    Scene scene(*engine);
    std::vector<Model> models;
    double x = 0;
    for (const char* const file : { "BoxAnimated/BoxAnimated.glb", "AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf",
                                    "BoxMeshopt/BoxMeshopt.glb", "BoxAnimated/BoxAnimated.glb" }) {
        auto model = loadGltf(*engine, tools::assetDir() / "models" / file);
        ASSERT_TRUE(model) << model.error().message;
        double4x4 place = fitToUnitCube(model->bounds());
        place[3].x += x++;
        scene.add(*model, place);
        models.push_back(std::move(*model));
    }
    addLight(scene);
    scene.add(models.back(), double4x4(1.0)); // a second copy
    const Camera camera = cameraFor(scene.bounds());
    const Image before = draw(scene, camera);
    EXPECT_THAT(save(scene, folder / "all.glb").warnings, IsEmpty());
    const std::optional<Image> after = drawFile(folder / "all.glb", camera);
    ASSERT_TRUE(after);
    EXPECT_LE(test::differingPixels(before, *after), 2u) << "the direction of the sun is a rotation in the file";
    const auto loaded = loadGltf(*engine, folder / "all.glb");
    EXPECT_EQ(loaded->animationCount(), 3u) << "copies play together";
}

/// Two triangles of one mesh, of two materials, and a lamp; a second node with the same mesh.
constexpr const char* kPair = R"({ "asset": { "version": "2.0", "copyright": "A. Author" }, "scene": 0,
    "scenes": [ { "nodes": [ 0, 1, 2 ] } ], "extensionsUsed": [ "KHR_materials_unlit", "KHR_lights_punctual" ],
    "extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point", "name": "lamp", "intensity": 3 } ] } },
    "nodes": [ { "mesh": 0, "name": "first" }, { "mesh": 0, "name": "second", "translation": [ 3, 0, 0 ] },
        { "name": "socket", "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [ 0, 0, 1 ] } ],
    "materials": [ { "name": "paint", "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 1, 1 ] },
                     "extensions": { "KHR_materials_unlit": {} } },
                   { "name": "steel", "pbrMetallicRoughness": { "roughnessFactor": 0.5 } } ],
    "meshes": [ { "name": "pair", "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 },
                                                 { "attributes": { "POSITION": 1 }, "material": 1 } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] },
                   { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [ -1, -1, 0 ], "max": [ 0, 0, 0 ] } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 36 } ],
    "buffers": [ { "byteLength": 72, "uri": "data:application/octet-stream;base64,)"
                              "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
                              "AAAAAAAAAAAAAAAAAACAvwAAAAAAAAAAAAAAAAAAgL8AAAAA\" } ] }";

class SaveEdits : public SavedGltfTest {
protected:
    void SetUp() override {
        SavedGltfTest::SetUp();
        std::ofstream(folder / "pair.gltf") << kPair;
        auto loaded = loadGltf(*engine, folder / "pair.gltf");
        ASSERT_TRUE(loaded) << loaded.error().message;
        model.emplace(std::move(*loaded));
        scene.emplace(*engine);
    }
    void TearDown() override {
        scene.reset();
        model.reset();
        SavedGltfTest::TearDown();
    }
    /// The scene and its file look the same.
    std::string expectSame(fs::path const& file, bool isWarned = false) {
        const Camera camera = Camera::lookAt({ 1.5, 0.5, 9 }, { 1.5, 0, 0 }, { .verticalFovDegrees = 60 });
        const Image before = draw(*scene, camera);
        const SavedGltf saved = save(*scene, folder / file);
        EXPECT_EQ(saved.warnings.empty(), !isWarned) << testing::PrintToString(saved.warnings);
        const std::optional<Image> after = drawFile(folder / file, camera);
        if (after) {
            EXPECT_EQ(test::differingPixels(before, *after), 0u);
        }
        std::ifstream in(folder / file);
        return { std::istreambuf_iterator<char>(in), {} };
    }

    std::optional<Model> model;
    std::optional<Scene> scene;
};
INSTANTIATE_TEST_SUITE_P(Apis, SaveEdits, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return toString(test.param); });

TEST_P(SaveEdits, CopiesHaveTheirPlacesMaterialsAndLights) {
    scene->add(*model);
    double4x4 above(1.0);
    above[3] = { 0, 2, 0, 1 };
    ModelCopy copy = *ModelCopy::of(*scene, scene->add(*model, above));
    ASSERT_TRUE(copy.set("paint", "baseColorFactor", float4(1, 0.5f, 0, 1)));
    ASSERT_TRUE(copy.set("steel", "metallicFactor", 0.25f));
    ASSERT_TRUE(copy.set("steel", "emissiveFactor", float3(0.1f, 0, 4)));
    double4x4 turned = glm::rotate(double4x4(1.0), 0.5, double3(0, 0, 1));
    turned[3] = { 3, 0, -1, 1 };
    scene->setTransform(*copy.node("second"), turned);
    scene->set(*copy.light("lamp"), PointLight{ .intensity = Candela{ 20 }, .color = { 1, 0.5f, 0.25f } });
    const std::string json = expectSame("copies.gltf");
    EXPECT_THAT(json, HasSubstr("A. Author"));
}

TEST_P(SaveEdits, WhatIsHiddenOrRemovedIsNotShown) {
    ModelCopy copy = *ModelCopy::of(*scene, scene->add(*model));
    const std::vector<CopyRenderable> all = copy.renderables();
    ASSERT_EQ(all.size(), 4u);
    scene->setVisible(all[0].renderable, false);
    scene->remove(all[3].renderable);
    expectSame("hidden.gltf");
    scene->remove(*copy.node("second"));
    expectSame("removed.gltf");
    scene->remove(*copy.light("lamp"));
    scene->setVisible(copy.root(), false);
    expectSame("all-hidden.gltf");
}

TEST_P(SaveEdits, NodesKeepMillimetresFarFromTheOrigin) {
    double4x4 far(1.0);
    far[3] = { 6'378'137.001, -0.0001, 1e7 / 3, 1 };
    const Node above = scene->add(NodeDesc{ .parentFromNode = far, .name = "far" });
    scene->setParent(scene->add(*model), above, Reparent::KeepLocal);
    ASSERT_THAT(save(*scene, folder / "far.glb").warnings, IsEmpty());
    const auto loaded = loadGltf(*engine, folder / "far.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    Scene again(*engine);
    again.add(*loaded);
    EXPECT_EQ(again.worldFromNode(again.findNode("second")), scene->worldFromNode(scene->findNode("second")));
    // and a file of a file is no deeper
    ASSERT_THAT(save(again, folder / "again.glb").warnings, IsEmpty());
    EXPECT_EQ(fs::file_size(folder / "again.glb"), fs::file_size(folder / "far.glb"));
}

TEST_P(SaveEdits, MeshesOfTheProgramAreReadBack) {
    const auto lit = engine->own(*createBuiltInMaterial(*engine, "lit"));
    const auto textured = engine->own(*createBuiltInMaterial(*engine, "unlitTextured"));
    const auto paint = engine->own(engine->createInstance(lit, "paint"));
    const auto picture = engine->own(engine->createInstance(textured, "picture"));
    ASSERT_TRUE(engine->set(paint, "baseColor", float3(0.8f, 0.3f, 0.1f)));
    ASSERT_TRUE(engine->set(paint, "roughness", 0.25f));
    ASSERT_TRUE(engine->set(paint, "reflectance", 0.75f));
    const std::array<uint8_t, 16> texels{ 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255 };
    const auto texture = engine->own(engine->create(TextureDesc{
            .format = Format::RGBA8Srgb, .width = 2, .height = 2, .pixels = std::as_bytes(std::span(texels)) }));
    ASSERT_TRUE(engine->set(picture, "baseColorMap", texture, Sampler{ .magFilter = Filter::Nearest }));
    const Mesh ball = *makeUvSphere(), box = *makeBox();
    const auto add = [&](Mesh const& mesh, MaterialInstance material, double x) {
        double4x4 place(1.0);
        place[3].x = x;
        const auto vertices = engine->own(engine->create(mesh.vertexBuffer()));
        const auto indices = engine->own(engine->create(mesh.indexBuffer()));
        scene->add(RenderableDesc{
                .vertices = vertices, .indices = indices, .material = material, .worldFromObject = place });
    };
    add(ball, paint, 0);
    add(box, picture, 1.5);
    scene->add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 5 } });
    scene->add(SpotLight{ .positionWorld = { 0, 3, 1 }, .directionWorld = { 0, -3, -1 }, .intensity = Candela{ 30 } });
    const Camera camera = Camera::lookAt({ 0.75, 1, 4 }, { 0.75, 0, 0 }, { .verticalFovDegrees = 45 });
    const Image before = draw(*scene, camera);
    EXPECT_THAT(save(*scene, folder / "own.glb").warnings, IsEmpty());
    const std::optional<Image> after = drawFile(folder / "own.glb", camera);
    ASSERT_TRUE(after);
    EXPECT_EQ(test::differingPixels(before, *after), 0u);
    EXPECT_GT(test::extremesOf(before).most, 0.5f);
}

TEST_P(SaveEdits, VertexStreamsAreReadBackAsOne) {
    const Owned<Material> lit = engine->own(*createBuiltInMaterial(*engine, "lit"));
    const auto paint = engine->own(engine->createInstance(lit, "paint"));
    const Mesh box = *makeBox();
    const auto indices = engine->own(engine->create(box.indexBuffer()));
    const auto bytesOf = [&](VertexBufferDesc const& desc) {
        Scene one(*engine);
        const auto vertices = engine->own(engine->create(desc));
        one.add(RenderableDesc{ .vertices = vertices, .indices = indices, .material = paint });
        EXPECT_THAT(save(one, folder / "box.glb").warnings, IsEmpty());
        std::ifstream in(folder / "box.glb", std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    VertexBufferDesc desc = box.vertexBuffer();
    const std::string whole = bytesOf(desc);
    std::vector<std::byte> positions;
    const auto position = std::ranges::find(desc.attributes, Attribute::Position, &AttributeDesc::attribute);
    ASSERT_NE(position, desc.attributes.end());
    for (size_t i = 0; i < desc.vertexCount; ++i) {
        const auto from = desc.data.subspan(i * desc.stride + position->offset, sizeof(float3));
        positions.insert(positions.end(), from.begin(), from.end());
    }
    desc.attributes.erase(position);
    desc.streams.push_back({ sizeof(float3), { { Attribute::Position, VertexFormat::Float3 } }, positions });
    EXPECT_EQ(bytesOf(desc), whole);
}

TEST_P(SaveEdits, WhatGltfDoesNotHaveIsAWarning) {
    const Node copy = scene->add(*model);
    scene->setLayers(copy, kAllLayers, 2);
    const std::array<uint8_t, 4> white{ 255, 255, 255, 255 };
    const auto image = engine->own(*engine->create(LightImageDesc{ .width = 1,
                                                                   .height = 1,
                                                                   .format = Format::RGBA8,
                                                                   .pixels = std::as_bytes(std::span(white)),
                                                                   .shape = LightImageShape::Emitted }));
    scene->add(RectLight{ .image = image });
    const SavedGltf saved = save(*scene, folder / "warned.gltf");
    EXPECT_THAT(saved.warnings, Contains(HasSubstr("4 layers of renderables are not written")));
    EXPECT_EQ(saved.warnings.size(), 1u) << testing::PrintToString(saved.warnings);
    EXPECT_TRUE(loadGltf(*engine, folder / "warned.gltf").ok());
}

TEST_P(SaveEdits, ErrorsNameTheCureAndLeaveNoFile) {
    scene->add(*model);
    const auto errorOf = [&](Scene const& of, fs::path const& file) {
        const Result<SavedGltf> saved = saveGltf(of, file);
        return saved ? std::string() : saved.error().message;
    };
    EXPECT_THAT(errorOf(*scene, folder / "scene.obj"), HasSubstr("give the file the ending .glb or .gltf"));
    std::ofstream(folder / "in-the-way") << "a file, no folder";
    EXPECT_THAT(errorOf(*scene, folder / "in-the-way" / "scene.glb"), HasSubstr("in-the-way"));

    Scene ofMemory(*engine);
    const std::span<const char> text(kPair, std::strlen(kPair));
    const GltfMemory memory{ .file = std::as_bytes(text), .name = "downloaded" };
    const auto downloaded = loadGltf(*engine, memory);
    ASSERT_TRUE(downloaded);
    ofMemory.add(*downloaded);
    EXPECT_THAT(errorOf(ofMemory, folder / "memory.glb"), HasSubstr("model 'downloaded' was loaded from memory"));
    EXPECT_FALSE(fs::exists(folder / "memory.glb"));
    EXPECT_TRUE(
            saveGltf(ofMemory, folder / "memory.glb", { .source = [&](std::string_view) { return Result(memory); } })
                    .ok());

    std::ofstream(folder / "pair.gltf", std::ios::app) << "\n";
    EXPECT_THAT(errorOf(*scene, folder / "late.glb"), HasSubstr("changed since it was loaded; load it again"));
    fs::remove(folder / "pair.gltf");
    EXPECT_THAT(errorOf(*scene, folder / "late.glb"), HasSubstr("pair.gltf"));
    EXPECT_FALSE(fs::exists(folder / "late.glb"));
}

/// Whether the file can be loaded; then it is saved, and loaded again.
bool saveAgain(Engine& engine, std::span<const std::byte> file, fs::path const& saved, bool isWhole) {
    const GltfMemory memory{ .file = file, .name = "specimen" };
    const Result<Model> model = loadGltf(engine, memory);
    if (!model) return false;
    Scene scene(engine);
    scene.add(*model);
    double4x4 beside(1.0);
    beside[3].x = 2;
    if (isWhole) scene.add(*model, beside);
    if (model->environment()) scene.setEnvironment(*model->environment());
    const Result<SavedGltf> done = saveGltf(scene, saved, { .source = [&](auto) { return Result(memory); } });
    if (!done) {
        EXPECT_FALSE(isWhole) << done.error().message;
        return true;
    }
    const Result<Model> again = loadGltf(engine, saved);
    EXPECT_TRUE(again) << again.error().message;
    if (!again) return true;
    Scene other(engine);
    const Node root = other.add(*again);
    EXPECT_EQ(other.renderableCount(), scene.renderableCount());
    if (again->environment()) other.setEnvironment(*again->environment());
    EXPECT_EQ(other.lightCount(), scene.lightCount());
    EXPECT_EQ(again->animationCount(), model->animationCount());
    EXPECT_EQ(again->variantNames(), model->variantNames());
    EXPECT_EQ(again->environment() != nullptr, model->environment() != nullptr);
    EXPECT_EQ(other.nodeCount(), scene.nodeCount());
    other.remove(root);
    return true;
}

// The seeds are fixed; the number of rounds depends on the time, as in ModelMutation.
TEST(SaveSpecimens, WhatLoadsIsSavedAndLoadsAgain) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 1 });
    ASSERT_TRUE(engine) << engine.error().message;
    const fs::path saved = test::folderOfThisTest() / "specimen.glb";
    const std::vector<assets::test::Specimen> specimens = assets::test::allSpecimens();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
    for (uint32_t round = 0; round < 1000 && (round == 0 || std::chrono::steady_clock::now() < end); ++round) {
        for (size_t i = 0; i < specimens.size(); ++i) {
            assets::test::Specimen specimen = specimens[i];
            SCOPED_TRACE(testing::Message() << "specimen " << i << ", round " << round);
            if (round > 0)
                assets::test::Scratcher(9'000'000 + round * 1000 + static_cast<uint32_t>(i)).scratch(specimen);
            const bool isLoaded =
                    saveAgain(*engine, assets::test::glbFrom(specimen.json, specimen.binary), saved, round == 0);
            EXPECT_TRUE(isLoaded || round > 0);
        }
    }
    (void)engine->takeErrors();
}

} // namespace
} // namespace filament_core
