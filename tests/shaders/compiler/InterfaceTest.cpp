// SPDX-License-Identifier: Apache-2.0
// Compares shaders/interface/interface.glsl with shaders/interface/ShaderInterface.h, by reflection.
#include "shaders/interface/ShaderInterface.h"

#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/package/GroupLayouts.h"

#include <gtest/gtest.h>
#include <spirv_cross/spirv_cross.hpp>

#include <algorithm>
#include <cstddef>

namespace filament_core::shader {
namespace {

struct Member {
    const char* name;
    size_t offset;
};

std::string interfaceText() {
    const auto text = embeddedSource("shaders/interface/interface.glsl");
    EXPECT_TRUE(text);
    return "#version 450\n#define HAS_SECTION_PLANES\n" + std::string(text.value_or(""));
}

/// Reflects a fragment shader that reads every block and texture of the interface.
class Interface : public ::testing::Test {
protected:
    explicit Interface(std::vector<uint32_t> spirv = compiled()) : mCompiler(std::move(spirv)) {}

    static std::vector<uint32_t> compiled() {
        const Result<std::vector<uint32_t>> spirv = spirvFromGlsl(interfaceText() + R"(
            layout(location = 0) out vec4 color;
            void main() {
                color = frameUniforms.exposure + objectUniforms.objects[0].row0 + lightBuffer.lights[0].offset
                        + vec4(froxelBuffer.words[0])
                        + passUniforms.target + texture(passSpecular, vec3(1.0)) + texture(passDfg, vec2(0.5))
                        + texture(passIrradiance, vec3(1.0)) + texture(passShadowMaps, vec2(0.5))
                        + shadowUniforms.maps[0].texel;
            })",
                                                                  backend::ShaderStage::Fragment, "interface");
        EXPECT_TRUE(spirv) << (spirv ? "" : spirv.error().message);
        return spirv ? *spirv : std::vector<uint32_t>{};
    }

    /// A uniform or storage block.
    spirv_cross::Resource block(uint32_t group, uint32_t binding) {
        const spirv_cross::ShaderResources all = mCompiler.get_shader_resources();
        for (auto const* buffers : { &all.uniform_buffers, &all.storage_buffers }) {
            for (auto const& buffer : *buffers) {
                if (mCompiler.get_decoration(buffer.id, spv::DecorationDescriptorSet) == group &&
                    mCompiler.get_decoration(buffer.id, spv::DecorationBinding) == binding)
                    return buffer;
            }
        }
        ADD_FAILURE() << "no block at binding " << binding << " of group " << group;
        return {};
    }

    void expectMembers(spirv_cross::SPIRType const& type, std::vector<Member> const& members) {
        ASSERT_EQ(type.member_types.size(), members.size()) << "a member is missing in one of the two files";
        for (uint32_t i = 0; i < members.size(); ++i) {
            EXPECT_EQ(mCompiler.get_member_name(type.self, i), members[i].name);
            EXPECT_EQ(mCompiler.type_struct_member_offset(type, i), members[i].offset) << members[i].name;
        }
    }

    /// The record type of a block that holds one array.
    spirv_cross::SPIRType const& record(spirv_cross::SPIRType const& block) {
        return mCompiler.get_type(mCompiler.get_type(block.member_types[0]).parent_type);
    }

