// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfParse.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

struct RestartGroup {
    std::vector<uint32_t> primitives;
    uint32_t indices = kNone;
};

bool isStripLoopOrFan(GltfMode mode) {
    return mode == GltfMode::LineLoop || mode == GltfMode::LineStrip || mode == GltfMode::TriangleStrip ||
           mode == GltfMode::TriangleFan;
}

bool isOfIndices(GltfAccessor const& accessor) {
    const bool isUnsigned = accessor.component == ComponentType::UByte || accessor.component == ComponentType::UShort ||
                            accessor.component == ComponentType::UInt;
    return isUnsigned && accessor.components == 1 && !accessor.normalized;
}

/// Equal except for their indices.
bool areAlike(GltfPrimitive const& a, GltfPrimitive const& b) {
    return a.attributes == b.attributes && a.material == b.material && a.variants == b.variants && a.mode == b.mode;
}

/// The rule of the extension that the group breaks; null: none. `isTaken`: primitives of groups, also of this one.
const char* brokenRule(RestartGroup const& group, std::vector<GltfAccessor> const& accessors, GltfMesh const& mesh,
                       std::vector<bool>& isTaken) {
    if (group.primitives.empty()) return "it names no primitives";
    if (!isOfIndices(accessors[group.indices])) return "its accessor does not hold indices";
    for (const uint32_t index : group.primitives) {
        GltfPrimitive const& primitive = mesh.primitives[index];
        if (isTaken[index]) return "a primitive is named twice";
        isTaken[index] = true;
        if (!isStripLoopOrFan(primitive.mode)) return "a primitive is no strip, loop or fan";
        if (primitive.indices == kNone || primitive.draco) return "a primitive has no indices";
        if (!primitive.targets.empty()) return "a primitive has morph targets";
        if (!areAlike(primitive, mesh.primitives[group.primitives.front()]))
            return "its primitives differ in more than their indices";
    }
    return nullptr;
}

std::vector<RestartGroup> parseGroups(JsonNode const& extension, size_t accessorCount, size_t primitiveCount) {
    std::vector<RestartGroup> groups;
    for (JsonNode const& node : extension["primitiveGroups"].elements()) {
        RestartGroup group{ {}, node["indices"].requiredIndex(accessorCount, "accessors") };
        for (JsonNode const& primitive : node["primitives"].elements())
            group.primitives.push_back(primitive.requiredIndex(primitiveCount, "primitives"));
        groups.push_back(std::move(group));
    }
    return groups;
}

} // namespace

void mergeRestartGroups(JsonNode const& extension, std::vector<GltfAccessor> const& accessors, GltfMesh& mesh) {
    if (!extension.exists() || !extension.diagnostics().ok()) return;
    constexpr const char* kIgnored = "the extension is ignored, and its primitives are drawn one by one";
    Diagnostics found;
    const std::vector<RestartGroup> groups =
            parseGroups(extension.reportingTo(found), accessors.size(), mesh.primitives.size());
    if (!found.ok()) return extension.diagnostics().warn("{}; {}", found.error().message, kIgnored);
    std::vector<bool> isTaken(mesh.primitives.size(), false);
    for (size_t i = 0; i < groups.size(); ++i) {
        if (const char* const rule = brokenRule(groups[i], accessors, mesh, isTaken))
            return extension.diagnostics().warn("{}.primitiveGroups[{}]: {}; {}", extension.path(), i, rule, kIgnored);
    }
    std::vector<bool> isMerged(mesh.primitives.size(), false);
    for (RestartGroup const& group : groups) {
        for (const uint32_t index : group.primitives) isMerged[index] = true;
        const uint32_t first = *std::ranges::min_element(group.primitives);
        isMerged[first] = false;
        mesh.primitives[first].indices = group.indices;
        mesh.primitives[first].restarts = true;
    }
    size_t index = 0;
    std::erase_if(mesh.primitives, [&](GltfPrimitive const&) { return isMerged[index++]; });
}

} // namespace filament_core::assets
