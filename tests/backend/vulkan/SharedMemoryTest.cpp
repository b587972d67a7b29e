// SPDX-License-Identifier: Apache-2.0
// Textures placed on the memory of others: DeviceTextureDesc::placedOn.
#include "tests/backend/vulkan/DriverFixture.h"

namespace filament_core::backend::vulkan {
namespace {

constexpr uint32_t kSide = 64;

class SharedMemoryTest : public DriverTest {
protected:
    TextureHandle makeOn(TextureHandle host, Format format, uint32_t side = kSide) {
        return makeTexture(
                { .format = format,
                  .usage = TextureUsage::Sampled | TextureUsage::ColorAttachment | TextureUsage::TransferSource,
                  .width = side,
                  .height = side,
                  .placedOn = host });
    }
    uint64_t usedBytes() {
        finish();
        return driver->device().memory().statistics().usedBytes;
    }
    void clear(TextureHandle texture, Format format, float value) {
        beginPass(texture, kSide, kSide, { value, value, value, value }, format);
        endPass();
    }
};

TEST_F(SharedMemoryTest, AliasedTexturesUseNoMoreMemoryAndTheLastWriteIsReadBack) {
    const TextureHandle bytes = makeTarget(kSide, kSide);
    const uint64_t before = usedBytes();
    const TextureHandle floats = makeOn(bytes, Format::R32F), halves = makeOn(floats, Format::RG16F);
    EXPECT_EQ(usedBytes(), before);
    for (const float value : { 0.0f, 1.0f, 0.0f }) { // in one stream: barriers alone keep them apart
        clear(bytes, Format::RGBA8, value);
        clear(floats, Format::R32F, value + 0.25f);
        clear(halves, Format::RG16F, value + 0.5f);
        clear(floats, Format::R32F, value + 2);
        EXPECT_EQ(readFloats(floats, kSide, kSide), std::vector<float>(kSide * kSide, value + 2));
        clear(bytes, Format::RGBA8, value);
        const auto level = static_cast<uint8_t>(value * 255);
        EXPECT_EQ(readPixels(bytes, kSide, kSide),
                  std::vector<Rgba8>(kSide * kSide, Rgba8{ level, level, level, level }));
    }
}

TEST_F(SharedMemoryTest, ALargeTextureWaitsForWhatASmallOneBeforeItHasNotCovered) {
    const TextureHandle samples =
            makeTexture({ .usage = TextureUsage::ColorAttachment, .samples = 4, .width = kSide, .height = kSide });
    const TextureHandle small = makeOn(samples, Format::R32F, kSide / 4), last = makeOn(samples, Format::RG16F);
    PassDesc pass{ .layout = colorLayout(Format::RGBA8), .area = { 0, 0, kSide, kSide }, .debugName = "samples" };
    pass.layout.samples = 4;
    pass.colors[0].texture = samples;
    commands.record(CmdBeginPass{ pass });
    endPass();
    beginPass(small, kSide / 4, kSide / 4, {}, Format::R32F);
    endPass();
    clear(makeTarget(kSide, kSide), Format::RGBA8, 0); // before this pass the small one becomes readable
    clear(last, Format::RG16F, 1); // the layer looks for the write of the samples, of which the small one hides a part
    finish();
    EXPECT_EQ(sink.errors.size(), 0u) << "messages of the validation layers, which follow";
}

TEST_F(SharedMemoryTest, EachLevelWaitsForThoseWhoHadItsMemory) {
    const TextureHandle first = makeTexture(
            { .usage = TextureUsage::Sampled | TextureUsage::ColorAttachment, .width = 2 * kSide, .height = kSide });
    const TextureHandle levels = makeTexture({ .usage = TextureUsage::Sampled | TextureUsage::ColorAttachment,
                                               .levels = 2,
                                               .width = kSide,
                                               .height = kSide,
                                               .placedOn = first });
    beginPass(first, 2 * kSide, kSide);
    endPass();
    for (uint8_t level = 0; level < 2; ++level) {
        PassDesc pass{ .layout = colorLayout(Format::RGBA8), .area = { 0, 0, kSide >> level, kSide >> level } };
        pass.colors[0].texture = levels;
        pass.colors[0].level = level;
        commands.record(CmdBeginPass{ pass });
        endPass();
    }
    finish();
    EXPECT_EQ(sink.errors.size(), 0u) << "messages of the validation layers, which follow";
}

TEST_F(SharedMemoryTest, ATextureThatDoesNotFitHasMemoryOfItsOwn) {
    const TextureHandle small = makeTarget(kSide, kSide);
    const uint64_t before = usedBytes();
    const TextureHandle large = makeOn(small, Format::RGBA16F, 2 * kSide);
    EXPECT_GE(usedBytes(), before + 4 * kSide * kSide * 8);
    clear(small, Format::RGBA8, 1);
    beginPass(large, 2 * kSide, 2 * kSide, {}, Format::RGBA16F);
    endPass();
    EXPECT_EQ(readPixels(small, kSide, kSide), std::vector<Rgba8>(kSide * kSide, Rgba8{ 255, 255, 255, 255 }));
}

TEST_F(SharedMemoryTest, MemoryLivesAsLongAsOneOfItsTextures) {
    const uint64_t before = usedBytes();
    const TextureHandle host = makeTarget(kSide, kSide);
    clear(host, Format::RGBA8, 1);
    const TextureHandle guest = makeOn(host, Format::R32F);
    commands.record(CmdDestroyTexture{ host });
    clear(guest, Format::R32F, 3); // the device may not have finished with the host
    EXPECT_EQ(readFloats(guest, kSide, kSide), std::vector<float>(kSide * kSide, 3));
    EXPECT_GT(usedBytes(), before);
    commands.record(CmdDestroyTexture{ guest });
    EXPECT_EQ(usedBytes(), before);
}

TEST_F(SharedMemoryTest, AHostThatCouldNotBeMadeIsNoHost) {
    const TextureHandle unknown = handle<TextureHandle>();
    const TextureHandle guest = makeOn(unknown, Format::R32F);
    clear(guest, Format::R32F, 3);
    EXPECT_EQ(readFloats(guest, kSide, kSide), std::vector<float>(kSide * kSide, 3));
}

} // namespace
} // namespace filament_core::backend::vulkan
