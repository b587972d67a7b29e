// SPDX-License-Identifier: Apache-2.0
// Scene files through the public API draw what the loader of the conformance tests draws, to the bit, also after they
// were saved.
#include "toolkit/materials/MaterialFile.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/scenes/SceneAssets.h"
#include "toolkit/scenes/ScenePasses.h"
#include "toolkit/scenes/ShownScene.h"

#include <filament_core/Animator.h>
#include <filament_core/BuildScene.h>
#include <filament_core/Renderer.h>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace filament_core {
namespace {

namespace fs = std::filesystem;

struct BuildSceneTest : testing::Test {
    fs::path scenes = tools::sourceDir() / "tests/conformance/scenes";
    tools::SceneFolders folders{ tools::buildDir() / "build-scene", {} };

    static Engine& engine() {
        static Engine one = Engine::create({ .backend = Backend::Gles }).value();
        return one;
    }

    /// Objects and skies that the conformance tests make.
    SceneBuildOptions builders(SceneFile const& file) const {
        SceneBuildOptions options;
        options.find = [this, spec = tools::specOf(file).value()](
                               SceneFileName const& name) -> Result<std::optional<fs::path>> {
            tools::SceneSpec named = spec;
            if (name.kind == SceneFileKind::Environment) named.environment = name.name;
            if (name.kind != SceneFileKind::Environment && name.kind != SceneFileKind::Object)
                return std::optional<fs::path>();
            Result<fs::path> path = name.kind == SceneFileKind::Object ? tools::modelFile(named, folders)
                                                                       : tools::environmentFile(named, folders);
            if (!path) return path.error();
            return std::optional(std::move(*path));
        };
        return options;
    }

    Image drawn(SceneFile const& file) const {
        Result<BuiltScene> built = buildScene(engine(), file, builders(file));
        EXPECT_TRUE(built.ok()) << (built ? "" : built.error().message);
        if (!built) return {};
        return Renderer(engine()).renderToImage(built->scene, built->view).value();
    }

