// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadRaster.h"

#include <array>

namespace filament_core::scenefile {
namespace {

constexpr std::array<std::string_view, 8> kTests{ "never",    "less",         "lessEqual", "equal",
                                                  "notEqual", "greaterEqual", "greater",   "always" };
constexpr std::array<std::string_view, 8> kOperations{ "keep",           "zero",   "replace",       "incrementClamp",
                                                       "decrementClamp", "invert", "incrementWrap", "decrementWrap" };

void readOperation(JsonReader& reader, const char* key, StencilOperation& operation) {
    reader.choice(key, operation, kOperations);
}

void readByte(JsonReader& reader, const char* key, uint8_t& value) {
    uint32_t number = value;
    reader.read(key, number, 0, 255);
    value = static_cast<uint8_t>(number);
}

StencilFace readFace(JsonReader& reader) {
    StencilFace face;
    reader.choice("test", face.test, kTests);
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

void readRaster(JsonReader& reader, SceneFileRaster& raster) {
    readSwitch(reader, "colorWrite", raster.colorWrite);
    readSwitch(reader, "depthWrite", raster.depthWrite);
    readSwitch(reader, "depthCulling", raster.depthCulling);
    reader.object("stencil", [&](JsonReader& r) { raster.stencil = bothSides(readFace(r)); });
}

} // namespace filament_core::scenefile
