// SPDX-License-Identifier: Apache-2.0
// writeBakedModel(): the JSON of the file with what changes, and one buffer.
#include "filament_core/assets/gltf/GltfContainer.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "toolkit/json/JsonFile.h"
#include "tools/bake/BakeModel.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <map>
#include <set>
#include <variant>

namespace filament_core::bake {
namespace {

using assets::kNone;
using tools::Json;

constexpr int kFloat = 5126, kUint = 5125, kArrayBuffer = 34962, kElementBuffer = 34963, kBilinear = 9729,
              kTrilinear = 9987;

using WrittenEntry = std::variant<LightmapEntry const*, OcclusionEntry const*>;

class Writer {
public:
    Writer(BakeModel const& model, Atlas const& atlas, WrittenEntry entry)
            : mModel(model), mAtlas(atlas), mEntry(entry) {}

    Result<std::vector<std::byte>> write() {
        const Result<assets::GltfContainer> container = assets::openGltfContainer(mModel.file);
        if (!container) return container.error();
        const std::string_view text(reinterpret_cast<const char*>(container->json.data()), container->json.size());
        Result<Json> json = tools::parseJson(text, "the model");
        if (!json) return json.error();
        mRoot = std::move(*json);
        mContainer = *container;
        if (Result<void> done = mergeBuffers(); !done) return done.error();
        if (Result<void> done = embedFiles("images", mRoot["images"]); !done) return done.error();
        if (mRoot.contains("extensions") && mRoot["extensions"].contains("EXT_lights_ies")) {
            if (auto done = embedFiles("lights", mRoot["extensions"]["EXT_lights_ies"]["lights"]); !done)
                return done.error();
        }
        const uint32_t texture = addTextures();
        addMeshes();
        addToMaterials(texture);
        Json& used = mRoot["extensionsUsed"];
        const char* const extension = lightmap() ? kLightmapExtension : kBentNormalExtension;
        const bool isNamed = lightmap() || occlusion()->hasBentNormals;
        if (isNamed && std::ranges::find(used, Json(extension)) == used.end()) used.push_back(extension);
        if (used.empty()) mRoot.erase("extensionsUsed");
        for (const char* list : { "images", "materials", "samplers", "textures", "meshes" }) {
            if (mRoot[list].empty()) mRoot.erase(list);
        }
        return bytes();
    }

private:
    size_t append(std::span<const std::byte> bytes) {
        mBinary.resize((mBinary.size() + 3) / 4 * 4);
        const size_t at = mBinary.size();
        mBinary.insert(mBinary.end(), bytes.begin(), bytes.end());
        return at;
    }

    uint32_t addView(std::span<const std::byte> bytes, int target = 0) {
        Json view{ { "buffer", 0 }, { "byteOffset", append(bytes) }, { "byteLength", bytes.size() } };
        if (target != 0) view["target"] = target;
        mRoot["bufferViews"].push_back(std::move(view));
        return static_cast<uint32_t>(mRoot["bufferViews"].size() - 1);
    }

    /// All buffers that have data become one; fallbacks without data stay.
    Result<void> mergeBuffers() {
        std::vector<std::pair<uint32_t, size_t>> moved; // new buffer and offset, by old one
        Json kept = Json::array({ Json::object() });
        uint32_t index = 0;
        for (Json& buffer : mRoot["buffers"]) {
            const bool isBinary = index++ == 0 && mContainer.hasBinary && !buffer.contains("uri");
            if (!isBinary && !buffer.contains("uri")) {
                moved.emplace_back(static_cast<uint32_t>(kept.size()), 0);
                kept.push_back(buffer);
                continue;
            }
            std::vector<std::byte> read;
            if (!isBinary) {
                auto bytes = assets::readGltfUri(buffer["uri"].get<std::string>(), { mModel.folder });
                if (!bytes) return bytes.error();
                read = std::move(*bytes);
            }
            moved.emplace_back(0, append(isBinary ? mContainer.binary : std::span<const std::byte>(read)));
        }
        mRoot["buffers"] = std::move(kept);
        for (Json& view : mRoot["bufferViews"]) {
            move(view, moved);
            if (!view.contains("extensions")) continue;
            for (const char* name : { "EXT_meshopt_compression", "KHR_meshopt_compression" }) {
                if (view["extensions"].contains(name)) move(view["extensions"][name], moved);
            }
        }
        return {};
    }