    Image drawnByTheLoader(SceneFile const& file) const {
        const tools::SceneSpec spec = tools::specOf(file).value();
        tools::SceneLoader loader(engine(), folders, tools::SceneLoader::Keep::Last);
        const tools::ShownScene shown = loader.show(spec, spec.modelOptions, spec.environmentOptions).value();
        View view = spec.view;
        view.camera = tools::cameraOf(spec, shown.scene.bounds());
        return Renderer(engine()).renderToImage(shown.scene, view).value();
    }
};

TEST_F(BuildSceneTest, DrawsWhatTheConformanceTestsDraw) {
    for (const char* name :
         { "mask", "spot-lights", "light-profiles", "irradiance-grid", "far-from-origin", "light-channels" }) {
        Result<SceneFile> file = SceneFile::load(scenes / (std::string(name) + ".json"));
        ASSERT_TRUE(file.ok()) << file.error().message;
        const Image image = drawn(*file), expected = drawnByTheLoader(*file);
        ASSERT_FALSE(image.pixels.empty()) << name;
        EXPECT_TRUE(image.pixels == expected.pixels) << name;
        const SceneFile saved = SceneFile::parse(file->text(), name, scenes).value();
        EXPECT_TRUE(drawn(saved).pixels == expected.pixels) << name << ", saved";
    }
}

TEST_F(BuildSceneTest, SaysWhatItCannotBuild) {
    const auto refusal = [&](const char* text) {
        const Result<BuiltScene> built = buildScene(engine(), SceneFile::parse(text, "kitchen").value());
        return built ? "was built" : built.error().message;
    };
    EXPECT_NE(refusal(R"({"model": "none.glb"})").find("kitchen: no file 'none.glb'"), std::string::npos)
            << refusal(R"({"model": "none.glb"})");
    EXPECT_NE(refusal(R"({"model": "asset:a.glb"})").find("there is no folder of assets"), std::string::npos);
    EXPECT_NE(refusal(R"({"model": {"objects": []}})").find("an object needs a program that builds it"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"environment": {"file": "none.hdr"}})").find("none.hdr"), std::string::npos);
    EXPECT_EQ(refusal("{}"), "was built");
}

TEST_F(BuildSceneTest, AFittedCopyIsAMetreLarge) {
    SceneFile file = SceneFile::parse(R"({"copies": [{"fit": true, "at": [10, 0, 0], "scale": [2, 2, 2]}]})").value();
    ASSERT_TRUE(file.set("model", (tools::sourceDir() / "samples/animated_gltf/windmill.gltf").string()).ok());
    const Result<BuiltScene> built = buildScene(engine(), file);
    ASSERT_TRUE(built.ok()) << built.error().message;
    const Box bounds = built->scene.bounds();
    const double3 size = bounds.max - bounds.min, middle = (bounds.max + bounds.min) * 0.5;
    EXPECT_NEAR(std::max({ size.x, size.y, size.z }), 2, 1e-3) << "one metre, scaled by two";
    EXPECT_NEAR(middle.x, 10, 1e-3);
}

TEST_F(BuildSceneTest, AnEditShows) {
    SceneFile file = SceneFile::load(scenes / "spot-lights.json").value();
    const Image before = drawn(file);
    ASSERT_TRUE(file.erase("spots[1]").ok());
    ASSERT_TRUE(file.add(PointLight{ .positionWorld = { 0, 0, 1 }, .intensity = Candela{ 20'000 } }).ok());
    Result<BuiltScene> built = buildScene(engine(), file, builders(file));
    ASSERT_TRUE(built.ok());
    EXPECT_EQ(built->scene.lightCount(), 2u);
    EXPECT_FALSE(Renderer(engine()).renderToImage(built->scene, built->view)->pixels == before.pixels);
}

constexpr const char* kMoving = R"({
    "copies": [ { "at": [ -0.6, 0, 0 ], "scale": [ 0.4, 0.4, 0.4 ], "moves": [ 0.08, 0, 0.02 ] },
                { "at": [ 0.7, 0, -1 ], "scale": [ 0.5, 0.5, 0.5 ] } ],
    "animation": { "index": 0, "seconds": 1.5 },
    "suns": [ { "direction": [ -0.4, -1, -0.5 ] } ],
    "camera": { "eye": [ 0, 0.4, 2.5 ], "at": [ 0, 0, 0 ], "moves": [ 0, 0.03, 0 ] }, "origin": [ 10, 0, 0 ],
    "view": { "size": [ 64, 48 ], "target": [ 72, 56 ], "viewport": { "offset": [ 4, 6 ] }, "frames": 4,
              "secondsPerFrame": 0.2 },
    "quality": { "antiAliasing": "taa" }, "effects": { "motionBlur": "on" },
    "postProcess": [ { "material": "trail.mat", "place": "beforeToneMapping", "values": { "kept": "0.9,0.7,0.5" } } ],
    "overlays": [ { "size": [ 24, 20 ], "viewport": { "offset": [ 40, 30 ] },
                    "camera": { "eye": [ 0, 3, 0.1 ], "at": [ 0, 0, 0 ] }, "clear": [ 0, 0.2, 0, 1 ] } ] })";

/// As tools/conformance/Stage.cpp draws.
Image framesByHand(Engine& engine, SceneFile const& file, tools::SceneFolders const& folders) {
    const tools::SceneSpec spec = tools::specOf(file).value();
    tools::SceneLoader loader(engine, folders, tools::SceneLoader::Keep::Last);
    tools::ShownScene shown = loader.show(spec, spec.modelOptions, spec.environmentOptions).value();
    const auto passes = tools::ScenePasses::make(engine, file.folder(), file.contents().passes).value();
    View view = spec.view;
    view.postProcess = passes.passes();
    const Camera last = tools::cameraOf(spec, shown.scene.bounds());
    const Owned<SwapChain> target = engine.own(engine.create(SwapChainDesc{ .size = spec.target, .imageCount = 1 }));
    Renderer renderer(engine);
    for (uint32_t back = spec.frames; back-- > 0;) {
        const auto moved = [&](double3 const& moves) { return glm::translate(double4x4(1.0), moves * -double(back)); };
        for (size_t i = 0; i < shown.copies.size(); ++i) {
            shown.scene.setTransform(shown.copies[i], moved(spec.copyMoves[i]) * tools::placedCopies(spec)[i]);
            Animator(*shown.model, shown.scene, shown.copies[i])
                    .apply(spec.animation, *spec.animationSeconds - spec.secondsPerFrame * back);
        }
        view.camera = last;
        view.camera.worldFromView = moved(spec.cameraMoves) * last.worldFromView;
        view.timeSeconds = spec.view.timeSeconds - spec.secondsPerFrame * back;
        renderer.render(shown.scene, view, target);
    }
    for (tools::OverlaySpec const& overlay : spec.overlays) {
        View over = overlay.view;
        over.camera = Camera::lookAt(overlay.eye + spec.origin, overlay.at + spec.origin, overlay.lens, spec.exposure);
        Renderer(engine).render(shown.scene, over, target);
    }
    return renderer.waitPixels(renderer.readPixels(target)).value();
}

TEST_F(BuildSceneTest, DrawsFramesPassesAndOverlays) {
    const fs::path materials = tools::sourceDir() / "samples/post_process";
    SceneFile file = SceneFile::parse(kMoving, "moving", materials).value();
    ASSERT_TRUE(file.set("model", (tools::sourceDir() / "samples/animated_gltf/windmill.gltf").string()).ok());
    SceneBuildOptions options{ .compile = [](fs::path const& path) -> Result<std::vector<std::byte>> {
        const auto material = tools::readMaterialFile(path);
        if (!material) return material.error();
        return (*material)->bytes;
    } };
    Result<BuiltScene> built = buildScene(engine(), file, options);
    ASSERT_TRUE(built.ok()) << built.error().message;
    const Image image = renderFrames(engine(), *built).value(), expected = framesByHand(engine(), file, folders);
    ASSERT_EQ(image.width, 72u);
    EXPECT_TRUE(image.pixels == expected.pixels);
    EXPECT_TRUE(renderFrames(engine(), *built)->pixels == expected.pixels) << "again";
    ASSERT_TRUE(file.set("view.frames", "1").ok());
    Result<BuiltScene> still = buildScene(engine(), file, options);
    EXPECT_FALSE(renderFrames(engine(), *still)->pixels == expected.pixels) << "frames before the last one are seen";

    ASSERT_TRUE(file.set("postProcess[0].values", R"({"kepd": "1"})").ok());
    const Result<BuiltScene> wrong = buildScene(engine(), file, options);
    EXPECT_NE(wrong.error().message.find("postProcess: material 'trail' has no parameter or constant 'kepd'"),
              std::string::npos)
            << wrong.error().message;
    const Result<BuiltScene> text = buildScene(engine(), file);
    EXPECT_NE(text.error().message.find("is the text of a material: compile it with matc"), std::string::npos);
}

} // namespace
} // namespace filament_core
