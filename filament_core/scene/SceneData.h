// SPDX-License-Identifier: Apache-2.0
/// SceneData: all objects of a scene, by column. Dense arrays for the frame, handles for the user.
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Memory  one array per property; add and remove are O(1), and removal moves the last element into the gap.
#pragma once

#include "filament_core/scene/Attachments.h"
#include "filament_core/scene/ContentVersions.h"
#include "filament_core/scene/Deformations.h"
#include "filament_core/scene/Grids.h"
#include "filament_core/scene/Materials.h"
#include "filament_core/scene/PickRules.h"
#include "filament_core/scene/Probes.h"
#include "filament_core/scene/Renderables.h"
#include "filament_core/scene/SplatData.h"
#include "filament_core/scene/Transforms.h"

#include <filament_core/Box.h>
#include <filament_core/Objects.h>
#include <filament_core/Quality.h>
#include <filament_core/Units.h>

#include <array>
#include <memory>
#include <vector>

namespace filament_core::scene {

struct LightRecord {
    enum class Type : uint8_t { Sun, Point, Spot, Rect, Disc, Tube } type = Type::Sun;
    double3 positionWorld{ 0.0 };
    float3 directionWorld{ 0, -1, 0 }; ///< direction in which the light travels, unit
    float3 color{ 1.0f };
    float intensity = 0; ///< lux (sun), candela, or nits of areas
    float rangeMeters = 0;
    float innerConeRadians = 0, outerConeRadians = 0;
    float sourceRadius = 0; ///< of the disc that softens shadows, metres; of suns: for each metre of distance
    bool castsShadows = true, contactShadows = false;
    uint8_t channels = 1;        ///< bit n: channel n
    bool isTwoSided = false;     ///< rectangles and discs
    bool isVisible = false;      ///< areas: drawn with their luminance
    float3 sideWorld{ 1, 0, 0 }; ///< of areas: along the first of halfExtent, unit; of tubes the axis
    float2 halfExtent{ 0.0f };   ///< metres: half sides, radii, half length and radius
    /// Of points and spots: the words of shader::kProfileHeaderWords. None: as bright in all directions. The light
    /// shines along directionWorld, and the profile's +X is along sideWorld.
    std::shared_ptr<const std::vector<uint32_t>> profile{};
    /// Of points, spots and suns: the words of shader::kImageHeaderWords; its right is sideWorld. None: white.
    std::shared_ptr<const std::vector<uint32_t>> image{};
    float2 imageScale{ 1.0f };  ///< images that a unit beside the axis covers: a metre from a spot; of suns
    float2 imageOffset{ 0.0f }; ///< of suns, images
    bool showsDisc = false;     ///< suns
    float haloSize = 1, haloFalloff = 0;

    bool isArea() const { return type >= Type::Rect; }
};

struct Lights {
    explicit Lights(uint16_t owner = 0) : index(owner) {}

    DenseIndex<LightObject> index;
    std::vector<LightRecord> records;
};

/// Of a light attached to a node: in the node's space.
struct LightPose {
    double3 position{ 0.0 };
    float3 direction{ 0, -1, 0 }, side{ 1, 0, 0 };
};

/// What is attached to which node; maintained by SceneNodes.h.
struct NodeContents {
    Attachments<RenderableObject> renderables;
    Attachments<LightObject> lights;
    Attachments<SkinObject> skins;
    std::vector<LightPose> lightPoses; ///< by handle index
    PickRules pickRules;
};

struct IndirectLightRecord {
    backend::TextureHandle specular;
    backend::TextureHandle irradiance; ///< none: the coefficients only
    EnvironmentStorage storage{};
    CubeShape shape{}; ///< of `specular`
    float levelOfRoughnessOne = 0;
    std::array<float4, 9> irradianceSh{};
    float3x3 worldFromCube{ 1.0f }; ///< before `rotationRadians`
    Lux illuminance{};
    float rotationRadians = 0;
};

/// Where the lower half of a background lies; EnvironmentSettings.
struct BackgroundGround {
    float heightMeters = 0; ///< 0: it is infinitely far away
    float levelMeters = 0;
    float radiusMeters = 0;
};

struct SkyboxRecord {
    backend::TextureHandle cube;
    bool isRgbm = false; ///< RGBA8 as RGBM
    float3x3 worldFromCube{ 1.0f };
    Lux illuminance{};
    float rotationRadians = 0;
    BackgroundGround ground{};
};

/// A cloud of splats, placed as a renderable without geometry is.
struct SplatRecord {
    Renderable renderable;
    std::shared_ptr<const SplatData> data;
};

/// The image of a light that is drawn, as a texture.
struct ShownImage {
    std::shared_ptr<const std::vector<uint32_t>> words{}; ///< LightRecord::image
    Texture texture{};
};

/// A light that is drawn, by a renderable that the app has no handle of.
struct LightShape {
    Light light;
    Renderable renderable;
    filament_core::MaterialInstance instance;
    ShownImage shown{};
    double4x4 worldFromShape{ 1.0 };
};

struct SceneData {
    uint64_t serial = newOwnerSerial();
    Renderables renderables{ ownerTag(serial) };
    Lights lights{ ownerTag(serial) };
    Probes probes{ ownerTag(serial) };
    Grids grids{ ownerTag(serial) };
    Transforms transforms{ ownerTag(serial) }; ///< of the nodes
    NodeContents atNodes;
    Deformations deformations{ ownerTag(serial) };
    std::vector<SplatRecord> splats;           ///< in the order in which they were added
    std::vector<LightShape> lightShapes;       ///< of lights with LightRecord::isVisible
    ContentVersions const* versions = nullptr; ///< of buffers and textures; null: they never change
    IndirectLightRecord indirectLight;         ///< specular: none means no indirect light
    SkyboxRecord skybox;                       ///< cube: none means no skybox
};

Renderable addRenderable(SceneData& scene, RenderableInput const& input);
void removeRenderable(SceneData& scene, Renderable renderable);
/// `input` has no geometry, and the bounds of the splats.
Renderable addSplats(SceneData& scene, RenderableInput const& input, std::shared_ptr<const SplatData> data);
/// A renderable moved by a skin or by morph targets. Fills in `deformation.renderable`.
Renderable addDeformed(SceneData& scene, RenderableInput input, Deformation deformation);
/// place() of Renderables.h, by handle. A renderable attached to a node is moved by its node instead.
void setTransform(SceneData& scene, Renderable renderable, double4x4 const& worldFromObject);
/// In object space; of a deformed renderable: at rest.
void setBounds(SceneData& scene, Renderable renderable, MinMax const& bounds);
void checkIntensity(LightRecord const& light);
Light addLight(SceneData& scene, LightRecord const& light);
void removeLight(SceneData& scene, Light light);
Box sceneBounds(SceneData const& scene);

} // namespace filament_core::scene
