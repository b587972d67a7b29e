// SPDX-License-Identifier: Apache-2.0
// Pictures in the place of textures: of glTF models and of .mat files, with the same bits on both APIs, and gone when
// their edit is.
#include "tests/tools/view/stage/StageFiles.h"
#include "tools/view/stage/Stage.h"

#include <filament_core/Image.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace filament_core::view {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A triangle with a texture, and one whose texture nothing shows.
constexpr const char* kSign = R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ],
    "nodes": [ { "mesh": 0 } ], "images": [ { "uri": "white.png" } ], "textures": [ { "source": 0 } ],
    "materials": [ { "name": "board", "doubleSided": true, "extensions": { "KHR_materials_unlit": {} },
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } } ],
    "extensionsUsed": [ "KHR_materials_unlit" ],
    "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] },
        { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
    "buffers": [ { "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ] })";

constexpr const char* kPoster =
        "// show: mesh=sphere\nmaterial { name : poster, shadingModel : unlit, requires : [ uv0 ],\n"
        "    variantFilter : [ skinning, fog, ssr, vsm, shadowReceiver, dynamicLighting, directionalLighting ],\n"
        "    parameters : [ { type : sampler2d, name : picture } ] }\n"
        "fragment { void material(inout MaterialInputs material) { prepareMaterial(material);\n"
        "    material.baseColor = texture(materialParams_picture, getUV0()); } }\n";

class PictureFolder : public StageFolder {
public:
    PictureFolder() {
        write("sign.gltf", kSign);
        write("poster.mat", kPoster);
        paint("white.png", { 255, 255, 255 });
        paint("red.png", { 255, 0, 0 });
        paint("grey.png", { 128, 128, 128 });
    }
    void paint(std::string const& name, std::array<uint8_t, 3> color) const {
        Image image{ .width = 4, .height = 4 };
        for (int i = 0; i < 16; ++i) {
            for (const uint8_t code : color) image.pixels.push_back(std::byte{ code });
            image.pixels.push_back(std::byte{ 255 });
        }
        EXPECT_TRUE(savePng(*this / name, image).ok());
    }
};

PictureFolder& pictures() {
    static PictureFolder files;
    return files;
}

struct TexturedStage {
    std::unique_ptr<Stage> stage;
    Document document{};

    TexturedStage(Backend backend, std::string const& model) {
        auto made = Stage::create(
                { .engine = { .backend = backend, .workers = 1, .validation = true }, .watchesFiles = false });
        EXPECT_TRUE(made.ok()) << made.error().message;
        if (made) stage = std::move(*made);
        document.model.file = pictures() / model;
        document.view.size = { 32, 32 };
        document.view.camera = Camera::lookAt({ 0, 0, 2 }, double3(0));
        document.view.display.toneMapper = ToneMapper::Linear;
        document.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1.0f / 1.2f, .iso = 100 }; // a factor of 1
    }
    Image shoot() {
        stage->apply(document);
        stage->finishLoading();
        stage->forgetFrames();
        return stage->renderToImage().value();
    }
    /// Of the middle of the image.
    std::array<int, 3> color() {
        const Image image = shoot();
        auto const* pixel = image.pixels.data() + 4 * (18 * 32 + 13); // of the sphere and of the triangle
        return { static_cast<int>(pixel[0]), static_cast<int>(pixel[1]), static_cast<int>(pixel[2]) };
    }
};

struct TexturedModel {
    const char *file, *material, *parameter;
};
constexpr TexturedModel kSignModel{ "sign.gltf", "board", "baseColorMap" };
constexpr TexturedModel kPosterModel{ "poster.mat", "poster", "picture" };

class StageTextures : public testing::TestWithParam<std::tuple<Backend, TexturedModel>> {
public:
    Backend backend() const { return std::get<0>(GetParam()); }
    TexturedModel model() const { return std::get<1>(GetParam()); }
    static void set(TexturedStage& textured, TexturedModel const& model, std::string const& file, bool isData = false) {
        setTexture(textured.document, model.material, model.parameter, pictures() / file, isData);
    }
};
INSTANTIATE_TEST_SUITE_P(Apis, StageTextures,
                         testing::Combine(testing::Values(Backend::Vulkan, Backend::Gles),
                                          testing::Values(kSignModel, kPosterModel)),
                         [](auto const& tested) {
                             return std::string(toString(std::get<0>(tested.param))) + "_" +
                                    std::get<1>(tested.param).material;
                         });

TEST_P(StageTextures, ShowThePictureAndThenWhatTheFileSays) {
    TexturedStage textured(backend(), model().file);
    if (!textured.stage) return;
    const Image before = textured.shoot();
    EXPECT_THAT(textured.color(), ElementsAre(255, 255, 255));
    set(textured, model(), "red.png");
    EXPECT_THAT(textured.color(), ElementsAre(255, 0, 0));
    set(textured, model(), "grey.png");
    EXPECT_THAT(textured.color(), ElementsAre(128, 128, 128)) << "colours are codes of sRGB";
    set(textured, model(), "grey.png", true);
    EXPECT_THAT(textured.color(), ElementsAre(188, 188, 188)) << "of data, half of the light";
    resetTexture(textured.document, model().material, model().parameter);
    EXPECT_EQ(textured.shoot().pixels, before.pixels);
    EXPECT_THAT(textured.stage->takeMessages(), IsEmpty());
}

TEST_P(StageTextures, OfAFileThatCannotBeReadAreNamedAndNothingChanges) {
    TexturedStage textured(backend(), model().file);
    if (!textured.stage) return;
    const Image before = textured.shoot();
    set(textured, model(), "absent.png");
    EXPECT_EQ(textured.shoot().pixels, before.pixels);
    EXPECT_THAT(textured.stage->takeMessages(), ElementsAre(HasSubstr("absent.png")));
    textured.document.textures = { { "nobody", model().parameter, pictures() / "red.png" } };
    EXPECT_EQ(textured.shoot().pixels, before.pixels);
    EXPECT_THAT(textured.stage->takeMessages(), ElementsAre(HasSubstr("nobody")));
    textured.document.textures = { { model().material, "pictur", pictures() / "red.png" } };
    EXPECT_EQ(textured.shoot().pixels, before.pixels);
    EXPECT_THAT(textured.stage->takeMessages(), ElementsAre(HasSubstr("pictur")));
    EXPECT_FALSE(textured.stage->progress().isLoading);
}

TEST_P(StageTextures, AreReadAgainOnReload) {
    TexturedStage textured(backend(), model().file);
    if (!textured.stage) return;
    pictures().paint("changing.png", { 0, 255, 0 });
    set(textured, model(), "changing.png");
    EXPECT_THAT(textured.color(), ElementsAre(0, 255, 0));
    pictures().paint("changing.png", { 0, 0, 255 });
    textured.stage->reload();
    EXPECT_THAT(textured.color(), ElementsAre(0, 0, 255));
    EXPECT_THAT(textured.stage->takeMessages(), IsEmpty());
}

TEST_P(StageTextures, MayBeChangedBeforeTheyHaveCome) {
    TexturedStage textured(backend(), model().file);
    if (!textured.stage) return;
    textured.shoot();
    for (int i = 0; i < 20; ++i) {
        set(textured, model(), i % 2 ? "red.png" : "white.png", i % 3 == 0);
        textured.stage->apply(textured.document);
        if (i % 4 == 0) textured.stage->poll();
    }
    EXPECT_TRUE(textured.stage->progress().isLoading);
    EXPECT_THAT(textured.color(), ElementsAre(255, 0, 0));
    textured.stage->cancel();
    EXPECT_THAT(textured.stage->takeMessages(), IsEmpty());
}

TEST(StageTexturesOnBothApis, HaveTheSameBits) {
    for (TexturedModel const& model : { kSignModel, kPosterModel }) {
        std::vector<Image> images;
        for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
            TexturedStage textured(backend, model.file);
            if (!textured.stage) return;
            setTexture(textured.document, model.material, model.parameter, pictures() / "day.hdr", false);
            textured.document.view.size = { 128, 128 };
            images.push_back(textured.shoot());
            EXPECT_THAT(textured.stage->takeMessages(), IsEmpty());
        }
        EXPECT_EQ(images[0].pixels, images[1].pixels) << model.file;
    }
}

} // namespace
} // namespace filament_core::view