    static void move(Json& view, std::vector<std::pair<uint32_t, size_t>> const& moved) {
        const auto [buffer, offset] = moved.at(view["buffer"].get<size_t>());
        view["buffer"] = buffer;
        if (offset > 0) view["byteOffset"] = view.value("byteOffset", size_t(0)) + offset;
    }

    Result<void> embedFiles(const char* what, Json& list) {
        for (Json& element : list) {
            if (!element.contains("uri")) continue;
            const auto uri = element["uri"].get<std::string>();
            if (assets::isDataUri(uri)) continue;
            const auto bytes = assets::readGltfUri(uri, { mModel.folder });
            if (!bytes) return bytes.error();
            element.erase("uri");
            element["bufferView"] = addView(*bytes);
            element["mimeType"] = what == std::string_view("lights") ? "application/x-ies-lm-63" : mimeOf(*bytes);
        }
        return {};
    }

    static const char* mimeOf(std::span<const std::byte> bytes) {
        const auto begins = [&](std::string_view magic, size_t at) {
            return bytes.size() >= at + magic.size() && std::memcmp(&bytes[at], magic.data(), magic.size()) == 0;
        };
        if (begins("\x89PNG", 0)) return "image/png";
        if (begins("RIFF", 0)) return "image/webp";
        if (begins("\xabKTX", 0)) return "image/ktx2";
        if (begins("DDS ", 0)) return "image/vnd-ms.dds";
        return begins("ftyp", 4) ? "image/avif" : "image/jpeg";
    }

    LightmapEntry const* lightmap() const {
        LightmapEntry const* const* entry = std::get_if<LightmapEntry const*>(&mEntry);
        return entry ? *entry : nullptr;
    }
    OcclusionEntry const* occlusion() const {
        OcclusionEntry const* const* entry = std::get_if<OcclusionEntry const*>(&mEntry);
        return entry ? *entry : nullptr;
    }

    /// One for each page; returns the first.
    uint32_t addTextures() {
        mRoot["samplers"].push_back({ { "magFilter", 9729 },
                                      { "minFilter", mAtlas.levels > 1 ? kTrilinear : kBilinear },
                                      { "wrapS", 33071 },
                                      { "wrapT", 33071 } });
        const auto first = static_cast<uint32_t>(mRoot["textures"].size());
        const size_t count = lightmap() ? lightmap()->pages.size() : occlusion()->pages.size();
        for (size_t page = 0; page < count; ++page) {
            Json texture = lightmap() ? lightmapTexture(page) : occlusionTexture(page);
            texture["sampler"] = mRoot["samplers"].size() - 1;
            mRoot["textures"].push_back(std::move(texture));
        }
        return first;
    }

    Json lightmapTexture(size_t page) {
        LightmapEntry const& light = *lightmap();
        const std::string name = nameOf("lightmap", page);
        Json source{ { "source", addImage(name, light.pages[page], "image/ktx2") } };
        if (!light.openness.empty())
            source["openness"] = addImage(name + " openness", light.openness[page], "image/ktx2");
        return { { "extensions", { { kLightmapExtension, source } } } };
    }

    Json occlusionTexture(size_t page) {
        return { { "source", addImage(nameOf("occlusion", page), occlusion()->pages[page], "image/png") } };
    }

    static std::string nameOf(const char* stem, size_t page) {
        return page == 0 ? std::string(stem) : fmt::format("{} {}", stem, page);
    }

    size_t addImage(std::string const& name, std::vector<std::byte> const& file, const char* mimeType) {
        mRoot["images"].push_back({ { "name", name }, { "bufferView", addView(file) }, { "mimeType", mimeType } });
        return mRoot["images"].size() - 1;
    }

    /// Values of the new vertices, `components` floats each.
    template <class T>
    uint32_t addAttribute(AtlasSurface const& surface, std::vector<T> const& values, bool hasBounds = false) {
        std::vector<T> picked;
        for (const uint32_t source : surface.sources) picked.push_back(values[source]);
        return addValues(picked, hasBounds);
    }

    template <class T>
    uint32_t addValues(std::vector<T> const& values, bool hasBounds = false) {
        constexpr const char* kTypes[] = { "SCALAR", "VEC2", "VEC3", "VEC4" };
        Json accessor{ { "bufferView", addView(std::as_bytes(std::span(values)), kArrayBuffer) },
                       { "componentType", kFloat },
                       { "count", values.size() },
                       { "type", kTypes[T::length() - 1] } };
        if (hasBounds) {
            T low = values.front(), high = values.front();
            for (T const& value : values) low = glm::min(low, value), high = glm::max(high, value);
            for (int i = 0; i < T::length(); ++i) accessor["min"].push_back(low[i]), accessor["max"].push_back(high[i]);
        }
        mRoot["accessors"].push_back(std::move(accessor));
        return static_cast<uint32_t>(mRoot["accessors"].size() - 1);
    }

