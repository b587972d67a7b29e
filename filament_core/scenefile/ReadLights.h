// SPDX-License-Identifier: Apache-2.0
/// The lights of a scene file, one JSON object each. docs/scene-files.md describes the fields.
///   Fails   the reader keeps the first error: field, what is valid. What is read is fit for Scene::add.
///   Thread  any; pure.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

void readSun(JsonReader& reader, SceneFileLight& read);
void readPoint(JsonReader& reader, SceneFileLight& read);
void readSpot(JsonReader& reader, SceneFileLight& read);
void readRect(JsonReader& reader, SceneFileLight& read);
void readDisc(JsonReader& reader, SceneFileLight& read);
void readTube(JsonReader& reader, SceneFileLight& read);

/// A list of numbers from 0 to 7: the bits that are set.
void readBits(JsonReader& reader, const char* name, uint8_t& bits);
/// "channels": a list of numbers from 0 to 7, of a light or a copy.
void readLightChannels(JsonReader& reader, LightChannels& channels);

} // namespace filament_core::scenefile
