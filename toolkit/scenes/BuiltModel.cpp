// SPDX-License-Identifier: Apache-2.0
#include "toolkit/scenes/BuiltModel.h"

#include "base/math/Elementary.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "toolkit/scenes/BuiltLight.h"
#include "toolkit/showcase/Shapes.h"
#include "toolkit/showcase/Textures.h"

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace filament_core::tools {
namespace {

using assets::AlphaMode;
using assets::GlbScene;
using assets::kNone;
using assets::MaterialData;
using assets::TextureRef;
using showcase::Shape;
using showcase::TextureSet;

/// In the xy plane, facing +z, `steps` by `steps` cells, one metre per side.
Shape quad(uint32_t steps, float2 uvRepeats) {
    Shape shape;
    const auto at = [&](uint32_t i) { return static_cast<float>(i) / static_cast<float>(steps); };
    for (uint32_t y = 0; y <= steps; ++y) {
        for (uint32_t x = 0; x <= steps; ++x) {
            shape.positions.push_back({ at(x) - 0.5f, 0.5f - at(y), 0 });
            shape.normals.push_back({ 0, 0, 1 });
            shape.uvs.push_back(float2(at(x), at(y)) * uvRepeats);
        }
    }
    for (uint32_t y = 0; y < steps; ++y) {
        for (uint32_t x = 0; x < steps; ++x) {
            const uint32_t a = y * (steps + 1) + x, b = a + 1, c = a + steps + 1, d = c + 1;
            for (const uint32_t i : { a, c, b, b, c, d }) shape.indices.push_back(i);
        }
    }
    return shape;
}

/// Vertex colours from the position: red along x, green along y, alpha along z.
void paint(Shape& shape) {
    shape.colors.clear();
    for (float3 const& p : shape.positions) {
        const float3 c = glm::clamp(p + 0.5f, float3(0.0f), float3(1.0f));
        shape.colors.push_back({ c.x, c.y, 1 - c.x, 0.25f + 0.75f * c.z });
    }
}

struct ShapeSpec {
    std::string kind = "sphere";
    uint32_t detail = 24;
    float2 repeat{ 1, 1 };
    bool painted = false;
};

Shape makeShape(JsonReader& reader, ShapeSpec const& spec) {
    Shape shape;
    if (spec.kind == "sphere")
        shape = showcase::sphere(0.5f, spec.detail, spec.repeat);
    else if (spec.kind == "box")
        shape = showcase::roundedBox(float3(0.5f), 0.06f, 3, spec.repeat.x);
    else if (spec.kind == "torus")
        shape = showcase::torus(0.4f, 0.16f, spec.detail, spec.detail / 2);
    else if (spec.kind == "knot")
        shape = showcase::torusKnot(2, 3, 0.5f, 0.1f, spec.detail * 6, spec.detail / 2);
    else if (spec.kind == "quad")
        shape = quad(spec.detail > 0 ? spec.detail : 1, spec.repeat);
    else
        reader.complain("shape", "'" + spec.kind + "' is not known; sphere, box, torus, knot or quad");
    if (spec.painted) paint(shape);
    return shape;
}

using MakeTextures = TextureSet (*)(uint32_t);

const std::map<std::string, MakeTextures>& textureSets() {
    static const std::map<std::string, MakeTextures> sets{
        { "brick", showcase::brickTextures },        { "wood", showcase::woodTextures },
        { "terrazzo", showcase::terrazzoTextures },  { "checker", showcase::checkerTextures },
        { "dimple", showcase::dimpleTextures },      { "lattice", showcase::latticeTextures },
        { "glass", showcase::stainedGlassTextures }, { "lava", showcase::lavaTextures },
        { "brushed", showcase::brushedTextures }
    };
    return sets;
}

std::optional<WrapMode> wrapFromName(std::string_view name) {
    if (name == "repeat") return WrapMode::Repeat;
    if (name == "mirror") return WrapMode::MirroredRepeat;
    if (name == "clamp") return WrapMode::ClampToEdge;
    return std::nullopt;
}

std::optional<Filter> filterFromName(std::string_view name) {
    if (name == "nearest") return Filter::Nearest;
    if (name == "linear") return Filter::Linear;
    return std::nullopt;
}

std::optional<MipFilter> mipFromName(std::string_view name) {
    if (name == "none") return MipFilter::None;
    if (name == "nearest") return MipFilter::Nearest;
    if (name == "linear") return MipFilter::Linear;
    return std::nullopt;
}

std::optional<AlphaMode> alphaFromName(std::string_view name) {
    if (name == "opaque") return AlphaMode::Opaque;
    if (name == "mask") return AlphaMode::Mask;
    if (name == "blend") return AlphaMode::Blend;
    return std::nullopt;
}

/// Combines the objects into one model.
class ModelBuilder {
public:
    explicit ModelBuilder(std::string const& name) { mScene.name = name; }

    void add(JsonReader& reader) {
        ShapeSpec spec;
        reader.read("shape", spec.kind);
        reader.read("detail", spec.detail, 1, 128);
        reader.read("repeat", spec.repeat);
        reader.read("painted", spec.painted);
        const Shape shape = makeShape(reader, spec);
        MaterialData material;
        material.roughnessFactor = 0.5f;
        material.metallicFactor = 0;
        reader.object("material", [&](JsonReader& r) { readMaterial(r, material); });
        double3 at(0.0), scale(1.0), degrees(0.0);
        reader.read("at", at);
        reader.read("scale", scale);
        reader.read("degrees", degrees);
        double4x4 place = glm::translate(double4x4(1.0), at);
        place = glm::rotate(place, glm::radians(degrees.y), double3(0, 1, 0));
        place = glm::rotate(place, glm::radians(degrees.x), double3(1, 0, 0));
        place = glm::scale(glm::rotate(place, glm::radians(degrees.z), double3(0, 0, 1)), scale);
        Grid grid;
        reader.object("grid", [&](JsonReader& r) { readGrid(r, grid); });
        placeAll(shape, material, place, grid);
    }

    GlbScene& scene() { return mScene; }

private:
    struct Grid {
        uint2 count{ 1, 1 };
        double3 columnStep{ 1.1, 0, 0 }, rowStep{ 0, 1.1, 0 };
        std::optional<float2> roughness, metallic; ///< first to last column, first to last row
    };

    static void readGrid(JsonReader& reader, Grid& grid) {
        reader.read("count", grid.count);
        if (grid.count.x < 1 || grid.count.y < 1 || uint64_t(grid.count.x) * grid.count.y > 4096) {
            reader.complain("count", "expected columns and rows, 4096 objects at most");
            grid.count = { 1, 1 };
        }
        reader.read("columnStep", grid.columnStep);
        reader.read("rowStep", grid.rowStep);
        float2 range(0.0f, 1.0f);
        if (reader.has("roughness")) reader.read("roughness", range), grid.roughness = range;
        range = { 0, 1 };
        if (reader.has("metallic")) reader.read("metallic", range), grid.metallic = range;
    }

    void readMaterial(JsonReader& reader, MaterialData& material) {
        reader.read("color", material.baseColorFactor);
        reader.read("metallic", material.metallicFactor, 0, 1);
        reader.read("roughness", material.roughnessFactor, 0, 1);
        reader.read("emissive", material.emissiveFactor);
        reader.read("emissiveStrength", material.emissiveStrength, 0, 1e5);
        reader.read("normalScale", material.normalScale, -8, 8);
        reader.read("occlusion", material.occlusionStrength, 0, 1);
        reader.choice("alpha", material.alphaMode, "opaque, mask or blend", alphaFromName);
        reader.read("cutoff", material.alphaCutoff, 0, 1);
        reader.read("doubleSided", material.doubleSided);
        reader.read("unlit", material.unlit);
        reader.read("transmission", material.transmission.factor, 0, 1);
        reader.read("thickness", material.transmission.thicknessMeters, 0, 1e5);
        reader.read("attenuationColor", material.transmission.attenuationColor);
        reader.read("attenuationDistance", material.transmission.attenuationDistanceMeters, 1e-6, 1e9);
        reader.read("diffuseTransmission", material.diffuseTransmission.factor, 0, 1);
        reader.read("diffuseTransmissionColor", material.diffuseTransmission.color);
        reader.read("multiscatterColor", material.volumeScatter.color);
        reader.read("scatterAnisotropy", material.volumeScatter.anisotropy, -0.999, 0.999);
        reader.object("textures", [&](JsonReader& r) { readTextures(r, material); });
    }

    void readTextures(JsonReader& reader, MaterialData& material) {
        std::string set;
        uint32_t size = 128;
        reader.read("set", set);
        reader.read("size", size, 8, 512);
        TextureRef ref{ .sampler = { .magFilter = Filter::Linear,
                                     .minFilter = Filter::Linear,
                                     .mipFilter = MipFilter::Linear,
                                     .wrapU = WrapMode::Repeat,
                                     .wrapV = WrapMode::Repeat } };
        const char* const filters = "nearest or linear";
        reader.choice("mag", ref.sampler.magFilter, filters, filterFromName);
        reader.choice("min", ref.sampler.minFilter, filters, filterFromName);
        reader.choice("mip", ref.sampler.mipFilter, "none, nearest or linear", mipFromName);
        reader.choice("wrapU", ref.sampler.wrapU, "repeat, mirror or clamp", wrapFromName);
        reader.choice("wrapV", ref.sampler.wrapV, "repeat, mirror or clamp", wrapFromName);
        readTransform(reader, ref);
        const auto found = textureSets().find(set);
        if (found == textureSets().end()) return reader.complain("set", "'" + set + "' is not a set of textures");
        const Images images = imagesOf(found->first, found->second, size, reader);
        const auto use = [&](TextureRef& slot, uint32_t image) { slot = ref, slot.image = image; };
        if (images.color != kNone) use(material.baseColor, images.color);
        if (images.normal != kNone) use(material.normal, images.normal);
        ref.image = images.color;
        readBump(reader, ref, material);
        if (images.surface != kNone) use(material.metallicRoughness, images.surface);
        if (images.emission != kNone) use(material.emissive, images.emission);
    }

    /// `bump`: the image of colours is a height. `normals`: false leaves out the set's own relief.
    static void readBump(JsonReader& reader, TextureRef const& heights, MaterialData& material) {
        if (reader.has("bump")) material.bump.map = heights;
        reader.read("bump", material.bump.factor, -10, 10);
        bool usesNormals = true;
        reader.read("normals", usesNormals);
        if (!usesNormals) material.normal = {};
    }

    // KHR_texture_transform: translation * rotation * scale.
    static void readTransform(JsonReader& reader, TextureRef& ref) {
        ref.hasTransform = reader.has("offset") || reader.has("scale") || reader.has("degrees");
        double2 offset(0.0), scale(1.0);
        double degrees = 0;
        reader.read("offset", offset);
        reader.read("scale", scale);
        reader.read("degrees", degrees, -360, 360);
        const double c = elementary::cos(glm::radians(degrees)), s = elementary::sin(glm::radians(degrees));
        const double3x3 matrix{ c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y, 0, offset.x, offset.y, 1 };
        ref.uvTransform = float3x3(matrix);
    }

    struct Images {
        uint32_t color = kNone, normal = kNone, surface = kNone, emission = kNone;
    };

    Images imagesOf(std::string const& set, MakeTextures make, uint32_t size, JsonReader& reader) {
        const auto [entry, isNew] = mImages.try_emplace({ set, size });
        if (!isNew) return entry->second;
        const TextureSet pictures = make(size);
        const std::pair<showcase::Picture const*, uint32_t Images::*> all[] = { { &pictures.color, &Images::color },
                                                                                { &pictures.normal, &Images::normal },
                                                                                { &pictures.surface, &Images::surface },
                                                                                { &pictures.emission,
                                                                                  &Images::emission } };
        for (auto const& [picture, slot] : all) {
            if (picture->pixels.empty()) continue;
            auto image = assets::glbImageFromPixels(set, picture->size, picture->size, picture->pixels);
            if (!image) {
                reader.complain("set", image.error().message);
                continue;
            }
            entry->second.*slot = static_cast<uint32_t>(mScene.images.size());
            mScene.images.push_back(std::move(*image));
        }
        return entry->second;
    }

    static float between(float2 range, uint32_t i, uint32_t count) {
        return count < 2 ? range.x
                         : range.x + (range.y - range.x) * static_cast<float>(i) / static_cast<float>(count - 1);
    }

    // One material per column and row if they differ, otherwise one for all, so that the engine can merge the draws of
    // the copies.
    void placeAll(Shape const& shape, MaterialData const& material, double4x4 const& place, Grid const& grid) {
        uint32_t mesh = kNone;
        for (uint32_t row = 0; row < grid.count.y; ++row) {
            for (uint32_t column = 0; column < grid.count.x; ++column) {
                MaterialData one = material;
                if (grid.roughness) one.roughnessFactor = between(*grid.roughness, column, grid.count.x);
                if (grid.metallic) one.metallicFactor = between(*grid.metallic, row, grid.count.y);
                if (mesh == kNone || grid.roughness || grid.metallic) mesh = addMesh(shape, one);
                const double3 step = grid.columnStep * double(column) + grid.rowStep * double(row);
                mScene.nodes.push_back({ .name = "object " + std::to_string(mScene.nodes.size()),
                                         .parentFromNode = glm::translate(double4x4(1.0), step) * place,
                                         .mesh = mesh });
            }
        }
    }

    uint32_t addMesh(Shape const& shape, MaterialData material) {
        const auto index = static_cast<uint32_t>(mScene.materials.size());
        material.name = "material " + std::to_string(index);
        mScene.materials.push_back(std::move(material));
        mScene.meshes.push_back({ .name = "mesh " + std::to_string(mScene.meshes.size()),
                                  .primitives = { { .positions = shape.positions,
                                                    .normals = shape.normals,
                                                    .colors = shape.colors,
                                                    .uvs = shape.uvs,
                                                    .indices = shape.indices,
                                                    .material = index } } });
        return static_cast<uint32_t>(mScene.meshes.size() - 1);
    }

    GlbScene mScene;
    std::map<std::pair<std::string, uint32_t>, Images> mImages;
};

} // namespace

Result<std::vector<std::byte>> buildModel(Json const& model, std::string const& name) {
    ModelBuilder builder(name);
    JsonReader reader(model, name + ": model");
    reader.objects("objects", [&](JsonReader& object) { builder.add(object); });
    reader.object("imageBasedLight", [&](JsonReader& light) { addBuiltLight(light, builder.scene()); });
    if (const Result<void> done = reader.finish(); !done) return done.error();
    if (builder.scene().nodes.empty())
        return fail(ErrorCode::InvalidArgument, "{}: model: objects: a model needs at least one", name);
    return assets::writeGlb(builder.scene());
}

} // namespace filament_core::tools
