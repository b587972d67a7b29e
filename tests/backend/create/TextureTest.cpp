// SPDX-License-Identifier: Apache-2.0
// What a fragment stage reads from textures: formats, shapes, samplers. Expected values come from Texel.h and closed
// forms.
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/Texel.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace filament_core::backend {
namespace {

DRIVER_SUITE(Texture);

constexpr std::string_view kSampler2D = "layout(set = 1, binding = 0) uniform sampler2D image;";

/// One row of results: `body` sees `float i`, the column, and writes `result`.
std::vector<Rgba> paintRow(Gpu& gpu, uint32_t width, std::string_view declarations, std::string const& body,
                           TextureHandle texture, SamplerHandle sampler) {
    const Program program =
            gpu.program(kFullScreenVertex, fragmentOf(declarations, "float i = floor(gl_FragCoord.x);\n" + body));
    const TextureHandle target =
            gpu.paint(program, { .width = width, .height = 1, .group = gpu.imageGroup(program, texture, sampler) });
    return gpu.readAs<Rgba>(target, { 0, 0, width, 1 });
}

std::vector<float> firsts(std::vector<Rgba> const& row) {
    std::vector<float> values;
    for (Rgba const& texel : row) values.push_back(texel[0]);
    return values;
}

// ---------------------------------------------------------------------------------------------- formats

Bytes randomTexels(Format format, uint32_t count, std::mt19937& random) {
    FormatInfo const& info = formatInfo(format);
    Bytes bytes;
    for (uint32_t i = 0; i < count; ++i) {
        if (info.isFloat && format != Format::RGB9E5) { // random bits would be NaN or beyond what shaders keep
            std::uniform_real_distribution<float> value(0.001f, 100.0f);
            const Bytes texel = encodeTexel(format, { value(random), value(random), value(random), value(random) });
            bytes.insert(bytes.end(), texel.begin(), texel.end());
        } else {
            for (uint32_t byte = 0; byte < info.bytesPerBlock; ++byte)
                bytes.push_back(static_cast<std::byte>(random()));
        }
    }
    const bool isInteger = info.kind == FormatKind::UnsignedInteger || info.kind == FormatKind::SignedInteger;
    if (isInteger && info.bytesPerBlock / info.components == 4) {
        for (size_t i = 3; i < bytes.size(); i += 4) { // exact in the floats that the test reads
            const bool isNegative = info.kind == FormatKind::SignedInteger && i % 8 == 3;
            bytes[i] = isNegative ? std::byte{ 0xFF } : std::byte{ 0 };
        }
    }
    return bytes;
}

DRIVER_TEST(Texture, EveryUncompressedFormatIsSampledAsItsDefinitionSays) {
    std::mt19937 random(7);
    const SamplerHandle nearest = gpu.sampler();
    for (uint32_t i = 1; i < static_cast<uint32_t>(Format::Count); ++i) {
        const auto format = static_cast<Format>(i);
        FormatInfo const& info = formatInfo(format);
        if (isCompressed(format) || hasDepth(format)) continue;
        SCOPED_TRACE(info.name);
        const Bytes texels = randomTexels(format, 8, random);
        const std::string_view sampler = info.kind == FormatKind::UnsignedInteger
                                                 ? "layout(set = 1, binding = 0) uniform highp usampler2D image;"
                                         : info.kind == FormatKind::SignedInteger
                                                 ? "layout(set = 1, binding = 0) uniform highp isampler2D image;"
                                                 : kSampler2D;
        const std::vector<Rgba> seen =
                paintRow(gpu, 8, sampler, "result = vec4(texture(image, vec2((i + 0.5) / 8.0, 0.5)));",
                         gpu.image(format, 8, 1, texels), nearest);
        for (uint32_t t = 0; t < 8; ++t) {
            const Rgba expected = decodeTexel(format, texels.data() + size_t{ t } * info.bytesPerBlock);
            // sRGB decoding may use a table or a polynomial: half a step of 8 bits where its slope is 1.
            const double tolerance = info.isSrgb ? 2e-3 : 1e-6;
            for (uint32_t c = 0; c < 4; ++c) {
                ASSERT_NEAR(seen[t][c], expected[c], tolerance * std::max(1.0f, std::abs(expected[c])))
                        << t << ", " << c;
            }
        }
    }
}

/// Puts values into a block bit by bit, lowest first, as the BPTC specification counts them.
struct BitWriter {
    Bytes bytes = Bytes(16);
    uint32_t at = 0;
    void put(uint32_t value, uint32_t bits) {
        for (uint32_t i = 0; i < bits; ++i, ++at) bytes[at / 8] |= static_cast<std::byte>((value >> i & 1) << (at % 8));
    }
};

// Mode 6 of BC7: one subset, 7 bits an endpoint and a shared lowest bit; both endpoints equal.
Bytes solidBc7(std::array<uint8_t, 4> color) {
    BitWriter block;
    block.put(1u << 6, 7);
    for (const uint8_t c : color) block.put(c >> 1, 7), block.put(c >> 1, 7);
    block.put(color[0] & 1, 1), block.put(color[0] & 1, 1);
    return block.bytes;
}

// Mode 11 of BC6H: one region, 10 bits an endpoint, no deltas.
Bytes solidBc6h(std::array<uint32_t, 3> quantized) {
    BitWriter block;
    block.put(0b00011, 5);
    for (int endpoint = 0; endpoint < 2; ++endpoint) {
        for (const uint32_t q : quantized) block.put(q, 10);
    }
    return block.bytes;
}

float bc6hValue(uint32_t quantized) { // unquantise to 16 bits, then scale by 31/64 into the bits of a half
    const uint32_t wide = quantized == 0 ? 0 : quantized == 1023 ? 0xFFFF : ((quantized << 16) + 0x8000) >> 10;
    std::array<std::byte, 2> bits{};
    const auto half = static_cast<uint16_t>(wide * 31 >> 6);
    std::memcpy(bits.data(), &half, 2);
    return decodeTexel(Format::R16F, bits.data())[0];
}

Bytes blockOf(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

struct BlockCase {
    Format format;
    Bytes block;
    std::array<Rgba, 4> row; ///< texels 0..3 of row 0
};

std::vector<BlockCase> blockCases() {
    // BC1: red, blue, and the two thirds between them; row 0 has indices 0 1 2 3.
    const Bytes redBlue = blockOf({ 0x00, 0xF8, 0x1F, 0x00, 0xE4, 0xE4, 0xE4, 0xE4 });
    const std::array<Rgba, 4> redBlueRow{
        { { 1, 0, 0, 1 }, { 0, 0, 1, 1 }, { 2 / 3.f, 0, 1 / 3.f, 1 }, { 1 / 3.f, 0, 2 / 3.f, 1 } }
    };
    // BC4: 255 and 0, six values between; 3-bit indices 0 1 2 7 in every row: bits 000 001 010 111 = 0xE88, rows packed
    // by 12.
    const Bytes ramp = blockOf({ 255, 0, 0x88, 0x8E, 0xE8, 0x88, 0x8E, 0xE8 });
    const std::array<float, 4> rampRow{ 1, 0, 6 / 7.f, 1 / 7.f };
    const auto joined = [](Bytes a, Bytes const& b) { return a.insert(a.end(), b.begin(), b.end()), a; };
    std::vector<BlockCase> cases{ { Format::BC1, redBlue, redBlueRow }, { Format::BC1Srgb, redBlue, redBlueRow } };
    BlockCase bc2{ Format::BC2, joined(blockOf({ 0x50, 0xFA, 0, 0, 0, 0, 0, 0 }), redBlue), redBlueRow };
    const float explicitAlpha[4] = { 0, 5 / 15.f, 10 / 15.f, 1 };
    BlockCase bc3{ Format::BC3, joined(ramp, redBlue), redBlueRow };
    BlockCase bc4{ Format::BC4, ramp, {} }, bc5{ Format::BC5, joined(ramp, ramp), {} };
    for (size_t i = 0; i < 4; ++i) {
        bc2.row[i][3] = explicitAlpha[i];
        bc3.row[i][3] = rampRow[i];
        bc4.row[i] = { rampRow[i], 0, 0, 1 };
        bc5.row[i] = { rampRow[i], rampRow[i], 0, 1 };
    }
    for (BlockCase one : { bc2, bc3 }) {
        cases.push_back(one);
        one.format = one.format == Format::BC2 ? Format::BC2Srgb : Format::BC3Srgb;
        cases.push_back(one);
    }
    cases.push_back(bc4);
    cases.push_back(bc5);
    const Rgba solid{ 200 / 255.f, 100 / 255.f, 50 / 255.f, 128 / 255.f };
    // The shared lowest bit makes all of a colour's components even here.
    cases.push_back({ Format::BC7, solidBc7({ 200, 100, 50, 128 }), { solid, solid, solid, solid } });
    cases.push_back({ Format::BC7Srgb, solidBc7({ 200, 100, 50, 128 }), { solid, solid, solid, solid } });
    const Rgba hdr{ bc6hValue(700), bc6hValue(300), bc6hValue(1023), 1 };
    cases.push_back({ Format::BC6HUfloat, solidBc6h({ 700, 300, 1023 }), { hdr, hdr, hdr, hdr } });
    return cases;
}

DRIVER_TEST(Texture, EveryBlockCompressedFormatDecodesHandMadeBlocks) {
    if (!gpu.info().features.blockCompression) GTEST_SKIP() << "this device has no block compression";
    const SamplerHandle nearest = gpu.sampler();
    for (BlockCase const& one : blockCases()) {
        FormatInfo const& info = formatInfo(one.format);
        SCOPED_TRACE(info.name);
        const std::vector<Rgba> seen =
                paintRow(gpu, 4, kSampler2D, "result = texture(image, vec2((i + 0.5) / 4.0, 0.125));",
                         gpu.image(one.format, 4, 4, one.block), nearest);
        for (size_t t = 0; t < 4; ++t) {
            for (size_t c = 0; c < 4; ++c) {
                const double expected = info.isSrgb && c < 3 ? linearFromSrgb(one.row[t][c]) : double{ one.row[t][c] };
                // Decoders round interpolated colours to 8 bits, before sRGB decoding.
                ASSERT_NEAR(seen[t][c], expected, 0.009 * std::max(1.0, expected))
                        << "texel " << t << " component " << c;
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------- shapes

DRIVER_TEST(Texture, UploadsOfRectanglesReplaceNothingElse) {
    using enum TextureUsage;
    std::vector<uint32_t> expected(6 * 5, 0x11111111);
    const TextureHandle texture =
            gpu.texture({ .format = Format::R32UI, .usage = TransferTarget | TransferSource, .width = 6, .height = 5 });
    gpu.upload(texture, { 0, 0, 6, 5 }, bytesOf(expected));
    const std::vector<uint32_t> patch{ 1, 2, 3, 4, 5, 6 };
    gpu.upload(texture, { 2, 1, 3, 2 }, bytesOf(patch));
    for (uint32_t i = 0; i < 6; ++i) expected[(1 + i / 3) * 6 + 2 + i % 3] = patch[i];
    EXPECT_EQ(gpu.readAs<uint32_t>(texture, { 0, 0, 6, 5 }), expected);
    EXPECT_EQ(gpu.readAs<uint32_t>(texture, { 2, 1, 3, 2 }), patch) << "a read-back of the same rectangle";
}

DRIVER_TEST(Texture, OddRowsOfNarrowFormatsAreTightlyPacked) {
    using enum TextureUsage;
    for (const Format format : { Format::R8, Format::RG8, Format::R16F }) {
        SCOPED_TRACE(formatInfo(format).name);
        Bytes bytes(size_t{ 3 } * 5 * formatInfo(format).bytesPerBlock);
        for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i + 1);
        const TextureHandle texture =
                gpu.texture({ .format = format, .usage = TransferTarget | TransferSource, .width = 3, .height = 5 });
        gpu.upload(texture, { 0, 0, 3, 5 }, bytes);
        EXPECT_EQ(gpu.read(texture, { 0, 0, 3, 5 }), bytes);
    }
}

DRIVER_TEST(Texture, ArrayLayersAreUploadedTogetherAndSampledApart) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .type = TextureKind::Texture2DArray,
                                                .format = Format::R32F,
                                                .usage = Sampled | TransferTarget,
                                                .layers = 5,
                                                .width = 2,
                                                .height = 2 });
    std::vector<float> texels;
    for (int i = 0; i < 20; ++i) texels.push_back(static_cast<float>(i));
    gpu.upload(texture, { 0, 0, 2, 2 }, bytesOf(std::vector<float>(texels.begin(), texels.begin() + 8)), 0, 0, 2);
    gpu.upload(texture, { 0, 0, 2, 2 }, bytesOf(std::vector<float>(texels.begin() + 8, texels.end())), 0, 2, 3);
    const std::vector<Rgba> seen = paintRow(
            gpu, 20, "layout(set = 1, binding = 0) uniform highp sampler2DArray image;",
            "float t = mod(i, 4.0);\n"
            "result = texture(image, vec3((mod(t, 2.0) + 0.5) * 0.5, (floor(t * 0.5) + 0.5) * 0.5, floor(i * 0.25)));",
            texture, gpu.sampler());
    EXPECT_EQ(firsts(seen), texels);
}

DRIVER_TEST(Texture, CubeFacesAndTheirAxesFollowTheOrderOfBothApis) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .type = TextureKind::Cube,
                                                .format = Format::R32F,
                                                .usage = Sampled | TransferTarget,
                                                .layers = 6,
                                                .width = 2,
                                                .height = 2 });
    std::vector<float> texels; // face * 10 + row * 2 + column
    for (int i = 0; i < 24; ++i) texels.push_back(static_cast<float>(i / 4 * 10 + i % 4));
    gpu.upload(texture, { 0, 0, 2, 2 }, bytesOf(texels), 0, 0, 6);
    // Face selection: OpenGL ES 3.2 table 8.19. s runs along -z for +x, t along -y.
    const std::vector<Rgba> seen = paintRow(gpu, 8, "layout(set = 1, binding = 0) uniform highp samplerCube image;",
                                            R"(vec3 d = vec3(1.0, 0.5, 0.5);
               if (i == 1.0) d = vec3(-1.0, 0.5, 0.5);
               if (i == 2.0) d = vec3(0.5, 1.0, 0.5);
               if (i == 3.0) d = vec3(0.5, -1.0, 0.5);
               if (i == 4.0) d = vec3(0.5, 0.5, 1.0);
               if (i == 5.0) d = vec3(0.5, 0.5, -1.0);
               if (i == 6.0) d = vec3(1.0, -0.5, -0.5);
               if (i == 7.0) d = vec3(0.5, -0.5, 1.0);
               result = texture(image, d);)",
                                            texture, gpu.sampler());
    // +x: sc = -z < 0, tc = -y < 0 -> texel 0; -x: sc = +z; +y: sc = +x, tc = +z; -y: tc = -z; +z: sc = +x, tc = -y;
    // -z: sc = -x.
    EXPECT_EQ(firsts(seen), (std::vector<float>{ 0, 11, 23, 31, 41, 50, 3, 43 }));
}

