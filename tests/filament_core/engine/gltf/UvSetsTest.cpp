// SPDX-License-Identifier: Apache-2.0
// Four sets of texture coordinates in one material, of eight in the mesh: each square must look like the one whose mesh
// has only these four, and like the one whose maps are the single texels that the coordinates lie on.
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/engine/gltf/SquareGrid.h"

namespace filament_core::uv_sets {
namespace {

using assets::test::Json;
using assets::test::TestFile;

constexpr int kSets = 8;
constexpr uint32_t kPixels = 2;

enum class Form {
    Whole,  ///< eight sets; the maps use four of them
    Moved,  ///< these four as TEXCOORD_0 to 3
    Texels, ///< maps of one texel each
};

struct Square {
    std::array<int, 4> sets; ///< of base colour, emission, and the two by which the other maps take turns
    int kind;                ///< 0: metallic and rough, 1: with layers, 2: transmissive, 3: masked
};

std::array<int, 4> texelOf(int set) {
    return { 30 + set * 91 % 220, 50 + set * 57 % 200, 20 + set * 37 % 230, 140 + set * 5 };
}

size_t addPalette(TestFile& file, int firstTexel, int count) {
    std::vector<std::byte> texels;
    for (int i = firstTexel; i < firstTexel + count; ++i)
        for (const int code : texelOf(i)) texels.push_back(static_cast<std::byte>(code));
    const auto png =
            assets::glbImageFromPixels("palette", static_cast<uint32_t>(count), 1, texels, assets::GlbAlpha::Always);
    file.root["images"].push_back({ { "bufferView", file.addView(png->file) }, { "mimeType", "image/png" } });
    file.root["textures"].push_back({ { "source", file.root["images"].size() - 1 }, { "sampler", 0 } });
    return file.root["textures"].size() - 1;
}

Json materialOf(Square const& square, Form form) {
    const auto info = [&](size_t place) -> Json {
        const int set = square.sets[place];
        // Texture 0 is the palette, and texture 1 + n its texel n.
        if (form == Form::Texels) return { { "index", 1 + set } };
        return { { "index", 0 }, { "texCoord", form == Form::Whole ? set : static_cast<int>(place) } };
    };
    Json material{ { "pbrMetallicRoughness",
                     { { "baseColorTexture", info(0) }, { "metallicRoughnessTexture", info(2) } } },
                   { "occlusionTexture", info(3) },
                   { "emissiveTexture", info(1) },
                   { "emissiveFactor", { 0.2, 0.2, 0.2 } } };
    Json& extensions = material["extensions"] = Json::object();
    if (square.kind == 1) {
        extensions["KHR_materials_clearcoat"] = { { "clearcoatFactor", 1 },
                                                  { "clearcoatRoughnessFactor", 1 },
                                                  { "clearcoatTexture", info(2) },
                                                  { "clearcoatRoughnessTexture", info(3) } };
        extensions["KHR_materials_sheen"] = { { "sheenColorFactor", { 1, 1, 1 } }, { "sheenColorTexture", info(3) } };
    }
    if (square.kind == 2)
        extensions["KHR_materials_transmission"] = { { "transmissionFactor", 1 }, { "transmissionTexture", info(3) } };
    if (square.kind == 3) material["alphaMode"] = "MASK";
    return material;
}

Json primitiveOf(TestFile& file, Square const& square, Form form) {
    using assets::test::kFloat;
    const auto vectors = [&](std::vector<float> const& values) { return file.add(values, kFloat, "VEC3", 3); };
    Json attributes{ { "POSITION", vectors({ -1, 1, 0, -1, -1, 0, 1, -1, 0, 1, 1, 0 }) },
                     { "NORMAL", vectors({ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 }) } };
    for (int n = 0; n < (form == Form::Moved ? 4 : kSets); ++n) {
        const int content = form == Form::Moved ? square.sets[static_cast<size_t>(n)] : n;
        const float u = (static_cast<float>(content) + 0.5f) / kSets;
        attributes["TEXCOORD_" + std::to_string(n)] =
                file.add(std::vector<float>{ u, 0.5f, u, 0.5f, u, 0.5f, u, 0.5f }, kFloat, "VEC2", 2);
    }
    file.root["materials"].push_back(materialOf(square, form));
    return { { "attributes", attributes },
             { "indices", file.add(std::vector<uint16_t>{ 0, 1, 2, 0, 2, 3 }, assets::test::kUShort, "SCALAR", 1) },
             { "material", file.root["materials"].size() - 1 } };
}

/// The same bits on both APIs.
Image draw(test::SquareGrid const& grid, std::span<const Square> squares, Form form) {
    TestFile file;
    file.root["extensionsUsed"] = { "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_transmission" };
    file.root["samplers"] = { { { "magFilter", 9728 }, { "minFilter", 9728 } } };
    addPalette(file, 0, kSets);
    for (int set = 0; set < kSets; ++set) addPalette(file, set, 1);
    std::vector<Json> primitives;
    for (Square const& square : squares) primitives.push_back(primitiveOf(file, square, form));
    grid.place(file, primitives);
    return grid.draw(file.glb(), 1, [](test::MaterialStage& stage) {
        stage.scene.add(SunLight{ .directionWorld = { -0.5f, -0.3f, -1 }, .illuminance = Lux{ 3 } });
    });
}

TEST(UvSets, FourOfEightSetsInOneMaterialDrawTheirTexels) {
    std::vector<Square> squares;
    for (int first = 0; first < kSets; ++first) {
        for (const int step : { 1, 3, 5, 7 }) {
            Square square{ .sets = {}, .kind = static_cast<int>(squares.size() / 2 % 4) };
            for (int i = 0; i < 4; ++i) square.sets[static_cast<size_t>(i)] = (first + i * step) % kSets;
            squares.push_back(square);
        }
    }
    const test::SquareGrid grid{ .columns = 8, .pixels = kPixels, .count = squares.size() };
    const Image texels = draw(grid, squares, Form::Texels), moved = draw(grid, squares, Form::Moved),
                whole = draw(grid, squares, Form::Whole);
    for (size_t i = 0; i < squares.size(); ++i) {
        const uint2 at = grid.cornerOf(i, 1);
        const float4 expected = test::halfPixel(texels, at.x, at.y);
        EXPECT_GT(expected.y, 0) << "nothing to see";
        EXPECT_EQ(test::halfPixel(moved, at.x, at.y), expected) << i;
        EXPECT_EQ(test::halfPixel(whole, at.x, at.y), expected) << i;
    }
}

} // namespace
} // namespace filament_core::uv_sets
