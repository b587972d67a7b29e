// SPDX-License-Identifier: Apache-2.0
// filament_core/assets/blocks decodes BC1 to BC7 as devices do: every mode and partition, with random ends and indices.
#include "base/math/Half.h"
#include "filament_core/assets/blocks/BlockDecoder.h"
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/RandomBlocks.h"

#include <cmath>

namespace filament_core::backend {
namespace {

DRIVER_SUITE(BlockDecoding);

constexpr uint32_t kSide = 128, kBlocks = kSide / 4 * kSide / 4;

std::vector<Rgba> sampled(Gpu& gpu, Format format, Bytes const& bytes) {
    const Program program =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                                      "result = texelFetch(image, ivec2(gl_FragCoord.xy), 0);"));
    const BindGroupHandle group = gpu.imageGroup(program, gpu.image(format, kSide, kSide, bytes), gpu.sampler());
    const TextureHandle target = gpu.paint(program, { .width = kSide, .height = kSide, .group = group });
    return gpu.readAs<Rgba>(target, { 0, 0, kSide, kSide });
}

std::vector<Rgba> decoded(assets::BlockKind kind, Bytes const& bytes) {
    const bool isHalf = assets::hasHalfTexels(kind);
    Bytes texels(size_t{ kSide } * kSide * (isHalf ? 8 : 4));
    assets::decodeBlocks({ kind }, false, bytes, kSide, kSide, texels);
    std::vector<Rgba> colors(size_t{ kSide } * kSide);
    for (size_t i = 0; i < colors.size() * 4; ++i) {
        uint16_t half = 0;
        if (isHalf) std::memcpy(&half, &texels[2 * i], sizeof(half));
        colors[i / 4][i % 4] = isHalf ? floatFromHalf(half) : static_cast<float>(std::to_integer<int>(texels[i])) / 255;
    }
    return colors;
}

/// `steps`: codes of 8 bits by which devices may differ, who interpolate in other precisions.
void expectSame(Gpu& gpu, Format format, assets::BlockKind kind, Bytes const& bytes, float steps) {
    const std::vector<Rgba> device = sampled(gpu, format, bytes), ours = decoded(kind, bytes);
    float worst = 0;
    for (size_t i = 0; i < ours.size(); ++i) {
        for (size_t c = 0; c < 4; ++c) {
            const float difference = std::abs(device[i][c] - ours[i][c]);
            worst = std::max(worst, difference);
            ASSERT_LE(difference, steps / 255 + 1e-6f)
                    << formatInfo(format).name << ": texel " << i % kSide << ", " << i / kSide << " channel " << c
                    << ": " << device[i][c] << " and " << ours[i][c];
        }
    }
    testing::Test::RecordProperty(formatInfo(format).name, std::to_string(worst * 255));
}

DRIVER_TEST(BlockDecoding, ColoursOfBc1ToBc5AreThoseOfDevicesWithinTheirPrecision) {
    if (!gpu.info().features.blockCompression)
        GTEST_SKIP() << "this device samples no BC formats, which are optional: there is nothing to compare the "
                        "decoder with";
    using enum assets::BlockKind;
    expectSame(gpu, Format::BC1, Bc1Rgba, randomBlocks(8, kBlocks, 11, noMode), 2);
    expectSame(gpu, Format::BC2, Bc2, randomBlocks(16, kBlocks, 11, noMode), 2);
    expectSame(gpu, Format::BC3, Bc3, randomBlocks(16, kBlocks, 11, noMode), 2);
    expectSame(gpu, Format::BC4, Bc4, randomBlocks(8, kBlocks, 11, noMode), 2);
    expectSame(gpu, Format::BC5, Bc5, randomBlocks(16, kBlocks, 11, noMode), 2);
}

DRIVER_TEST(BlockDecoding, EveryModeAndPartitionOfBc7HasTheBitsOfDevices) {
    if (!gpu.info().features.blockCompression)
        GTEST_SKIP() << "this device samples no BC formats, which are optional: there is nothing to compare the "
                        "decoder with";
    expectSame(gpu, Format::BC7, assets::BlockKind::Bc7, randomBlocks(16, kBlocks, 11, modeOfBc7), 0);
}

DRIVER_TEST(BlockDecoding, EveryModeOfBc6HasTheBitsOfDevices) {
    if (!gpu.info().features.blockCompression)
        GTEST_SKIP() << "this device samples no BC formats, which are optional: there is nothing to compare the "
                        "decoder with";
    expectSame(gpu, Format::BC6HUfloat, assets::BlockKind::Bc6, randomBlocks(16, kBlocks, 11, modeOfBc6), 0);
}

} // namespace
} // namespace filament_core::backend