DRIVER_TEST(Texture, AnArrayOfCubesIsSelectedByTheFourthCoordinate) {
    using enum TextureUsage;
    if (!gpu.info().features.cubeArrays) GTEST_SKIP() << "the device has no arrays of cubes";
    const TextureHandle texture = gpu.texture({ .type = TextureKind::CubeArray,
                                                .format = Format::R32F,
                                                .usage = Sampled | TransferTarget,
                                                .levels = 2,
                                                .layers = 18,
                                                .width = 2,
                                                .height = 2 });
    const auto upload = [&](uint32_t level, size_t texelsOfFace) {
        std::vector<float> texels; // level * 100 + layer
        for (size_t i = 0; i < 18 * texelsOfFace; ++i)
            texels.push_back(static_cast<float>(level * 100 + i / texelsOfFace));
        const uint32_t size = 2 >> level;
        gpu.upload(texture, { 0, 0, size, size }, bytesOf(texels), static_cast<uint8_t>(level), 0, 18);
    };
    upload(0, 4);
    upload(1, 1);
    gpu.upload(texture, { 0, 0, 2, 2 }, bytesOf(std::vector<float>(4, 42)), 0, 7, 1); // -x of the second cube
    const std::vector<Rgba> seen =
            paintRow(gpu, 6, "layout(set = 1, binding = 0) uniform highp samplerCubeArray image;",
                     R"(vec4 d = vec4(1.0, 0.1, 0.1, 0.0);
               if (i == 1.0) d = vec4(0.1, 0.1, -1.0, 0.0);
               if (i == 2.0) d = vec4(1.0, 0.1, 0.1, 1.0);
               if (i == 3.0) d = vec4(-1.0, 0.1, 0.1, 1.0);
               if (i == 4.0) d = vec4(0.1, 1.0, 0.1, 2.0);
               result = i == 5.0 ? textureLod(image, vec4(0.1, 1.0, 0.1, 2.0), 1.0) : textureLod(image, d, 0.0);)",
                     texture, gpu.sampler({ .mipFilter = MipFilter::Nearest }));
    EXPECT_EQ(firsts(seen), (std::vector<float>{ 0, 5, 6, 42, 14, 114 }));
}

