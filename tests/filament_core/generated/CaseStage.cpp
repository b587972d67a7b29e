// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/generated/CaseStage.h"

#include "tests/filament_core/engine/CompiledMaterials.h"

#include <glm/ext/matrix_transform.hpp>

#include <array>

namespace filament_core::test {
namespace {

constexpr std::string_view kMetal = R"(material { name : metal, reflections : screenspace }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor.rgb = vec3(0.9, 0.7, 0.4); material.metallic = 1.0; material.roughness = 0.15;
    material.emissive = vec4(500.0, 100.0, 30.0, 0.0); } })";
constexpr std::string_view kPaint = R"(material { name : paint, requires : [ uv0 ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor.rgb = vec3(0.2, 0.5, step(0.5, fract(getUV0().x * 5.0))); material.roughness = 0.6; } })";
constexpr std::string_view kGlass = R"(material { name : glass, refractionMode : screenspace, refractionType : solid }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor.rgb = vec3(0.8, 1.0, 0.9); material.roughness = 0.1; material.transmission = 0.9;
    material.thickness = 0.3; } })";
constexpr std::string_view kFilm = R"(material { name : film, blending : transparent }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = vec4(0.3, 0.0, 0.1, 0.4); material.roughness = 0.3; } })";
constexpr std::string_view kFence = R"(material { name : fence, blending : masked, requires : [ uv0 ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = vec4(0.1, 0.6, 0.2, step(0.3, fract(getUV0().x * 8.0))); } })";
constexpr std::string_view kSign = R"(material { name : sign, shadingModel : unlit, requires : [ uv0 ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
    material.baseColor = vec4(getUV0(), 3.0, 1.0); } })";
constexpr std::string_view kEcho = R"(material { name : echo, domain : postprocess, parameters : [
    { type : sampler2d, name : color }, { type : sampler2d, name : depth }, { type : sampler2d, name : normals },
    { type : sampler2d, name : history } ] }
fragment { void postProcess(inout PostProcessInputs inputs) {
    vec2 at = getNormalizedUV();
    vec4 color = texelFetch(materialParams_color, getPixel(), 0);
    float near = 1.0 / (1.0 + texture(materialParams_depth, at).x);
    vec3 light = color.rgb + 0.25 * near * (texture(materialParams_normals, at).xyz + 1.0);
    inputs.color = vec4(mix(light, texture(materialParams_history, at).rgb, 0.25), color.a); } })";

} // namespace

CaseStage::CaseStage(Backend backend, int workers) : mEngine(makeEngine(backend, workers)) {
    const Result<Mesh> ball = makeUvSphere({ .slices = 12, .stacks = 7 });
    mVertices = mEngine->own(mEngine->create(ball->vertexBuffer()));
    mIndices = mEngine->own(mEngine->create(ball->indexBuffer()));
    makeMaterials();
    makeScenes();
}

CaseStage::~CaseStage() { expectNoErrors(*mEngine); }

