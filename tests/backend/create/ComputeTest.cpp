// SPDX-License-Identifier: Apache-2.0
// Dispatches: integer results with a single correct answer, and the order of reads and writes around them.
#include "tests/backend/create/Gpu.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace filament_core::backend {

DRIVER_SUITE(Compute);

namespace {

constexpr BufferUsage kReadable = BufferUsage::Storage | BufferUsage::TransferSource;

/// A compute stage of `size` invocations per group with `body` as main().
std::string computeOf(uint32_t size, std::string_view declarations, std::string_view body) {
    return fmt::format("#version 450\nlayout(local_size_x = {}) in;\n{}\nvoid main() {{\n{}\n}}\n", size, declarations,
                       body);
}

BindGroupEntry whole(uint8_t binding, BufferHandle buffer, uint32_t bytes) {
    return { .binding = binding, .buffer = buffer, .size = bytes };
}

/// Pseudo-random numbers (a linear congruential generator).
std::vector<uint32_t> scattered(size_t count) {
    std::vector<uint32_t> values(count);
    uint32_t state = 12345;
    for (uint32_t& value : values) value = state = state * 1664525 + 1013904223;
    return values;
}

} // namespace

DRIVER_TEST(Compute, EveryInvocationOfEveryGroupRunsOnceAndKnowsItsPlace) {
    constexpr uint32_t kCount = 3 * 2 * 4 * 8;
    const Program program = gpu.computeProgram(
            "#version 450\n"
            "layout(local_size_x = 2, local_size_y = 4) in;\n"
            "layout(set = 0, binding = 0, std430) buffer Out { uvec4 places[]; };\n"
            "void main() {\n"
            "    uvec3 groups = gl_NumWorkGroups;\n"
            "    uint group = gl_WorkGroupID.x + groups.x * (gl_WorkGroupID.y + groups.y * gl_WorkGroupID.z);\n"
            "    uint at = group * 8u + gl_LocalInvocationIndex;\n"
            "    places[at] += uvec4(gl_GlobalInvocationID, at + 1u);\n"
            "}\n");
    const BufferHandle out = gpu.buffer(kReadable, std::vector<uint32_t>(kCount * 4, 0));
    gpu.dispatch(gpu.computePipeline(program), { gpu.group(program, 0, { whole(0, out, kCount * 16) }) }, { 3, 2, 4 });
    const auto places = gpu.readBuffer<std::array<uint32_t, 4>>(out, kCount);
    for (uint32_t i = 0; i < kCount; ++i) {
        const uint32_t group = i / 8, local = i % 8;
        const std::array<uint32_t, 4> expected{ group % 3 * 2 + local % 2, group / 3 % 2 * 4 + local / 2, group / 6,
                                                i + 1 };
        EXPECT_EQ(places[i], expected) << i;
    }
}

DRIVER_TEST(Compute, AHistogramThroughSharedMemoryAndAtomicsCountsEveryValue) {
    constexpr uint32_t kValues = 10'000, kBins = 64;
    const std::vector<uint32_t> values = scattered(kValues);
    const Program program = gpu.computeProgram(
            computeOf(64,
                      "layout(set = 0, binding = 0, std430) readonly buffer In { uint values[]; };\n"
                      "layout(set = 0, binding = 1, std430) buffer Out { uint bins[]; };\n"
                      "layout(set = 1, binding = 0, std140) uniform Size { uvec4 count; };\n"
                      "shared uint partial[64];",
                      "partial[gl_LocalInvocationIndex] = 0u;\n"
                      "barrier();\n"
                      "for (uint i = gl_GlobalInvocationID.x; i < count.x; i += gl_NumWorkGroups.x * 64u)\n"
                      "    atomicAdd(partial[values[i] >> 26], 1u);\n"
                      "barrier();\n"
                      "atomicAdd(bins[gl_LocalInvocationIndex], partial[gl_LocalInvocationIndex]);"));
    const BufferHandle in = gpu.buffer(BufferUsage::Storage, values);
    const BufferHandle bins = gpu.buffer(kReadable, std::vector<uint32_t>(kBins, 0));
    const BufferHandle size = gpu.buffer(BufferUsage::Uniform, std::vector<uint32_t>{ kValues, 0, 0, 0 });
    gpu.dispatch(gpu.computePipeline(program),
                 { gpu.group(program, 0, { whole(0, in, kValues * 4), whole(1, bins, kBins * 4) }),
                   gpu.group(program, 1, { whole(0, size, 16) }) },
                 { .groupsX = 7 });
    std::vector<uint32_t> expected(kBins, 0);
    for (const uint32_t value : values) ++expected[value >> 26];
    EXPECT_EQ(gpu.readBuffer<uint32_t>(bins, kBins), expected);
}