// Half of the slices are drawn, in no order; two are uploaded before and one after that.
DRIVER_TEST(Texture, SlicesOfA3DTextureAreDrawnApartAndSampledTogether) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .type = TextureKind::Texture3D,
                                                .format = Format::R32F,
                                                .usage = Sampled | ColorAttachment | TransferTarget | TransferSource,
                                                .levels = 2,
                                                .layers = 6,
                                                .width = 4,
                                                .height = 2 });
    const auto upload = [&](uint8_t level, uint16_t slice, float value) {
        const uint32_t width = 4u >> level, height = 2u >> level;
        gpu.upload(texture, { 0, 0, width, height }, bytesOf(std::vector<float>(size_t{ width } * height, value)),
                   level, slice, 1);
    };
    const Program program =
            gpu.program(kFullScreenVertex,
                        fragmentOf("", "result = vec4(floor(gl_FragCoord.x) + 10.0 * floor(gl_FragCoord.y) + 7.0);"));
    const auto draw = [&](uint8_t level, uint16_t slice, float cleared) {
        PassDesc pass = passOver({ { texture, Format::R32F } }, 4u >> level, 2u >> level);
        pass.colors[0] = { .texture = texture, .level = level, .layer = slice, .clear = { cleared, 0, 0, 0 } };
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdEndPass{});
        pass.colors[0].load = LoadOp::Load; // all columns but the first, over what the slice holds
        pass.area.x = 1, pass.area.width -= 1;
        const PipelineHandle pipeline = gpu.pipeline(pipelineFor(program, pass.layout));
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdBindPipeline{ pipeline });
        gpu.record(CmdDraw{ .vertexCount = 3 });
        gpu.record(CmdEndPass{});
    };
    upload(0, 1, 1000), upload(1, 2, 2000);
    draw(0, 5, 500), draw(1, 0, 3000), draw(0, 0, 100), draw(0, 2, 200), draw(1, 1, 4000), draw(0, 3, 300);
    upload(0, 4, 400);
    const std::vector<Rgba> seen = paintRow(gpu, 54, "layout(set = 1, binding = 0) uniform highp sampler3D image;",
                                            R"(float slice = floor(i / 8.0), texel = mod(i, 8.0);
        result = i < 48.0 ? texelFetch(image, ivec3(mod(texel, 4.0), texel / 4.0, slice), 0)
                          : texelFetch(image, ivec3(mod(i, 2.0), 0, (i - 48.0) / 2.0), 1);)",
                                            texture, gpu.sampler({ .mipFilter = MipFilter::Nearest }));
    for (uint32_t i = 0; i < 48; ++i) {
        const uint32_t slice = i / 8, column = i % 4, row = i % 8 / 4;
        const std::array<float, 6> bases{ 100, 1000, 200, 300, 400, 500 };
        const bool isDrawn = slice != 1 && slice != 4 && column > 0;
        EXPECT_EQ(seen[i][0], isDrawn ? static_cast<float>(column + 10 * row + 7) : bases[slice]) << i;
    }
    const std::vector<float> smaller{ 3000, 8, 4000, 8, 2000, 2000 };
    for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(seen[48 + i][0], smaller[i]) << i;
    EXPECT_EQ(gpu.readAs<float>(texture, { 0, 0, 4, 2 }, 0, 3), (std::vector<float>{ 300, 8, 9, 10, 300, 18, 19, 20 }));
}