    uint32_t addIndices(std::vector<uint32_t> const& indices) {
        mRoot["accessors"].push_back({ { "bufferView", addView(std::as_bytes(std::span(indices)), kElementBuffer) },
                                       { "componentType", kUint },
                                       { "count", indices.size() },
                                       { "type", "SCALAR" } });
        return static_cast<uint32_t>(mRoot["accessors"].size() - 1);
    }

    /// Pages on which a surface lies.
    static std::set<uint32_t> pagesOf(AtlasSurface const& surface) {
        std::set<uint32_t> pages(surface.pages.begin(), surface.pages.end());
        if (pages.empty()) pages.insert(0);
        return pages;
    }

    /// The triangles of a page, and the vertices that they use.
    static AtlasSurface onPage(AtlasSurface const& surface, uint32_t page) {
        AtlasSurface part;
        std::map<uint32_t, uint32_t> made;
        for (size_t i = 0; i < surface.indices.size(); ++i) {
            if (surface.pages[i / 3] != page) continue;
            const uint32_t vertex = surface.indices[i];
            const auto [entry, isNew] = made.try_emplace(vertex, static_cast<uint32_t>(part.sources.size()));
            part.indices.push_back(entry->second);
            if (!isNew) continue;
            part.sources.push_back(surface.sources[vertex]);
            part.uvs.push_back(surface.uvs[vertex]);
        }
        return part;
    }

    void rewrite(BakeModel::Source const& source, AtlasSurface const& surface, Json& primitive) {
        assets::GltfGeometry const& geometry = source.geometry;
        Json attributes{ { "POSITION", addAttribute(surface, geometry.positions, true) } };
        if (!geometry.normals.empty()) attributes["NORMAL"] = addAttribute(surface, geometry.normals);
        if (!geometry.tangents.empty()) attributes["TANGENT"] = addAttribute(surface, geometry.tangents);
        if (!geometry.colors.empty()) attributes["COLOR_0"] = addAttribute(surface, geometry.colors);
        for (size_t i = 0; i < source.uvSets.size(); ++i) {
            const std::string name = fmt::format("TEXCOORD_{}", source.uvSets[i]);
            if (geometry.uvs[i].empty() || source.uvSets[i] == kNone || attributes.contains(name)) continue;
            attributes[name] = addAttribute(surface, geometry.uvs[i]);
        }
        attributes[fmt::format("TEXCOORD_{}", mModel.uvSet)] = addValues(surface.uvs);
        if (occlusion() && !occlusion()->vertices.empty()) addOcclusion(source, surface, attributes);
        primitive["attributes"] = std::move(attributes);
        primitive["indices"] = addIndices(surface.indices);
        if (primitive.contains("extensions")) {
            primitive["extensions"].erase("KHR_draco_mesh_compression");
            if (primitive["extensions"].empty()) primitive.erase("extensions");
        }
    }

    void addOcclusion(BakeModel::Source const& source, AtlasSurface const& surface, Json& attributes) {
        std::vector<glm::vec<1, float>> visible;
        std::vector<float3> directions;
        for (double4 const& value : occlusion()->vertices[source.surface]) {
            visible.emplace_back(static_cast<float>(value.x));
            const double3 direction = source.meshFromWorld * double3(value.y, value.z, value.w);
            const double length = glm::length(direction);
            directions.emplace_back(length > 0 ? direction / length : double3(0.0)); // nothing is open
        }
        attributes["_OCCLUSION"] = addAttribute(surface, visible);
        attributes["_BENT_NORMAL"] = addAttribute(surface, directions);
    }

    /// In the winding of the file: surfaces of mirrored nodes were turned.
    static AtlasSurface asWound(BakeModel::Source const& source, AtlasSurface surface) {
        std::vector<uint32_t>& indices = surface.indices;
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            if (surface.sources[indices[i + 1]] != source.geometry.indices[i + 1])
                std::swap(indices[i + 1], indices[i + 2]);
        }
        return surface;
    }