// Three dispatches, each reading the results of the previous one: sums of blocks, sums of those, both together.
DRIVER_TEST(Compute, APrefixSumOverManyBlocksSeesTheSumsOfTheOnesBefore) {
    constexpr uint32_t kBlock = 128, kBlocks = 100, kCount = kBlock * kBlocks;
    const std::vector<uint32_t> values = scattered(kCount);
    const std::string scan = computeOf(kBlock,
                                       "layout(set = 0, binding = 0, std430) buffer Values { uint values[]; };\n"
                                       "layout(set = 0, binding = 1, std430) buffer Sums { uint sums[]; };\n"
                                       "shared uint line[128];",
                                       "uint at = gl_GlobalInvocationID.x, i = gl_LocalInvocationIndex;\n"
                                       "line[i] = values[at];\n"
                                       "for (uint step = 1u; step < 128u; step *= 2u) {\n"
                                       "    barrier();\n"
                                       "    uint before = i >= step ? line[i - step] : 0u;\n"
                                       "    barrier();\n"
                                       "    line[i] += before;\n"
                                       "}\n"
                                       "values[at] = line[i];\n"
                                       "if (i == 127u) sums[gl_WorkGroupID.x] = line[i];");
    const std::string add = computeOf(kBlock,
                                      "layout(set = 0, binding = 0, std430) buffer Values { uint values[]; };\n"
                                      "layout(set = 0, binding = 1, std430) readonly buffer Sums { uint sums[]; };",
                                      "if (gl_WorkGroupID.x > 0u)\n"
                                      "    values[gl_GlobalInvocationID.x] += sums[gl_WorkGroupID.x - 1u];");
    const Program scanProgram = gpu.computeProgram(scan), addProgram = gpu.computeProgram(add);
    const PipelineHandle scanning = gpu.computePipeline(scanProgram), adding = gpu.computePipeline(addProgram);
    const BufferHandle all = gpu.buffer(kReadable, values);
    const BufferHandle sums = gpu.buffer(kReadable, std::vector<uint32_t>(kBlock, 0)); // one block of them, too
    const BufferHandle total = gpu.buffer(kReadable, std::vector<uint32_t>(1, 0));
    const BindGroupHandle blocks = gpu.group(scanProgram, 0, { whole(0, all, kCount * 4), whole(1, sums, kBlock * 4) });
    const BindGroupHandle ofSums = gpu.group(scanProgram, 0, { whole(0, sums, kBlock * 4), whole(1, total, 4) });
    gpu.dispatch(scanning, { blocks }, { .groupsX = kBlocks });
    gpu.dispatch(scanning, { ofSums }, {});
    gpu.dispatch(adding, { gpu.group(addProgram, 0, { whole(0, all, kCount * 4), whole(1, sums, kBlock * 4) }) },
                 { .groupsX = kBlocks });
    std::vector<uint32_t> expected(kCount);
    std::partial_sum(values.begin(), values.end(), expected.begin());
    EXPECT_EQ(gpu.readBuffer<uint32_t>(all, kCount), expected);
    EXPECT_EQ(gpu.readBuffer<uint32_t>(total, 1)[0], expected.back());
}