DRIVER_TEST(Texture, SlicesOfA3DTextureAreUploadedApartAndFilteredTogether) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .type = TextureKind::Texture3D,
                                                .format = Format::R32F,
                                                .usage = Sampled | TransferTarget,
                                                .levels = 3,
                                                .layers = 6,
                                                .width = 2,
                                                .height = 4 });
    const auto upload = [&](uint8_t level, Rect rect, uint16_t slice, uint16_t slices) {
        std::vector<float> texels; // level * 1000 + slice * 100 + row * 10 + column
        for (uint32_t z = slice; z < slice + uint32_t{ slices }; ++z) {
            for (uint32_t y = 0; y < rect.height; ++y) {
                for (uint32_t x = 0; x < rect.width; ++x)
                    texels.push_back(static_cast<float>(level * 1000 + z * 100 + (uint32_t(rect.y) + y) * 10 +
                                                        (uint32_t(rect.x) + x)));
            }
        }
        gpu.upload(texture, rect, bytesOf(texels), level, slice, slices);
    };
    upload(0, { 0, 0, 2, 4 }, 0, 4);
    upload(0, { 0, 0, 2, 3 }, 4, 2);
    upload(0, { 0, 3, 2, 1 }, 4, 2);
    upload(1, { 0, 0, 1, 2 }, 0, 3);
    upload(2, { 0, 0, 1, 1 }, 0, 1);
    constexpr const char* kImage = "layout(set = 1, binding = 0) uniform highp sampler3D image;";
    const std::vector<Rgba> all = paintRow(gpu, 48, kImage,
                                           "float t = mod(i, 8.0);\n"
                                           "vec3 at = vec3((mod(t, 2.0) + 0.5) * 0.5, (floor(t * 0.5) + 0.5) * 0.25, "
                                           "(floor(i * 0.125) + 0.5) / 6.0);\n"
                                           "result = textureLod(image, at, 0.0);",
                                           texture, gpu.sampler({ .mipFilter = MipFilter::Nearest }));
    for (uint32_t i = 0; i < 48; ++i)
        EXPECT_EQ(all[i][0], static_cast<float>(i / 8 * 100 + i % 8 / 2 * 10 + i % 2)) << i;
    const std::vector<Rgba> levels = paintRow(
            gpu, 4, kImage, "result = textureLod(image, vec3(0.5, 0.75, (i + 0.5) / 3.0), i < 3.0 ? 1.0 : 2.0);",
            texture, gpu.sampler({ .mipFilter = MipFilter::Nearest }));
    EXPECT_EQ(firsts(levels), (std::vector<float>{ 1010, 1110, 1210, 2000 }));
    // Half way between slices 1 and 2; beyond the last one, where wrapW repeats.
    const SamplerHandle linear =
            gpu.sampler({ .magFilter = Filter::Linear, .minFilter = Filter::Linear, .wrapW = WrapMode::Repeat });
    const std::vector<Rgba> between =
            paintRow(gpu, 2, kImage, "result = textureLod(image, vec3(0.25, 0.125, (2.0 + 4.0 * i) / 6.0), 0.0);",
                     texture, linear);
    EXPECT_EQ(firsts(between), (std::vector<float>{ 150, 250 }));
}

