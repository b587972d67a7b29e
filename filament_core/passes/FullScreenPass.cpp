// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FullScreenPass.h"

#include "filament_core/passes/PassGroup.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/ParameterLayout.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using shader::MaterialPackage;
using shader::Parameter;
using shader::PassKind;

// ---------------------------------------------------------------------------------------------- declaration

/// An input that the program reads, and what is bound to it.
struct Input {
    Parameter const* parameter = nullptr;
    FullScreenInput from;
};

/// In the order of the parameters, which is that of the layout.
std::span<const Input> boundInputs(Arena& arena, FullScreenPass const& pass, MaterialPackage const& package) {
    const std::span<Input> inputs = arena.array<Input>(package.parameters.size());
    size_t count = 0;
    for (Parameter const& parameter : package.parameters) {
        if (!shader::isTexture(parameter.type) || !parameter.isBound) continue;
        const auto given = std::ranges::find(pass.inputs, parameter.name, &FullScreenInput::name);
        FILAMENT_ASSERT(given != pass.inputs.end(), "a full-screen pass gives every input that its check named");
        FILAMENT_ASSERT(!given->texture || !given->image, "an input is a texture of the graph or an image, not both");
        FILAMENT_ASSERT(given->texture || !(parameter.currentPixel || parameter.type == ParameterType::Sampler2DMS),
                        "an input that is currentPixel or has several samples is a texture of the graph");
        inputs[count++] = { &parameter, *given };
    }
    return inputs.first(count);
}

// The alternatives of ParameterValue are in the order of ParameterType.
static_assert(std::variant_size_v<ParameterValue> == static_cast<size_t>(ParameterType::Float4x4) + 1);

PassBlock declareValues(Arena& arena, FrameContext const& context, MaterialPackage const& package,
                        std::span<const FullScreenValue> values, std::span<const std::byte> block = {}) {
    if (package.uniformBytes == 0) return {};
    FILAMENT_ASSERT(block.empty() || block.size() == package.uniformBytes, "a block holds all of the parameters");
    if (!block.empty()) return context.blocks->add(block);
    const std::span<std::byte> bytes = arena.array<std::byte>(package.uniformBytes);
    for (FullScreenValue const& value : values) {
        Parameter const* parameter = package.findParameter(value.name);
        FILAMENT_ASSERT(parameter && static_cast<size_t>(parameter->type) == value.value.index(),
                        "the values of a full-screen pass have the names and types that its check named");
        std::visit([&](auto const& v) { shader::storeValue(bytes.data() + parameter->offset, v); }, value.value);
    }
    return context.blocks->add(bytes);
}

/// What one draw covers, and its values.
struct Part {
    Rect rect; ///< without a width: all of the target
    PassBlock values;
    scene::Material const* material = nullptr;
    std::span<const Input> inputs; ///< of the material
};

/// `inputs`: of the pass. Materials of other tiles may read fewer of them.
std::span<const Part> declareParts(Arena& arena, FrameContext const& context, FullScreenPass const& pass,
                                   std::span<const Input> inputs) {
    const auto parts = arena.array<Part>(std::max<size_t>(pass.tiles.size(), 1));
    if (pass.tiles.empty())
        parts[0] = {
            {}, declareValues(arena, context, pass.material.package, pass.values, pass.block), &pass.material, inputs
        };
    for (size_t i = 0; i < pass.tiles.size(); ++i) {
        FullScreenTile const& tile = pass.tiles[i];
        scene::Material const& material = tile.material ? *tile.material : pass.material;
        parts[i] = { tile.rect, declareValues(arena, context, material.package, tile.values), &material,
                     &material == &pass.material ? inputs : boundInputs(arena, pass, material.package) };
    }
    return parts;
}

void declareReads(PassBuilder& builder, std::span<const Input> inputs) {
    uint8_t attachment = 0;
    for (Input const& input : inputs) {
        if (input.parameter->currentPixel)
            builder.readInput(input.from.texture, attachment++, input.from.range.level, input.from.range.layer);
        else if (input.from.texture)
            builder.readSampled(input.from.texture, input.from.range);
    }
}

framegraph::ColorTarget targetOf(FullScreenPass const& pass) {
    // What draws every pixel without blending needs no earlier contents: tiled devices then load none.
    framegraph::ColorTarget target{ .overwrites = (pass.tiles.empty() || pass.fillsTarget) &&
                                                  pass.material.package.blending == shader::Blending::Opaque,
                                    .level = pass.level,
                                    .layer = pass.layer,
                                    .resolve = pass.resolve };
    float4 const& color = pass.clearColor;
    if (pass.clears) target.clear = std::array{ color.x, color.y, color.z, color.w };
    return target;
}

// ---------------------------------------------------------------------------------------------- before drawing

struct ChosenPart {
    PipelineHandle pipeline;
    BindGroupHandle material;
};

