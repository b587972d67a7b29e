// SPDX-License-Identifier: Apache-2.0
// Two maps of one extension that differ in anything that says how they are read: each draws what it draws alone. The
// other is white then, so that the same numbers are multiplied by one: the pictures have the same bits.
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/engine/gltf/SquareGrid.h"

#include <array>
#include <span>

namespace filament_core::texture_pairs {
namespace {

using assets::test::Json;
using assets::test::TestFile;

struct Pair {
    const char *firstExtension, *first, *secondExtension, *second;
    const char* factors; ///< the extensions without maps
};

constexpr Pair kPairs[] = {
    { "KHR_materials_clearcoat", "clearcoatTexture", "KHR_materials_clearcoat", "clearcoatRoughnessTexture",
      R"({ "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatRoughnessFactor": 1 } })" },
    { "KHR_materials_sheen", "sheenColorTexture", "KHR_materials_sheen", "sheenRoughnessTexture",
      R"({ "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ], "sheenRoughnessFactor": 1 } })" },
    { "KHR_materials_specular", "specularColorTexture", "KHR_materials_specular", "specularTexture",
      R"({ "KHR_materials_specular": { "specularFactor": 1, "specularColorFactor": [ 1, 1, 1 ] } })" },
    { "KHR_materials_iridescence", "iridescenceTexture", "KHR_materials_iridescence", "iridescenceThicknessTexture",
      R"({ "KHR_materials_iridescence": { "iridescenceFactor": 1 } })" },
    { "KHR_materials_transmission", "transmissionTexture", "KHR_materials_volume", "thicknessTexture",
      R"({ "KHR_materials_transmission": { "transmissionFactor": 1 }, "KHR_materials_volume": { "thicknessFactor": 0.5,
           "attenuationDistance": 0.3, "attenuationColor": [ 0.1, 0.5, 0.9 ] } })" },
    { "KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture", "KHR_materials_diffuse_transmission",
      "diffuseTransmissionTexture",
      R"({ "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.9 } })" },
};

/// How the second map is read; the first has the defaults.
struct Reading {
    const char* what;
    int set = 0, side = 8; ///< texels
    const char *transform = "", *sampler = "{}";
};

constexpr const char* kNearest = R"({ "magFilter": 9728, "minFilter": 9728 })";
constexpr const char* kClamped = R"({ "wrapS": 33071, "wrapT": 33071 })";
constexpr const char* kMirrored = R"({ "wrapS": 33648, "wrapT": 10497, "magFilter": 9728, "minFilter": 9728 })";
constexpr const char* kScaled = R"({ "scale": [ 2, 3 ] })";
constexpr const char* kTurned = R"({ "rotation": 0.5, "offset": [ 0.2, 0.1 ] })";

constexpr Reading kReadings[] = {
    { .what = "alike" },
    { .what = "set", .set = 1 },
    { .what = "one texel", .side = 1 },
    { .what = "smaller", .side = 4 },
    { .what = "larger", .side = 16 },
    { .what = "odd", .side = 5 },
    { .what = "scaled", .transform = kScaled },
    { .what = "turned", .transform = kTurned },
    { .what = "moved", .transform = R"({ "offset": [ 0.25, 0.5 ] })" },
    { .what = "mirrored", .transform = R"({ "scale": [ -1, 1 ] })" },
    { .what = "nearest", .sampler = kNearest },
    { .what = "clamped", .sampler = kClamped },
    { .what = "mirrored nearest", .sampler = kMirrored },
    { .what = "nearest and scaled", .transform = kScaled, .sampler = kNearest },
    { .what = "clamped and turned", .transform = kTurned, .sampler = kClamped },
    { .what = "smaller and nearest", .side = 4, .sampler = kNearest },
    { .what = "larger and clamped", .side = 16, .sampler = kClamped },
    { .what = "smaller, of the other set", .set = 1, .side = 4 },
    { .what = "clamped, of the other set", .set = 1, .sampler = kClamped },
    { .what = "nearest, of the other set", .set = 1, .sampler = kNearest },
    { .what = "larger, of the other set", .set = 1, .side = 16, .sampler = kMirrored },
    { .what = "smaller and scaled", .side = 2, .transform = kScaled },
    { .what = "larger and turned", .side = 16, .transform = kTurned },
    { .what = "all but the set", .side = 16, .transform = kScaled, .sampler = kMirrored },
    { .what = "smaller and mirrored", .side = 4, .sampler = kMirrored },
};

enum class Content { None, White, Varying };

struct Square {
    Pair const* pair;
    Content first, second;
    Reading const *firstReading, *secondReading;
};

Json infoOf(TestFile& file, Content content, Reading const& reading) {
    std::vector<std::byte> texels;
    for (int i = 0; i < reading.side * reading.side; ++i) {
        const int code = content == Content::White ? 255 : 40 + i * 73 % 200;
        for (const int channel : { 0, 31, 17, 7 })
            texels.push_back(static_cast<std::byte>(std::min(code + channel, 255)));
    }
    const auto side = static_cast<uint32_t>(reading.side);
    const auto png = assets::glbImageFromPixels("map", side, side, texels, assets::GlbAlpha::Always);
    file.root["images"].push_back({ { "bufferView", file.addView(png->file) }, { "mimeType", "image/png" } });
    file.root["samplers"].push_back(Json::parse(reading.sampler));
    file.root["textures"].push_back(
            { { "source", file.root["images"].size() - 1 }, { "sampler", file.root["samplers"].size() - 1 } });
    Json info{ { "index", file.root["textures"].size() - 1 }, { "texCoord", reading.set } };
    if (*reading.transform) info["extensions"]["KHR_texture_transform"] = Json::parse(reading.transform);
    return info;
}