// ---------------------------------------------------------------------------------------------- samplers

int wrapped(int texel, int size, WrapMode mode) {
    const auto modulo = [](int a, int b) { return (a % b + b) % b; };
    switch (mode) {
    case WrapMode::Repeat:
        return modulo(texel, size);
    case WrapMode::MirroredRepeat: {
        const int m = modulo(texel, 2 * size);
        return m < size ? m : 2 * size - 1 - m;
    }
    case WrapMode::ClampToEdge:
        return std::clamp(texel, 0, size - 1);
    }
    return 0;
}

DRIVER_TEST(Texture, WrapModesContinueTheTextureAsTheirNamesSay) {
    const TextureHandle texture = gpu.image(Format::R32F, 4, 1, bytesOf(std::vector<float>{ 10, 20, 30, 40 }));
    for (const WrapMode mode : { WrapMode::Repeat, WrapMode::MirroredRepeat, WrapMode::ClampToEdge }) {
        const std::vector<Rgba> seen =
                paintRow(gpu, 24, kSampler2D, "result = texture(image, vec2((i - 10.0 + 0.5) * 0.25, 0.5));", texture,
                         gpu.sampler({ .wrapU = mode }));
        for (int i = 0; i < 24; ++i) {
            ASSERT_EQ(seen[static_cast<size_t>(i)][0], 10.0f * static_cast<float>(wrapped(i - 10, 4, mode) + 1)) << i;
        }
    }
}

