// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FullScreenPass.h"

#include "base/Result.h"
#include "base/Suggest.h"
#include "filament_core/passes/PassGroup.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/ParameterLayout.h"

#include <algorithm>

namespace filament::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;
using shader::MaterialPackage;
using shader::Parameter;
using shader::PassKind;

// ---------------------------------------------------------------------------------------------- when it is loaded

Result<void> checkGiven(scene::Material const& material, std::string_view pass, FullScreenParameter const& given,
                        bool isInput) {
    Parameter const* parameter = material.package.findParameter(given.name);
    const char* const what = isInput ? "input" : "value";
    if (!parameter || shader::isTexture(parameter->type) != isInput) {
        return fail(ErrorCode::NotFound, "material '{}' has no {} '{}', which pass '{}' gives it{}", material.name,
                    what, given.name, pass, suggestion(given.name, namesOf(material.package.parameters)));
    }
    if (isInput || (parameter->type == given.type && parameter->arraySize == 0)) return {};
    return fail(ErrorCode::InvalidArgument, "material '{}': value '{}' is {}{}, but pass '{}' gives {}", material.name,
                given.name, toString(parameter->type), parameter->arraySize > 0 ? "[]" : "", pass,
                toString(given.type));
}

Result<void> checkNeeded(scene::Material const& material, FullScreenInterface const& given,
                         Parameter const& parameter) {
    const bool isInput = shader::isTexture(parameter.type);
    if (isInput && !parameter.isBound) return {};
    if (parameter.type == ParameterType::SubpassInput) {
        return fail(
                ErrorCode::InvalidArgument,
                "material '{}': input '{}' is a subpassInput, so pass '{}' could not draw it where it is not merged; "
                "make it type : sampler2d, currentPixel : true",
                material.name, parameter.name, given.pass);
    }
    const bool isGiven = isInput ? std::ranges::count(given.inputs, parameter.name) > 0
                                 : std::ranges::count(given.values, parameter.name, &FullScreenParameter::name) > 0;
    if (isGiven) return {};
    return fail(ErrorCode::InvalidArgument, "material '{}' has the {} '{}', which pass '{}' does not give it",
                material.name, isInput ? "input" : "value", parameter.name, given.pass);
}

// ---------------------------------------------------------------------------------------------- when it is declared

/// An input that the program reads, with what it is bound to.
struct Input {
    Parameter const* parameter = nullptr;
    FullScreenInput from;
};

/// In the order of the parameters, which is that of the layout.
std::span<Input> boundInputs(Arena& arena, FullScreenPass const& pass) {
    MaterialPackage const& package = pass.material.package;
    const std::span<Input> inputs = arena.array<Input>(package.parameters.size());
    size_t count = 0;
    for (Parameter const& parameter : package.parameters) {
        if (!shader::isTexture(parameter.type) || !parameter.isBound) continue;
        const auto given = std::ranges::find(pass.inputs, parameter.name, &FullScreenInput::name);
        FILAMENT_ASSERT(given != pass.inputs.end(), "a full-screen pass gives every input that its check named");
        FILAMENT_ASSERT(static_cast<bool>(given->texture) != static_cast<bool>(given->image),
                        "an input of a full-screen pass is a texture of the graph or an image");
        inputs[count++] = { &parameter, *given };
    }
    return inputs.first(count);
}

// The alternatives of ParameterValue are in the order of ParameterType.
static_assert(std::variant_size_v<ParameterValue> == static_cast<size_t>(ParameterType::Float4x4) + 1);

PassBlock declareValues(Arena& arena, FrameContext const& context, FullScreenPass const& pass) {
    MaterialPackage const& package = pass.material.package;
    if (package.uniformBytes == 0) return {};
    const std::span<std::byte> bytes = arena.array<std::byte>(package.uniformBytes);
    for (FullScreenValue const& value : pass.values) {
        Parameter const* parameter = package.findParameter(value.name);
        FILAMENT_ASSERT(parameter && static_cast<size_t>(parameter->type) == value.value.index(),
                        "the values of a full-screen pass have the names and types that its check named");
        std::visit([&](auto const& v) { shader::storeValue(bytes.data() + parameter->offset, v); }, value.value);
    }
    return context.blocks->add(bytes);
}