DRIVER_TEST(Compute, DrawsReadWhatADispatchWroteAsVerticesIndicesUniformsAndStorage) {
    const Program fill = gpu.computeProgram(
            computeOf(1,
                      "layout(set = 0, binding = 0, std430) writeonly buffer Corners { vec4 corners[]; };\n"
                      "layout(set = 0, binding = 1, std430) writeonly buffer Indices { uint indices[]; };\n"
                      "layout(set = 0, binding = 2, std430) writeonly buffer Tint { vec4 tint; };\n"
                      "layout(set = 0, binding = 3, std430) writeonly buffer Table { vec4 table[]; };",
                      "corners[0] = vec4(-1, -1, 0, 1); corners[1] = vec4(1); // the color of the first one\n"
                      "corners[2] = vec4(3, -1, 0, 1); corners[3] = vec4(1);\n"
                      "corners[4] = vec4(-1, 3, 0, 1); corners[5] = vec4(1);\n"
                      "indices[0] = 2u; indices[1] = 0u; indices[2] = 1u;\n"
                      "tint = vec4(0.5, 0.25, 0, 1);\n"
                      "for (int i = 0; i < 4; ++i) table[i] = vec4(i, 10 * i, 100 * i, 0);"));
    using enum BufferUsage;
    const BufferHandle corners = gpu.buffer(Storage | Vertex, 96), indices = gpu.buffer(Storage | Index, 12),
                       tint = gpu.buffer(Storage | Uniform, 16), table = gpu.buffer(Storage, 64);
    gpu.dispatch(
            gpu.computePipeline(fill),
            { gpu.group(fill, 0,
                        { whole(0, corners, 96), whole(1, indices, 12), whole(2, tint, 16), whole(3, table, 64) }) },
            {});
    const Program show = gpu.program(
            kColorVertex,
            "#version 450\nlayout(location = 0) in vec4 vertexColor;\nlayout(location = 0) out vec4 result;\n"
            "layout(set = 1, binding = 0, std140) uniform Tint { vec4 tint; };\n"
            "layout(set = 1, binding = 1, std430) readonly buffer Table { vec4 table[]; };\n"
            "void main() { result = vertexColor * tint + table[int(gl_FragCoord.x)]; }");
    const TextureHandle target = gpu.target(Format::RGBA32F, 4, 1);
    const PassDesc pass = passOver({ { target, Format::RGBA32F } }, 4, 1);
    PipelineDesc desc = pipelineFor(show, pass.layout);
    useColorVertices(desc);
    const PipelineHandle pipeline = gpu.pipeline(desc);
    const BindGroupHandle group = gpu.group(show, 1, { whole(0, tint, 16), whole(1, table, 64) });
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdBindGroup{ .group = group, .index = 1 });
    gpu.record(CmdBindVertexBuffers{ .buffers = { corners }, .count = 1 });
    gpu.record(CmdBindIndexBuffer{ .buffer = indices, .type = IndexFormat::UInt32 });
    gpu.record(CmdDrawIndexed{ .indexCount = 3 });
    gpu.record(CmdEndPass{});
    const auto pixels = gpu.readAs<Rgba>(target, { 0, 0, 4, 1 });
    for (uint32_t i = 0; i < 4; ++i) {
        const auto x = static_cast<float>(i);
        EXPECT_EQ(pixels[i], (Rgba{ 0.5f + x, 0.25f + 10 * x, 100 * x, 1 })) << i;
    }
}

