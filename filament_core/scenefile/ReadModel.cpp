// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadModel.h"

#include "filament_core/scenefile/ReadLights.h"
#include "filament_core/scenefile/ReadOptions.h"
#include "filament_core/scenefile/ReadRaster.h"

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace filament_core::scenefile {
namespace {

void readCopy(JsonReader& reader, SceneFileCopy& copy) {
    double3 at(0.0), scale(1.0), degrees(0.0);
    reader.read("at", at);
    reader.read("scale", scale);
    reader.read("degrees", degrees);
    double4x4 world = glm::translate(double4x4(1.0), at);
    world = glm::rotate(world, glm::radians(degrees.y), double3(0, 1, 0));
    world = glm::rotate(world, glm::radians(degrees.x), double3(1, 0, 0));
    world = glm::rotate(world, glm::radians(degrees.z), double3(0, 0, 1));
    copy.worldFromModel = glm::scale(world, scale);
    reader.read("fit", copy.isFitted);
    readLightChannels(reader, copy.lightChannels);
    readBits(reader, "layers", copy.layers);
    uint32_t priority = DrawOrder{}.priority, blendOrder = 0;
    reader.read("priority", priority, 0, DrawOrder::kLastPriority);
    reader.read("blendOrder", blendOrder, 0, 65535);
    copy.drawOrder = { static_cast<uint8_t>(priority), static_cast<uint16_t>(blendOrder) };
    reader.read("values", copy.values);
    readRaster(reader, copy.raster);
    reader.read("moves", copy.metersPerFrame);
}

void readAnimation(JsonReader& reader, SceneFileModel& model) {
    reader.read("index", model.animation, 0, 1000);
    double seconds = 0;
    reader.read("seconds", seconds, -1e6, 1e6);
    model.animationSeconds = seconds;
}

void readModel(JsonReader& reader, SceneFileModel& model) {
    Json const* named = reader.raw("model", R"({"type": ["string", "object"]})");
    const bool isText = named && named->is_string();
    if (named && !isText && !named->is_object()) reader.complain("model", "expected a file or an object");
    if (isText) model.file = named->get<std::string>();
    if (named && named->is_object()) model.object = named->dump(-1, ' ', false, Json::error_handler_t::replace);
    reader.object("geometry", [&](JsonReader& r) { readOptions(r, model.options); });
    reader.read("variant", model.variant);
    reader.object("animation", [&](JsonReader& r) { readAnimation(r, model); });
    std::vector<SceneFileCopy> copies;
    reader.objects("copies", [&](JsonReader& r) { readCopy(r, copies.emplace_back()); });
    if (!copies.empty()) model.copies = std::move(copies);
    const bool isMaterial = named && named->is_object() && named->contains("material");
    const bool varies = std::ranges::any_of(
            model.copies, [](SceneFileCopy const& copy) { return !copy.values.empty() || copy.raster.isUsed(); });
    if (varies && !isMaterial)
        reader.complain("copies", "'values' and raster states belong to a model that is a material");
}

} // namespace

void readModels(JsonReader& reader, std::vector<SceneFileModel>& models) {
    SceneFileModel first;
    readModel(reader, first);
    if (!first.file.empty() || !first.object.empty()) models.push_back(std::move(first));
    reader.objectsOrTexts(
            "models", [&](JsonReader& r) { readModel(r, models.emplace_back()); },
            [&](std::string const& file) { models.emplace_back().file = file; });
}

} // namespace filament_core::scenefile
