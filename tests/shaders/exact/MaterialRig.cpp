// SPDX-License-Identifier: Apache-2.0
#include "tests/shaders/exact/MaterialRig.h"

#include "filament_core/assets/tables/DfgTable.h"
#include "shaders/package/EngineMaterials.h"
#include "shaders/package/GroupLayouts.h"
#include "shaders/package/ParameterLayout.h"
#include "shaders/package/RemoveUnusedTextures.h"
#include "toolkit/packages/PackageCache.h"

#include <cmath>
#include <cstring>
#include <random>

namespace filament_core::shader::test {
namespace {

using namespace backend;

constexpr uint32_t kGrid = 16; // quads a side
constexpr uint32_t kDfgSide = 32;
constexpr uint32_t kPatternSide = 16;

struct Vertex {
    float position[3];
    float tangents[4];
    float uv0[2], uv1[2];
    float color[4];
};

template <class T>
std::span<const std::byte> bytesOf(std::vector<T> const& values) {
    return std::as_bytes(std::span(values));
}

/// A plane two metres ahead whose normals lean up to 50 degrees in random directions.
std::vector<Vertex> bumpyGrid() {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> lean(-0.4f, 0.4f), unit(0.0f, 1.0f);
    std::vector<Vertex> vertices;
    for (uint32_t y = 0; y <= kGrid; ++y) {
        for (uint32_t x = 0; x <= kGrid; ++x) {
            const float q[3] = { lean(random), lean(random), lean(random) };
            const float w = std::sqrt(1.0f - q[0] * q[0] - q[1] * q[1] - q[2] * q[2]);
            vertices.push_back({ { static_cast<float>(x) * 0.15f - 1.2f, static_cast<float>(y) * 0.15f - 1.2f,
                                   -2.0f + 0.1f * unit(random) },
                                 { q[0], q[1], q[2], w },
                                 { unit(random), unit(random) },
                                 { unit(random), unit(random) },
                                 { unit(random), unit(random), unit(random), 1.0f } });
        }
    }
    return vertices;
}

std::vector<uint16_t> gridIndices() {
    std::vector<uint16_t> indices;
    for (uint32_t y = 0; y < kGrid; ++y) {
        for (uint32_t x = 0; x < kGrid; ++x) {
            const uint32_t a = y * (kGrid + 1) + x, b = a + 1, c = a + kGrid + 1, d = c + 1;
            for (const uint32_t index : { a, b, d, a, d, c }) indices.push_back(static_cast<uint16_t>(index));
        }
    }
    return indices;
}

VertexLayout vertexLayout() {
    VertexLayout layout;
    const auto add = [&](uint8_t location, uint8_t slot, VertexFormat format, size_t offset) {
        layout.attributes[layout.attributeCount++] = { location, slot, format, static_cast<uint16_t>(offset) };
    };
    add(kAttributePosition, 0, VertexFormat::Float3, offsetof(Vertex, position));
    add(kAttributeTangents, 0, VertexFormat::Float4, offsetof(Vertex, tangents));
    add(kAttributeUv0, 0, VertexFormat::Float2, offsetof(Vertex, uv0));
    add(kAttributeUv1, 0, VertexFormat::Float2, offsetof(Vertex, uv1));
    add(kAttributeColor, 0, VertexFormat::Float4, offsetof(Vertex, color));
    add(kAttributeInstance, 1, VertexFormat::UInt, 0);
    layout.buffers[0] = { sizeof(Vertex), false };
    layout.buffers[1] = { sizeof(uint32_t), true };
    layout.bufferCount = 2;
    return layout;
}

/// Infinite reversed-Z projection, 60 degrees; the camera looks down -Z.
float4x4 clipFromView() {
    float4x4 projection(0.0f);
    projection[0][0] = projection[1][1] = 1.7320508f;
    projection[2][3] = -1.0f;
    projection[3][2] = 0.1f;
    return projection;
}

std::vector<ConstantValue> constantsOf(MaterialPackage const& package, MaterialScene const& scene) {
    std::vector<ConstantValue> constants;
    for (auto const& [name, bits] : scene.constants) {
        Constant const* constant = package.findConstant(name);
        constants.push_back({ constant->id, bits, constant->type });
    }
    for (ConstantValue const& constant : variantConstants(scene.variant)) constants.push_back(constant);
    return constants;
}

PassLayout passLayout() {
    PassLayout layout{ .depthFormat = Format::D32F, .colorCount = 1 };
    layout.colorFormats[0] = Format::RGBA32F;
    return layout;
}

} // namespace

std::unique_ptr<MaterialRig> MaterialRig::make(Backend type) {
    auto stream = CommandStream::start([type](ResultSink& sink) { return createDriver(type, {}, sink); });
    if (!stream) return nullptr;
    std::unique_ptr<MaterialRig> rig(new MaterialRig(std::move(*stream)));
    rig->createShared();
    return rig;
}

BufferHandle MaterialRig::buffer(CommandBuffer& commands, BufferUsage usage, std::span<const std::byte> bytes) {
    const BufferHandle handle = mStream->allocateBuffer();
    commands.record(CmdCreateBuffer{ handle, { bytes.size(), usage, "test" } });
    commands.record(CmdUpdateBuffer{ .buffer = handle, .bytes = bytes });
    return handle;
}

TextureHandle MaterialRig::texture(CommandBuffer& commands, TextureKind type, Format format, uint32_t side,
                                   std::span<const std::byte> texels) {
    const TextureHandle handle = mStream->allocateTexture();
    const auto layers = static_cast<uint16_t>(type == TextureKind::Cube ? 6 : 1);
    commands.record(CmdCreateTexture{ handle,
                                      { .type = type,
                                        .format = format,
                                        .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                        .layers = layers,
                                        .width = side,
                                        .height = side,
                                        .debugName = "test" } });
    commands.record(
            CmdUploadTexture{ .texture = handle, .layerCount = layers, .rect = { 0, 0, side, side }, .bytes = texels });
    return handle;
}

TextureHandle MaterialRig::pattern(CommandBuffer& commands, uint8_t binding) {
    TextureHandle& made = mPatterns[binding];
    if (made) return made;
    std::vector<uint8_t> texels(kPatternSide * kPatternSide * 4);
    std::mt19937 random(11u + binding);
    for (uint8_t& byte : texels) byte = static_cast<uint8_t>(128 + random() % 128); // normals of a map look outwards
    made = texture(commands, TextureKind::Texture2D, Format::RGBA8, kPatternSide, bytesOf(texels));
    return made;
}

void MaterialRig::createShared() {
    CommandBuffer& commands = mStream->acquire();
    const std::vector<Vertex> vertices = bumpyGrid();
    const std::vector<uint16_t> indices = gridIndices();
    mIndexCount = static_cast<uint32_t>(indices.size());
    mVertices = buffer(commands, BufferUsage::Vertex, bytesOf(vertices));
    mIndices = buffer(commands, BufferUsage::Index, bytesOf(indices));
    mInstance = buffer(commands, BufferUsage::Vertex, bytesOf(std::vector<uint32_t>{ 0 }));
    ObjectUniforms objects{};
    objects.objects[0] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 1, 0, 0, 0 } };
    mObjects = buffer(commands, BufferUsage::Uniform, std::as_bytes(std::span(&objects, 1)));

    mWhiteCube = texture(commands, TextureKind::Cube, Format::RGBA32F, 1, bytesOf(std::vector<float>(6 * 4, 1.0f)));
    jobs::JobSystem jobs({ .workers = 1 });
    mDfg = texture(commands, TextureKind::Texture2D, Format::RGBA16F, kDfgSide,
                   assets::bakeDfgTable(jobs, kDfgSide).data);
    mSampler = mStream->allocateSampler();
    commands.record(CmdCreateSampler{ mSampler, { .magFilter = Filter::Linear, .minFilter = Filter::Linear } });

    mColor = mStream->allocateTexture(), mDepth = mStream->allocateTexture();
    commands.record(CmdCreateTexture{ mColor,
                                      { .format = Format::RGBA32F,
                                        .usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                                        .width = kPictureSide,
                                        .height = kPictureSide,
                                        .debugName = "color" } });
    commands.record(CmdCreateTexture{ mDepth,
                                      { .format = Format::D32F,
                                        .usage = TextureUsage::DepthAttachment,
                                        .width = kPictureSide,
                                        .height = kPictureSide,
                                        .debugName = "depth" } });
    mStream->submit(commands);
}