DRIVER_TEST(Texture, LinearFilteringWeighsFourNeighbours) {
    const TextureHandle texture = gpu.image(Format::R32F, 2, 2, bytesOf(std::vector<float>{ 0, 1, 2, 5 }));
    const std::vector<Rgba> seen =
            paintRow(gpu, 16, kSampler2D,
                     "result = texture(image, vec2(0.25 + mod(i, 4.0) / 6.0, 0.25 + floor(i * 0.25) / 6.0));", texture,
                     gpu.sampler({ .magFilter = Filter::Linear, .minFilter = Filter::Linear }));
    for (int i = 0; i < 16; ++i) {
        const double x = i % 4 / 3.0, y = i / 4 / 3.0; // 0 at the first centre, 1 at the second
        const double expected = (1 - y) * x + y * (2 * (1 - x) + 5 * x);
        ASSERT_NEAR(seen[static_cast<size_t>(i)][0], expected, 5.0 / 256)
                << i; // 8 bits of weight are what devices promise
    }
}

TextureHandle levelsOfTheirNumber(Gpu& gpu, uint32_t size, uint8_t levels) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .format = Format::R32F,
                                                .usage = Sampled | TransferTarget,
                                                .levels = levels,
                                                .width = size,
                                                .height = size });
    for (uint8_t level = 0; level < levels; ++level) {
        const uint32_t side = size >> level;
        gpu.upload(texture, { 0, 0, side, side }, bytesOf(std::vector<float>(size_t{ side } * side, level)), level);
    }
    return texture;
}

