// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/DrawnTexture.h"

#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

#include <array>

namespace filament_core::tools {
namespace {

constexpr std::array<std::string_view, 5> kKindWords{ "2d", "array", "cube", "cubeArray", "3d" };
constexpr std::array<std::string_view, 4> kFormatWords{ "RGBA8", "RGBA8Srgb", "RGBA16F", "RGBA32F" };
constexpr std::array kFormatsOfWords{ Format::RGBA8, Format::RGBA8Srgb, Format::RGBA16F, Format::RGBA32F };

void readPart(JsonReader& reader, DrawnPart& part) {
    reader.read("material", part.material);
    reader.read("values", part.values);
    reader.read("level", part.level, 0, 14);
    reader.read("layer", part.layer, 0, 255);
    reader.read("meshes", part.drawsMeshes);
    reader.read("keeps", part.keeps);
    reader.read("keepsHoles", part.keepsHoles);
    reader.read("clear", part.clear);
    reader.read("layers", part.layers, 0, kAllLayers);
}

} // namespace

Result<DrawnTexture> readDrawnTexture(std::filesystem::path const& file) {
    const Result<Json> json = readJson(file);
    if (!json) return json.error();
    DrawnTexture texture;
    JsonReader reader(*json, file.filename().string());
    size_t format = 2;
    reader.choice("kind", texture.kind, kKindWords);
    reader.choice("format", format, kFormatWords);
    texture.format = kFormatsOfWords[format];
    reader.read("size", texture.size, 1, 4096);
    reader.read("layers", texture.layers, 1, 256);
    reader.read("levels", texture.levels, 1, 13);
    reader.read("colors", texture.colors, 1, 4);
    reader.read("shown", texture.shown, 0, 3);
    reader.objects("draws", [&](JsonReader& r) { readPart(r, texture.draws.emplace_back()); });
    if (texture.shown >= texture.colors) reader.complain("shown", "is one of the colors, from 0 on");
    if (Result<void> done = reader.finish(); !done) return done.error();
    return texture;
}

} // namespace filament_core::tools
