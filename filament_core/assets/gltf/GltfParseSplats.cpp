// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfParse.h"

namespace filament_core::assets {
namespace {

constexpr const char* kExtension = "KHR_gaussian_splatting";

std::string attributeName(std::string_view suffix) { return fmt::format("{}:{}", kExtension, suffix); }

/// A property with one value in this version: another one is of an extension that is not known.
void expectValue(JsonNode const& node, std::string_view known) {
    const std::string text = node.exists() ? node.text() : std::string(known);
    if (text != known)
        node.diagnostics().warn("{}: '{}' is not a value that this loader knows; {} is used", node.path(), text, known);
}

SplatColors parseColors(JsonNode const& node) {
    const std::string text = node.text();
    if (text == "lin_rec709_display") return SplatColors::Linear;
    if (text != "srgb_rec709_display")
        node.diagnostics().warn("{}: '{}' is not a value that this loader knows; srgb_rec709_display is used",
                                node.path(), text);
    return SplatColors::Srgb;
}

/// Coefficients of one degree; whether all are there. kNone where one is not.
bool readDegree(JsonNode const& attributes, uint32_t degree, size_t accessorCount, GltfSplats& splats) {
    bool hasAll = true;
    for (uint32_t i = 0; i < 2 * degree + 1; ++i) {
        const std::string name = attributeName(fmt::format("SH_DEGREE_{}_COEF_{}", degree, i));
        uint32_t& accessor = splats.harmonics[degree * degree + i];
        accessor = attributes[name.c_str()].index(accessorCount, "accessors");
        hasAll = hasAll && accessor != kNone;
    }
    return hasAll;
}

/// The highest degree of which, and of all below, every coefficient is there.
void readHarmonics(JsonNode const& attributes, size_t accessorCount, GltfSplats& splats) {
    splats.harmonics.fill(kNone);
    if (!readDegree(attributes, 0, accessorCount, splats)) return;
    bool isComplete = true, hasMore = false;
    for (uint32_t degree = 1; degree <= GltfSplats::kMaxDegree; ++degree) {
        isComplete = readDegree(attributes, degree, accessorCount, splats) && isComplete;
        if (isComplete) splats.degree = degree;
        for (uint32_t i = degree * degree; !isComplete && i < (degree + 1) * (degree + 1); ++i)
            hasMore = hasMore || splats.harmonics[i] != kNone;
    }
    if (hasMore)
        attributes.diagnostics().warn("{}: coefficients of degree {} are missing; only lower degrees are used",
                                      attributes.path(), splats.degree + 1);
}

const char* missingAttribute(GltfSplats const& splats, JsonNode const& attributes) {
    if (!attributes["POSITION"].exists()) return "POSITION";
    if (splats.rotation == kNone) return "KHR_gaussian_splatting:ROTATION";
    if (splats.scale == kNone) return "KHR_gaussian_splatting:SCALE";
    if (splats.opacity == kNone) return "KHR_gaussian_splatting:OPACITY";
    return splats.harmonics[0] == kNone ? "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0" : nullptr;
}

void requireProperty(JsonNode const& extension, const char* name) {
    if (extension[name].exists()) return;
    extension.diagnostics().refuse(ErrorCode::Corrupt, "{}.{}: is missing; the extension requires it", extension.path(),
                                   name);
}

} // namespace

std::optional<GltfSplats> parseGltfSplats(JsonNode const& primitive, GltfMode mode, size_t accessorCount) {
    const JsonNode extension = primitive.extension(kExtension), attributes = primitive["attributes"];
    if (!extension.exists()) return std::nullopt;
    Diagnostics& diagnostics = primitive.diagnostics();
    if (mode != GltfMode::Points) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}.mode: {} needs 0, points", primitive.path(), kExtension);
        return std::nullopt;
    }
    requireProperty(extension, "kernel");
    requireProperty(extension, "colorSpace");
    expectValue(extension["kernel"], "ellipse");
    expectValue(extension["projection"], "perspective");
    expectValue(extension["sortingMethod"], "cameraDistance");
    const auto accessorOf = [&](std::string_view suffix) {
        return attributes[attributeName(suffix).c_str()].index(accessorCount, "accessors");
    };
    GltfSplats splats{ .rotation = accessorOf("ROTATION"),
                       .scale = accessorOf("SCALE"),
                       .opacity = accessorOf("OPACITY"),
                       .colors = parseColors(extension["colorSpace"]) };
    readHarmonics(attributes, accessorCount, splats);
    const char* missing = missingAttribute(splats, attributes);
    if (!missing) return splats;
    if (!extension["extensions"].exists()) {
        diagnostics.refuse(ErrorCode::Corrupt, "{}.attributes: {} is missing; splats need it", primitive.path(),
                           missing);
    } else { // which keeps them elsewhere, compressed for example
        diagnostics.warn("{}: its splats need an extension that is not supported; they are drawn as points",
                         primitive.path());
    }
    return std::nullopt;
}

} // namespace filament_core::assets
