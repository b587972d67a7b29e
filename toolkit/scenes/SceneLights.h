// SPDX-License-Identifier: Apache-2.0
/// The lights of a scene file, one JSON object each. docs/conformance.md describes the fields.
///   Fails   the reader keeps the first error: field, what is valid. Whatever is returned is fit for Scene::add.
///   Thread  any; pure.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <filament_core/Light.h>

#include <filesystem>
#include <string>

namespace filament_core::tools {

/// The image of a light.
struct LightImageFile {
    std::filesystem::path file{}; ///< as the scene names it; empty: none
    LightImageShape shape = LightImageShape::Projected;
    friend bool operator==(LightImageFile const&, LightImageFile const&) = default;
};

SunLight readSun(JsonReader& reader, LightImageFile& image);
/// `profile`: the file of the light's profile, as the scene names it; empty: none.
PointLight readPoint(JsonReader& reader, std::string& profile, LightImageFile& image);
SpotLight readSpot(JsonReader& reader, std::string& profile, LightImageFile& image);
RectLight readRect(JsonReader& reader, LightImageFile& image);
DiscLight readDisc(JsonReader& reader);
TubeLight readTube(JsonReader& reader);

/// A list of numbers from 0 to 7: the bits that are set.
void readBits(JsonReader& reader, const char* name, uint8_t& bits);
/// "channels": a list of numbers from 0 to 7, of a light or a copy.
void readLightChannels(JsonReader& reader, LightChannels& channels);

} // namespace filament_core::tools
