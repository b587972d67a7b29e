// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/ShareFiles.h"

#include "filament_core/assets/files/FileBytes.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::tools {
namespace {

std::string rowOf(std::string_view name, double4 const& value) {
    return fmt::format("  {:<32} {:>13.7g} {:>13.7g} {:>13.7g}\n", name, value.x, value.y, value.z);
}

std::string numberText(const char* name, std::optional<float> const& value) {
    return value ? fmt::format(", {} {:.4g}", name, *value) : std::string();
}

std::string vectorText(const char* name, std::optional<float3> const& value) {
    return value ? fmt::format(", {} ({:.4g}, {:.4g}, {:.4g})", name, value->x, value->y, value->z) : std::string();
}

std::string surfaceText(PixelSurface const& surface) {
    return fmt::format("  object '{}', primitive {}, material '{}' ({}), {:.6g} m along the view{}{}{}{}{}{}\n",
                       surface.object, surface.primitive, surface.instance, surface.material, surface.distanceMeters,
                       vectorText("base colour", surface.baseColor), numberText("roughness", surface.roughness),
                       numberText("metallic", surface.metallic), numberText("occlusion", surface.occlusion),
                       vectorText("normal", surface.normal), vectorText("emissive", surface.emissive));
}

} // namespace

std::string textOf(PixelExplanation const& explanation) {
    std::string text =
            fmt::format("pixel {}, {}: pre-exposed linear light\n", explanation.pixel.x, explanation.pixel.y);
    for (PixelTerm const& term : explanation.terms) text += rowOf(term.term.name, term.value);
    text += rowOf("sum", explanation.value);
    for (PixelLobe const& lobe : explanation.lobes) text += rowOf("lobe: " + lobe.name, lobe.value);
    for (PixelTexture const& texture : explanation.textures)
        text += rowOf("texture: " + (texture.parameter.empty() ? "none" : texture.parameter), texture.value);
    for (PixelTexture const& texture : explanation.textures) {
        if (!texture.texel) continue;
        const std::string at = texture.uv ? fmt::format(" at uv ({:.6g}, {:.6g})", texture.uv->x, texture.uv->y) : "";
        text += fmt::format("  {} '{}' {}x{}{}{}\n", texture.parameter, texture.texture, texture.size.x, texture.size.y,
                            at, vectorText("linear texel", texture.texel));
    }
    return text + (explanation.surface ? surfaceText(*explanation.surface) : "  no surface\n");
}

Result<void> saveShares(Options const& options, BackendRun const& run) {
    const auto file = [&](const char* ending) {
        return options.out / fmt::format("{}.{}", fileStem(run.backend), ending);
    };
    if (run.shares) {
        if (Result<void> saved = saveExr(file("shares.exr"), *run.shares); !saved) return saved;
    }
    if (!run.explained) return {};
    const std::string json = toJson(*run.explained) + '\n';
    return assets::replaceFile(file("pixel.json"), std::as_bytes(std::span(json)));
}

bool hasSameShares(BackendRun const& a, BackendRun const& b) {
    if (a.explained && b.explained && toJson(*a.explained) != toJson(*b.explained)) return false;
    if (!a.shares || !b.shares) return true;
    return std::ranges::equal(a.shares->sums, b.shares->sums, {}, &Image::pixels, &Image::pixels);
}

} // namespace filament_core::tools