    spirv_cross::Compiler mCompiler;
};

#define MEMBER(type, name)                                                                                             \
    Member { #name, offsetof(type, name) }

TEST_F(Interface, FrameUniformsAgree) {
    const auto& type = mCompiler.get_type(block(kGroupView, kBindingFrame).base_type_id);
    expectMembers(type, { MEMBER(FrameUniforms, clipFromWorld),
                          MEMBER(FrameUniforms, worldFromClip),
                          MEMBER(FrameUniforms, viewFromWorld),
                          MEMBER(FrameUniforms, clipFromView),
                          MEMBER(FrameUniforms, cameraPosition),
                          MEMBER(FrameUniforms, exposure),
                          MEMBER(FrameUniforms, time),
                          MEMBER(FrameUniforms, sunDirection),
                          MEMBER(FrameUniforms, sunIlluminance),
                          MEMBER(FrameUniforms, ambient),
                          MEMBER(FrameUniforms, skyFactor),
                          MEMBER(FrameUniforms, irradianceSh),
                          MEMBER(FrameUniforms, worldFromEnvironment),
                          MEMBER(FrameUniforms, materialGlobals),
                          MEMBER(FrameUniforms, froxelGrid),
                          MEMBER(FrameUniforms, froxelPlaces),
                          MEMBER(FrameUniforms, fogMedium),
                          MEMBER(FrameUniforms, fogLight),
                          MEMBER(FrameUniforms, fogSun),
                          MEMBER(FrameUniforms, fogSunDirection),
                          MEMBER(FrameUniforms, fogGrid),
                          MEMBER(FrameUniforms, fogScattering),
                          MEMBER(FrameUniforms, fogNoise),
                          MEMBER(FrameUniforms, fogVariation),
                          MEMBER(FrameUniforms, contactShadows),
                          MEMBER(FrameUniforms, skyGround),
                          MEMBER(FrameUniforms, jitter),
                          MEMBER(FrameUniforms, sectionPlanes),
                          MEMBER(FrameUniforms, section),
                          MEMBER(FrameUniforms, sectionCap),
                          MEMBER(FrameUniforms, sectionHatch),
                          MEMBER(FrameUniforms, sectionHatchColor) });
    EXPECT_EQ(mCompiler.get_declared_struct_size(type), sizeof(FrameUniforms));
}

TEST_F(Interface, ObjectUniformsAgree) {
    const auto& type = mCompiler.get_type(block(kGroupView, kBindingObjects).base_type_id);
    expectMembers(type, { MEMBER(ObjectUniforms, objects) });
    EXPECT_EQ(mCompiler.get_declared_struct_size(type), sizeof(ObjectUniforms));
    expectMembers(record(type), { MEMBER(ObjectData, row0), MEMBER(ObjectData, row1), MEMBER(ObjectData, row2),
                                  MEMBER(ObjectData, flags) });
    EXPECT_EQ(mCompiler.type_struct_member_array_stride(type, 0), sizeof(ObjectData));
}

TEST_F(Interface, LightBufferAgrees) {
    const auto& type = mCompiler.get_type(block(kGroupView, kBindingLights).base_type_id);
    expectMembers(type, { { "lights", 0 } });
    expectMembers(record(type), { MEMBER(PunctualLight, positionRange), MEMBER(PunctualLight, colorIntensity),
                                  MEMBER(PunctualLight, directionScale), MEMBER(PunctualLight, offset) });
    EXPECT_EQ(mCompiler.type_struct_member_array_stride(type, 0), sizeof(PunctualLight));
}

TEST_F(Interface, FroxelBufferHasWords) {
    const auto& type = mCompiler.get_type(block(kGroupView, kBindingFroxels).base_type_id);
    expectMembers(type, { { "words", 0 } });
    EXPECT_EQ(mCompiler.type_struct_member_array_stride(type, 0), sizeof(uint32_t));
}

TEST_F(Interface, PassUniformsAgree) {
    const auto& type = mCompiler.get_type(block(kGroupPass, kBindingPass).base_type_id);
    expectMembers(type, { MEMBER(PassUniforms, target), MEMBER(PassUniforms, raster), MEMBER(PassUniforms, picture),
                          MEMBER(PassUniforms, reflection), MEMBER(PassUniforms, lastClipFromWorld),
                          MEMBER(PassUniforms, lastAlongView), MEMBER(PassUniforms, lastTime) });
    EXPECT_EQ(mCompiler.get_declared_struct_size(type), sizeof(PassUniforms));
}

TEST_F(Interface, ShadowUniformsAgree) {
    const auto& type = mCompiler.get_type(block(kGroupPass, kBindingShadows).base_type_id);
    expectMembers(type, { MEMBER(ShadowUniforms, atlas), MEMBER(ShadowUniforms, sun), MEMBER(ShadowUniforms, maps) });
    EXPECT_EQ(mCompiler.get_declared_struct_size(type), sizeof(ShadowUniforms));
    const auto& map = mCompiler.get_type(mCompiler.get_type(type.member_types[2]).parent_type);
    expectMembers(map, { MEMBER(ShadowMapRecord, atlasFromWorld), MEMBER(ShadowMapRecord, tile),
                         MEMBER(ShadowMapRecord, texel), MEMBER(ShadowMapRecord, softness) });
    EXPECT_EQ(mCompiler.type_struct_member_array_stride(type, 2), sizeof(ShadowMapRecord));
}

TEST_F(Interface, EveryResourceIsInTheLayoutOfItsGroup) {
    const std::array groups{ viewGroupLayout(), passGroupLayout(PassKind::LitScreen) };
    const spirv_cross::ShaderResources resources = mCompiler.get_shader_resources();
    constexpr size_t kShared = 1; // passProbes has the binding of passSpecular: a program reads one of them
    ASSERT_EQ(groups[0].count + groups[1].count + kShared,
              resources.uniform_buffers.size() + resources.storage_buffers.size() + resources.sampled_images.size());
    for (auto const& list : { resources.uniform_buffers, resources.storage_buffers, resources.sampled_images }) {
        for (auto const& resource : list) {
            const uint32_t group = mCompiler.get_decoration(resource.id, spv::DecorationDescriptorSet);
            ASSERT_LT(group, groups.size()) << resource.name;
            const uint32_t binding = mCompiler.get_decoration(resource.id, spv::DecorationBinding);
            const auto used = std::span(groups[group].bindings).first(groups[group].count);
            EXPECT_EQ(std::ranges::count(used, binding, &backend::BindingDesc::binding), 1) << resource.name;
        }
    }
}

TEST(GroupLayouts, EveryKindOfPassGroupIsPartOfThatOfSurfacesThatSeeThePicture) {
    const backend::BindGroupLayout largest = passGroupLayout(PassKind::LitScreen);
    const auto all = std::span(largest.bindings).first(largest.count);
    for (const PassKind kind : { PassKind::Lit, PassKind::Unlit, PassKind::Picture }) {
        const backend::BindGroupLayout layout = passGroupLayout(kind);
        EXPECT_EQ(layout.bindings[0].binding, kBindingPass);
        uint8_t before = 0;
        for (backend::BindingDesc const& binding : std::span(layout.bindings).first(layout.count)) {
            EXPECT_EQ(std::ranges::count(all, binding), 1) << int{ binding.binding };
            EXPECT_TRUE(binding.binding >= before) << "in the same order";
            before = binding.binding;
        }
    }
}

/// The vertex stage of deformed geometry reads every block and texture of the Deformation group.
class DeformationInterface : public Interface {
protected:
    DeformationInterface() : Interface(compiled()) {}

    static std::string text() {
        const auto own = embeddedSource("shaders/interface/deformation.glsl");
        EXPECT_TRUE(own);
        return std::string(own.value_or(""));
    }

    static std::vector<uint32_t> compiled() {
        const Result<std::vector<uint32_t>> spirv = spirvFromGlsl("#version 450\n" + text() + R"(
            layout(location = 0) in vec4 position;
            void main() {
                gl_Position = texelFetch(boneRows, ivec2(0), 0) + vec4(deformationUniforms.bones)
                        + deformationUniforms.shape
                        + texelFetch(morphDeltas, ivec2(0), 0);
            })",
                                                                  backend::ShaderStage::Vertex, "deformation");
        EXPECT_TRUE(spirv) << (spirv ? "" : spirv.error().message);
        return spirv ? *spirv : std::vector<uint32_t>{};
    }
};

TEST_F(DeformationInterface, BlocksAgree) {
    const auto& all = mCompiler.get_type(block(kGroupDeformation, kBindingDeformation).base_type_id);
    expectMembers(all, { MEMBER(DeformationUniforms, shape), MEMBER(DeformationUniforms, bones) });
    EXPECT_EQ(mCompiler.get_declared_struct_size(all), sizeof(DeformationUniforms));
}

TEST_F(DeformationInterface, EveryResourceIsInTheGroupsLayoutForTheVertexStage) {
    const backend::BindGroupLayout layout = deformationGroupLayout();
    const spirv_cross::ShaderResources resources = mCompiler.get_shader_resources();
    ASSERT_EQ(layout.count, resources.uniform_buffers.size() + resources.sampled_images.size());
    for (auto const& list : { resources.uniform_buffers, resources.sampled_images }) {
        for (auto const& resource : list) {
            EXPECT_EQ(mCompiler.get_decoration(resource.id, spv::DecorationDescriptorSet), kGroupDeformation);
            const uint32_t binding = mCompiler.get_decoration(resource.id, spv::DecorationBinding);
            const auto used = std::span(layout.bindings).first(layout.count);
            EXPECT_EQ(std::ranges::count(used, binding, &backend::BindingDesc::binding), 1) << resource.name;
        }
    }
    for (uint32_t i = 0; i < layout.count; ++i) EXPECT_EQ(layout.bindings[i].stages, backend::ShaderStage::Vertex);
}

TEST_F(DeformationInterface, ConstantsAgree) {
    const auto expect = [&](const char* name, uint32_t value) {
        const std::string line = std::string("const int ") + name + " = " + std::to_string(value) + ";";
        EXPECT_NE(text().find(line), std::string::npos) << line;
    };
    expect("kAttributeJoints1", kAttributeJoints1);
    expect("kAttributeWeights1", kAttributeWeights1);
    expect("kBonesPerRow", kBonesPerRow);
    expect("kMorphTextureWidth", kMorphTextureWidth);
}

TEST(InterfaceLocations, AttributeLocationsAgree) {
    const Result<std::vector<uint32_t>> spirv = spirvFromGlsl(interfaceText() + R"(
        layout(location = kAttributePosition) in vec3 position;
        layout(location = kAttributeTangents) in vec4 tangents;
        layout(location = kAttributeColor) in vec4 color;
        layout(location = kAttributeUv0) in vec2 uv0;
        layout(location = kAttributeUv1) in vec2 uv1;
        layout(location = kAttributeJoints) in uvec4 joints;
        layout(location = kAttributeWeights) in vec4 weights;
        layout(location = kAttributeCustom0) in vec4 custom0;
        layout(location = kAttributeInstance) in uint instance;
        void main() { gl_Position = vec4(position + tangents.xyz, 1.0) + color + vec4(uv0, uv1) + vec4(joints) + weights + custom0 + vec4(instance); }
        )",
                                                              backend::ShaderStage::Vertex, "attributes");
    ASSERT_TRUE(spirv) << spirv.error().message;
    spirv_cross::Compiler compiler(*spirv);
    const std::vector<std::pair<std::string, uint32_t>> expected{
        { "position", kAttributePosition }, { "tangents", kAttributeTangents }, { "color", kAttributeColor },
        { "uv0", kAttributeUv0 },           { "uv1", kAttributeUv1 },           { "joints", kAttributeJoints },
        { "weights", kAttributeWeights },   { "custom0", kAttributeCustom0 },   { "instance", kAttributeInstance }
    };
    for (auto const& input : compiler.get_shader_resources().stage_inputs) {
        const std::pair<std::string, uint32_t> found{ input.name,
                                                      compiler.get_decoration(input.id, spv::DecorationLocation) };
        EXPECT_EQ(std::ranges::count(expected, found), 1) << found.first << " at " << found.second;
    }
}

TEST(InterfaceLimits, ArraySizesAgree) {
    const std::string text = interfaceText();
    EXPECT_NE(text.find("kObjectsPerWindow = " + std::to_string(kObjectsPerWindow) + ";"), std::string::npos);
    EXPECT_NE(text.find("kMaxProbesOfView = " + std::to_string(kMaxProbesOfView) + ";"), std::string::npos);
    EXPECT_NE(text.find("kFroxelCountBits = " + std::to_string(kFroxelCountBits) + ";"), std::string::npos);
}

} // namespace
} // namespace filament_core::shader