BindGroupHandle MaterialRig::viewGroup(CommandBuffer& commands, MaterialScene const& scene) {
    FrameUniforms frame = scene.frame;
    frame.clipFromWorld = frame.clipFromView = clipFromView();
    frame.worldFromClip = glm::inverse(frame.clipFromWorld);
    frame.viewFromWorld = frame.worldFromEnvironment = float4x4(1.0f);
    frame.ambient.w = static_cast<float>(scene.lights.size());
    std::vector<PunctualLight> lights(scene.lights.begin(), scene.lights.end());
    lights.resize(std::max<size_t>(lights.size(), 1)); // something to bind
    const std::vector<uint32_t> words(1);              // no grid: every point reads all lights
    const BufferHandle frameBuffer = buffer(commands, BufferUsage::Uniform, std::as_bytes(std::span(&frame, 1)));
    const BufferHandle lightBuffer = buffer(commands, BufferUsage::Storage, bytesOf(lights));
    const BufferHandle froxelBuffer = buffer(commands, BufferUsage::Storage, bytesOf(words));
    const std::vector<BindGroupEntry> entries{
        { .binding = kBindingFrame, .buffer = frameBuffer, .size = sizeof(FrameUniforms) },
        { .binding = kBindingObjects, .buffer = mObjects, .size = sizeof(ObjectUniforms) },
        { .binding = kBindingLights,
          .buffer = lightBuffer,
          .size = static_cast<uint32_t>(lights.size() * sizeof(PunctualLight)) },
        { .binding = kBindingFroxels, .buffer = froxelBuffer, .size = sizeof(uint32_t) }
    };
    const BindGroupHandle group = mStream->allocateBindGroup();
    commands.record(CmdCreateBindGroup{ group, { viewGroupLayout(), entries, "view" } });
    return group;
}

