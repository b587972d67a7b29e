// SPDX-License-Identifier: Apache-2.0
/// SceneData: what exists, by column. Dense arrays for the frame, handles for the user.
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Memory  one array a property; add and remove are O(1), removal moves the last element into the gap.
#pragma once

#include "backend/api/Descriptions.h"
#include "filament_core/base/Handle.h"
#include "filament_core/math/Box.h"
#include "filament_core/scene/Materials.h"

#include <filament/Box.h>
#include <filament/Objects.h>
#include <filament/Units.h>

#include <string>
#include <vector>

namespace filament::scene {

/// Maps handles to positions in dense arrays and back.
template <class Tag>
class DenseIndex {
public:
    Handle<Tag> add() {
        const Handle<Tag> handle = mHandles.allocate();
        if (handle.index() >= mDense.size()) mDense.resize(handle.index() + 1);
        mDense[handle.index()] = static_cast<uint32_t>(mOwners.size());
        mOwners.push_back(handle);
        return handle;
    }

    /// The position that the last element must be moved into; the caller then drops the last element.
    uint32_t remove(Handle<Tag> handle) {
        const uint32_t gap = at(handle);
        const Handle<Tag> last = mOwners.back();
        mOwners[gap] = last;
        mDense[last.index()] = gap;
        mOwners.pop_back();
        mHandles.free(handle);
        return gap;
    }

    uint32_t at(Handle<Tag> handle) const {
        FILAMENT_ASSERT(mHandles.isLive(handle), "the handle names something that was removed or never added");
        return mDense[handle.index()];
    }

    uint32_t size() const { return static_cast<uint32_t>(mOwners.size()); }

private:
    HandleAllocator<Tag> mHandles;
    std::vector<uint32_t> mDense;     // by handle index
    std::vector<Handle<Tag>> mOwners; // by dense position
};

/// One draw's worth of geometry on the device.
struct Geometry {
    backend::BufferHandle vertices, indices;
    uint32_t layout = 0; ///< into GeometryLayouts: vertex layout and topology
    uint32_t firstIndex = 0, indexCount = 0;
    backend::IndexType indexType = backend::IndexType::UInt16;
    friend bool operator==(Geometry const&, Geometry const&) = default;
};

/// Vertex layout and topology, interned: geometries with equal layouts share pipelines.
struct GeometryLayout {
    backend::VertexLayout vertices{};
    backend::Topology topology = backend::Topology::Triangles;
    friend bool operator==(GeometryLayout const&, GeometryLayout const&) = default;
};

class GeometryLayouts {
public:
    uint32_t intern(GeometryLayout const& layout);
    GeometryLayout const& operator[](uint32_t index) const { return mLayouts[index]; }

private:
    std::vector<GeometryLayout> mLayouts;
};

enum RenderableFlag : uint8_t {
    kCulled = 1,   ///< may be dropped when its box is out of view
    kMirrored = 2, ///< the transform turns front faces into back faces
};

struct Renderables {
    DenseIndex<RenderableObject> index;
    std::vector<double4x4> worldFromObject;
    std::vector<double3> worldCenter; ///< of the bounds
    std::vector<float3> worldHalfExtent;
    std::vector<CenteredBox> objectBounds;
    std::vector<Geometry> geometry;
    std::vector<MaterialInstance const*> material;
    std::vector<uint8_t> flags;
    std::vector<std::string> name;

    uint32_t count() const { return index.size(); }
};

struct LightRecord {
    enum class Type : uint8_t { Sun, Point, Spot } type = Type::Sun;
    double3 positionWorld{ 0.0 };
    float3 directionWorld{ 0, -1, 0 }; ///< in which light travels, unit
    float3 color{ 1.0f };
    float intensity = 0; ///< lux (sun) or candela
    float rangeMeters = 0;
    float innerConeRadians = 0, outerConeRadians = 0;
};

struct Lights {
    DenseIndex<LightObject> index;
    std::vector<LightRecord> records;
};

struct IndirectLightState {
    backend::TextureHandle specular;
    float levelOfRoughnessOne = 0;
    std::array<float4, 9> irradianceSh{};
    Lux illuminance{};
    float rotationRadians = 0;
};

struct SkyboxState {
    backend::TextureHandle cube;
    Lux illuminance{};
    float rotationRadians = 0;
};

struct SceneData {
    Renderables renderables;
    Lights lights;
    IndirectLightState indirectLight; ///< specular: none means no indirect light
    SkyboxState skybox;               ///< cube: none means no skybox
};

struct RenderableInput {
    Geometry geometry{};
    MaterialInstance const* material = nullptr;
    float3 boundsMin{ 0.0f }, boundsMax{ 0.0f };
    double4x4 worldFromObject{ 1.0 };
    bool culled = true;
    std::string name;
};

Renderable addRenderable(SceneData& scene, RenderableInput const& input);
void removeRenderable(SceneData& scene, Renderable renderable);
/// `worldFromObject` affine and finite; anything else is replaced by a zero scale, which draws nothing.
void setTransform(SceneData& scene, Renderable renderable, double4x4 const& worldFromObject);
Light addLight(SceneData& scene, LightRecord const& light);
void removeLight(SceneData& scene, Light light);
Box sceneBounds(SceneData const& scene);

} // namespace filament::scene