DRIVER_TEST(Texture, ExplicitLevelsOfDetailRoundOrBlendByTheMipFilter) {
    const TextureHandle texture = levelsOfTheirNumber(gpu, 16, 5);
    const std::string lod = "result = textureLod(image, vec2(0.5), i * 0.25 - 1.0);";
    const auto seen = [&](MipFilter filter) {
        return firsts(paintRow(gpu, 24, kSampler2D, lod, texture, gpu.sampler({ .mipFilter = filter })));
    };
    const std::vector<float> none = seen(MipFilter::None), nearest = seen(MipFilter::Nearest),
                             linear = seen(MipFilter::Linear);
    for (int i = 0; i < 24; ++i) {
        const double lambda = std::clamp(i * 0.25 - 1.0, 0.0, 4.0);
        EXPECT_EQ(none[static_cast<size_t>(i)], 0) << i;
        EXPECT_NEAR(linear[static_cast<size_t>(i)], lambda, 1.0 / 256) << i;
        if (std::abs(lambda - std::floor(lambda) - 0.5) < 0.1) continue; // a tie: either neighbour is correct
        EXPECT_EQ(nearest[static_cast<size_t>(i)], std::round(lambda)) << i;
    }
}

DRIVER_TEST(Texture, ImplicitLevelsFollowTheFootprintOfAPixel) {
    const TextureHandle texture = levelsOfTheirNumber(gpu, 64, 7);
    const SamplerHandle sampler =
            gpu.sampler({ .mipFilter = MipFilter::Linear, .wrapU = WrapMode::Repeat, .wrapV = WrapMode::Repeat });
    for (int level = 0; level < 6; ++level) {
        const int texels = 1 << level; // a pixel
        const Program program = gpu.program(
                kFullScreenVertex, fragmentOf(kSampler2D, "result = texture(image, gl_FragCoord.xy * " +
                                                                  std::to_string(texels) + ".0 * (1.0 / 64.0));"));
        const TextureHandle target =
                gpu.paint(program, { .width = 4, .height = 4, .group = gpu.imageGroup(program, texture, sampler) });
        for (Rgba const& texel : gpu.readAs<Rgba>(target, { 0, 0, 4, 4 })) ASSERT_NEAR(texel[0], level, 0.01) << texels;
    }
}

