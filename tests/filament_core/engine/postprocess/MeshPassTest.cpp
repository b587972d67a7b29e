// SPDX-License-Identifier: Apache-2.0
// Mesh passes: the objects of a scene drawn with one material into targets of the app.
#include "tests/filament_core/engine/postprocess/PassStage.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core {
namespace {

using test::halfPixel;
using test::kPassSide;
using test::PassStage;
using test::renderLinear;
using testing::HasSubstr;

/// `head`: more properties; `code`: of material().
std::string meshText(std::string const& name, std::string const& head, std::string const& code,
                     std::string const& vertex = {}) {
    return "material { name : " + name + ", shadingModel : unlit" + (head.empty() ? "" : ", " + head) + " }\n" +
           vertex + "fragment { void material(inout MaterialInputs material) { prepareMaterial(material);\n" + code +
           "\n} }";
}

const std::string kWhere = meshText("where", "culling : none", "material.baseColor = vec4(getWorldPosition(), 1.0);");
const std::string kThreeOfMeshes = meshText("three",
                                            "culling : none, outputs : [ { name : chosen }, { name : place }, "
                                            "{ name : slope, type : float2 } ]",
                                            "material.chosen = vec4(1.0, getUserTime().x, 0.0, 1.0);\n"
                                            "material.place = vec4(getUserWorldPosition(), 1.0);\n"
                                            "material.slope = vec2(dFdx(getWorldPosition().x), 0.5);");
const std::string kFlatOutput = meshText(
        "mask", "culling : none, parameters : [ { type : float4, name : tint } ], outputs : [ { name : mask } ]",
        "material.mask = materialParams.tint;");

struct MeshPassTest : testing::TestWithParam<Backend>, PassStage {
    MeshPassTest() : PassStage(GetParam()) {}

