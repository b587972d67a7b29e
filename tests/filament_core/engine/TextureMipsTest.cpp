// SPDX-License-Identifier: Apache-2.0
// Who makes the mips of a texture: the driver, or, if sRGB must be encoded, the engine.
#include "backend/layers/Captured.h"
#include "filament_core/assets/image/MipMaps.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/Engine.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace filament_core {
namespace {

using Bytes = std::vector<std::byte>;

/// The contents of one texture.
struct Filling {
    std::map<uint32_t, Bytes> levels; ///< by level: what was uploaded, layer after layer
    uint32_t generated = 0;           ///< CmdGenerateMips
};

/// Records, on the driver thread, what the stream does to textures.
class FillingLog final : public backend::StreamEdit {
public:
    explicit FillingLog(Filling& filling) : mFilling(filling) {}

    using backend::StreamEdit::edit;
    void inspect(backend::CommandView view) override {
        for (backend::CommandChunk const& chunk : view) {
            for (size_t at = 0; at < chunk.size;) {
                auto const& header = *reinterpret_cast<backend::CommandHeader const*>(chunk.data + at);
                mFilling.generated += header.id == backend::kCommandId<backend::CmdGenerateMips>;
                at += header.bytes;
            }
        }
    }
    void edit(backend::CmdUploadTexture& command) override {
        Bytes& level = mFilling.levels[command.level];
        level.insert(level.end(), command.bytes.begin(), command.bytes.end());
    }

private:
    Filling& mFilling;
};

/// Creates `desc` on a separate engine; `before` are the uploads that a new engine makes itself.
Filling fillingOf(Backend backend, TextureDesc const& desc) {
    Filling filling;
    auto engine = Engine::create(
            { .backend = backend,
              .workers = 0,
              .validation = true,
              .debug = { .capture = std::make_shared<backend::FrameCapture>(std::make_unique<FillingLog>(filling)) } });
    EXPECT_TRUE(engine.ok()) << (engine.ok() ? "" : engine.error().message);
    if (!engine) return filling;
    engine->waitIdle();
    filling = {};
    const Owned<Texture> texture = engine->own(engine->create(desc));
    engine->waitIdle();
    test::expectNoErrors(*engine);
    return filling;
}

Bytes noise(size_t count) {
    std::mt19937 random(11);
    Bytes bytes(count);
    for (std::byte& value : bytes) value = static_cast<std::byte>(random());
    return bytes;
}

class TextureMips : public testing::TestWithParam<Backend> {};

TEST_P(TextureMips, OfSrgbAreUploadedWholeSoThatNoDriverEncodesThem) {
    for (TextureDesc desc : { TextureDesc{ .width = 13, .height = 5 }, TextureDesc{ .width = 1, .height = 1 },
                              TextureDesc{ .kind = TextureKind::Texture2DArray, .width = 8, .height = 4, .layers = 3 },
                              TextureDesc{ .kind = TextureKind::Cube, .width = 4, .height = 4, .layers = 6 } }) {
        SCOPED_TRACE(desc.width);
        const size_t layerBytes = size_t{ desc.width } * desc.height * 4;
        const Bytes pixels = noise(layerBytes * desc.layers);
        desc.format = Format::RGBA8Srgb, desc.generateMips = true, desc.pixels = pixels;
        const Filling filling = fillingOf(GetParam(), desc);
        EXPECT_EQ(filling.generated, 0u);
        std::map<uint32_t, Bytes> expected; // each layer separately
        for (uint32_t layer = 0; layer < desc.layers; ++layer) {
            const auto own = std::span(pixels).subspan(layer * layerBytes, layerBytes);
            const assets::Image mips = assets::withMipMaps(
                    { .width = desc.width, .height = desc.height, .data = Bytes(own.begin(), own.end()) }, true);
            for (uint32_t level = 0; level < mips.levels; ++level) {
                const auto from = mips.data.begin() + static_cast<std::ptrdiff_t>(mips.levelOffset(level));
                expected[level].insert(expected[level].end(), from,
                                       from + static_cast<std::ptrdiff_t>(mips.levelBytes(level)));
            }
        }
        EXPECT_EQ(filling.levels, expected);
    }
}

TEST_P(TextureMips, OfPlainNumbersAreLeftToTheDriver) {
    const Bytes pixels = noise(8 * 4 * 4);
    const Filling filling = fillingOf(GetParam(), { .width = 8, .height = 4, .generateMips = true, .pixels = pixels });
    EXPECT_EQ(filling.generated, 1u);
    EXPECT_EQ(filling.levels, (std::map<uint32_t, Bytes>{ { 0, pixels } }));
}

INSTANTIATE_TEST_SUITE_P(BothApis, TextureMips, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