Json materialOf(TestFile& file, Square const& square) {
    Json extensions = Json::parse(square.pair->factors);
    Pair const& pair = *square.pair;
    if (square.first != Content::None)
        extensions[pair.firstExtension][pair.first] = infoOf(file, square.first, *square.firstReading);
    if (square.second != Content::None)
        extensions[pair.secondExtension][pair.second] = infoOf(file, square.second, *square.secondReading);
    return { { "pbrMetallicRoughness", { { "metallicFactor", 0 }, { "roughnessFactor", 0.6 } } },
             { "extensions", extensions } };
}

constexpr uint32_t kPixels = 4;
using SquarePixels = std::array<float4, size_t{ kPixels } * kPixels>;

/// Under suns from both sides, before a white background; the same bits on both APIs.
std::vector<SquarePixels> draw(std::span<const Square> squares) {
    using assets::test::kFloat;
    const test::SquareGrid grid{ .columns = 20, .pixels = kPixels, .count = squares.size() };
    TestFile file;
    for (const char* name : { "KHR_texture_transform", "KHR_materials_clearcoat", "KHR_materials_sheen",
                              "KHR_materials_specular", "KHR_materials_iridescence", "KHR_materials_transmission",
                              "KHR_materials_volume", "KHR_materials_diffuse_transmission" })
        file.root["extensionsUsed"].push_back(name);
    const std::vector<float> places{ -1, 1, 0, -1, -1, 0, 1, -1, 0, 1, 1, 0 };
    const std::vector<float> normals{ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    const std::vector<float> upright{ 0, 0, 0, 1, 1, 1, 1, 0 }, other{ 0.1f, 0.7f, 0.9f, 0.2f, 1.4f, 1.1f, 0.3f, 1.6f };
    const Json attributes{ { "POSITION", file.add(places, kFloat, "VEC3", 3) },
                           { "NORMAL", file.add(normals, kFloat, "VEC3", 3) },
                           { "TEXCOORD_0", file.add(upright, kFloat, "VEC2", 2) },
                           { "TEXCOORD_1", file.add(other, kFloat, "VEC2", 2) } };
    const size_t indices = file.add(std::vector<uint16_t>{ 0, 1, 2, 0, 2, 3 }, assets::test::kUShort, "SCALAR", 1);
    std::vector<Json> primitives;
    for (size_t i = 0; i < squares.size(); ++i) {
        file.root["materials"].push_back(materialOf(file, squares[i]));
        primitives.push_back({ { "attributes", attributes }, { "indices", indices }, { "material", i } });
    }
    grid.place(file, primitives);
    const Image image = grid.draw(file.glb(), 1, [](test::MaterialStage& stage) {
        for (const float side : { 1.0f, -1.0f })
            stage.scene.add(SunLight{ .directionWorld = { -0.3f, -0.2f, -side }, .illuminance = Lux{ 2 + side } });
        stage.view.clearColor = float4(1);
    });
    std::vector<SquarePixels> pixels(squares.size());
    for (size_t i = 0; i < squares.size() && !image.pixels.empty(); ++i) {
        const uint2 corner = grid.cornerOf(i, 1);
        for (uint32_t p = 0; p < kPixels * kPixels; ++p)
            pixels[i][p] = test::halfPixel(image, corner.x + p % kPixels, corner.y + p / kPixels);
    }
    return pixels;
}

/// Maps of one extension are compared: a scene of them all would be slow.
class TexturePairs : public testing::TestWithParam<size_t> {};

TEST_P(TexturePairs, EachMapDrawsWhatItDrawsAlone) {
    Pair const& pair = kPairs[GetParam()];
    std::vector<Square> together, alone;
    for (Reading const& reading : kReadings) {
        for (const bool isFirst : { true, false }) {
            const Content first = isFirst ? Content::Varying : Content::White;
            const Content second = isFirst ? Content::White : Content::Varying;
            together.push_back({ &pair, first, second, &kReadings[0], &reading });
            alone.push_back({ &pair, isFirst ? first : Content::None, isFirst ? Content::None : second, &kReadings[0],
                              &reading });
        }
    }
    const std::vector<SquarePixels> drawn = draw(together), expected = draw(alone);
    for (size_t i = 0; i < together.size(); ++i) {
        EXPECT_EQ(drawn[i], expected[i]) << pair.second << ": " << together[i].secondReading->what << ", varying "
                                         << (together[i].first == Content::Varying ? "first" : "second");
    }
}

TEST_P(TexturePairs, BothMapsAreSeen) {
    Pair const& pair = kPairs[GetParam()];
    Reading const& plain = kReadings[0];
    const std::vector<Square> squares{ { &pair, Content::White, Content::White, &plain, &plain },
                                       { &pair, Content::Varying, Content::White, &plain, &plain },
                                       { &pair, Content::White, Content::Varying, &plain, &plain },
                                       { &pair, Content::Varying, Content::Varying, &plain, &kReadings[7] } };
    const std::vector<SquarePixels> pixels = draw(squares);
    for (size_t i = 0; i < squares.size(); ++i) {
        for (size_t k = 0; k < i; ++k) EXPECT_NE(pixels[i], pixels[k]) << pair.second << ": " << i << " as " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Pairs, TexturePairs, testing::Range(size_t{ 0 }, std::size(kPairs)));

} // namespace
} // namespace filament_core::texture_pairs
