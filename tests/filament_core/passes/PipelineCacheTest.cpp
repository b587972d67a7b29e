// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/passes/DrawFixture.h"

#include <gmock/gmock.h>

#include <map>
#include <tuple>
#include <unordered_map>

namespace filament_core::passes {
namespace {

using namespace backend;
using prepare::DrawCall;

struct CreatedPipelines {
    std::vector<PipelineHandle> pipelines;
    std::vector<PipelineDesc> descs; ///< without what they point to
    std::vector<std::string> names;
    uint32_t programs = 0, destroyedPipelines = 0, destroyedPrograms = 0;
    void execute(CmdCreatePipeline const& c) {
        pipelines.push_back(c.handle);
        descs.push_back(c.desc);
        descs.back().debugName = {};
        names.emplace_back(c.desc.debugName);
    }
    void execute(CmdCreateProgram const&) { ++programs; }
    void execute(CmdDestroyPipeline const&) { ++destroyedPipelines; }
    void execute(CmdDestroyProgram const&) { ++destroyedPrograms; }
    void execute(auto const&) {}
};

CreatedPipelines createdBy(CommandBuffer const& setup) {
    CreatedPipelines created;
    replay(setup.view(), created);
    return created;
}

TEST(ChoosePipelines, OneForEachMaterialLayoutAndWindingMadeInTheOrderOfDrawing) {
    DrawFixture fixture(6, 50, 20);
    const std::vector<DrawCall> draws = fixture.randomDraws(3000, 5);
    CommandBuffer setup;
    const std::vector<PipelineHandle> chosen = fixture.choose(draws, setup);
    std::map<std::tuple<uint32_t, uint32_t, bool>, PipelineHandle> expected;
    std::vector<PipelineHandle> inOrder;
    for (size_t i = 0; i < draws.size(); ++i) {
        const std::tuple key{ draws[i].material->material->id, draws[i].geometry->layout, draws[i].mirrored };
        const auto [entry, isNew] = expected.try_emplace(key, chosen[i]);
        if (isNew) inOrder.push_back(chosen[i]);
        ASSERT_EQ(chosen[i], entry->second) << "draw " << i;
    }
    const CreatedPipelines created = createdBy(setup);
    EXPECT_EQ(created.pipelines, inOrder);
    EXPECT_EQ(created.programs, 6u);
    EXPECT_EQ(fixture.pipelines->size(), expected.size());
}

TEST(ChoosePipelines, ASecondFrameMakesNothing) {
    DrawFixture fixture(6, 50, 20);
    const std::vector<DrawCall> draws = fixture.randomDraws(3000, 6);
    CommandBuffer first, second;
    const auto chosen = fixture.choose(draws, first);
    EXPECT_EQ(fixture.choose(draws, second), chosen);
    EXPECT_EQ(second.commandCount(), 0u);
}

TEST(ChoosePipelines, AFilteredVariantGivesNoneAndOneRefusal) {
    DrawFixture fixture(1, 4, 1);
    fixture.materials[0].name = "filtered";
    fixture.materials[0].package.filteredVariants = shader::kVariantSun | shader::kVariantFog;
    const std::vector<DrawCall> draws = fixture.randomDraws(100, 7);
    CommandBuffer setup;
    for (int frame = 0; frame < 2; ++frame) {
        EXPECT_THAT(fixture.choose(draws, setup, nullptr, shader::kVariantSun), testing::Each(PipelineHandle{}));
    }
    EXPECT_EQ(setup.commandCount(), 0u);
    EXPECT_THAT(
            fixture.pipelines->takeRefusals(),
            testing::ElementsAre("material 'filtered': variant 'directionalLighting' is asked for, but it was compiled "
                                 "without 'directionalLighting' (variantFilter): it is not drawn; compile it without "
                                 "that filter"))
            << "front and back faces are two pipelines, and one line";
    EXPECT_THAT(fixture.pipelines->takeRefusals(), testing::IsEmpty());
}

TEST(ChoosePipelines, UnlitMaterialsShareOnePipelineBetweenVariants) {
    DrawFixture fixture(1, 1, 1);
    fixture.materials[0].package.shading = shader::ShadingModel::Unlit;
    const std::vector<DrawCall> draws{ fixture.draw(0, 0, 0) };
    CommandBuffer setup;
    const auto lit = fixture.choose(draws, setup, nullptr, shader::kVariantSun);
    EXPECT_TRUE(lit[0]);
    EXPECT_EQ(fixture.choose(draws, setup), lit);
}

TEST(ChoosePipelines, HalfPrecisionTakesAProgramOfItsOwnWhereTheMaterialHasOneAndElseTheFullOne) {
    DrawFixture fixture(2, 2, 1);
    fixture.materials[0].package.variants.push_back({ .key = shader::kVariantHalf,
                                                      .vertex = shader::sharedStage({ { 1 }, "" }),
                                                      .fragment = shader::sharedStage({ { 3 }, "" }) });
    const std::vector<DrawCall> draws{ fixture.draw(0, 0, 0), fixture.draw(1, 0, 1) };
    CommandBuffer setup;
    const auto full = fixture.choose(draws, setup);
    fixture.slot = fixture.pipelines->slot({ .precision = ShadingPrecision::Half });
    const auto half = fixture.choose(draws, setup);
    EXPECT_THAT(half, testing::Each(testing::Ne(PipelineHandle{})));
    EXPECT_NE(half[0], full[0]);
    EXPECT_EQ(fixture.pipelines->programCount(fixture.materials[0]), 2u);
    EXPECT_EQ(fixture.pipelines->programCount(fixture.materials[1]), 1u);
}

TEST(ChoosePipelines, APictureThatIsMirroredOrRefractedChangesOnlyMaterialsThatReadIt) {
    DrawFixture fixture(3, 3, 1);
    fixture.materials[1].package.refractionMode = shader::RefractionMode::ScreenSpace;
    fixture.materials[2].package.reflections = shader::Reflections::ScreenSpace;
    fixture.materials[2].package.shading = shader::ShadingModel::Lit;
    const std::vector<DrawCall> draws{ fixture.draw(0, 0, 0), fixture.draw(1, 0, 1), fixture.draw(2, 0, 2) };
    CommandBuffer setup;
    const auto chooseWith = [&](ShadedScreen const& screen) {
        fixture.slot = fixture.pipelines->slot({ .shading = shadingKey({}, {}, {}, screen) });
        (void)fixture.choose(draws, setup);
    };
    chooseWith({});
    chooseWith({ .hasRefraction = true });
    chooseWith({ .hasReflections = true });
    EXPECT_EQ(fixture.pipelines->programCount(fixture.materials[0]), 1u);
    EXPECT_EQ(fixture.pipelines->programCount(fixture.materials[1]), 2u);
    EXPECT_EQ(fixture.pipelines->programCount(fixture.materials[2]), 2u);
}

/// The pipelines of both passes of a material that blends, in a pass with a depth buffer.
std::vector<PipelineDesc> twoPassesOf(shader::TransparencyMode transparency, bool depthWrite) {
    DrawFixture fixture(1, 1, 1);
    shader::MaterialPackage& package = fixture.materials[0].package;
    package.blending = shader::Blending::Transparent;
    package.transparency = transparency;
    package.depthWrite = depthWrite;
    PassSlot slot{ .layout = { .depthFormat = Format::D32F } };
    slot.layout.subpasses[0].usesDepth = true;
    fixture.slot = fixture.pipelines->slot(slot);
    std::vector<DrawCall> draws(3, fixture.draw(0, 0, 0));
    draws[0].pass = prepare::DrawPass::First;
    draws[1].pass = prepare::DrawPass::Second;
    CommandBuffer setup;
    const auto chosen = fixture.choose(draws, setup);
    EXPECT_EQ(fixture.pipelines->size(), 3u) << "either pass, and a single one, have a pipeline of their own";
    EXPECT_EQ(createdBy(setup).programs, 1u);
    return createdBy(setup).descs;
}

TEST(PipelineCache, OneSideDrawsDepthAloneAndThenTheColorOfWhatIsNearest) {
    for (const bool depthWrite : { false, true }) {
        const auto descs = twoPassesOf(shader::TransparencyMode::TwoPassesOneSide, depthWrite);
        ASSERT_EQ(descs.size(), 3u);
        PipelineDesc depthOnly = descs[2];
        depthOnly.depthStencil.depthWrite = true;
        EXPECT_EQ(descs[0].depthStencil, depthOnly.depthStencil);
        EXPECT_EQ(descs[0].raster, depthOnly.raster);
        for (BlendState const& blend : descs[0].blend) EXPECT_EQ(blend.writeMask, 0);
        EXPECT_EQ(descs[1].depthStencil.depthCompare, CompareOp::GreaterEqual) << "equal depths pass";
        EXPECT_EQ(descs[1].depthStencil, descs[2].depthStencil);
        EXPECT_EQ(descs[1].blend, descs[2].blend);
    }
}

TEST(PipelineCache, TwoSidesDrawTheBackFacesAndThenTheFrontFaces) {
    const auto descs = twoPassesOf(shader::TransparencyMode::TwoPassesTwoSides, false);
    ASSERT_EQ(descs.size(), 3u);
    EXPECT_EQ(descs[0].raster.cull, CullMode::Front);
    EXPECT_EQ(descs[1].raster.cull, CullMode::Back);
    for (int pass = 0; pass < 2; ++pass) {
        EXPECT_EQ(descs[pass].depthStencil, descs[2].depthStencil);
        EXPECT_EQ(descs[pass].blend, descs[2].blend);
    }
}

/// The pipeline of a material that blends in any order, by what the pass is for.
PipelineDesc composing(shader::TransparencyTerm term, shader::ShadingModel shading = shader::ShadingModel::Lit) {
    DrawFixture fixture(1, 1, 1);
    shader::MaterialPackage& package = fixture.materials[0].package;
    package.shading = shading;
    package.blending = shader::Blending::Fade;
    fixture.instances[0].raster.depthWrite = false;
    PassSlot slot{ .layout = { .depthFormat = Format::D32F }, .transparency = term };
    slot.layout.subpasses[0].usesDepth = true;
    fixture.slot = fixture.pipelines->slot(slot);
    CommandBuffer setup;
    (void)fixture.choose(std::vector{ fixture.draw(0, 0, 0) }, setup);
    return createdBy(setup).descs.at(0);
}

TEST(PipelineCache, EachPassOfTransparencyBlendsAndLeavesDepthAsItsSumNeeds) {
    using enum BlendFactor;
    const auto expectBlendState = [](shader::TransparencyTerm term, BlendState const& expected) {
        const PipelineDesc desc = composing(term);
        EXPECT_EQ(desc.blend[0], expected) << int{ term };
        EXPECT_FALSE(desc.depthStencil.depthWrite) << int{ term };
        EXPECT_EQ(desc.depthStencil.depthCompare, CompareOp::GreaterEqual) << int{ term };
    };
    const auto expectBlend = [&](shader::TransparencyTerm term, BlendFactor source, BlendFactor target) {
        expectBlendState(
                term,
                { .enabled = true, .srcColor = source, .dstColor = target, .srcAlpha = source, .dstAlpha = target });
    };
    expectBlend(shader::kTransparencyInOrder, One, OneMinusSrcAlpha);
    expectBlend(shader::kTransparencyBeyond, One, OneMinusSrcAlpha);
    expectBlend(shader::kTransparencyCover, One, OneMinusSrcAlpha);
    expectBlend(shader::kTransparencyWeightedLight, One, One);
    expectBlendState(
            shader::kTransparencyLayer,
            { .enabled = true, .srcColor = DstAlpha, .dstColor = One, .srcAlpha = Zero, .dstAlpha = OneMinusSrcAlpha });
    for (const auto term : { shader::kTransparencyDepth, shader::kTransparencyNextDepth }) {
        const PipelineDesc desc = composing(term);
        EXPECT_EQ(desc.blend[0].writeMask, 0);
        EXPECT_TRUE(desc.depthStencil.depthWrite);
        EXPECT_EQ(desc.depthStencil.depthCompare, CompareOp::GreaterEqual);
    }
}

TEST(PipelineCache, WhereAlphaAloneCountsALitMaterialTakesTheProgramWithoutLight) {
    DrawFixture fixture(1, 1, 1);
    shader::MaterialPackage& package = fixture.materials[0].package;
    package.shading = shader::ShadingModel::Lit;
    package.blending = shader::Blending::Transparent;
    const std::vector<DrawCall> draws{ fixture.draw(0, 0, 0) };
    CommandBuffer setup;
    for (const uint8_t variant : { uint8_t{ 0 }, uint8_t{ shader::kVariantSun } }) {
        for (const auto term :
             { shader::kTransparencyCover, shader::kTransparencyDepth, shader::kTransparencyNextDepth }) {
            fixture.slot = fixture.pipelines->slot(
                    { .shading = shadingKey({ .fresnel = FresnelTerm::Exact }), .transparency = term });
            EXPECT_TRUE(fixture.choose(draws, setup, nullptr, variant)[0]);
        }
    }
    EXPECT_EQ(fixture.pipelines->programCount(fixture.materials[0]), 3u) << "one for each term";
}

TEST(PipelineCache, CullingOfBothFacesLeavesNoTraceInTheDepthBuffer) {
    DrawFixture fixture(1, 1, 1);
    fixture.instances[0].raster.culling = shader::Culling::FrontAndBack;
    PassSlot slot{ .layout = { .depthFormat = Format::D32F } };
    slot.layout.subpasses[0].usesDepth = true;
    fixture.slot = fixture.pipelines->slot(slot);
    CommandBuffer setup;
    fixture.choose(std::vector{ fixture.draw(0, 0, 0) }, setup);
    const auto descs = createdBy(setup).descs;
    ASSERT_EQ(descs.size(), 1u);
    EXPECT_FALSE(descs[0].depthStencil.depthWrite);
    EXPECT_EQ(descs[0].blend[0].writeMask, 0);
}

TEST(PipelineCache, EveryRasterStateOfAnInstanceHasAPipelineOfItsOwn) {
    DrawFixture fixture(1, 1, 1);
    PassSlot slot{ .layout = { .depthFormat = Format::D32F } };
    slot.layout.subpasses[0].usesDepth = true;
    fixture.slot = fixture.pipelines->slot(slot);
    std::vector<scene::InstanceRaster> states;
    for (const shader::Culling culling :
         { shader::Culling::None, shader::Culling::Front, shader::Culling::Back, shader::Culling::FrontAndBack }) {
        for (uint32_t flags = 0; flags < 16; ++flags)
            states.push_back({ culling, (flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0, (flags & 8) != 0 });
    }
    CommandBuffer setup;
    std::map<PipelineHandle, size_t> pipelines;
    for (size_t i = 0; i < states.size(); ++i) {
        fixture.instances[0].raster = states[i];
        const PipelineHandle pipeline = fixture.choose(std::vector{ fixture.draw(0, 0, 0) }, setup)[0];
        ASSERT_TRUE(pipelines.emplace(pipeline, i).second) << i;
    }
    const auto descs = createdBy(setup).descs;
    ASSERT_EQ(descs.size(), states.size());
    for (size_t i = 0; i < states.size(); ++i) {
        const bool isVisible = states[i].culling != shader::Culling::FrontAndBack || states[i].cullingDisabled;
        EXPECT_EQ(descs[i].blend[0].writeMask != 0, states[i].colorWrite && isVisible) << i;
        const bool writesDepth = states[i].depthWrite && isVisible;
        const CompareOp compare = states[i].depthCulling ? CompareOp::GreaterEqual
                                  : writesDepth          ? CompareOp::Always
                                                         : CompareOp::None;
        EXPECT_EQ(descs[i].depthStencil.depthCompare, compare) << i;
        EXPECT_EQ(descs[i].depthStencil.depthWrite, writesDepth) << i;
    }
}

TEST(PipelineCache, AMaterialForPicturesIsRefusedAsASurfaceAndSaysSoOnce) {
    DrawFixture fixture(1, 1, 1);
    fixture.materials[0].package.domain = shader::MaterialDomain::PostProcess;
    CommandBuffer setup;
    for (int frame = 0; frame < 2; ++frame) {
        EXPECT_THAT(fixture.choose(std::vector{ fixture.draw(0, 0, 0), fixture.draw(0, 0, 1, true) }, setup),
                    testing::Each(PipelineHandle{}));
    }
    EXPECT_EQ(setup.commandCount(), 0u);
    EXPECT_THAT(
            fixture.pipelines->takeRefusals(),
            testing::ElementsAre(testing::HasSubstr("is of domain postprocess: it draws pictures, not the surfaces")));
}

TEST(PipelineCache, ForgettingAMaterialDestroysWhatWasMadeOfItAndNothingElse) {
    DrawFixture fixture(3, 9, 2);
    const std::vector<DrawCall> draws = fixture.randomDraws(500, 8);
    CommandBuffer setup, commands;
    const auto chosen = fixture.choose(draws, setup);
    const size_t all = createdBy(setup).pipelines.size();
    const uint32_t live = fixture.stream->liveHandles();
    fixture.pipelines->forget(commands, fixture.materials[1]);
    const CreatedPipelines forgotten = createdBy(commands);
    EXPECT_EQ(forgotten.destroyedPrograms, 1u);
    EXPECT_EQ(fixture.pipelines->size(), all - forgotten.destroyedPipelines);
    EXPECT_EQ(fixture.stream->liveHandles(), live - forgotten.destroyedPipelines - 1);
    CommandBuffer again;
    const auto rechosen = fixture.choose(draws, again);
    EXPECT_EQ(createdBy(again).pipelines.size(), forgotten.destroyedPipelines);
    for (size_t i = 0; i < draws.size(); ++i)
        EXPECT_EQ(rechosen[i] == chosen[i], draws[i].material->material != &fixture.materials[1]);
}

TEST(PipelineCache, TwoCachesOfOneMaterialKnowNothingOfEachOther) {
    DrawFixture fixture(1, 1, 1);
    const std::vector<DrawCall> draws{ fixture.draw(0, 0, 0) };
    CommandBuffer setup, commands;
    const PipelineHandle first = fixture.choose(draws, setup)[0];
    PipelineCache other(*fixture.stream, fixture.layouts);
    EXPECT_EQ(other.programCount(fixture.materials[0]), 0u);
    const PipelineUse use{ .instance = *draws[0].material, .geometryLayout = draws[0].geometry->layout };
    const PipelineHandle second = other.pipelineFor(setup, other.slot({}), use);
    EXPECT_NE(second, first);
    EXPECT_EQ(createdBy(setup).programs, 2u);
    other.forget(commands, fixture.materials[0]);
    EXPECT_EQ(createdBy(commands).destroyedPrograms, 1u);
    EXPECT_EQ(fixture.choose(draws, commands)[0], first);
}

// ---------------------------------------------------------------------------------------------- the table itself

TEST(PipelineTable, AnswersAsAMapDoesThroughInsertionsAndRemovals) {
    PipelineTable table;
    std::unordered_map<uint64_t, uint32_t> map;
    std::mt19937_64 random(9);
    for (uint32_t step = 0; step < 20'000; ++step) {
        const uint64_t key = 1 + random() % 3000 * 0x1'0000'0001ull; // upper and lower bits vary together
        PipelineTable::Entry const* entry = table.find(key);
        ASSERT_EQ(entry != nullptr, map.contains(key)) << step;
        if (entry)
            ASSERT_EQ(entry->material, map[key]);
        else
            table.insert({ key, PipelineHandle::make(step & 1023, 1), map[key] = step });
        if (step % 4000 == 3999) {
            table.eraseIf([&](PipelineTable::Entry const& e) { return e.material % 2 == 0; });
            std::erase_if(map, [](auto const& item) { return item.second % 2 == 0; });
        }
        ASSERT_EQ(table.size(), map.size());
    }
}

// The keys differ only in the bits of the material or of the layout; a hash of some of the bits would make them
// collide.
TEST(PipelineTable, SpreadsKeysThatDifferInAnyOfTheirFields) {
    for (const int shift : { 0, 4, 8, 20, 32, 40 }) {
        PipelineTable table;
        for (uint64_t i = 0; i < 2000; ++i) table.insert({ uint64_t{ 1 } << 63 | i << shift, {}, 0 });
        EXPECT_LT(table.longestProbe(), 40u) << "bits from " << shift;
    }
}

TEST(PipelineTableDeathTest, InsertingAKeyTwice) {
    PipelineTable table;
    table.insert({ 5, {}, 0 });
    EXPECT_DEATH(table.insert({ 5, {}, 0 }), "a pipeline is inserted once");
}

} // namespace
} // namespace filament_core::passes
