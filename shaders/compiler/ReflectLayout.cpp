// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ReflectLayout.h"

#include <spirv_cross/spirv_cross.hpp>

#include <algorithm>
#include <exception>

namespace filament_core::shader {
namespace {

using backend::BindGroupLayout;
using backend::BindingDesc;
using backend::BindingType;
using backend::ProgramLayout;
using backend::ShaderStage;

/// Keeps the bindings of a group in ascending order and merges the stages of a binding that both declare.
Result<void> insertBinding(BindGroupLayout& group, uint32_t set, BindingDesc const& added, std::string const& name) {
    auto* const begin = group.bindings.data();
    auto* const end = begin + group.count;
    auto* const at = std::lower_bound(begin, end, added.binding,
                                      [](BindingDesc const& have, uint8_t binding) { return have.binding < binding; });
    if (at != end && at->binding == added.binding) {
        const bool isSame = at->type == added.type && at->inputAttachment == added.inputAttachment &&
                            at->isMultisampled == added.isMultisampled;
        if (!isSame) {
            return fail(ErrorCode::InvalidArgument,
                        "set {} binding {} ('{}') is declared as two different things; "
                        "give one of them another binding",
                        set, added.binding, name);
        }
        at->stages = static_cast<ShaderStage>(static_cast<uint8_t>(at->stages) | static_cast<uint8_t>(added.stages));
        return {};
    }
    std::move_backward(at, end, end + 1);
    *at = added;
    ++group.count;
    return {};
}

class StageReader {
public:
    StageReader(std::span<const uint32_t> spirv, ShaderStage stage, StageResources& out)
            : mCompiler(spirv.data(), spirv.size()), mStage(stage), mOut(out) {}

    Result<void> read(std::optional<std::vector<SetBinding>> const& dynamicBuffers) {
        // Declared but never read: omitted, as the drivers do.
        const spirv_cross::ShaderResources all =
                mCompiler.get_shader_resources(mCompiler.get_active_interface_variables());
        if (const char* unsupported = unsupportedKind(all)) {
            return fail(ErrorCode::InvalidArgument,
                        "{} are not supported in shaders; use uniform blocks and combined "
                        "image samplers",
                        unsupported);
        }
        for (auto const& buffer : all.uniform_buffers) {
            const SetBinding at{ static_cast<uint8_t>(decoration(buffer, spv::DecorationDescriptorSet)),
                                 static_cast<uint8_t>(decoration(buffer, spv::DecorationBinding)) };
            const bool isDynamic = dynamicBuffers ? std::ranges::count(*dynamicBuffers, at) > 0 : at.set == 0;
            const BindingType type = isDynamic ? BindingType::DynamicUniformBuffer : BindingType::UniformBuffer;
            if (Result<void> added = add(buffer, type); !added) return added;
        }
        for (auto const& buffer : all.storage_buffers) {
            Result<void> added = checkStorage(buffer);
            if (added) added = add(buffer, BindingType::StorageBuffer);
            if (!added) return added;
        }
        for (auto const& image : all.sampled_images) {
            if (Result<void> added = add(image, BindingType::SampledTexture); !added) return added;
        }
        for (auto const& input : all.subpass_inputs) {
            if (Result<void> added = add(input, BindingType::InputAttachment); !added) return added;
        }
        if (mStage == ShaderStage::Vertex) readVertexInputs(all);
        return {};
    }

private:
    uint32_t decoration(spirv_cross::Resource const& resource, spv::Decoration which) const {
        return mCompiler.get_decoration(resource.id, which);
    }

    /// Draws only read storage buffers, and only in stages in which every OpenGL ES device supports them.
    Result<void> checkStorage(spirv_cross::Resource const& buffer) const {
        const bool isReadonly = mCompiler.get_buffer_block_flags(buffer.id).get(spv::DecorationNonWritable);
        if (mStage == ShaderStage::Compute || (mStage == ShaderStage::Fragment && isReadonly)) return {};
        return fail(ErrorCode::InvalidArgument, "storage buffer '{}': {}", buffer.name,
                    mStage == ShaderStage::Vertex ? "a vertex stage cannot have one; use a vertex or uniform buffer"
                                                  : "a fragment stage only reads them; declare it readonly");
    }

