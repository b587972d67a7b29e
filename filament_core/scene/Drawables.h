// SPDX-License-Identifier: Apache-2.0
/// Drawables: the distinct pairs of geometry and material instance in a scene, numbered. Renderables with equal numbers
/// can share an instanced draw, so a frame only compares and sorts numbers.
///   In      the geometry and material of renderables.   Out: small dense numbers, reused when no renderable has them.
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Levels  of detail are pairs of their own, each of which names the next coarser one.
///   Memory  about 100 bytes per pair. Adding a known pair allocates nothing.
#pragma once

#include "backend/api/Descriptions.h"
#include "filament_core/scene/Materials.h"

#include <filament_core/GeometryLevel.h>
#include <filament_core/Objects.h>
#include <filament_core/Occluder.h>

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace filament_core::scene {

/// The vertex streams after the first; those that are not there come last.
using VertexStreams = std::array<backend::BufferHandle, kMaxVertexStreams - 1>;

/// The geometry of one draw on the device.
struct Geometry {
    backend::BufferHandle vertices, indices;
    uint32_t layout = 0; ///< into GeometryLayouts: vertex layout and topology
    uint32_t firstIndex = 0, indexCount = 0;
    backend::IndexFormat indexFormat = backend::IndexFormat::UInt16;
    bool isOfTriangles = true;
    OccluderMesh const* occluder = nullptr; ///< Drawables keeps it
    VertexStreams streams{};                ///< each vertex buffer has its own: `vertices` tells them
    friend bool operator==(Geometry const&, Geometry const&) = default;
};

/// Vertex layout and topology, stored once: geometries with equal layouts share pipelines.
struct GeometryLayout {
    backend::VertexLayout vertices{};
    backend::PrimitiveType topology = backend::PrimitiveType::Triangles;
    friend bool operator==(GeometryLayout const&, GeometryLayout const&) = default;
};

class GeometryLayouts {
public:
    uint32_t intern(GeometryLayout const& layout);
    uint32_t size() const { return static_cast<uint32_t>(mLayouts.size()); }
    GeometryLayout const& operator[](uint32_t index) const { return mLayouts[index]; }

private:
    std::vector<GeometryLayout> mLayouts;
};

/// Instead of a slot of Deformations.
inline constexpr uint32_t kNotDeformed = ~0u;

/// Of a deformation: what is equal here can share a draw.
struct DeformationKind {
    uint32_t skin = 0;                ///< kDeformed, how many sets of joints a vertex has, and bones; 0: not deformed
    backend::TextureHandle targets{}; ///< of MorphTargets; none: it has none
    friend bool operator==(DeformationKind const&, DeformationKind const&) = default;
    bool isDeformed() const { return skin != 0; }
};

/// What a renderable gives its draws besides geometry and material. RenderableInput, Drawable and DrawCall carry it
/// whole, so a new property is a member here and whatever reads it.
struct DrawProperties {
    bool receivesShadows = true;
    uint8_t lightChannels = 1; ///< bit n: lights of channel n shine on it
    friend bool operator==(DrawProperties const&, DrawProperties const&) = default;
    uint64_t bits() const { return uint64_t{ lightChannels } << 1 | receivesShadows; }
};

/// For Drawable::coarser.
inline constexpr uint32_t kNoLevel = ~0u;

struct Drawable {
    Geometry geometry{};
    MaterialInstance const* material = nullptr;
    DeformationKind deformedAs{}; ///< Deformations::kindOf()
    DrawProperties properties{};
    DrawOrder place{};
    uint32_t coarser = kNoLevel; ///< the number of the next level of detail, which differs in its triangles
    float errorMeters = 0;       ///< of this level, in object space
    friend bool operator==(Drawable const&, Drawable const&) = default;
};

/// Smaller: drawn first. 19 bits.
constexpr uint32_t placeOrder(DrawOrder place) { return uint32_t{ place.priority } << 16 | place.blendOrder; }

/// Whether Quality::transparency may compose this material order-independently: it is placed in the scene,
/// covers its background, tests depth without writing it, has no stencil state, no depth pass of its own, and
/// does not refract the scene colour.
bool blendsInAnyOrder(MaterialInstance const& instance);

class Drawables {
public:
    /// Bits of Use::order: neighbours in this order share programs, then parameters. Ids beyond 12 bits wrap around,
    /// which only costs state changes.
    static constexpr uint32_t kMaterialBits = 12, kInstanceBits = 12;
    static constexpr uint32_t kBlendedOrder = 1u << 31;
    static constexpr uint32_t kTwoPassesOrder = 1u << 30; ///< blended, and drawn twice
    /// Opaque without depth test or depth write: drawn after the sky, before transparent objects.
    static constexpr uint32_t kNoDepthWriteOrder = 1u << 29;
    static constexpr uint32_t kNoDepthTestOrder = 1u << 28; ///< opaque on top of all other opaque objects: after those
    static constexpr uint32_t kReadsSceneColorOrder = 1u << 27; ///< opaque, but refracts the scene colour
    static constexpr uint32_t kAnyOrder = 1u << 26; ///< blended, but may be composed in any order (blendsInAnyOrder())
    static constexpr uint32_t kStencilWriteOrder = 1u << 25; ///< opaque, and writes stencil values: drawn first

    /// The number of this pair; adds a user to it and to its coarser levels: those that `drawable` names, with the rest
    /// as in `drawable`.
    uint32_t acquire(Drawable const& drawable);
    /// The same for a drawable without levels that gets these.
    uint32_t acquire(Drawable const& drawable, std::span<const GeometryLevel> levels);
    void release(uint32_t number);
    /// After the raster state of a material instance changed.
    void updateUses();

    Drawable const& operator[](uint32_t number) const { return mDrawables[number]; }
    /// The part of a pair that sorting reads.
    struct Use {
        uint32_t order = 0; ///< material << kInstanceBits | instance, and the flags above
        uint32_t users = 0;
        uint32_t place = 0; ///< placeOrder() of Drawable::place
        bool staysInBounds =
                false;         ///< what it covers lies in the box of its vertices: triangles, where the mesh has them
        bool occludes = false; ///< its triangles hide what is behind them
    };
    Use use(uint32_t number) const { return mUses[number]; }
    bool hasOccluders() const { return mOccluding > 0; } ///< some pair with users occludes
    /// The part of a pair that the choice of levels reads.
    struct Level {
        uint32_t coarser = kNoLevel; ///< none, too, where vertices are not placed in object space
        float errorMeters = 0;
        uint32_t triangles = 0;
    };
    Level level(uint32_t number) const { return mLevels[number]; }
    /// All numbers are below this, including those of pairs without users.
    uint32_t limit() const { return static_cast<uint32_t>(mDrawables.size()); }
    uint32_t count() const { return static_cast<uint32_t>(mNumbers.size()); }

private:
    struct Hash {
        size_t operator()(Drawable const& drawable) const noexcept;
    };
    void setUse(uint32_t number, Use use);
    uint32_t acquireOne(Drawable const& drawable);
    template <class Acquire>
    uint32_t acquireAfter(uint32_t coarser, Acquire const& acquire);

    std::vector<Drawable> mDrawables;
    std::vector<Use> mUses;           // parallel to mDrawables
    std::vector<Level> mLevels;       // the same
    std::vector<Occluder> mOccluders; // of these that have users
    uint32_t mOccluding = 0;          // how many of mUses occlude
    std::vector<uint32_t> mFree;
    std::unordered_map<Drawable, uint32_t, Hash> mNumbers;
};

} // namespace filament_core::scene
