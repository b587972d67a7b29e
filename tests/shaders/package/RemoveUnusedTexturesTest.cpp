// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/RemoveUnusedTextures.h"

#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"
#include "tests/shaders/EditStage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace filament_core::shader {
namespace {

using backend::BindingType;
using backend::ConstantValue;

constexpr uint32_t kOpDecorate = 4u << 16 | 71, kBinding = 33, kDescriptorSet = 34;

/// The annotations of a module that has variable 10 + n at binding n of the material group, one variable at binding 2
/// of the Pass group, and a function.
std::vector<uint32_t> module(uint32_t textures) {
    std::vector<uint32_t> words{ 0x07230203, 0x10300, 0, 100, 0 };
    const auto decorate = [&](uint32_t id, uint32_t decoration, uint32_t value) {
        words.insert(words.end(), { kOpDecorate, id, decoration, value });
    };
    for (uint32_t n = 1; n <= textures; ++n) {
        decorate(10 + n, kBinding, n); // in either order
        decorate(10 + n, kDescriptorSet, kGroupMaterial);
    }
    decorate(50, kDescriptorSet, kGroupPass);
    decorate(50, kBinding, 2);
    words.insert(words.end(), { 5u << 16 | 54, 1, 2, 0, 3, kOpDecorate, 12, kBinding, 2 });
    return words;
}

uint32_t bindingOf(std::vector<uint32_t> const& words, uint32_t id) {
    for (size_t at = 5; at + 3 < words.size(); at += words[at] >> 16) {
        if (words[at] == kOpDecorate && words[at + 1] == id && words[at + 2] == kBinding) return words[at + 3];
    }
    return ~0u;
}

/// The first unit behind the textures of the pass.
int firstUnit() { return static_cast<int>(samplerCount(passGroupLayout(PassKind::Lit))); }

std::string cubeAt(int unit) {
    return "layout(binding = " + std::to_string(unit) + ") uniform highp samplerCube cube;\n";
}

std::string samplerAt(int unit, std::string const& name) {
    return "layout(binding = " + std::to_string(unit) + ") uniform highp sampler2D " + name + ";\n";
}

/// A lit material: a block, textures 1 to 4 (`always`, then one per constant with ids 0, 1, 2), a cube at 5 for
/// constant 3.
MaterialPackage fourTextures() {
    MaterialPackage package;
    package.layout[kGroupView] = viewGroupLayout();
    package.layout[kGroupPass] = passGroupLayout(PassKind::Lit);
    backend::BindGroupLayout& group = package.layout[kGroupMaterial];
    group.bindings[group.count++] = { .binding = 0, .type = BindingType::UniformBuffer };
    const char* const names[] = { "always", "a", "b", "c", "cube" };
    for (uint8_t n = 1; n <= 5; ++n) {
        Parameter parameter{ .name = names[n - 1], .type = ParameterType::Sampler2D, .binding = n };
        if (n == 5) parameter.type = ParameterType::SamplerCube;
        if (n > 1) {
            parameter.usedIf = { n - 2u };
            package.constants.push_back({ .name = "has " + parameter.name, .id = n - 2u });
        }
        package.parameters.push_back(parameter);
        group.bindings[group.count++] = { .binding = n, .type = BindingType::SampledTexture };
    }
    // Units: those of the pass, five of the material, then those of the Deformation group.
    std::string essl = "layout(binding = 4, std140) uniform MaterialParams\n{ vec4 x; };\n" + samplerAt(2, "passDfg");
    for (int n = 0; n < 4; ++n) essl += samplerAt(firstUnit() + n, names[n]);
    essl += cubeAt(firstUnit() + 4);
    package.variants.push_back(
            { .key = kVariantSkinning,
              .vertex = sharedStage(
                      { {}, samplerAt(firstUnit() + 5, "boneRows") + samplerAt(firstUnit() + 6, "morphDeltas") }),
              .fragment = sharedStage({ module(5), essl }) });
    return package;
}

std::vector<uint8_t> bindingsOf(MaterialPackage const& package) {
    std::vector<uint8_t> bindings;
    for (uint32_t i = 0; i < package.layout[kGroupMaterial].count; ++i)
        bindings.push_back(package.layout[kGroupMaterial].bindings[i].binding);
    return bindings;
}

TEST(RemoveUnusedTextures, LeavesAMaterialAloneWhoseConstantsAreAllTrue) {
    MaterialPackage package = fourTextures();
    const std::vector<ConstantValue> all{ { 0, 1 }, { 1, 1 }, { 2, 1 }, { 3, 1 } };
    removeUnusedTextures(package, all);
    EXPECT_EQ(package, fourTextures());
}

TEST(RemoveUnusedTextures, TakesTheDefaultOfAConstantThatIsNotGiven) {
    MaterialPackage package = fourTextures();
    for (Constant& constant : package.constants) constant.defaultBits = constant.id != 1;
    removeUnusedTextures(package, {});
    EXPECT_EQ(bindingsOf(package), (std::vector<uint8_t>{ 0, 1, 2, 4, 5 }));
}

TEST(RemoveUnusedTextures, GivesWhatIsTakenOutTheBindingOfATextureOfItsType) {
    MaterialPackage package = fourTextures();
    removeUnusedTextures(package, std::vector<ConstantValue>{ { 1, 1 } }); // b is used
    EXPECT_EQ(bindingsOf(package), (std::vector<uint8_t>{ 0, 1, 3, 5 })) << "nothing else is a cube, so one stays";
    const bool isBound[] = { true, false, true, false, true };
    for (size_t i = 0; i < 5; ++i) EXPECT_EQ(package.parameters[i].isBound, isBound[i]) << i;

    std::vector<uint32_t> const& words = package.variants[0].fragment->spirv;
    const uint32_t bindings[] = { 1, 1, 3, 1, 5 };
    for (uint32_t n = 1; n <= 5; ++n) EXPECT_EQ(bindingOf(words, 10 + n), bindings[n - 1]) << n;
    EXPECT_EQ(bindingOf(words, 50), 2u) << "of another group";
    EXPECT_EQ(words.back(), 2u) << "in a function nothing is a decoration";
}

TEST(RemoveUnusedTextures, MovesTheUnitsOfOpenGlUpInEveryGroupBehind) {
    MaterialPackage package = fourTextures();
    removeUnusedTextures(package, std::vector<ConstantValue>{ { 1, 1 } });
    Variant const& variant = package.variants[0];
    const std::string expected = "layout(binding = 4, std140) uniform MaterialParams\n{ vec4 x; };\n" +
                                 samplerAt(2, "passDfg") + samplerAt(firstUnit(), "always") +
                                 samplerAt(firstUnit(), "a") + samplerAt(firstUnit() + 1, "b") +
                                 samplerAt(firstUnit(), "c") + cubeAt(firstUnit() + 2);
    EXPECT_EQ(variant.fragment->essl, expected);
    EXPECT_EQ(variant.vertex->essl, samplerAt(firstUnit() + 3, "boneRows") + samplerAt(firstUnit() + 4, "morphDeltas"));
    const backend::ProgramLayout layout = programLayout(package, kVariantSkinning);
    EXPECT_EQ(backend::flatBinding(layout, kGroupMaterial, 5), firstUnit() + 2);
    EXPECT_EQ(backend::flatBinding(layout, kGroupDeformation, kBindingBones), firstUnit() + 3);
    EXPECT_EQ(backend::flatBinding(layout, kGroupDeformation, kBindingMorphDeltas), firstUnit() + 4);
}

TEST(RemoveUnusedTextures, KeepsOneOfAKindWhereNoneIsUsed) {
    MaterialPackage package = fourTextures();
    package.parameters[0].usedIf = { 0 };
    removeUnusedTextures(package, {});
    EXPECT_EQ(bindingsOf(package), (std::vector<uint8_t>{ 0, 1, 5 }));
}

TEST(RemoveUnusedTextures, SurvivesCodeThatIsNone) {
    std::mt19937 random(7);
    for (int round = 0; round < 20'000; ++round) {
        MaterialPackage package = fourTextures();
        Variant& variant = package.variants[0];
        for (uint32_t edits = 1 + random() % 4; edits > 0; --edits) {
            StageCode& code = test::editable(variant.fragment);
            std::vector<uint32_t>& words = code.spirv;
            words[random() % words.size()] = random() % 3 == 0 ? 0 : static_cast<uint32_t>(random());
            std::string& text = code.essl;
            text[random() % text.size()] = static_cast<char>('0' + random() % 10);
            if (random() % 8 == 0) text.resize(1 + random() % text.size());
            if (random() % 8 == 0) words.resize(1 + random() % words.size());
        }
        const size_t words = variant.fragment->spirv.size();
        removeUnusedTextures(package, {});
        ASSERT_EQ(variant.fragment->spirv.size(), words);
    }
}

} // namespace
} // namespace filament_core::shader