    static const char* unsupportedKind(spirv_cross::ShaderResources const& all) {
        if (!all.storage_images.empty()) return "storage images";
        if (!all.separate_images.empty() || !all.separate_samplers.empty()) return "separate images and samplers";
        if (!all.push_constant_buffers.empty()) return "push constants";
        return nullptr;
    }

    Result<void> add(spirv_cross::Resource const& resource, BindingType type) {
        const uint32_t set = decoration(resource, spv::DecorationDescriptorSet);
        const uint32_t binding = decoration(resource, spv::DecorationBinding);
        if (set >= backend::kMaxBindGroups || binding >= backend::kMaxBindings) {
            return fail(ErrorCode::InvalidArgument, "'{}' is at set {} binding {}; sets end at {} and bindings at {}",
                        resource.name, set, binding, backend::kMaxBindGroups - 1, backend::kMaxBindings - 1);
        }
        if (!mCompiler.get_type(resource.type_id).array.empty()) {
            return fail(ErrorCode::InvalidArgument,
                        "'{}' is an array of resources; use an array texture or separate "
                        "bindings",
                        resource.name);
        }
        BindingDesc desc{ .binding = static_cast<uint8_t>(binding), .type = type, .stages = mStage };
        if (type == BindingType::InputAttachment) {
            desc.inputAttachment = static_cast<uint8_t>(decoration(resource, spv::DecorationInputAttachmentIndex));
        }
        if (type == BindingType::SampledTexture) desc.isMultisampled = mCompiler.get_type(resource.type_id).image.ms;
        return insertBinding(mOut.layout[set], set, desc, resource.name);
    }

    void readVertexInputs(spirv_cross::ShaderResources const& all) {
        for (auto const& input : all.stage_inputs) {
            const uint32_t location = decoration(input, spv::DecorationLocation);
            if (location < 32) mOut.vertexInputs |= 1u << location;
        }
    }

    spirv_cross::Compiler mCompiler;
    ShaderStage mStage;
    StageResources& mOut;
};

bool covers(BindingDesc const& have, BindingDesc const& need) {
    const auto haveStages = static_cast<uint8_t>(have.stages), needStages = static_cast<uint8_t>(need.stages);
    return have.type == need.type && have.inputAttachment == need.inputAttachment &&
           have.isMultisampled == need.isMultisampled && (haveStages & needStages) == needStages;
}

} // namespace

Result<StageResources> reflectStage(std::span<const uint32_t> spirv, ShaderStage stage,
                                    std::optional<std::vector<SetBinding>> const& dynamicBuffers) {
    try {
        StageResources resources;
        Result<void> read = StageReader(spirv, stage, resources).read(dynamicBuffers);
        if (!read) return read.error();
        return resources;
    } catch (std::exception const& error) { // SPIRV-Cross throws on unsupported input
        return fail(ErrorCode::Unsupported, "the shader cannot be reflected: {}", error.what());
    }
}

Result<StageResources> reflectResources(std::span<const uint32_t> vertexSpirv, std::span<const uint32_t> fragmentSpirv,
                                        std::optional<std::vector<SetBinding>> const& dynamicBuffers) {
    try {
        StageResources resources;
        Result<void> vertex = StageReader(vertexSpirv, ShaderStage::Vertex, resources).read(dynamicBuffers);
        if (!vertex) return vertex.error();
        Result<void> fragment = StageReader(fragmentSpirv, ShaderStage::Fragment, resources).read(dynamicBuffers);
        if (!fragment) return fragment.error();
        return resources;
    } catch (std::exception const& error) { // SPIRV-Cross throws on unsupported input
        return fail(ErrorCode::Unsupported, "the shader cannot be reflected: {}", error.what());
    }
}

Result<void> checkContains(ProgramLayout const& layout, ProgramLayout const& used) {
    for (uint32_t set = 0; set < backend::kMaxBindGroups; ++set) {
        for (uint32_t i = 0; i < used[set].count; ++i) {
            BindingDesc const& need = used[set].bindings[i];
            const auto have = std::span(layout[set].bindings).first(layout[set].count);
            const auto at = std::ranges::find(have, need.binding, &BindingDesc::binding);
            if (at == have.end() || !covers(*at, need)) {
                return fail(ErrorCode::InvalidArgument, "the shader reads set {} binding {}, which the given layout {}",
                            set, need.binding, at == have.end() ? "lacks" : "declares with another type or stage");
            }
        }
    }
    return {};
}

} // namespace filament_core::shader
