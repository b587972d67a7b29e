// SPDX-License-Identifier: Apache-2.0
// loadPointCloud(): the vertices of a .ply, or the points of a glTF file where its nodes put them.
#include "base/OutOfMemory.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/meshfiles/MeshFile.h"
#include "filament_core/scene/VertexPositions.h"
#include "shaders/interface/ShaderInterface.h"

#include <filament_core/Points.h>

namespace filament_core {
namespace {

Result<PointCloudData> pointsOfPly(std::filesystem::path const& path) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
    if (!bytes) return bytes.error();
    const Result<assets::MeshFile> file = assets::readPly(*bytes);
    if (!file) return fail(file.error().code, "{}: {}", path.filename().string(), file.error().message);
    PointCloudData cloud;
    for (assets::MeshFilePart const& part : file->parts) {
        for (float3 const& position : part.positions) cloud.positions.push_back(part.origin + double3(position));
        cloud.colors.insert(cloud.colors.end(), part.colors.begin(), part.colors.end());
    }
    return cloud;
}

/// An attribute of the vertices of a primitive, at most three components of it.
class VertexReader {
public:
    VertexReader(assets::PrimitiveData const& primitive, int location) : mPrimitive(primitive) {
        for (uint8_t i = 0; i < primitive.layout.attributeCount; ++i)
            if (primitive.layout.attributes[i].location == location) mAttribute = &primitive.layout.attributes[i];
    }

    std::optional<double3> at(uint32_t vertex) const {
        if (!mAttribute) return std::nullopt;
        const size_t stride = mPrimitive.layout.buffers[0].stride;
        return scene::positionAt(mPrimitive.vertices.data() + vertex * stride + mAttribute->offset, mAttribute->format);
    }

private:
    assets::PrimitiveData const& mPrimitive;
    backend::VertexAttribute const* mAttribute = nullptr;
};

void addPoints(assets::PrimitiveData const& primitive, double4x4 const& worldFromNode, float3 tint,
               PointCloudData& cloud) {
    const VertexReader positions(primitive, shader::kAttributePosition), colors(primitive, shader::kAttributeColor);
    for (const uint32_t vertex : scene::indicesOf(primitive.indexFormat, primitive.indices)) {
        const double3 place = double3(primitive.positionOffset) +
                              double{ primitive.positionScale } * positions.at(vertex).value_or(double3(0));
        const double3 color = primitive.hasColor ? colors.at(vertex).value_or(double3(1)) : double3(1);
        cloud.positions.emplace_back(worldFromNode * double4(place, 1));
        cloud.colors.emplace_back(float3(color) * tint, 1.0f);
    }
}

Result<PointCloudData> pointsOfGltf(std::filesystem::path const& path) {
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<assets::ModelData> model = assets::loadGltf(path, jobs);
    if (!model) return model.error();
    PointCloudData cloud;
    for (assets::NodeData const& node : model->nodes) {
        if (node.mesh == assets::kNone) continue;
        for (assets::PrimitiveData const& primitive : model->meshes[node.mesh].primitives) {
            if (primitive.topology != backend::PrimitiveType::Points || primitive.splats) continue;
            const bool hasMaterial = primitive.material != assets::kNone;
            const float3 tint = hasMaterial ? float3(model->materials[primitive.material].baseColorFactor) : float3(1);
            addPoints(primitive, node.worldFromNode, tint, cloud);
        }
    }
    if (cloud.positions.empty())
        return fail(ErrorCode::Unsupported, "{}: there are no points in the file", path.filename().string());
    return cloud;
}

} // namespace

Result<PointCloudData> loadPointCloud(std::filesystem::path const& path) {
    return orOutOfMemory("loading", path.native(), [&] {
        const bool isPly = assets::meshFormatOf(path.filename().string()) == assets::MeshFormat::Ply;
        return isPly ? pointsOfPly(path) : pointsOfGltf(path);
    });
}

} // namespace filament_core
