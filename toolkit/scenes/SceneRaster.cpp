// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/SceneRaster.h"

#include <algorithm>
#include <array>

namespace filament_core::tools {
namespace {

constexpr std::array<std::string_view, 8> kTests{ "never",    "less",         "lessEqual", "equal",
                                                  "notEqual", "greaterEqual", "greater",   "always" };
constexpr std::array<std::string_view, 8> kOperations{ "keep",           "zero",   "replace",       "incrementClamp",
                                                       "decrementClamp", "invert", "incrementWrap", "decrementWrap" };

/// The enumerator of a word, in the order of their declaration.
template <class E>
std::optional<E> enumeratorOf(std::array<std::string_view, 8> const& words, std::string_view word) {
    const auto found = std::ranges::find(words, word);
    return found != words.end() ? std::optional(static_cast<E>(found - words.begin())) : std::nullopt;
}

void readOperation(JsonReader& reader, const char* key, StencilOperation& operation) {
    reader.choice(key, operation,
                  "keep, zero, replace, incrementClamp, decrementClamp, invert, incrementWrap or decrementWrap",
                  [](std::string_view word) { return enumeratorOf<StencilOperation>(kOperations, word); });
}

void readByte(JsonReader& reader, const char* key, uint8_t& value) {
    uint32_t number = value;
    reader.read(key, number, 0, 255);
    value = static_cast<uint8_t>(number);
}

StencilFace readFace(JsonReader& reader) {
    StencilFace face;
    reader.choice("test", face.test, "never, less, lessEqual, equal, notEqual, greaterEqual, greater or always",
                  [](std::string_view word) { return enumeratorOf<StencilTest>(kTests, word); });
    readOperation(reader, "onFail", face.onFail);
    readOperation(reader, "onDepthFail", face.onDepthFail);
    readOperation(reader, "onPass", face.onPass);
    readByte(reader, "reference", face.reference);
    readByte(reader, "readMask", face.readMask);
    readByte(reader, "writeMask", face.writeMask);
    return face;
}

void readSwitch(JsonReader& reader, const char* key, std::optional<bool>& value) {
    if (!reader.has(key)) return;
    bool isOn = true;
    reader.read(key, isOn);
    value = isOn;
}

} // namespace

void readRaster(JsonReader& reader, CopyRaster& raster) {
    readSwitch(reader, "colorWrite", raster.colorWrite);
    readSwitch(reader, "depthWrite", raster.depthWrite);
    readSwitch(reader, "depthCulling", raster.depthCulling);
    reader.object("stencil", [&](JsonReader& r) { raster.stencil = bothSides(readFace(r)); });
}

void applyRaster(Engine& engine, MaterialInstance instance, CopyRaster const& raster) {
    if (raster.colorWrite) engine.setColorWrite(instance, *raster.colorWrite);
    if (raster.depthWrite) engine.setDepthWrite(instance, *raster.depthWrite);
    if (raster.depthCulling) engine.setDepthCulling(instance, *raster.depthCulling);
    if (raster.stencil) engine.setStencil(instance, raster.stencil);
}

} // namespace filament_core::tools