    Texture film(Format format = Format::RGBA16F) {
        return texture({ .format = format, .width = kPassSide, .height = kPassSide });
    }
    MaterialInstance tinted(float4 tint) {
        const MaterialInstance mask = instance(kFlatOutput);
        EXPECT_TRUE(engine.set(mask, "tint", tint));
        return mask;
    }
    /// Pixels of the film that are not black.
    size_t covered(RenderTarget target) {
        const Image image = pixelsOf(target);
        size_t count = 0;
        for (uint32_t i = 0; i < kPassSide * kPassSide; ++i)
            count += halfPixel(image, i % kPassSide, i / kPassSide) != float4(0);
        return count;
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, MeshPassTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(MeshPassTest, OneMaterialDrawsEveryObjectIntoSeveralColours) {
    const Texture chosen = film(), place = film(Format::RGBA32F), slope = film(), depth = film(Format::R32F);
    const RenderTarget all = target({ .color = chosen, .depth = depth, .others = { place, slope } }),
                       ofSlope = target({ .color = slope });
    MeshPass pass{ .material = instance(kThreeOfMeshes) };
    pass.clearColors[2] = float4(7, 8, 9, 10);
    view.timeSeconds = 2.5;
    renderer.render(scene, pass, all, view);
    EXPECT_EQ(halfPixel(pixelsOf(all), 6, 15), float4(1, 2.5f, 0, 1)) << "of the nearer square";
    EXPECT_EQ(halfPixel(pixelsOf(all), 15, 8), float4(1, 2.5f, 0, 1)) << "of the other one";
    EXPECT_EQ(halfPixel(pixelsOf(all), 0, 0), float4(0)) << "of none";
    // Pixels of the square at z = 0 are 2 tan(20 degrees) 3 / 24 metres apart.
    const double step = 2 * std::tan(glm::radians(20.0)) * 3 / kPassSide;
    EXPECT_NEAR(halfPixel(pixelsOf(ofSlope), 6, 15).x, step, 1e-4);
    EXPECT_EQ(halfPixel(pixelsOf(ofSlope), 0, 0), float4(7, 8, 9, 10)) << "a colour of its own";
    const Image places = pixelsOf(target({ .color = place }));
    float4 at;
    std::memcpy(&at, places.pixels.data() + (15 * kPassSide + 6) * sizeof(at), sizeof(at));
    EXPECT_NEAR(at.x, (6.5 - 12) * step, 1e-5);
    EXPECT_NEAR(at.y, (12 - 15.5) * step, 1e-5);
    const MaterialInstance read = this->pass(
            test::passText(test::input("metres"), "inputs.color = texelFetch(materialParams_metres, getPixel(), 0);"),
            PassPlace::Last);
    ASSERT_TRUE(engine.set(read, "metres", depth));
    const Image metres = light();
    EXPECT_NEAR(halfPixel(metres, 6, 15).x, 3, 2e-3);
    EXPECT_NEAR(halfPixel(metres, 15, 8).x, 4, 4e-3);
}

// Surfaces that have the material in a view have the same bits: mirrored, instanced, skinned and morphed ones, too.
TEST_P(MeshPassTest, DrawsWhatAViewDrawsWithTheMaterial) {
    struct Vertex {
        float3 position;
        std::array<uint8_t, 4> joints{};
        float4 weights{ 1, 0, 0, 0 };
    };
    const std::array<Vertex, 3> triangle{ { { { -1, -1, 0 } }, { { 1, -1, 0 }, { 1, 0, 0, 0 } }, { { 0, 1, 0 } } } };
    const Owned<VertexBuffer> vertices = engine.own(
            engine.create({ .vertexCount = 3,
                            .stride = sizeof(Vertex),
                            .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                            { Attribute::Joints, VertexFormat::UByte4, offsetof(Vertex, joints) },
                                            { Attribute::Weights, VertexFormat::Float4, offsetof(Vertex, weights) } },
                            .data = std::as_bytes(std::span(triangle)) }));
    constexpr std::array<uint16_t, 3> kIndices{ 0, 1, 2 };
    const Owned<IndexBuffer> indices =
            engine.own(engine.create({ .indexCount = 3, .data = std::as_bytes(std::span(kIndices)) }));
    const std::array<float3, 3> raised(std::array{ float3(0), float3(0), float3(0, 0.5f, 0.25f) });
    const Owned<MorphTargets> morphs =
            engine.own(engine.create(MorphTargetsDesc{ .vertexCount = 3, .targets = { { .positions = raised } } }));
    const auto fill = [&](Scene& into, MaterialInstance opaque, MaterialInstance blended) {
        for (int i = 0; i < 9; ++i)
            square.add(into, i == 4 ? blended : opaque, { 0.4 * (i % 3) - 0.4, 0.4 * (i / 3.0) - 0.6, -0.2 * i }, 0.17);
        double4x4 mirrored(0.3);
        mirrored[0].x = -0.3, mirrored[3] = double4(0.7, -0.7, 0.1, 1);
        square.add(into, opaque, mirrored);
        const Skin skin = into.add(SkinDesc{ .boneCount = 2 });
        std::array bones{ float4x4(0.3f), float4x4(0.3f) };
        bones[0][3] = float4(-0.6f, 0.6f, 0, 1), bones[1][3] = float4(-0.3f, 0.75f, 0.15f, 1);
        into.setBones(skin, bones);
        RenderableDesc deformed{ .vertices = vertices, .indices = indices, .material = opaque };
        deformed.skin = skin, deformed.morphTargets = morphs, deformed.morphWeights = { 0.5f };
        (void)into.add(deformed);
    };
    const MaterialInstance where = instance(kWhere), glass = instance(kFlat), wall = instance(kSolid);
    Scene painted(engine), drawn(engine);
    fill(painted, where, where);
    fill(drawn, wall, glass);
    const RenderTarget into = target({ .color = film() });
    MeshPass pass{ .material = where };
    pass.clearColors[0] = view.clearColor;
    for (const bool keepsHoles : { false, true }) {
        pass.keepsHoles = keepsHoles;
        renderer.render(drawn, pass, into, view);
        const Image expected = renderLinear(engine, painted, view), seen = pixelsOf(into);
        EXPECT_TRUE(keepsHoles || test::differingPixels(seen, expected) == 0);
        EXPECT_LE(test::differingPixels(seen, expected), 12u) << "the one that blends is left out";
        EXPECT_TRUE(!keepsHoles || test::differingPixels(seen, expected) > 0);
    }
}

TEST_P(MeshPassTest, LayersChooseAndPassesFollowEachOther) {
    const Renderable third = add(solid, float4(1), { 0.6, -0.6, 0.2 }, 0.2);
    scene.setLayers(third, kAllLayers, 4);
    const RenderTarget into = target({ .color = film() });
    MeshPass pass{ .material = tinted({ 1, 0, 0, 1 }) };
    view.visibleLayers = 4;
    renderer.render(scene, pass, into, view);
    const size_t third0 = covered(into);
    EXPECT_GT(third0, 0u);
    view.visibleLayers = 1;
    pass = { .material = tinted({ 0, 1, 0, 1 }), .contents = TargetContents::Keep };
    renderer.render(scene, pass, into, view);
    EXPECT_GT(covered(into), third0);
    EXPECT_EQ(halfPixel(pixelsOf(into), 6, 15), float4(0, 1, 0, 1));
    EXPECT_EQ(halfPixel(pixelsOf(into), 19, 19), float4(1, 0, 0, 1)) << "of the pass before";
    pass.contents = TargetContents::Clear;
    renderer.render(scene, pass, into, view);
    EXPECT_EQ(halfPixel(pixelsOf(into), 19, 19), float4(0));
}

TEST_P(MeshPassTest, HolesOfMaskedObjectsAreFilledUnlessTheyAreKept) {
    const MaterialInstance grid =
            instance(meshText("grid", "blending : masked, culling : none",
                              "material.baseColor = vec4(1.0, 1.0, 1.0, fract(gl_FragCoord.x * 0.5));"));
    Scene masked(engine);
    square.add(masked, grid, {}, 4);
    const RenderTarget into = target({ .color = film() });
    MeshPass pass{ .material = tinted(float4(1)) };
    renderer.render(masked, pass, into, view);
    EXPECT_EQ(covered(into), kPassSide * kPassSide);
    pass.keepsHoles = true;
    renderer.render(masked, pass, into, view);
    EXPECT_EQ(covered(into), kPassSide * kPassSide / 2);
    // A mask of its own: fract(x / 2) is 0.25 and 0.75 of pixels in turn.
    pass = { .material = instance(
                     meshText("own", "blending : masked, culling : none, outputs : [ { name : mask } ]",
                              "material.baseColor.a = fract(gl_FragCoord.x * 0.5); material.mask = vec4(1.0);")) };
    renderer.render(masked, pass, into, view);
    EXPECT_EQ(covered(into), kPassSide * kPassSide / 2);
}

// Layers of surfaces, counted by blending, hidden ones among them.
TEST_P(MeshPassTest, BlendingAddsWhatIsHidden) {
    Scene stack(engine);
    for (int i = 0; i < 3; ++i) square.add(stack, instances[0], { 0, 0, -0.5 * i }, 4);
    const RenderTarget into = target({ .color = film() });
    MeshPass pass{ .material = instance(meshText(
                           "count", "blending : add, culling : none, depthCulling : false, outputs : [ { name : n } ]",
                           "material.n = vec4(1.0, 0.5, 0.0, 0.0);")) };
    renderer.render(stack, pass, into, view);
    EXPECT_EQ(halfPixel(pixelsOf(into), 3, 3), float4(3, 1.5f, 0, 0));
    view.postProcess = {};
}

TEST_P(MeshPassTest, DrawsToLayersAndLevels) {
    const Texture cube = texture({ .kind = TextureKind::Cube,
                                   .format = Format::RGBA16F,
                                   .width = 2 * kPassSide,
                                   .height = 2 * kPassSide,
                                   .layers = 6,
                                   .levels = 3 });
    const RenderTarget flat0 = target({ .color = film() });
    MeshPass pass{ .material = instance(kWhere) };
    renderer.render(scene, pass, flat0, view);
    std::vector<RenderTarget> faces;
    for (const uint32_t face : { 2u, 5u }) {
        faces.push_back(target({ .color = cube, .level = 1, .layer = face }));
        renderer.render(scene, pass, faces.back(), view);
        pass.material = tinted(float4(static_cast<float>(face)));
    }
    EXPECT_EQ(test::differingPixels(pixelsOf(faces[0]), pixelsOf(flat0)), 0u) << "the other face did not change it";
    EXPECT_EQ(halfPixel(pixelsOf(faces[1]), 6, 15), float4(2));
}

// A map in texture space: the vertex block places the corners by their coordinates.
TEST_P(MeshPassTest, AVertexBlockDrawsIntoTextureSpace) {
    Scene one(engine);
    square.add(one, instances[0], {}, 0.5);
    const MaterialInstance unfold =
            instance(meshText("unfold", "requires : [ uv0 ], culling : none, outputs : [ { name : place } ]",
                              "material.place = vec4(getUserWorldPosition(), 1.0);",
                              "vertex { void materialVertex(inout MaterialVertexInputs material) {\n"
                              "material.clipSpacePosition = vec4(material.uv0 * 2.0 - 1.0, 0.5, 1.0); } }\n"));
    const RenderTarget into = target({ .color = film() });
    renderer.render(one, { .material = unfold }, into, view);
    const Image map = pixelsOf(into);
    for (const uint32_t i : { 0u, 11u, 23u }) {
        const float4 place = halfPixel(map, i, i);
        EXPECT_NEAR(std::abs(place.x), std::abs((i + 0.5) / kPassSide - 0.5), 1e-3) << i;
        EXPECT_EQ(place.w, 1) << i;
    }
}

TEST_P(MeshPassTest, FramesOfViewsStayAsTheyWere) {
    view.quality.antiAliasing = AntiAliasing::Taa;
    view.effects.motionBlur.enabled = true;
    const RenderTarget into = target({ .color = film() });
    const auto frames = [&](bool draws) {
        Scene moving(engine);
        const Renderable panel = square.add(moving, instances[0], {}, 0.5);
        Renderer own(engine);
        std::vector<Image> images;
        for (int frame = 0; frame < 4; ++frame) {
            double4x4 at(0.5);
            at[3] = double4(0.1 * frame, 0, 0, 1);
            moving.setTransform(panel, at);
            if (draws) own.render(moving, { .material = instances[1] }, into, view);
            images.push_back(renderLinear(engine, own, moving, view));
            if (draws) own.render(moving, { .material = instances[1] }, into, View{});
        }
        EXPECT_EQ(own.statistics().frame, 4u);
        return images;
    };
    const std::vector<Image> without = frames(false), with = frames(true);
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(test::differingPixels(without[i], with[i]), 0u) << i;
}

TEST_P(MeshPassTest, WhatCannotBeDrawnIsNamedWithItsCure) {
    const RenderTarget one = target({ .color = film() });
    const auto refused = [&](MeshPass const& pass, RenderTarget into) {
        renderer.render(scene, pass, into, view);
        const std::string line = error();
        renderer.prewarm(scene, pass, into, view);
        const std::string again = error();
        EXPECT_TRUE(again == line || again.empty()) << again;
        return line;
    };
    EXPECT_THAT(refused({}, one), HasSubstr("a mesh pass has no material; Engine::createInstance()"));
    EXPECT_THAT(refused({ .material = instance(kThreeOfMeshes) }, one),
                HasSubstr("'three' of a mesh pass writes 3 colours, and is drawn to 1; give `outputs`"));
    EXPECT_THAT(refused({ .material = instance(test::passText("", "inputs.color = vec4(1.0);", "whole")) }, one),
                HasSubstr("'whole' of a mesh pass is of domain postprocess; leave `domain` out"));
    EXPECT_THAT(refused({ .material = instance(
                                  "material { name : lit }\nfragment { void material(inout MaterialInputs material) { "
                                  "prepareMaterial(material); } }") },
                        one),
                HasSubstr("is lit; say shadingModel : unlit"));
    EXPECT_THAT(refused({ .material = instance(
                                  meshText("tint", "requires : [ color ]", "material.baseColor = getColor();")) },
                        one),
                HasSubstr("'tint' of a mesh pass reads Color, which the vertices of an object in view lack"));
    const Texture own = film();
    const MaterialInstance loop =
            instance(meshText("loop", "parameters : [ { type : sampler2d, name : paper } ]",
                              "material.baseColor = texelFetch(materialParams_paper, ivec2(0), 0);"));
    ASSERT_TRUE(engine.set(loop, "paper", own));
    EXPECT_THAT(refused({ .material = loop }, target({ .color = own })),
                HasSubstr("'loop' of a mesh pass samples by 'paper' what the frame draws to; draw to another"));
    renderer.render(scene, { .material = tinted(float4(1)) }, one, view);
    EXPECT_EQ(halfPixel(pixelsOf(one), 6, 15), float4(1)) << "the next pass is drawn";
}

TEST_P(MeshPassTest, ExpectedPassesMakeTheirPipelines) {
    const RenderTarget one = target({ .color = film() }), two = target({ .color = film(), .others = { film() } });
    const MaterialInstance mask = tinted(float4(1)),
                           pair = instance(meshText("pair", "culling : none, outputs : [ { name : a }, { name : b } ]",
                                                    "material.b = vec4(0.5);")),
                           alone = instance(test::passText("", "inputs.color = vec4(1.0);", "alone"));
    renderer.prewarm(scene, { .material = mask }, one, view);
    renderer.prewarm(scene, { .material = pair }, two, view);
    renderer.prewarm(alone, one, view);
    const auto asked = engine.compile(solid);
    ASSERT_TRUE(asked);
    while (!engine.progress(*asked).isComplete()) engine.waitIdle();
    engine.waitIdle();
    const uint64_t before = engine.statistics().pipelinesCreated, programs = engine.statistics().programsCreated;
    renderer.render(scene, { .material = mask }, one, view);
    renderer.render(scene, { .material = pair }, two, view);
    renderer.render(alone, one, view);
    engine.waitIdle();
    EXPECT_EQ(engine.statistics().pipelinesCreated, before);
    EXPECT_EQ(engine.statistics().programsCreated, programs);
    renderer.render(scene, { .material = tinted(float4(1)) }, one, view);
    engine.waitIdle();
    EXPECT_GT(engine.statistics().pipelinesCreated, before) << "this is what the lines above would notice";
}

TEST_P(MeshPassTest, InAViewAMaterialWithAnOutputShowsIt) {
    Scene shown(engine);
    square.add(shown, tinted({ 0.25f, 0.5f, 0.75f, 1 }));
    EXPECT_EQ(halfPixel(renderLinear(engine, shown, view), 12, 12), float4(0.25f, 0.5f, 0.75f, 1));
}

// Its program may be there, of a mesh pass. What else is in view is drawn.
TEST_P(MeshPassTest, InAViewAMaterialWithSeveralOutputsIsNamedAndNotDrawn) {
    const MaterialInstance three = instance(kThreeOfMeshes);
    Scene shown(engine);
    square.add(shown, three);
    const RenderTarget all = target({ .color = film(), .others = { film(), film() } });
    renderer.render(shown, { .material = three }, all, view);
    EXPECT_GT(covered(all), 0u);
    const Image empty = renderLinear(engine, renderer, Scene(engine), view);
    EXPECT_EQ(renderLinear(engine, renderer, shown, view).pixels, empty.pixels);
    EXPECT_THAT(error(), HasSubstr("material 'three' has several outputs, and views draw to one colour: draw the "
                                   "objects that have it by a mesh pass"));
    EXPECT_EQ(renderLinear(engine, renderer, shown, view).pixels, empty.pixels);
    EXPECT_THAT(engine.takeErrors(), testing::IsEmpty()) << "it is said once";
    renderer.render(shown, { .material = three }, all, view);
    EXPECT_GT(covered(all), 0u) << "mesh passes still do";
}

} // namespace
} // namespace filament_core
