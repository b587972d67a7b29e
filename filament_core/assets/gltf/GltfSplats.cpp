// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfSplats.h"

#include "base/math/Elementary.h"
#include "filament_core/assets/gltf/Accessor.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

/// The lists of a SplatCloudDesc.
struct SplatLists {
    std::vector<float3> positions, scales, harmonics;
    std::vector<float4> rotations;
    std::vector<float> opacities;
    size_t perSplat = 1; ///< of `harmonics`

    size_t count() const { return positions.size(); }
};

/// Values of one attribute, as stored: `dropBroken` sees what is not finite.
template <class T>
std::vector<T> readAttribute(GltfDocument const& document, uint32_t accessor, std::string const& name, size_t count,
                             std::string const& path, Diagnostics& diagnostics) {
    std::vector<T> values = readVectors<T>(document, accessor, name, diagnostics, NonFinite::IsKept);
    if (diagnostics.ok() && values.size() != count)
        diagnostics.refuse(ErrorCode::Corrupt, "{}: {} has {} elements, POSITION has {}", path, name, values.size(),
                           count);
    return values;
}

SplatLists readLists(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                     Diagnostics& diagnostics) {
    GltfSplats const& splats = *primitive.splats;
    SplatLists lists;
    lists.positions =
            readVectors<float3>(document, primitive.attributes.position, "POSITION", diagnostics, NonFinite::IsKept);
    const size_t count = lists.count();
    const auto read = [&]<class T>(std::vector<T>& values, uint32_t accessor, std::string const& name) {
        if (diagnostics.ok()) values = readAttribute<T>(document, accessor, name, count, path, diagnostics);
    };
    read(lists.rotations, splats.rotation, "ROTATION");
    read(lists.scales, splats.scale, "SCALE");
    read(lists.opacities, splats.opacity, "OPACITY");
    lists.perSplat = size_t{ splats.degree + 1 } * (splats.degree + 1);
    std::vector<float3> coefficients;
    for (size_t k = 0; k < lists.perSplat && diagnostics.ok(); ++k) {
        read(coefficients, splats.harmonics[k], fmt::format("coefficient {} of its harmonics", k));
        if (!diagnostics.ok()) break;
        lists.harmonics.resize(count * lists.perSplat);
        for (size_t i = 0; i < count; ++i) lists.harmonics[i * lists.perSplat + k] = coefficients[i];
    }
    return lists;
}

bool isFiniteSplat(SplatLists const& lists, size_t i) {
    const auto isFinite = [](auto const& v) { return glm::dot(v - v, v - v) == 0; }; // NaN - NaN, inf - inf: NaN
    bool isGood = isFinite(lists.positions[i]) && isFinite(lists.rotations[i]) && isFinite(lists.scales[i]) &&
                  std::isfinite(lists.opacities[i]);
    for (size_t k = 0; k < lists.perSplat; ++k) isGood = isGood && isFinite(lists.harmonics[i * lists.perSplat + k]);
    const float3 scale = lists.scales[i];
    return isGood && std::max({ scale.x, scale.y, scale.z }) <= scene::kMaxSplatScale;
}

/// Splats whose numbers are not finite, or whose size is beyond the limit, are left out.
void dropBroken(SplatLists& lists, std::string const& path, Diagnostics& diagnostics) {
    const size_t count = lists.count(), perSplat = lists.perSplat;
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!isFiniteSplat(lists, i)) continue;
        lists.positions[kept] = lists.positions[i];
        lists.rotations[kept] = lists.rotations[i];
        lists.scales[kept] = lists.scales[i];
        lists.opacities[kept] = lists.opacities[i];
        for (size_t k = 0; k < perSplat; ++k) lists.harmonics[kept * perSplat + k] = lists.harmonics[i * perSplat + k];
        ++kept;
    }
    if (kept == count) return;
    diagnostics.warn("{}: {} of {} splats have numbers that are not finite, or scales beyond 1e15; they are left out",
                     path, count - kept, count);
    lists.positions.resize(kept);
    lists.rotations.resize(kept);
    lists.scales.resize(kept);
    lists.opacities.resize(kept);
    lists.harmonics.resize(kept * perSplat);
}

/// Scales are standard deviations; an earlier draft of the extension stored their logarithms.
void repairScales(SplatLists& lists, std::string const& path, Diagnostics& diagnostics) {
    const auto isNegative = [](float3 scale) { return std::min({ scale.x, scale.y, scale.z }) < 0; };
    if (std::ranges::none_of(lists.scales, isNegative)) return;
    diagnostics.warn("{}: KHR_gaussian_splatting:SCALE has negative numbers; all are taken as logarithms, as a draft "
                     "of the extension stored them",
                     path);
    for (float3& scale : lists.scales) {
        for (int axis = 0; axis < 3; ++axis)
            scale[axis] = std::min(elementary::exp(scale[axis]), scene::kMaxSplatScale);
    }
}

