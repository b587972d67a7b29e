// SPDX-License-Identifier: Apache-2.0
/// PassStage: three flat squares, and passes of the app over their picture.
#pragma once

#include "tests/filament_core/engine/materials/MaterialFixture.h"

namespace filament_core::test {

inline constexpr uint32_t kPassSide = 24;

/// `inputs`: between the brackets of "parameters"; `code`: of postProcess().
inline std::string passText(std::string const& inputs, std::string const& code, std::string const& name = "effect") {
    return "material { name : " + name + ", domain : postprocess, parameters : [ " + inputs +
           " ] }\nfragment { void postProcess(inout PostProcessInputs inputs) {\n" + code + "\n} }";
}
inline std::string input(std::string const& name) { return "{ type : sampler2d, name : " + name + " }"; }

struct PassStage {
    static constexpr const char* kFlat = R"(material { name : flat, shadingModel : unlit, culling : none,
        blending : transparent, parameters : [ { type : float4, name : color } ] }
    fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";
    static constexpr const char* kSolid = R"(material { name : solid, shadingModel : unlit, culling : none,
        parameters : [ { type : float4, name : color } ] }
    fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";

    explicit PassStage(Backend backend, int workers = 1)
            : engine(std::move(*Engine::create(
                      { .backend = backend, .workers = workers, .validation = true, .hashFrames = true }))) {
        for (auto [at, color] : { std::pair{ double3(-0.5, -0.3, 0), float4(0.25f, 0.5f, 0.125f, 1) },
                                  std::pair{ double3(0.4, 0.4, -1), float4(0.75f, 0.25f, 0.5f, 1) } })
            add(solid, color, at, 0.7);
    }
    ~PassStage() { expectNoErrors(engine); }

    Renderable add(Material material, float4 color, double3 at, double scale) {
        instances.push_back(engine.own(engine.createInstance(material)));
        EXPECT_TRUE(engine.set(instances.back(), "color", color));
        return square.add(scene, instances.back(), at, scale);
    }

    MaterialInstance pass(std::string const& text, PassPlace place, std::vector<MaterialConstant> constants = {}) {
        materials.push_back(loadMaterial(engine, text, std::move(constants)));
        instances.push_back(engine.own(engine.createInstance(materials.back())));
        passes.push_back({ instances.back(), place });
        view.postProcess = passes;
        return instances.back();
    }
    MaterialInstance instance(std::string const& text) {
        materials.push_back(loadMaterial(engine, text));
        instances.push_back(engine.own(engine.createInstance(materials.back())));
        return instances.back();
    }
    Texture texture(TextureDesc desc) {
        desc.renderable = true, desc.name = "film";
        textures.push_back(engine.own(engine.create(desc)));
        return textures.back();
    }
    RenderTarget target(RenderTargetDesc const& desc) {
        targets.push_back(engine.own(engine.create(desc)));
        return targets.back();
    }
    Image pixelsOf(RenderTarget target) {
        auto image = renderer.waitPixels(renderer.readPixels(target));
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }
    void clear() { passes.clear(), view.postProcess = {}; }

    Image light() { return renderLinear(engine, renderer, scene, view); }
    Image codes() {
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image) << (image ? "" : image.error().message);
        return image ? std::move(*image) : Image{};
    }
    /// The only error since the last call; empty: none, or several.
    std::string error() {
        const std::vector<std::string> errors = engine.takeErrors();
        return errors.size() == 1 ? errors[0] : std::string();
    }
    bool ran(std::string_view name) {
        return std::ranges::any_of(renderer.decisions(), [&](EffectDecision const& decision) {
            return decision.name == name && decision.state == EffectDecision::State::Ran;
        });
    }

    Engine engine;
    SquareMesh square{ engine };
    Owned<Material> solid = loadMaterial(engine, kSolid), flat = loadMaterial(engine, kFlat);
    std::vector<Owned<Material>> materials;
    std::vector<Owned<MaterialInstance>> instances;
    std::vector<Owned<Texture>> textures;
    std::vector<Owned<RenderTarget>> targets;
    Scene scene{ engine };
    Renderer renderer{ engine };
    std::vector<PostProcessPass> passes;
    View view{ .camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
               .size = uint2(kPassSide),
               .clearColor = { 0.0625f, 0.125f, 0.25f, 1 } };
};

} // namespace filament_core::test