namespace {

/// Those that the layout has, in its order.
std::vector<BindGroupEntry> entriesOf(BindGroupLayout const& layout, std::span<const BindGroupEntry> entries) {
    std::vector<BindGroupEntry> found;
    for (BindingDesc const& binding : std::span(layout.bindings).first(layout.count))
        found.push_back(*std::ranges::find(entries, binding.binding, &BindGroupEntry::binding));
    return found;
}

} // namespace

BindGroupHandle MaterialRig::passGroup(CommandBuffer& commands, MaterialPackage const& package) {
    const PassUniforms pass{ .target = { kPictureSide, kPictureSide, 1.0f / kPictureSide, 1.0f / kPictureSide },
                             .raster = { 1, 0, 0, 0 },
                             .picture = { 0, 0, kPictureSide, kPictureSide } };
    const BufferHandle passBuffer = buffer(commands, BufferUsage::Uniform, std::as_bytes(std::span(&pass, 1)));
    const std::vector<std::byte> noFog(kFogCellBytes);
    const BufferHandle fogCells = buffer(commands, BufferUsage::Storage, noFog);
    const std::vector<BindGroupEntry> entries{
        { .binding = kBindingPass, .buffer = passBuffer, .size = sizeof(PassUniforms) },
        { .binding = kBindingShadowMaps, .texture = mDfg, .sampler = mSampler },            // read by no
        { .binding = kBindingShadows, .buffer = passBuffer, .size = sizeof(PassUniforms) }, // variant drawn here
        { .binding = kBindingSpecular, .texture = mWhiteCube, .sampler = mSampler },
        { .binding = kBindingDfg, .texture = mDfg, .sampler = mSampler },
        { .binding = kBindingIrradiance, .texture = mWhiteCube, .sampler = mSampler },
        { .binding = kBindingOcclusion, .texture = mDfg, .sampler = mSampler },  // read by no program:
        { .binding = kBindingSceneDepth, .texture = mDfg, .sampler = mSampler }, // its constants are 0
        { .binding = kBindingFog, .texture = mWhiteCube, .sampler = mSampler },
        { .binding = kBindingPicture, .texture = mDfg, .sampler = mSampler },
        { .binding = kBindingFogCells, .buffer = fogCells, .size = kFogCellBytes },
        { .binding = kBindingProbes, .buffer = passBuffer, .size = sizeof(PassUniforms) }, // see above
    };
    const BindGroupLayout layout = passGroupLayout(passKind(package));
    const BindGroupHandle group = mStream->allocateBindGroup();
    const std::vector<BindGroupEntry> bound = entriesOf(layout, entries);
    commands.record(CmdCreateBindGroup{ group, { layout, bound, "pass" } });
    return group;
}

BindGroupHandle MaterialRig::materialGroup(CommandBuffer& commands, MaterialPackage const& package,
                                           MaterialScene const& scene) {
    std::vector<BindGroupEntry> entries;
    std::vector<float> block(package.uniformBytes / sizeof(float));
    if (!block.empty()) {
        for (auto const& [name, values] : scene.parameters) {
            Parameter const* parameter = package.findParameter(name);
            if (parameter) std::copy(values.begin(), values.end(), block.begin() + parameter->offset / 4);
        }
        entries.push_back(
                { .buffer = buffer(commands, BufferUsage::Uniform, bytesOf(block)), .size = package.uniformBytes });
    }
    for (Parameter const& parameter : package.parameters) {
        if (!isTexture(parameter.type) || !parameter.isBound) continue;
        entries.push_back(
                { .binding = parameter.binding, .texture = pattern(commands, parameter.binding), .sampler = mSampler });
    }
    const BindGroupHandle group = mStream->allocateBindGroup();
    commands.record(CmdCreateBindGroup{ group, { package.layout[kGroupMaterial], entries, "material" } });
    return group;
}

