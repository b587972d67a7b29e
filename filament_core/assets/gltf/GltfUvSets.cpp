// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfUvSets.h"

#include "filament_core/assets/gltf/GltfPointer.h"

#include <algorithm>
#include <numeric>

namespace filament_core::assets {
namespace {

constexpr size_t kPlaces = GltfAttributes::kUvSets;
using Sets = std::array<uint32_t, kPlaces>; ///< of the file, by place
constexpr size_t kFirstPlaces = GltfAttributes::kFirstUvSets;
constexpr Sets kAsInFile{ 0, 1, kNone, kNone };

/// What a map is for; sets are chosen in this order.
enum class MapUse : uint8_t { Color, Surface, Nothing }; ///< Color: base colour and emission, of unlit materials too

/// Calls visit(map, name, MapUse) for the maps that a material has, the base colour first.
template <class Visit>
void visitMaps(GltfMaterial& material, Visit const& visit) {
    MaterialData const& m = material.values;
    const auto isDrawn = [&](MapName map) {
        const bool isCore = map == MapName::Normal || map == MapName::Occlusion || map == MapName::Emissive;
        if (map == MapName::BaseColor || m.unlit) return map == MapName::BaseColor;
        if (isCore || m.specularGlossiness) return isCore;
        if (map >= MapName::ClearCoat && map <= MapName::ClearCoatNormal) return m.clearCoat.isUsed();
        if (map == MapName::Sheen || map == MapName::SheenRoughness) return m.sheen.isUsed();
        if (map == MapName::Specular || map == MapName::SpecularFactor) return m.specular.isUsed();
        if (map == MapName::Anisotropy) return m.anisotropy.isUsed();
        if (map == MapName::Iridescence || map == MapName::IridescenceThickness) return m.iridescence.isUsed();
        if (map == MapName::Transmission) return m.transmission.isUsed();
        if (map == MapName::Thickness) return m.transmission.isSolid() || m.scatters();
        if (map == MapName::Multiscatter) return m.scatters();
        const bool isDiffuse = map == MapName::DiffuseTransmission || map == MapName::DiffuseTransmissionFactor;
        return !isDiffuse || m.diffuseTransmission.isUsed();
    };
    for (TexturePath const& path : texturePaths()) {
        GltfTextureInfo& info = *textureInfoOf(material, path.map);
        const bool isColor = path.map == MapName::BaseColor || path.map == MapName::Emissive;
        const MapUse use = isColor ? MapUse::Color : MapUse::Surface;
        if (info.texture != kNone) visit(info, path.path, isDrawn(path.map) ? use : MapUse::Nothing);
    }
    if (material.specularGlossiness.texture != kNone)
        visit(material.specularGlossiness, "extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
              MapUse::Surface);
}

/// Materials that primitives have in common: each in one group, named by a material of it.
class Groups {
public:
    explicit Groups(GltfDocument const& document) : mNext(document.materials.size()) {
        std::iota(mNext.begin(), mNext.end(), 0u);
        for (GltfMesh const& mesh : document.meshes) {
            for (GltfPrimitive const& primitive : mesh.primitives) {
                const uint32_t first = materialOf(primitive);
                for (VariantMaterial const& variant : primitive.variants) {
                    if (variant.material != kNone) join(variant.material, first);
                }
            }
        }
    }

    /// The material of a primitive, or one of a variant.
    static uint32_t materialOf(GltfPrimitive const& primitive) {
        if (primitive.material != kNone || primitive.variants.empty()) return primitive.material;
        return primitive.variants.front().material;
    }

    uint32_t of(uint32_t material) {
        // Path halving (Tarjan and van Leeuwen 1984, "Worst-case Analysis of Set Union Algorithms").
        while (mNext[material] != material) material = mNext[material] = mNext[mNext[material]];
        return material;
    }

private:
    void join(uint32_t a, uint32_t b) {
        if (b != kNone) mNext[of(std::max(a, b))] = of(std::min(a, b));
    }