void CaseStage::makeMaterials() {
    for (const auto& [name, text] :
         { std::pair("metal", kMetal), std::pair("paint", kPaint), std::pair("glass", kGlass), std::pair("film", kFilm),
           std::pair("fence", kFence), std::pair("sign", kSign), std::pair("echo", kEcho) }) {
        const auto material = mEngine->create(MaterialDesc{ .package = compiledPackage(text) });
        ASSERT_TRUE(material.ok());
        mMaterials[name] = mEngine->own(*material);
        mInstances[name] = mEngine->own(mEngine->createInstance(*material));
    }
    std::array<uint8_t, 4 * (16 + 4 + 1)> dirt{};
    for (size_t i = 0; i < dirt.size(); ++i) dirt[i] = static_cast<uint8_t>(i < 4 * 16 ? 40 + i * 53 % 200 : 140);
    mDirt = mEngine->own(mEngine->create(TextureDesc{
            .width = 4, .height = 4, .levels = 3, .pixels = std::as_bytes(std::span(dirt)), .name = "dirt" }));
    std::vector<uint16_t> texels;
    for (uint32_t face = 0; face < 6; ++face) {
        for (uint32_t i = 0; i < 16; ++i) {
            const float bright = static_cast<float>(1 + (face * 7 + i * 5) % 11) * 0.2f;
            for (const float value : { bright, bright * 0.8f, 2.2f - bright, 1.0f })
                texels.push_back(halfFromFloat(value));
        }
    }
    mSky = mEngine->own(mEngine->create(TextureDesc{ .kind = TextureKind::Cube,
                                                     .format = Format::RGBA16F,
                                                     .width = 4,
                                                     .height = 4,
                                                     .layers = 6,
                                                     .pixels = std::as_bytes(std::span(texels)),
                                                     .name = "sky" }));
    IndirectLightDesc light{ .specular = mSky };
    light.irradianceSh[0] = float4(1, 0.9f, 1.1f, 0);
    mLight = mEngine->own(mEngine->create(light));
    mSkybox = mEngine->own(mEngine->create(SkyboxDesc{ .cube = mSky }));
}

void CaseStage::makeScenes() {
    for (const SeenScene which :
         { SeenScene::Everything, SeenScene::Empty, SeenScene::SkyOnly, SeenScene::UnlitOnly, SeenScene::BlendedOnly })
        mScenes.emplace(which, Scene(*mEngine));
    Scene& all = scene(SeenScene::Everything);
    add(all, "paint", { 0, -20.5, 0 }, 40);
    mMoving.emplace_back(&all, add(all, "metal", { -0.8, 0, 0 }, 1));
    add(all, "fence", { 0.9, 0.1, -0.6 }, 1.2);
    add(all, "glass", { 0.2, 0.2, 1.2 }, 0.7);
    add(all, "sign", { 0, 1.2, -1.5 }, 0.8);
    addLights(all);
    addSky(all);
    addSky(scene(SeenScene::SkyOnly));
    scene(SeenScene::SkyOnly).add(SunLight{ .directionWorld = { 0, -0.2f, 1 }, .showsDisc = true });
    Scene& unlit = scene(SeenScene::UnlitOnly);
    mMoving.emplace_back(&unlit, add(unlit, "sign", { 0.2, 0, 0 }, 1.5));
    addLights(unlit);
    Scene& blended = scene(SeenScene::BlendedOnly);
    addLights(blended);
    for (Scene* const over : { &all, &blended }) {
        for (int i = 0; i < 3; ++i)
            mMoving.emplace_back(over, add(*over, "film", { 0.3 * i - 0.4, 0.4, 1.4 - 0.3 * i }, 1));
    }
}

void CaseStage::addLights(Scene& scene) {
    scene.add(SunLight{ .directionWorld = { -0.5f, -1, -0.4f }, .illuminance = Lux{ 800 }, .contactShadows = true });
    scene.add(PointLight{ .positionWorld = { 1.5, 1.5, 1 }, .intensity = Candela{ 300 }, .rangeMeters = 5 });
    scene.add(SpotLight{ .positionWorld = { -2, 2, 1 },
                         .directionWorld = { 1, -1, -0.5f },
                         .intensity = Candela{ 900 },
                         .rangeMeters = 8 });
    scene.add(RectLight{ .positionWorld = { 0, 2, -2 }, .directionWorld = { 0, -1, 1 }, .luminance = Nits{ 300 } });
}

void CaseStage::addSky(Scene& scene) {
    scene.setIndirectLight(mLight, Lux{ 200 });
    scene.setSkybox(mSkybox, Lux{ 200 });
}

Renderable CaseStage::add(Scene& scene, std::string_view material, double3 at, double scale, float yaw) {
    const double4x4 world = glm::rotate(glm::translate(double4x4(1.0), at), double(yaw), double3(0, 1, 0)) *
                            glm::scale(double4x4(1.0), double3(scale));
    return scene.add({ .vertices = mVertices,
                       .indices = mIndices,
                       .material = mInstances.find(material)->second,
                       .worldFromObject = world });
}