DRIVER_TEST(Compute, ADispatchSamplesWhatAPassHasJustDrawn) {
    constexpr uint32_t kSize = 64;
    const Program paint =
            gpu.program(kFullScreenVertex, fragmentOf("", "uvec2 at = uvec2(gl_FragCoord.xy); result = "
                                                          "vec4(float((at.x * 5u + at.y * 3u) % 16u), 0, 0, 1);"));
    const TextureHandle picture = gpu.paint(paint, { .width = kSize, .height = kSize, .format = Format::R32F });
    const Program sum = gpu.computeProgram(
            computeOf(8,
                      "layout(set = 0, binding = 0) uniform highp sampler2D picture;\n"
                      "layout(set = 0, binding = 1, std430) buffer Out { uint bins[]; };",
                      "for (int y = 0; y < 64; ++y)\n"
                      "    atomicAdd(bins[uint(texelFetch(picture, ivec2(gl_GlobalInvocationID.x, y), 0).x)], 1u);"));
    const BufferHandle bins = gpu.buffer(kReadable, std::vector<uint32_t>(16, 0));
    gpu.dispatch(gpu.computePipeline(sum),
                 { gpu.group(sum, 0,
                             { { .binding = 0, .texture = picture, .sampler = gpu.sampler() }, whole(1, bins, 64) }) },
                 { .groupsX = kSize / 8 });
    std::vector<uint32_t> expected(16, 0);
    for (uint32_t i = 0; i < kSize * kSize; ++i) ++expected[(i % kSize * 5 + i / kSize * 3) % 16];
    EXPECT_EQ(gpu.readBuffer<uint32_t>(bins, 16), expected);
}

// Four writers of one buffer in turn; each reader sees the result of the previous writer.
DRIVER_TEST(Compute, UploadsDispatchesDrawsAndReadBacksOfOneBufferStayInOrder) {
    const Program doubled = gpu.computeProgram(computeOf(
            1, "layout(set = 0, binding = 0, std430) buffer Value { vec4 value; };", "value = value * 2.0 + 1.0;"));
    const Program show = gpu.program(
            kFullScreenVertex,
            fragmentOf("layout(set = 1, binding = 0, std140) uniform Value { vec4 value; };", "result = value;"));
    using enum BufferUsage;
    const BufferHandle value = gpu.buffer(Storage | Uniform | TransferSource, std::vector<float>{ 1, 2, 3, 4 });
    const PipelineHandle twice = gpu.computePipeline(doubled);
    const BindGroupHandle write = gpu.group(doubled, 0, { whole(0, value, 16) });
    const BindGroupHandle read = gpu.group(show, 1, { whole(0, value, 16) });
    const Paint small{ .width = 1, .height = 1, .group = read };

    const TextureHandle before = gpu.paint(show, small); // 1 2 3 4
    gpu.dispatch(twice, { write }, {});                  // 3 5 7 9
    const TextureHandle once = gpu.paint(show, small);
    gpu.dispatch(twice, { write }, {}); // 7 11 15 19
    gpu.dispatch(twice, { write }, {}); // 15 23 31 39
    const Ticket early = gpu.nextTicket();
    gpu.record(CmdReadBuffer{ .buffer = value, .offset = 4, .size = 8, .ticket = early });
    gpu.update(value, std::vector<float>{ 100, 200 }, 8); // 15 23 100 200
    gpu.dispatch(twice, { write }, {});                   // 31 47 201 401
    const TextureHandle after = gpu.paint(show, small);
    gpu.update(value, std::vector<float>{ 0, 0, 0, 0 });

    const Rect pixel{ 0, 0, 1, 1 };
    EXPECT_EQ(gpu.readAs<Rgba>(before, pixel)[0], (Rgba{ 1, 2, 3, 4 }));
    EXPECT_EQ(gpu.readAs<Rgba>(once, pixel)[0], (Rgba{ 3, 5, 7, 9 }));
    EXPECT_EQ(gpu.readAs<Rgba>(after, pixel)[0], (Rgba{ 31, 47, 201, 401 }));
    EXPECT_EQ(gpu.wait(early), bytesOf(std::vector<float>{ 23, 31 }));
    EXPECT_EQ(gpu.readBuffer<float>(value, 4), (std::vector<float>{ 0, 0, 0, 0 }));
}