PipelineHandle MaterialRig::pipeline(CommandBuffer& commands, MaterialPackage const& package,
                                     MaterialScene const& scene, PassLayout const& pass) {
    Variant const* variant = package.findVariant(scene.variant);
    const bool spirv = mStream->info().shaderLanguage == ShaderLanguage::SpirV;
    const std::vector<ConstantValue> constants = constantsOf(package, scene);
    const ProgramHandle program = mStream->allocateProgram();
    commands.record(CmdCreateProgram{ program,
                                      { .vertex = spirv ? std::as_bytes(std::span(variant->vertex->spirv))
                                                        : std::as_bytes(std::span(variant->vertex->essl)),
                                        .fragment = spirv ? std::as_bytes(std::span(variant->fragment->spirv))
                                                          : std::as_bytes(std::span(variant->fragment->essl)),
                                        .constants = constants,
                                        .layout = package.layout,
                                        .debugName = package.name } });
    const PipelineHandle handle = mStream->allocatePipeline();
    commands.record(
            CmdCreatePipeline{ handle,
                               { .program = program,
                                 .pass = pass,
                                 .vertices = vertexLayout(),
                                 .raster = { .cull = CullMode::None },
                                 .depthStencil = { .depthCompare = CompareOp::GreaterEqual, .depthWrite = true },
                                 .debugName = package.name } });
    return handle;
}

void MaterialRig::draw(CommandBuffer& commands, MaterialPackage const& package, MaterialScene const& scene) {
    const PipelineHandle state = pipeline(commands, package, scene, passLayout());
    const BindGroupHandle view = viewGroup(commands, scene), inPass = passGroup(commands, package);
    const BindGroupHandle material = materialGroup(commands, package, scene);
    PassDesc pass{ .layout = passLayout(), .area = { 0, 0, kPictureSide, kPictureSide }, .debugName = "material" };
    pass.colors[0] = { .texture = mColor };
    pass.depth = { .texture = mDepth, .store = StoreOp::Discard };
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ state });
    commands.record(CmdBindGroup{ .group = view, .index = kGroupView, .dynamicCount = 3 });
    commands.record(CmdBindGroup{ .group = inPass, .index = kGroupPass });
    commands.record(CmdBindGroup{ .group = material, .index = kGroupMaterial });
    commands.record(CmdBindVertexBuffers{ .buffers = { mVertices, mInstance }, .count = 2 });
    commands.record(CmdBindIndexBuffer{ .buffer = mIndices });
    commands.record(CmdDrawIndexed{ .indexCount = mIndexCount });
    commands.record(CmdEndPass{});
}

Result<MaterialPackage> MaterialRig::package(MaterialScene const& scene) {
    if (scene.source.empty()) {
        Result<MaterialPackage> read = readPackage(engineMaterial(scene.material));
        if (read && scene.removesUnusedTextures) removeUnusedTextures(*read, constantsOf(*read, scene));
        return read;
    }
    const Result<tools::CompiledPackage> compiled = // for both devices, and for the next run
            tools::compilePackage(scene.source, "test.mat", { .onlyVariant = scene.variant });
    if (!compiled) return compiled.error();
    return readPackage(compiled->bytes);
}

Result<std::vector<float>> MaterialRig::render(MaterialScene const& scene) {
    const Result<MaterialPackage> found = package(scene);
    if (!found) return found.error();
    CommandBuffer& commands = mStream->acquire();
    draw(commands, *found, scene);
    const Ticket ticket = mStream->nextTicket();
    commands.record(
            CmdReadTexture{ .texture = mColor, .rect = { 0, 0, kPictureSide, kPictureSide }, .ticket = ticket });
    mStream->submit(commands);
    const Result<std::vector<std::byte>> bytes = mStream->waitReadback(ticket);
    for (DriverError const& error : mStream->takeErrors()) return fail(ErrorCode::Internal, "{}", error.message);
    if (!bytes) return bytes.error();
    std::vector<float> picture(bytes->size() / sizeof(float));
    std::memcpy(picture.data(), bytes->data(), bytes->size());
    return picture;
}

} // namespace filament_core::shader::test
