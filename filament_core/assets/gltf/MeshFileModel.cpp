// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/MeshFileModel.h"

#include "filament_core/assets/gltf/GltfWriter.h"

#include <algorithm>
#include <map>

namespace filament_core::assets {
namespace {

class ImageList {
public:
    ImageList(GlbScene& scene, GltfFolder const& folder, Diagnostics& diagnostics)
            : mScene(scene), mFolder(folder), mDiagnostics(diagnostics) {}

    TextureRef textureOf(std::string const& file) {
        if (file.empty()) return {};
        const auto [found, isNew] = mPlaces.try_emplace(file, kNone);
        if (isNew) {
            std::string path = file;
            std::ranges::replace(path, '\\', '/');
            Result<std::vector<std::byte>> bytes = readGltfUri(path, mFolder);
            if (bytes) {
                found->second = static_cast<uint32_t>(mScene.images.size());
                mScene.images.push_back({ file, std::move(*bytes) });
            } else {
                mDiagnostics.warn("a map is not read: {}", bytes.error().message);
            }
        }
        TextureRef texture;
        texture.image = found->second;
        return texture;
    }

private:
    GlbScene& mScene;
    GltfFolder const& mFolder;
    Diagnostics& mDiagnostics;
    std::map<std::string, uint32_t> mPlaces;
};

MaterialData materialOf(MeshFileMaterial const& material, ImageList& images) {
    MaterialData data;
    data.name = material.name;
    data.baseColorFactor = material.baseColor;
    data.metallicFactor = material.metallic;
    data.roughnessFactor = material.roughness;
    const float brightest = std::max({ material.emissive.x, material.emissive.y, material.emissive.z, 1.0f });
    data.emissiveFactor = material.emissive / brightest;
    data.emissiveStrength = brightest;
    data.baseColor = images.textureOf(material.baseColorMap);
    data.emissive = images.textureOf(material.emissiveMap);
    data.normal = images.textureOf(material.normalMap);
    if (material.baseColor.w < 1) data.alphaMode = AlphaMode::Blend;
    data.doubleSided = true; // none of these formats knows of culling, and their triangles face either way
    return data;
}

} // namespace

Result<std::vector<std::byte>> glbOfMeshFile(std::span<const std::byte> file, MeshFormat format,
                                             GltfFolder const& folder, Diagnostics& diagnostics) {
    const auto read = [&](std::string const& name) {
        std::string path = name;
        std::ranges::replace(path, '\\', '/');
        return readGltfUri(path, folder);
    };
    Result<MeshFile> mesh = readMeshFile(file, format, read, diagnostics);
    if (!mesh) return mesh.error();
    GlbScene scene;
    ImageList images(scene, folder, diagnostics);
    for (MeshFileMaterial const& material : mesh->materials) scene.materials.push_back(materialOf(material, images));
    // Parts without a material: dielectric and rough, as those of an .mtl without values.
    const auto plain = static_cast<uint32_t>(scene.materials.size());
    if (std::ranges::find(mesh->parts, MeshFilePart::kNoMaterial, &MeshFilePart::material) != mesh->parts.end())
        scene.materials.push_back(materialOf({}, images));
    for (MeshFilePart& part : mesh->parts) {
        GlbPrimitive primitive{ .positions = std::move(part.positions),
                                .normals = std::move(part.normals),
                                .colors = std::move(part.colors),
                                .uvs = std::move(part.uvs),
                                .indices = std::move(part.indices),
                                .material = part.material,
                                .arePoints = part.arePoints };
        if (primitive.material == MeshFilePart::kNoMaterial) primitive.material = plain;
        const auto index = static_cast<uint32_t>(scene.meshes.size());
        double4x4 place(1.0);
        place[3] = double4(part.origin, 1);
        scene.nodes.push_back({ .name = part.name, .parentFromNode = place, .mesh = index });
        scene.meshes.push_back({ part.name, {} });
        scene.meshes.back().primitives.push_back(std::move(primitive));
    }
    return writeGlb(scene);
}

} // namespace filament_core::assets