DRIVER_TEST(Texture, AnisotropyKeepsTheShortAxisOfAStretchedFootprint) {
    if (gpu.info().limits.maxAnisotropy < 8) GTEST_SKIP() << "this device has no anisotropic filtering";
    const TextureHandle texture = levelsOfTheirNumber(gpu, 64, 7);
    const auto levelSeen = [&](uint8_t anisotropy) {
        const SamplerHandle sampler = gpu.sampler({ .magFilter = Filter::Linear,
                                                    .minFilter = Filter::Linear,
                                                    .mipFilter = MipFilter::Linear,
                                                    .wrapU = WrapMode::Repeat,
                                                    .wrapV = WrapMode::Repeat,
                                                    .anisotropy = anisotropy });
        const Program program = gpu.program(
                kFullScreenVertex,
                fragmentOf(kSampler2D, "result = texture(image, gl_FragCoord.xy * vec2(8.0, 1.0) * (1.0 / 64.0));"));
        const TextureHandle target =
                gpu.paint(program, { .width = 4, .height = 4, .group = gpu.imageGroup(program, texture, sampler) });
        return gpu.readAs<Rgba>(target, { 0, 0, 4, 4 })[5][0];
    };
    EXPECT_NEAR(levelSeen(1), 3, 0.05) << "isotropic: log2 of the long axis";
    EXPECT_LT(levelSeen(8), 0.5f) << "8 samples along the long axis: log2 of the short one";
}

// ---------------------------------------------------------------------------------------------- shadow compare

// A depth texture whose left half is 0.25 and right half 0.75, drawn by clearing.
TextureHandle twoDepths(Gpu& gpu) {
    const TextureHandle depth = gpu.target(Format::D32F, 4, 4);
    PassDesc pass;
    pass.layout.depthFormat = Format::D32F;
    pass.depth = { .texture = depth, .clear = { 0.25f, 0, 0, 0 } };
    pass.area = { 0, 0, 4, 4 };
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdEndPass{});
    constexpr std::string_view kRightHalf = R"(#version 450
void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, float(gl_VertexIndex >> 1) * 2.0 - 1.0), 0.75, 1.0); })";
    const Program program = gpu.program(kRightHalf, "#version 450\nvoid main() {}\n");
    PipelineDesc desc = pipelineFor(program, pass.layout);
    desc.raster.topology = PrimitiveType::TriangleStrip;
    desc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
    pass.depth.load = LoadOp::Load;
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 4 });
    gpu.record(CmdEndPass{});
    return depth;
}

bool compares(CompareOp op, double reference, double texel) {
    switch (op) {
    case CompareOp::Never:
        return false;
    case CompareOp::Less:
        return reference < texel;
    case CompareOp::Equal:
        return reference == texel;
    case CompareOp::LessEqual:
        return reference <= texel;
    case CompareOp::Greater:
        return reference > texel;
    case CompareOp::NotEqual:
        return reference != texel;
    case CompareOp::GreaterEqual:
        return reference >= texel;
    default:
        return true;
    }
}

constexpr std::string_view kShadow = "layout(set = 1, binding = 0) uniform highp sampler2DShadow image;";

DRIVER_TEST(Texture, ShadowSamplersCompareTheReferenceWithTheTexel) {
    const TextureHandle depth = twoDepths(gpu);
    for (int i = 1; i <= static_cast<int>(CompareOp::Always); ++i) {
        const auto op = static_cast<CompareOp>(i);
        const std::vector<Rgba> seen =
                paintRow(gpu, 6, kShadow,
                         "float shadow = texture(image, vec3(i < 3.0 ? 0.25 : 0.75, 0.5, 0.25 + mod(i, 3.0) * 0.25));\n"
                         "result = vec4(shadow);",
                         depth, gpu.sampler({ .compare = op }));
        for (int column = 0; column < 6; ++column) {
            const double reference = 0.25 + column % 3 * 0.25, texel = column < 3 ? 0.25 : 0.75;
            EXPECT_EQ(seen[static_cast<size_t>(column)][0], compares(op, reference, texel) ? 1.0f : 0.0f)
                    << "op " << i << ", " << column;
        }
    }
}

DRIVER_TEST(Texture, LinearShadowSamplersFilterTheComparisons) {
    const TextureHandle depth = twoDepths(gpu);
    const std::vector<Rgba> seen = paintRow(
            gpu, 9, kShadow,
            "float shadow = texture(image, vec3(0.375 + i * (0.25 / 8.0), 0.5, 0.5));\nresult = vec4(shadow);", depth,
            gpu.sampler({ .magFilter = Filter::Linear, .minFilter = Filter::Linear, .compare = CompareOp::Less }));
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(seen[static_cast<size_t>(i)][0], i / 8.0, 1.0 / 256) << i;
}

} // namespace
} // namespace filament_core::backend
