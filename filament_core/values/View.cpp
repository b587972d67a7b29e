// SPDX-License-Identifier: Apache-2.0
#include <filament/View.h>

#include <algorithm>
#include <array>

namespace filament {
namespace {

// In the order of the enumerators.
constexpr std::array<std::string_view, kDebugViewCount> kDebugViews{ "none",
                                                                     "cascades",
                                                                     "atlas",
                                                                     "froxels",
                                                                     "lights",
                                                                     "occlusion",
                                                                     "bentNormals",
                                                                     "reflections",
                                                                     "refraction",
                                                                     "fog",
                                                                     "motion",
                                                                     "circleOfConfusion",
                                                                     "historyWeight",
                                                                     "histogram",
                                                                     "luminance",
                                                                     "numerics",
                                                                     "baseColor",
                                                                     "roughness",
                                                                     "metallic",
                                                                     "normals",
                                                                     "tangents",
                                                                     "textureCoordinates",
                                                                     "materialOcclusion",
                                                                     "emissive",
                                                                     "mipLevel",
                                                                     "overdraw",
                                                                     "transparentLayers",
                                                                     "wireframe",
                                                                     "wireframeAlone" };

} // namespace

const char* toString(DebugView debugView) { return kDebugViews[static_cast<size_t>(debugView)].data(); }

std::optional<DebugView> debugViewFromName(std::string_view name) {
    const auto found = std::ranges::find(kDebugViews, name);
    if (found == kDebugViews.end()) return std::nullopt;
    return static_cast<DebugView>(found - kDebugViews.begin());
}

} // namespace filament