DRIVER_TEST(Compute, ConstantsSpecialiseADispatchAndDynamicOffsetsMoveItsUniforms) {
    const std::string text = computeOf(1,
                                       "layout(constant_id = 4) const int kFactor = 1;\n"
                                       "layout(set = 0, binding = 0, std140) uniform Add { ivec4 add; };\n"
                                       "layout(set = 1, binding = 2, std430) buffer Out { int sums[]; };",
                                       "atomicAdd(sums[0], kFactor * add.x);");
    const uint32_t stride = gpu.info().limits.uniformOffsetAlignment;
    std::vector<int32_t> adds(stride / 4 + 4, 0);
    adds[0] = 1;
    adds[stride / 4] = 10;
    const BufferHandle uniforms = gpu.buffer(BufferUsage::Uniform, adds);
    const BufferHandle sums = gpu.buffer(kReadable, std::vector<int32_t>{ 0 });
    for (const uint32_t factor : { 3u, 500u }) {
        const Program program = gpu.computeProgram(
                text, { { .id = 4, .bits = factor, .type = ConstantValue::Type::Int } }, { { 0, 0 } });
        const BindGroupHandle add = gpu.group(program, 0, { whole(0, uniforms, 16) });
        const BindGroupHandle out = gpu.group(program, 1, { whole(2, sums, 4) });
        gpu.record(CmdBindPipeline{ gpu.computePipeline(program) });
        gpu.record(CmdBindGroup{ .group = out, .index = 1 });
        for (const uint32_t offset : { 0u, stride }) {
            gpu.record(CmdBindGroup{ .group = add, .index = 0, .dynamicCount = 1, .dynamicOffsets = { offset } });
            gpu.record(CmdDispatch{});
        }
    }
    EXPECT_EQ(gpu.readBuffer<int32_t>(sums, 1)[0], 3 + 30 + 500 + 5000);
}

DRIVER_TEST(Compute, APartOfABufferIsBoundAndTheRestIsLeftAlone) {
    const uint32_t stride = std::max(gpu.info().limits.storageOffsetAlignment, 256u);
    const Program program = gpu.computeProgram(
            computeOf(4, "layout(set = 0, binding = 0, std430) buffer Out { uint values[]; };",
                      "values[gl_LocalInvocationIndex] = uint(values.length()) * 10u + gl_LocalInvocationIndex;"));
    const BufferHandle buffer = gpu.buffer(kReadable, std::vector<uint32_t>(3 * stride / 4, 7));
    const BindGroupHandle middle =
            gpu.group(program, 0, { { .binding = 0, .buffer = buffer, .offset = stride, .size = 16 } });
    gpu.dispatch(gpu.computePipeline(program), { middle }, {});
    std::vector<uint32_t> expected(3 * stride / 4, 7);
    for (uint32_t i = 0; i < 4; ++i) expected[stride / 4 + i] = 40 + i;
    EXPECT_EQ(gpu.readBuffer<uint32_t>(buffer, expected.size()), expected);
}

DRIVER_TEST(Compute, AProgramThatDoesNotCompileIsReportedOnceAndItsDispatchSkipped) {
    const BufferHandle buffer = gpu.buffer(kReadable, std::vector<uint32_t>{ 7 });
    const std::array<uint32_t, 5> header{ 0x07230203, 0x00010300, 0, 1, 0 }; // valid header, empty SPIR-V module
    const std::string_view spirv(reinterpret_cast<const char*>(header.data()), sizeof(header));
    const bool isVulkan = gpu.backend() == Backend::Vulkan;
    const ProgramHandle broken =
            gpu.rawComputeProgram(isVulkan ? spirv : "#version 310 es\nvoid main() { undeclared = 1.0; }\n");
    gpu.record(CmdBindPipeline{ gpu.pipeline({ .program = broken }) });
    gpu.record(CmdDispatch{});
    EXPECT_EQ(gpu.readBuffer<uint32_t>(buffer, 1)[0], 7u) << "life goes on";
    const std::vector<DriverError> errors = gpu.takeErrors();
    ASSERT_FALSE(errors.empty());
    EXPECT_EQ(errors.front().kind, DriverErrorKind::ShaderCompile);
    EXPECT_THAT(errors.front().message, testing::HasSubstr("program 'broken program', compute shader"));
}

} // namespace filament_core::backend