struct ChosenPipelines {
    BindGroupHandle pass;
    std::span<const ChosenPart> parts;
};

/// What the pass keeps until it is drawn.
struct Declared {
    std::span<const Input> inputs;
    std::span<const Part> parts;
    PassBlock target;
};

bool isMerged(PassContext& pass, std::span<const Input> inputs) {
    return std::ranges::any_of(inputs, [&](Input const& input) {
        return input.parameter->currentPixel && pass.isMerged(input.from.texture);
    });
}

TextureHandle imageOf(PassContext& pass, FrameContext const& context, FullScreenInput const& input) {
    if (input.texture) return pass.texture(input.texture);
    return input.image ? input.image : context.resources.white;
}

BindGroupHandle materialGroup(PassContext& pass, FrameContext const& context, Part const& part) {
    MaterialPackage const& package = part.material->package;
    const bool merged = isMerged(pass, part.inputs);
    std::array<BindGroupEntry, kMaxBindings> entries{};
    size_t count = 0;
    if (part.values.bytes > 0) entries[count++] = context.blocks->entry(0, part.values);
    for (Input const& input : part.inputs) {
        const SamplerHandle sampler = input.from.sampler ? input.from.sampler : context.resources.samplers.nearest;
        entries[count++] = { .binding = input.parameter->binding,
                             .texture = imageOf(pass, context, input.from),
                             // An input attachment is the pixel itself, and read without a sampler.
                             .sampler = merged && input.parameter->currentPixel ? SamplerHandle{} : sampler,
                             .range = input.from.range };
    }
    const uint16_t variant = merged ? shader::kVariantMerged : 0;
    return pass.bindGroup(shader::programLayout(package, variant)[shader::kGroupMaterial],
                          std::span(entries).first(count), package.name);
}

ChosenPipelines choose(PassContext& pass, FrameContext const& context, Declared const& declared) {
    PipelineSource const& pipelines = context.resources.pipelines;
    const uint32_t slot = pipelines.slot(fullScreenSlot(pass.passLayout(), pass.subpass()));
    const auto parts = context.arena->array<ChosenPart>(declared.parts.size());
    std::ranges::transform(declared.parts, parts.begin(), [&](Part const& part) {
        return ChosenPart{ pipelines.fullscreenPipeline(pass.commands(), slot, *part.material),
                           materialGroup(pass, context, part) };
    });
    return { passGroup(pass, context, PassKind::Picture, declared.target), parts };
}

void bindPipeline(CommandBuffer& commands, FrameContext const& context, PipelineHandle pipeline, BindGroupHandle pass) {
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(context.views[0].bind(0));
    commands.record(CmdBindGroup{ pass, shader::kGroupPass });
}

void draw(CommandBuffer& commands, FrameContext const& context, std::span<const Part> parts,
          ChosenPipelines const& chosen) {
    PipelineHandle bound;
    for (size_t i = 0; i < parts.size(); ++i) {
        ChosenPart const& part = chosen.parts[i];
        if (part.pipeline != bound) bindPipeline(commands, context, part.pipeline, chosen.pass);
        bound = part.pipeline;
        if (parts[i].rect.width > 0) commands.record(CmdSetScissor{ parts[i].rect });
        commands.record(CmdBindGroup{ part.material, shader::kGroupMaterial });
        commands.record(CmdDraw{ 3 });
    }
}

} // namespace

std::array<Rect, 4> rectsAround(Rect const& inside, uint2 size) {
    const auto x = static_cast<uint32_t>(inside.x), y = static_cast<uint32_t>(inside.y);
    const uint32_t right = x + inside.width, below = y + inside.height;
    return { Rect{ 0, 0, size.x, y }, Rect{ 0, inside.y, x, inside.height },
             Rect{ static_cast<int32_t>(right), inside.y, size.x - right, inside.height },
             Rect{ 0, static_cast<int32_t>(below), size.x, size.y - below } };
}

framegraph::PassId addFullScreenPass(FrameGraph& graph, FrameContext const& context, FullScreenPass const& pass) {
    const std::span<const Input> inputs = boundInputs(graph.arena(), pass, pass.material.package);
    const Declared declared{ inputs, declareParts(graph.arena(), context, pass, inputs),
                             declareTarget(context, graph.texture(pass.target).desc, pass.level) };
    return graph.addPass(
            pass.name,
            [&](PassBuilder& builder) {
                declareReads(builder, declared.inputs);
                builder.writeColor(0, pass.target, targetOf(pass));
                uint8_t slot = 1;
                for (const framegraph::TextureId other : pass.others)
                    builder.writeColor(slot++, other, { .overwrites = targetOf(pass).overwrites });
            },
            [of = &context, declared](PassContext& at) { return choose(at, *of, declared); },
            [of = &context, parts = declared.parts](PassContext& at, ChosenPipelines const& chosen) {
                draw(at.commands(), *of, parts, chosen);
            });
}

} // namespace filament_core::passes
