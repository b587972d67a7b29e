// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ExplainPixel.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <type_traits>

namespace filament_core {
namespace {

using Json = nlohmann::ordered_json;

Json numberJson(double value) { return std::isfinite(value) ? Json(value) : Json(); }

template <class Vector>
Json vectorJson(Vector const& vector) {
    Json list = Json::array();
    for (int i = 0; i < Vector::length(); ++i) list.push_back(numberJson(static_cast<double>(vector[i])));
    return list;
}

template <class Value>
void addIfThere(Json& object, const char* name, std::optional<Value> const& value) {
    if (!value) return;
    if constexpr (std::is_same_v<Value, float>)
        object[name] = numberJson(static_cast<double>(*value));
    else if constexpr (std::is_same_v<Value, uint32_t>)
        object[name] = *value;
    else
        object[name] = vectorJson(*value);
}

Json surfaceJson(PixelSurface const& surface) {
    Json object{ { "object", surface.object },
                 { "isLight", static_cast<bool>(surface.light) },
                 { "primitive", surface.primitive },
                 { "material", surface.material },
                 { "instance", surface.instance },
                 { "distanceMeters", numberJson(surface.distanceMeters) },
                 { "positionWorld", vectorJson(surface.positionWorld) } };
    addIfThere(object, "normal", surface.normal);
    addIfThere(object, "geometricNormal", surface.geometricNormal);
    addIfThere(object, "baseColor", surface.baseColor);
    addIfThere(object, "roughness", surface.roughness);
    addIfThere(object, "metallic", surface.metallic);
    addIfThere(object, "occlusion", surface.occlusion);
    addIfThere(object, "emissive", surface.emissive);
    addIfThere(object, "objectId", surface.objectId);
    addIfThere(object, "materialId", surface.materialId);
    addIfThere(object, "materialInstanceId", surface.materialInstanceId);
    addIfThere(object, "triangleId", surface.triangleId);
    return object;
}

Json textureJson(PixelTexture const& texture) {
    if (texture.parameter.empty()) return { { "name", "none" }, { "value", vectorJson(texture.value) } };
    Json object{ { "name", texture.parameter },
                 { "texture", texture.texture },
                 { "size", { texture.size.x, texture.size.y } },
                 { "value", vectorJson(texture.value) } };
    addIfThere(object, "uv", texture.uv);
    addIfThere(object, "texel", texture.texel);
    return object;
}

std::string jsonOf(PixelExplanation const& explanation) {
    Json terms = Json::array();
    for (PixelTerm const& term : explanation.terms)
        terms.push_back({ { "kind", toString(term.term.kind) },
                          { "name", term.term.name },
                          { "value", vectorJson(term.value) } });
    Json object{ { "pixel", { explanation.pixel.x, explanation.pixel.y } },
                 { "value", vectorJson(explanation.value) },
                 { "terms", std::move(terms) } };
    Json lobes = Json::array();
    for (PixelLobe const& lobe : explanation.lobes)
        lobes.push_back({ { "name", lobe.name }, { "value", vectorJson(lobe.value) } });
    if (!explanation.lobes.empty()) object["lobes"] = std::move(lobes);
    Json textures = Json::array();
    for (PixelTexture const& texture : explanation.textures) textures.push_back(textureJson(texture));
    if (!explanation.textures.empty()) object["textures"] = std::move(textures);
    if (explanation.surface) object["surface"] = surfaceJson(*explanation.surface);
    return object.dump(2, ' ', false, Json::error_handler_t::replace); // names may be no UTF-8
}

} // namespace

std::string toJson(PixelExplanation const& explanation) { return jsonOf(explanation); }

} // namespace filament_core