    std::vector<uint32_t> mNext; ///< towards the one that names the group
};

/// Places for at most four sets.
Sets placesFor(std::vector<uint32_t> const& wanted) {
    Sets sets = kAsInFile;
    if (wanted.size() > kFirstPlaces) {
        std::ranges::copy(wanted, sets.begin());
        return sets;
    }
    const auto isWanted = [&](uint32_t set) { return std::ranges::find(wanted, set) != wanted.end(); };
    for (const uint32_t set : wanted) {
        if (set < kFirstPlaces) continue;
        auto* place = std::ranges::find_if(sets, [&](uint32_t other) { return !isWanted(other); });
        *place = set;
    }
    return sets;
}

/// By group: the places of the sets that its maps use.
std::vector<Sets> choosePlaces(GltfDocument& document, Groups& groups) {
    std::vector<std::vector<uint32_t>> wanted(document.materials.size());
    // Colours first, because only the first two places serve them; maps without a use take what is left.
    for (const MapUse now : { MapUse::Color, MapUse::Surface, MapUse::Nothing }) {
        for (uint32_t i = 0; i < document.materials.size(); ++i) {
            std::vector<uint32_t>& sets = wanted[groups.of(i)];
            visitMaps(document.materials[i], [&](GltfTextureInfo const& info, std::string_view, MapUse use) {
                if (use == now && sets.size() < kPlaces && std::ranges::find(sets, info.uvSet) == sets.end())
                    sets.push_back(info.uvSet);
            });
        }
    }
    std::vector<Sets> places;
    for (std::vector<uint32_t> const& sets : wanted) places.push_back(placesFor(sets));
    return places;
}

void follow(GltfTextureInfo& info, MapUse use, Sets const& places) {
    const auto place = static_cast<size_t>(std::ranges::find(places, info.uvSet) - places.begin());
    const bool isKept = place < (use == MapUse::Color ? kFirstPlaces : kPlaces);
    if (!isKept) info.leftSet = info.uvSet;
    info.uvSet = isKept ? static_cast<uint32_t>(place) : 0;
}

void keepSets(Sets const& places, GltfAttributes& attributes) {
    const auto setAt = [&](uint32_t set) { return set < attributes.uvSets.size() ? attributes.uvSets[set] : kNone; };
    for (size_t i = 0; i < kPlaces; ++i) {
        const bool isLacking = places[i] != kNone && places[i] >= kFirstPlaces && setAt(places[i]) == kNone;
        attributes.keptSets[i] = isLacking ? 0 : places[i];
        attributes.uv[i] = setAt(attributes.keptSets[i]);
    }
}

} // namespace

void chooseUvSets(GltfDocument& document) {
    Groups groups(document);
    const std::vector<Sets> places = choosePlaces(document, groups);
    for (uint32_t i = 0; i < document.materials.size(); ++i) {
        visitMaps(document.materials[i], [&](GltfTextureInfo& info, std::string_view, MapUse use) {
            follow(info, use, places[groups.of(i)]);
        });
    }
    for (GltfMesh& mesh : document.meshes) {
        for (GltfPrimitive& primitive : mesh.primitives) {
            const uint32_t material = Groups::materialOf(primitive);
            Sets const& kept = material == kNone ? kAsInFile : places[groups.of(material)];
            keepSets(kept, primitive.attributes);
            if (primitive.draco) keepSets(kept, primitive.draco->ids);
        }
    }
}

void warnAboutUvSets(GltfDocument& document, Diagnostics& diagnostics) {
    for (uint32_t i = 0; i < document.materials.size(); ++i) {
        if (!document.use.has(GltfArray::Materials, i)) continue;
        visitMaps(document.materials[i], [&](GltfTextureInfo const& info, std::string_view name, MapUse use) {
            if (use == MapUse::Nothing || info.leftSet == kNone) return;
            diagnostics.warn("materials[{}]/{}: is drawn with another set of texture coordinates than TEXCOORD_{}: the "
                             "materials of a primitive may use four sets here, and two for base colour and emission",
                             i, name, info.leftSet);
        });
    }
}

} // namespace filament_core::assets