template <class Target>
Image CaseStage::drawFrames(Target target, ViewCase const& viewCase, View view, int frames) {
    Renderer renderer(*mEngine);
    DebugDraw debug;
    debug.box(Box{ float3(-1), float3(1) }, { .color = { 1, 1, 0, 0.7f }, .widthPixels = 1.5f });
    debug.screenText({ 1, 1 }, "Ag", {});
    if (viewCase.hasDebugDraw) view.debugDraw = &debug;
    const PostProcessPass echo{ mInstances.find("echo")->second, viewCase.pass.value_or(PassPlace::Last) };
    if (viewCase.pass) view.postProcess = std::span(&echo, 1);
    if (viewCase.hasDirt) view.effects.bloom.dirt = mDirt;
    ReflectionProbe probe;
    if (viewCase.hasProbe)
        probe = scene(viewCase.scene)
                        .add(ReflectionProbeDesc{ .centerWorld = { -0.5, 0, 0 },
                                                  .halfExtentMeters = { 1, 0.8f, 2 },
                                                  .light = mLight,
                                                  .intensity = 300 });
    mEngine->waitIdle();
    const uint64_t before = mEngine->statistics().commands;
    for (int frame = 0; frame < frames; ++frame) {
        view.timeSeconds = 10 + frame / 30.0;
        if (viewCase.moves) {
            view.camera.worldFromView[3].x += 0.03;
            for (auto const& [scene, renderable] : mMoving)
                if (scene == &this->scene(viewCase.scene)) {
                    const double4x4 at = glm::translate(double4x4(1.0), double3(0.1 * frame, 0.2, 0.05 * frame));
                    scene->setTransform(renderable, at);
                }
        }
        renderer.render(scene(viewCase.scene), view, target);
    }
    auto image = renderer.waitPixels(renderer.readPixels(target));
    mEngine->waitIdle();
    if (probe) scene(viewCase.scene).remove(probe);
    mCommands = mEngine->statistics().commands - before;
    mStatistics = renderer.statistics();
    EXPECT_TRUE(image.ok()) << (image ? "" : image.error().message);
    return image ? std::move(*image) : Image{};
}

Image CaseStage::draw(ViewCase const& viewCase, int frames) {
    const uint2 size = targetSize(viewCase);
    const bool isLight = viewCase.target == SeenTarget::LightWithDepth;
    if (!isLight && viewCase.target != SeenTarget::SrgbWithMips) {
        constexpr std::array kFormats{ Format::RGBA8, Format::RGB10A2, Format::RGBA16F };
        const Owned<SwapChain> chain = mEngine->own(mEngine->create(SwapChainDesc{
                .size = size, .imageCount = 2, .format = kFormats[static_cast<size_t>(viewCase.target)] }));
        return drawFrames(chain.get(), viewCase, viewCase.view, frames);
    }
    const Owned<Texture> color =
            mEngine->own(mEngine->create(TextureDesc{ .format = isLight ? Format::RGBA16F : Format::RGBA8Srgb,
                                                      .width = size.x,
                                                      .height = size.y,
                                                      .levels = isLight || std::max(size.x, size.y) < 2 ? 1u : 2u,
                                                      .renderable = true,
                                                      .name = "film" }));
    const Owned<Texture> depth = mEngine->own(mEngine->create(TextureDesc{
            .format = Format::R32F, .width = size.x, .height = size.y, .renderable = true, .name = "depth" }));
    const Owned<RenderTarget> target = mEngine->own(mEngine->create(RenderTargetDesc{
            .color = color, .depth = isLight ? depth.get() : Texture{}, .generateMips = !isLight, .name = "target" }));
    return drawFrames(target.get(), viewCase, viewCase.view, frames);
}

} // namespace filament_core::test