void declareReads(PassBuilder& builder, std::span<const Input> inputs) {
    uint8_t attachment = 0;
    for (Input const& input : inputs) {
        if (input.parameter->currentPixel)
            builder.readInput(input.from.texture, attachment++);
        else if (input.from.texture)
            builder.readSampled(input.from.texture);
    }
}

// ---------------------------------------------------------------------------------------------- before it is drawn

struct Chosen {
    PipelineHandle pipeline;
    BindGroupHandle pass, material;
};

/// What the pass keeps until then.
struct Declared {
    scene::Material const* material = nullptr;
    std::span<const Input> inputs;
    PassBlock values, target;
};

bool isMerged(PassContext& pass, std::span<const Input> inputs) {
    return std::ranges::any_of(inputs, [&](Input const& input) {
        return input.parameter->currentPixel && pass.isMerged(input.from.texture);
    });
}

BindGroupHandle materialGroup(PassContext& pass, FrameContext const& context, Declared const& declared) {
    MaterialPackage const& package = declared.material->package;
    const bool merged = isMerged(pass, declared.inputs);
    std::array<BindGroupEntry, kMaxBindings> entries{};
    size_t count = 0;
    if (declared.values.bytes > 0) entries[count++] = context.blocks->entry(0, declared.values);
    for (Input const& input : declared.inputs) {
        const SamplerHandle sampler = input.from.sampler ? input.from.sampler : context.resources.nearestSampler;
        entries[count++] = { .binding = input.parameter->binding,
                             .texture = input.from.texture ? pass.texture(input.from.texture) : input.from.image,
                             .sampler = merged && input.parameter->currentPixel ? SamplerHandle{} : sampler };
    }
    const uint16_t variant = merged ? shader::kVariantMerged : 0;
    return pass.bindGroup(shader::programLayout(package, variant)[shader::kGroupMaterial],
                          std::span(entries).first(count), package.name);
}

Chosen choose(PassContext& pass, FrameContext const& context, Declared const& declared) {
    PipelineSource const& pipelines = context.resources.pipelines;
    const uint32_t slot = pipelines.slot(fullScreenSlot(pass.passLayout(), pass.subpass()));
    return { pipelines.fullscreenPipeline(pass.commands(), slot, *declared.material),
             passGroup(pass, context, PassKind::Picture, declared.target), materialGroup(pass, context, declared) };
}

void draw(CommandBuffer& commands, FrameContext const& context, Chosen const& chosen) {
    commands.record(CmdBindPipeline{ chosen.pipeline });
    commands.record(context.views[0].bind(0));
    commands.record(CmdBindGroup{ chosen.pass, shader::kGroupPass });
    commands.record(CmdBindGroup{ chosen.material, shader::kGroupMaterial });
    commands.record(CmdDraw{ 3 });
}

} // namespace

Result<void> checkFullScreenMaterial(scene::Material const& material, FullScreenInterface const& given) {
    if (material.package.domain != shader::MaterialDomain::PostProcess) {
        return fail(ErrorCode::InvalidArgument,
                    "material '{}' is of domain surface, and pass '{}' draws a picture; say domain : postprocess in it",
                    material.name, given.pass);
    }
    for (const std::string_view name : given.inputs) {
        if (Result<void> exists = checkGiven(material, given.pass, { name }, true); !exists) return exists;
    }
    for (FullScreenParameter const& value : given.values) {
        if (Result<void> exists = checkGiven(material, given.pass, value, false); !exists) return exists;
    }
    for (Parameter const& parameter : material.package.parameters) {
        if (Result<void> isGiven = checkNeeded(material, given, parameter); !isGiven) return isGiven;
    }
    return {};
}

framegraph::PassId addFullScreenPass(FrameGraph& graph, FrameContext const& context, FullScreenPass const& pass) {
    const Declared declared{ &pass.material, boundInputs(graph.arena(), pass),
                             declareValues(graph.arena(), context, pass),
                             declareTarget(context, graph.texture(pass.target).desc, pass.level) };
    return graph.addPass(
            pass.name,
            [&](PassBuilder& builder) {
                declareReads(builder, declared.inputs);
                const bool covers = pass.material.package.blending == shader::Blending::Opaque;
                builder.writeColor(0, pass.target, { .overwrites = covers, .level = pass.level });
            },
            [of = &context, declared](PassContext& at) { return choose(at, *of, declared); },
            [of = &context](PassContext& at, Chosen const& chosen) { draw(at.commands(), *of, chosen); });
}

} // namespace filament::passes