    void addMeshes() {
        std::map<uint32_t, uint32_t> meshOfNode;
        for (BakeModel::Source const& source : mModel.sources) {
            auto [entry, isNew] = meshOfNode.try_emplace(source.node, 0);
            if (isNew) {
                Json mesh = mRoot["meshes"][source.mesh];
                mRoot["meshes"].push_back(std::move(mesh));
                entry->second = static_cast<uint32_t>(mRoot["meshes"].size() - 1);
                mRoot["nodes"][source.node]["mesh"] = entry->second;
            }
            Json& primitives = mRoot["meshes"][entry->second]["primitives"];
            const AtlasSurface surface = asWound(source, mAtlas.surfaces[source.surface]);
            const std::set<uint32_t> pages = pagesOf(surface);
            const Json original = primitives[source.primitive];
            for (const uint32_t page : pages) {
                const bool isFirst = page == *pages.begin();
                const size_t index = isFirst ? source.primitive : primitives.size();
                if (!isFirst) primitives.push_back(original);
                rewrite(source, pages.size() == 1 ? surface : onPage(surface, page), primitives[index]);
                mBaked[{ entry->second, static_cast<uint32_t>(index) }] = page;
            }
        }
    }

    /// Materials of baked primitives, once more where others use them too.
    void addToMaterials(uint32_t firstTexture) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> lit; // by material of the file and page
        const auto litOne = [&](uint32_t material, uint32_t page) {
            const auto [entry, isNew] = lit.try_emplace({ material, page }, 0);
            if (!isNew) return entry->second;
            Json copy = material == kNone ? Json::object() : mRoot["materials"][material];
            const Json map{ { "index", firstTexture + page }, { "texCoord", mModel.uvSet } };
            if (LightmapEntry const* const light = lightmap()) {
                copy["extensions"][kLightmapExtension] = { { "lightmapTexture", map },
                                                           { "intensity", light->intensity },
                                                           { "directLight", light->hasDirectLight } };
            } else {
                copy["occlusionTexture"] = map;
                if (occlusion()->hasBentNormals) copy["extensions"][kBentNormalExtension] = Json::object();
            }
            mRoot["materials"].push_back(std::move(copy));
            return entry->second = static_cast<uint32_t>(mRoot["materials"].size() - 1);
        };
        for (auto const& [baked, page] : mBaked) {
            Json& primitive = mRoot["meshes"][baked.first]["primitives"][baked.second];
            primitive["material"] = litOne(primitive.value("material", kNone), page);
            if (!primitive.contains("extensions") || !primitive["extensions"].contains("KHR_materials_variants"))
                continue;
            for (Json& mapping : primitive["extensions"]["KHR_materials_variants"]["mappings"])
                mapping["material"] = litOne(mapping["material"].get<uint32_t>(), page);
        }
    }

    Result<std::vector<std::byte>> bytes() {
        mBinary.resize((mBinary.size() + 3) / 4 * 4);
        mRoot["buffers"][0] = { { "byteLength", mBinary.size() } };
        std::string text = mRoot.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const size_t total = 12 + 8 + text.size() + 8 + mBinary.size();
        if (total > 0xffffffffull) return fail(ErrorCode::OutOfMemory, "a .glb holds 4 GiB; split the model");
        std::vector<std::byte> file;
        const auto put = [&](uint32_t word) {
            const auto bytes = std::as_bytes(std::span(&word, 1));
            file.insert(file.end(), bytes.begin(), bytes.end());
        };
        put(0x46546C67), put(2), put(static_cast<uint32_t>(total));
        put(static_cast<uint32_t>(text.size())), put(0x4E4F534A);
        const auto chars = std::as_bytes(std::span(text));
        file.insert(file.end(), chars.begin(), chars.end());
        put(static_cast<uint32_t>(mBinary.size())), put(0x004E4942);
        file.insert(file.end(), mBinary.begin(), mBinary.end());
        return file;
    }

    BakeModel const& mModel;
    Atlas const& mAtlas;
    const WrittenEntry mEntry;
    assets::GltfContainer mContainer;
    Json mRoot;
    std::vector<std::byte> mBinary;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> mBaked; // pages, by mesh and primitive
};

} // namespace

Result<std::vector<std::byte>> writeBakedModel(BakeModel const& model, Atlas const& atlas, LightmapEntry const& light) {
    return Writer(model, atlas, &light).write();
}

Result<std::vector<std::byte>> writeBakedModel(BakeModel const& model, Atlas const& atlas,
                                               OcclusionEntry const& occlusion) {
    return Writer(model, atlas, &occlusion).write();
}

} // namespace filament_core::bake