void repair(SplatLists& lists, std::string const& path, Diagnostics& diagnostics) {
    // First, because an infinite scale of one splat must not decide whether those of all are logarithms.
    dropBroken(lists, path, diagnostics);
    repairScales(lists, path, diagnostics);
    size_t turned = 0, clamped = 0;
    for (size_t i = 0; i < lists.count(); ++i) {
        float4& rotation = lists.rotations[i];
        const float length2 = glm::dot(rotation, rotation);
        if (!(length2 > 1e-30f && std::isfinite(length2))) rotation = float4(0, 0, 0, 1), ++turned;
        float& opacity = lists.opacities[i];
        if (opacity < 0 || opacity > 1) opacity = std::clamp(opacity, 0.0f, 1.0f), ++clamped;
    }
    if (turned > 0)
        diagnostics.warn("{}: {} splats have rotations without a length; they are not rotated", path, turned);
    if (clamped > 0)
        diagnostics.warn("{}: {} splats have opacities outside of 0 to 1; they are clamped", path, clamped);
}

enum TypeMask : uint32_t {
    kFloats = 1u << static_cast<uint32_t>(ComponentType::Float),
    kSigned = 1u << static_cast<uint32_t>(ComponentType::Byte) | 1u << static_cast<uint32_t>(ComponentType::Short),
    kUnsigned = 1u << static_cast<uint32_t>(ComponentType::UByte) | 1u << static_cast<uint32_t>(ComponentType::UShort),
};

/// Section "Attributes" of the specification. Scales of any small integers: drafts had signed ones.
void checkType(GltfDocument const& document, uint32_t accessor, uint32_t types, bool isNormalized, const char* name,
               std::string const& path, Diagnostics& diagnostics) {
    GltfAccessor const& of = document.accessors[accessor];
    const bool isFloat = of.component == ComponentType::Float;
    const bool isKnown = (types >> static_cast<uint32_t>(of.component) & 1) != 0;
    if (!isKnown || (isNormalized && !isFloat && !of.normalized))
        diagnostics.refuse(ErrorCode::Corrupt,
                           "{}: {}: accessors[{}] has a component type that the extension does not "
                           "allow; floats always are",
                           path, name, accessor);
}

void checkTypes(GltfDocument const& document, GltfSplats const& splats, std::string const& path,
                Diagnostics& diagnostics) {
    checkType(document, splats.rotation, kFloats | kSigned, true, "ROTATION", path, diagnostics);
    checkType(document, splats.scale, kFloats | kSigned | kUnsigned, false, "SCALE", path, diagnostics);
    checkType(document, splats.opacity, kFloats | kUnsigned, true, "OPACITY", path, diagnostics);
    for (uint32_t k = 0; k < (splats.degree + 1) * (splats.degree + 1); ++k)
        checkType(document, splats.harmonics[k], kFloats, false, "spherical harmonics", path, diagnostics);
}

void warnIgnored(GltfPrimitive const& primitive, std::string const& path, Diagnostics& diagnostics) {
    if (primitive.indices != kNone || !primitive.targets.empty() || primitive.draco)
        diagnostics.warn("{}: indices, morph targets and Draco streams of splats are ignored", path);
}

} // namespace

PrimitiveData buildSplats(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                          Diagnostics& diagnostics) {
    checkTypes(document, *primitive.splats, path, diagnostics);
    warnIgnored(primitive, path, diagnostics);
    if (!diagnostics.ok()) return {};
    SplatLists lists = readLists(document, primitive, path, diagnostics);
    if (!diagnostics.ok()) return {};
    repair(lists, path, diagnostics);
    if (lists.positions.empty()) {
        diagnostics.warn("{}: is empty and is not drawn", path);
        return {};
    }
    auto data = scene::makeSplatData({ .positions = lists.positions,
                                       .rotations = lists.rotations,
                                       .scales = lists.scales,
                                       .opacities = lists.opacities,
                                       .degree = primitive.splats->degree,
                                       .harmonics = lists.harmonics,
                                       .colors = primitive.splats->colors,
                                       .name = path });
    if (!data) {
        diagnostics.refuse(data.error());
        return {};
    }
    PrimitiveData made;
    made.topology = backend::PrimitiveType::Points;
    made.splats = std::move(*data);
    return made;
}

} // namespace filament_core::assets
