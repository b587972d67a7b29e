// SPDX-License-Identifier: Apache-2.0
// Changes from frame to frame make Mesa's Vulkan driver compile nothing: it may recompile a stage for every
// value of the uniforms that alone decide a condition, which takes seconds a frame. Counted in files of its shader
// cache.
#include "tests/base/ScopedVariable.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

#include <filament_core/BuiltInMaterials.h>

namespace filament_core {
namespace {

namespace fs = std::filesystem;

/// Has Mesa keep compiled code in a folder of its own, which is empty at first.
class OwnShaderCache {
public:
    OwnShaderCache() : mFolder(test::folderOfThisTest() / "shaders") {
        fs::remove_all(mFolder);
        mVariable.set(mFolder.string()); // read when a device is created
    }
    ~OwnShaderCache() { fs::remove_all(mFolder); }

    /// Complete once the devices are destroyed.
    size_t files() const {
        size_t count = 0;
        if (!fs::exists(mFolder)) return 0;
        for (fs::directory_entry const& entry : fs::recursive_directory_iterator(mFolder))
            count += entry.is_regular_file();
        return count;
    }

private:
    fs::path mFolder;
    test::ScopedVariable mVariable{ "MESA_SHADER_CACHE_DIR", {} };
};

/// Spheres of several materials, with textures and without, in the light of a sky, a sun and a lamp, of which
/// everything changes in each frame.
class ChangingScene {
public:
    explicit ChangingScene(test::MaterialStage& stage)
            : mStage(stage), mSphere(stage.engine, scenes::makeSphere(6, 12)), mSky(stage, test::kDirectionSky) {
        for (const char* name : { "gltf_lit_opaque", "gltf_lit_blended", "gltf_transmissive_solid_opaque" }) {
            mMaterials.push_back(
                    stage.engine.own(*stage.engine.create(MaterialDesc{ .package = shader::engineMaterial(name) })));
            mInstances.push_back(stage.engine.own(stage.engine.createInstance(mMaterials.back())));
            double4x4 world(1);
            world[3] = double4(2.2 * static_cast<double>(mInstances.size()) - 4.4, 0, 0, 1);
            mSpheres.push_back(stage.scene.add(mSphere.renderable(mInstances.back(), world)));
        }
        mMaterials.push_back(stage.engine.own(*createBuiltInMaterial(stage.engine, "lit")));
        mPlain = stage.engine.own(stage.engine.createInstance(mMaterials.back()));
        for (int i = 0; i < 600; ++i) { // several draws, each of which binds the parameters
            double4x4 world(0.05);
            world[3] = double4(0.1 * (i % 30) - 1.5, 0.1 * (i / 30) - 1, 1, 1);
            stage.scene.add(mSphere.renderable(mPlain, world));
        }
        mSun = stage.scene.add(SunLight{});
        mLamp = stage.scene.add(PointLight{});
    }

    void draw(Renderer& renderer, int frame, void (*ask)(View&)) {
        const auto t = static_cast<float>(frame);
        mStage.scene.setIndirectLight(mSky.light, Lux{ 20'000 + 500 * t }, 0.1f * t);
        mStage.scene.remove(mSun);
        mStage.scene.remove(mLamp);
        mSun = mStage.scene.add(SunLight{ .directionWorld = { -0.4f + 0.01f * t, -1, -0.6f },
                                          .illuminance = Lux{ 50'000 + 1000 * t },
                                          .contactShadows = true });
        mLamp = mStage.scene.add(PointLight{ .positionWorld = { 0.1f * t, 2, 2 },
                                             .intensity = Candela{ 20'000 + 100 * t },
                                             .rangeMeters = 8 + 0.1f * t });
        EXPECT_TRUE(mStage.engine.set(mPlain, "roughness", 0.3f + 0.02f * t)); // no texture: uniforms decide alone
        EXPECT_TRUE(mStage.engine.set(mPlain, "metallic", 0.1f * t));
        EXPECT_TRUE(mStage.engine.set(mPlain, "baseColor", float3(0.5f + 0.03f * t, 0.4f, 0.2f)));
        double4x4 world(1);
        world[3] = double4(-2.2, 0.05 * frame, 0, 1);
        mStage.scene.setTransform(mSpheres[0], world);

        View view{ .camera = Camera::lookAt({ 0.03 * frame, 1, 6 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 + t }),
                   .size = { 96, 64 } };
        view.camera.exposure.shutterSeconds = 1 / (100 + 3 * t);
        view.timeSeconds = frame;
        ask(view);
        view.effects.fog.density = 0.05f + 0.01f * t;
        view.effects.contactShadows.distanceMeters = 0.2f + 0.01f * t;
        view.effects.ambientOcclusion.intensity = 1.1f + 0.1f * t;
        view.effects.bloom.strength = 0.1f + 0.01f * t;
        view.effects.lensFlare.ghostStrength = 0.03f + 0.001f * t;
        view.effects.depthOfField.focusMeters = 3 + 0.1f * t;
        EXPECT_TRUE(renderer.renderToImage(mStage.scene, view));
    }

private:
    test::MaterialStage& mStage;
    scenes::Sphere mSphere;
    test::SkyObjects mSky;
    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
    Owned<MaterialInstance> mPlain;
    std::vector<Renderable> mSpheres;
    Light mSun{}, mLamp{};
};

/// How many programs the cache holds after drawing so many frames with a new device.
size_t programsAfter(int frames, OwnShaderCache const& cache, void (*ask)(View&)) {
    {
        std::optional<Engine> engine = test::makeEngine(Backend::Vulkan);
        if (!engine) return 0;
        test::MaterialStage stage(*engine);
        ChangingScene scene(stage);
        Renderer renderer(*engine);
        for (int frame = 0; frame < frames; ++frame) scene.draw(renderer, frame, ask);
        test::expectNoErrors(*engine);
    }
    return cache.files();
}

std::string vulkanDevice() {
    const std::optional<Engine> engine = test::makeEngine(Backend::Vulkan);
    return engine ? engine->device().device : std::string();
}

void expectNoFurtherPrograms(void (*ask)(View&)) {
    constexpr int kFew = 3, kMore = 8;
    const OwnShaderCache cache;
    if (const std::string device = vulkanDevice(); device.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << device << " is not Mesa's CPU driver, whose shader cache this test counts";
    EXPECT_GT(programsAfter(kFew, cache, ask), 0u) << "Mesa's shader cache is off: MESA_SHADER_CACHE_DISABLE";
    const size_t programs = programsAfter(kFew, cache, ask); // the first device does not keep quite everything
    EXPECT_EQ(programsAfter(kMore, cache, ask), programs) << "programs were compiled for the values of single frames";
}

TEST(Compilations, MovingPicturesCompileNothing) {
    expectNoFurtherPrograms([](View&) {});
}

TEST(Compilations, MovingPicturesWithEffectsCompileNothing) {
    expectNoFurtherPrograms([](View& view) {
        view.effects.screenSpaceReflections.enabled = true;
        view.effects.ambientOcclusion.enabled = true;
        view.quality.antiAliasing = AntiAliasing::Taa;
        Effects& effects = view.effects;
        effects.fog.enabled = effects.bloom.enabled = effects.depthOfField.enabled = true;
        effects.motionBlur.enabled = effects.autoExposure.enabled = effects.colorGrading.enabled = true;
        effects.vignette.enabled = effects.grain.enabled = effects.chromaticAberration.enabled = true;
        effects.lensFlare.enabled = true;
        effects.lensFlare.threshold = 0.1f;
    });
}

} // namespace
} // namespace filament_core
