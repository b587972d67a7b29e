// SPDX-License-Identifier: Apache-2.0
/// The objects of an engine: small typed handles, and the descriptions that they are created from.
///   Defaults  a default-initialised description is valid except for documented fields.
///   Lifetime  until Engine::destroy, or the end of the engine, which names objects that were not destroyed. Owned<T>
///             destroys its object by RAII.
#pragma once

#include <filament_core/Format.h>
#include <filament_core/Handle.h>
#include <filament_core/Material.h>
#include <filament_core/Math.h>
#include <filament_core/NativeWindow.h>
#include <filament_core/OutputSpace.h>
#include <filament_core/Quality.h>
#include <filament_core/Sampler.h>
#include <filament_core/Units.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace filament_core {

using Texture = ObjectHandle<struct TextureObject>;
using VertexBuffer = ObjectHandle<struct VertexBufferObject>;
using IndexBuffer = ObjectHandle<struct IndexBufferObject>;
using Material = ObjectHandle<struct MaterialObject>;
using MaterialInstance = ObjectHandle<struct MaterialInstanceObject>;
using IndirectLight = ObjectHandle<struct IndirectLightObject>;
using MorphTargets = ObjectHandle<struct MorphTargetsObject>;
using LightProfile = ObjectHandle<struct LightProfileObject>;
using LightImage = ObjectHandle<struct LightImageObject>;
using Skybox = ObjectHandle<struct SkyboxObject>;
using RenderTarget = ObjectHandle<struct RenderTargetObject>;
using SwapChain = ObjectHandle<struct SwapChainObject>;

/// Any object of an engine, for Engine::destroy().
using EngineObject = std::variant<Texture, VertexBuffer, IndexBuffer, MorphTargets, Material, MaterialInstance,
                                  IndirectLight, Skybox, LightProfile, LightImage, RenderTarget, SwapChain>;

/// Refers to a request to Engine::compile().
struct Compilation {
    uint64_t id = 0;
    explicit operator bool() const { return id != 0; }
};
using Renderable = ObjectHandle<struct RenderableObject>;           ///< of one Scene
using Light = ObjectHandle<struct LightObject>;                     ///< of one Scene
using Skin = ObjectHandle<struct SkinObject>;                       ///< of one Scene
using Node = ObjectHandle<struct NodeObject>;                       ///< of one Scene
using ReflectionProbe = ObjectHandle<struct ReflectionProbeObject>; ///< of one Scene
using IrradianceGrid = ObjectHandle<struct IrradianceGridObject>;   ///< of one Scene

/// What a pick is for. Nodes can be left out of picks of the first two aims: Scene::setPickable().
enum class PickAim : uint8_t { Select, Hover, Anything };

/// Bit n: layer n. A view shows the renderables of its layers (View::visibleLayers): a renderable in view is drawn, and
/// casts shadows, if it is in one of them. Lights have no layers, but LightChannels.
using Layers = uint8_t;
inline constexpr Layers kDefaultLayers = 1, kAllLayers = 0xFF;

/// Sort order among transparent objects, and among opaque ones without depth test or depth write.
/// Smaller priorities are drawn first, then smaller blend orders, then objects farther from the camera;
/// ties keep the order of the scene. Ignored for refractive materials that write depth.
/// Quality::transparency is order-independent only for objects with the default.
struct DrawOrder {
    static constexpr uint8_t kLastPriority = 7;
    uint8_t priority = 4;    ///< [0, kLastPriority]
    uint16_t blendOrder = 0; ///< among those of one priority
    friend bool operator==(DrawOrder const&, DrawOrder const&) = default;
};

/// `pixels`: level 0, then level 1, ...; each level holds all layers, with tightly packed rows and row 0 at the top. If
/// it is empty, the contents are undefined. Copied before the call returns.
/// A 3D texture (`sampler3d` of a material) has an uncompressed format, and `pixels`, if any, all of its levels: its
/// slices, from w = 0 on, are halved from level to level like its rows.
struct TextureDesc {
    TextureKind kind = TextureKind::Texture2D;
    Format format = Format::RGBA8;
    uint32_t width = 1, height = 1; ///< >= 1, at most DeviceDescription::maxTextureSize, or max3DTextureSize
    uint32_t layers = 1;            ///< 6 for a cube; the slices of level 0 of a 3D texture, at most max3DTextureSize
    uint32_t levels = 1;            ///< mip levels given in `pixels`
    bool generateMips = false;      ///< compute levels 1.. from level 0, on the device or, for RGBA8Srgb, before the
                                    ///< upload; `pixels` then has level 0 only
    bool renderable = false;        ///< can be the colour of a RenderTarget
    std::span<const std::byte> pixels{};
    std::string name{};
};

/// A part of a texture, and its new contents.
struct TextureUpdate {
    std::span<const std::byte> pixels{}; ///< tightly packed rows, row 0 at the top, layer after layer
    uint32_t level = 0;
    uint32_t firstLayer = 0, layerCount = 1; ///< or slices of a 3D texture
    uint2 offset{ 0 }, size{ 0 };            ///< texels, from the left and the top; a size of 0: up to the edge
    /// Then computes levels 1.. from level 0; of RGBA8Srgb only if `pixels` is all of level 0. On the device, or for
    /// RGBA8Srgb before the upload.
    bool generateMips = false;
};

/// The attribute's name in the shaders.
enum class Attribute : uint8_t {
    Position = 0, ///< float3
    Tangents = 1, ///< float4: quaternion of the tangent frame (x tangent, z normal); w < 0: bitangent flipped
    Color = 2,    ///< float4, linear
    Uv0 = 3,
    Uv1 = 4,       ///< float2
    Joints = 5,    ///< uint4: bones of the skin
    Weights = 6,   ///< float4: the weight of each bone; the sum is 1
    Custom0 = 7,   ///< float4; Custom0 + 7 is the last
    Joints1 = 13,  ///< uint4: bones 5 to 8 of a vertex; replaces Custom0 + 6
    Weights1 = 14, ///< float4; replaces Custom0 + 7; the sum of all eight is 1
};

struct AttributeDesc {
    Attribute attribute = Attribute::Position;
    VertexFormat format = VertexFormat::Float3;
    uint32_t offset = 0; ///< bytes from the start of a vertex
};

/// Attributes that lie apart from the others, because they change at other times.
struct VertexStreamDesc {
    uint32_t stride = 0; ///< bytes, > 0, multiple of 4
    std::vector<AttributeDesc> attributes{};
    std::span<const std::byte> data{}; ///< vertexCount * stride bytes
};

inline constexpr uint32_t kMaxVertexStreams = 3;

/// Interleaved attributes. `data` is copied before the call returns.
struct VertexBufferDesc {
    uint32_t vertexCount = 0; ///< > 0
    uint32_t stride = 0;      ///< bytes, > 0, multiple of 4
    std::vector<AttributeDesc> attributes{};
    std::span<const std::byte> data{}; ///< vertexCount * stride bytes
    /// Further streams, of as many vertices, with other attributes: the first is stream 1 of Engine::update(). At most
    /// kMaxVertexStreams with that of `data`. docs/objects.md, "Vertex streams".
    std::vector<VertexStreamDesc> streams{};
    std::string name{};
};

/// Displacements of a mesh, one per vertex. An empty span changes nothing; tangents keep their handedness.
struct MorphTargetDesc {
    std::span<const float3> positions{}, normals{}, tangents{};
};

/// The targets that RenderableDesc::morphWeights refers to. Copied before the call returns: 16 bytes per vertex, target
/// and kind of displacement that any target has.
struct MorphTargetsDesc {
    uint32_t vertexCount = 0;               ///< > 0, that of the vertex buffer it is used with
    std::vector<MorphTargetDesc> targets{}; ///< at least one; as many as the texels of the device's largest texture
    std::string name{};
};

struct IndexBufferDesc {
    uint32_t indexCount = 0; ///< > 0
    IndexFormat format = IndexFormat::UInt16;
    std::span<const std::byte> data{};
    std::string name{};
};

/// Value of a constant ("constants" in the .mat file), fixed when the material is loaded.
struct MaterialConstant {
    std::string name{};
    std::variant<bool, int32_t, float> value{};
};

/// `package`: the bytes of a .fmat file written by matc.
struct MaterialDesc {
    std::span<const std::byte> package{};
    std::vector<MaterialConstant> constants{};
    std::string name{}; ///< empty: the name in the package
};

/// A parameter of one material, found once by Engine::findParameter() instead of at each set().
struct ParameterId {
    uint32_t material = ~0u, index = ~0u; ///< the engine's numbers
};

/// Which parameter Engine::set() sets: its name, or its id.
class ParameterKey {
public:
    template <class T>
    requires std::is_convertible_v<T const&, std::string_view> ParameterKey(T const& name) : mName(name) {}
    ParameterKey(ParameterId id) : mId(id) {}

    std::string_view name() const { return mName; } ///< empty: an id
    std::optional<ParameterId> id() const { return mId; }

private:
    std::string_view mName{};
    std::optional<ParameterId> mId{};
};

/// Value of a parameter. The C++ type has the same name as the parameter's type (ParameterType).
using ParameterValue = std::variant<bool, bool2, bool3, bool4, float, float2, float3, float4, int32_t, int2, int3, int4,
                                    uint32_t, uint2, uint3, uint4, float3x3, float4x4>;

/// A number of C++ for a parameter of another type: Engine::set().
using ParameterNumber = std::variant<int64_t, uint64_t, double>;

/// Values of consecutive elements of an array parameter.
using ParameterArray =
        std::variant<std::span<const bool>, std::span<const bool2>, std::span<const bool3>, std::span<const bool4>,
                     std::span<const float>, std::span<const float2>, std::span<const float3>, std::span<const float4>,
                     std::span<const int32_t>, std::span<const int2>, std::span<const int3>, std::span<const int4>,
                     std::span<const uint32_t>, std::span<const uint2>, std::span<const uint3>, std::span<const uint4>,
                     std::span<const float3x3>, std::span<const float4x4>>;

/// Order in which materials are compiled, and how much of that happens per frame.
enum class CompilePriority : uint8_t {
    Low,      ///< one program or pipeline per frame, when nothing else waits
    Normal,   ///< two
    High,     ///< four
    Critical, ///< sixteen: the material is about to be drawn
};

struct CompileProgress {
    uint32_t done = 0, total = 0; ///< programs and pipelines that did not exist already
    bool isComplete() const { return done == total; }
    friend bool operator==(CompileProgress const&, CompileProgress const&) = default;
};

/// Work before the first draw: the programs of all requested variants, and their pipelines for every vertex
/// format and every kind of pass that may draw them.
struct CompileDesc {
    CompilePriority priority = CompilePriority::Normal;
    /// Every combination of these that the package has. Naming a variant that was filtered out is an error; All never
    /// is. If Skinning is named, it is prepared for all vertices (morph targets), otherwise only for vertices with
    /// joints.
    VariantSet variants = VariantSet::All;
    /// Vertex formats to expect; empty: those of everything added to a scene so far.
    std::vector<VertexBuffer> vertices{};
    PrimitiveType primitive = PrimitiveType::Triangles; ///< of `vertices`
    bool mirrored = false;                              ///< also prepare for transforms that mirror
    /// Called on the app thread inside Renderer::render() or Engine::progress() whenever there is progress.
    std::function<void(CompileProgress const&)> onProgress{};
};

/// Pre-filtered environment: irradiance and specular reflections of distant surroundings.
struct IndirectLightDesc {
    Texture specular{}; ///< cube; `mapping` gives the roughness of each level; RGBA8 is RGBM (shaders/lib/ibl.glsl)
    uint32_t specularLevels = 1;
    RoughnessMapping mapping = RoughnessMapping::Quadratic;
    Texture irradiance{};                 ///< cube of irradiance / pi, for DiffuseIrradiance::Cube; optional
    std::array<float4, 9> irradianceSh{}; ///< rgb; see shaders/lib/ibl.glsl, irradianceSh()
    /// How cubes and coefficients lie in the world before the scene rotates them: three unit vectors at right angles.
    /// May mirror. A skybox in the same scene lies as the light does.
    float3x3 worldFromCube{ 1.0f };
    std::string name{};
};

struct SkyboxDesc {
    Texture cube{};                 ///< RGBA8 is RGBM
    float3x3 worldFromCube{ 1.0f }; ///< as IndirectLightDesc
    std::string name{};
};

/// How a luminaire spreads its light, for PointLight::profile and SpotLight::profile.
struct LightProfileDesc {
    /// A file of ANSI/IES LM-63, of any edition and photometric type, at most 16 MiB. Not needed after the call.
    std::span<const std::byte> file{};
    std::string name{}; ///< in messages
};

/// The luminaire in the file of a profile.
struct LightProfileDescription {
    Candela peak{}; ///< the brightest direction, > 0
    Lumen flux{};   ///< of all directions together
};

/// Which lights an image is for, and how its pixels lie around them. docs/lights.md, "Light cookies".
enum class LightImageShape : uint8_t {
    Projected,  ///< SpotLight: as from a slide projector
    Tiled,      ///< SunLight: repeated over the plane across its direction
    Octahedron, ///< PointLight: square; an octahedral map of all directions, the light's in the middle
    Cube,       ///< PointLight: six square faces, +X -X +Y -Y +Z -Z, beside or below each other
    Emitted,    ///< RectLight: what each point of the rectangle emits
};
template <>
struct EnumNames<LightImageShape> {
    static constexpr std::array<std::string_view, 5> values{ "projected", "tiled", "octahedron", "cube", "emitted" };
};

/// A share of a light for each colour, by direction or place: SpotLight::cookie and others. Negative numbers and those
/// that are none count as 0; above 1 they brighten; the largest is 65408.
struct LightImageDesc {
    uint32_t width = 0, height = 0;      ///< pixels, [1, 16384]; more than kMaxLightImageSize a side are averaged
    Format format = Format::RGBA8Srgb;   ///< or RGBA8, RGBA16F, RGBA32F; alpha is ignored
    std::span<const std::byte> pixels{}; ///< tightly packed rows, row 0 at the top. Not needed after the call
    LightImageShape shape = LightImageShape::Projected;
    std::string name{}; ///< in messages
};
inline constexpr uint32_t kMaxLightImageSize = 512; ///< of a side, as it is stored

struct LightImageDescription {
    LightImageShape shape = LightImageShape::Projected;
    uint32_t width = 0, height = 0; ///< as it is stored; a cube as an octahedron
    float3 mean{ 0.0f };            ///< of all pixels, linear
};

/// The target of a view. Materials may sample its textures in every render() except those that draw to it.
/// docs/views.md, "Render targets".
struct RenderTargetDesc {
    /// Renderable RGBA8, RGBA8Srgb, RGB10A2, RGBA16F (then scene-linear, without tone mapping), or RGBA32F (then for
    /// views with View::aov, or own passes). Of RGBA8Srgb the texels are those of RGBA8, and samplers decode them.
    /// OpenGL ES needs EXT_sRGB_write_control for it: without, the texture is not created, and takeErrors() reports it.
    Texture color{};
    /// Renderable 2D R32F of the size of what is drawn: linear depth in metres; 1e30 for background. Transparent
    /// surfaces are ignored. Null: no depth output.
    Texture depth{};
    bool generateMips = false; ///< after every view: levels 1.. of `color`, means of light for RGBA8Srgb, 2D
    uint32_t level = 0;        ///< of `color`, to which is drawn: the size of the target is that of the level
    /// Of `color`, to which is drawn: a layer of an array, a face of a cube (+X -X +Y -Y +Z -Z), or of an array of
    /// cubes, or a slice of a level of a 3D texture. What the others hold is kept.
    uint32_t layer = 0;
    /// At most three renderable 2D textures of the size of the target, and of any format that passes can write: the
    /// attachments 1, 2, 3 of passes without a view and of mesh passes (MeshPass.h). Views do not draw to them.
    std::vector<Texture> others{};
    std::string name{};
};

/// A ring of images that frames are drawn to and read back from. With a window, Renderer::present() shows the image
/// drawn last in it, bit by bit.
struct SwapChainDesc {
    uint2 size{ 1280, 720 };       ///< pixels, >= 1
    uint32_t imageCount = 2;       ///< [1, 4]
    Format format = Format::RGBA8; ///< RGBA8, RGB10A2 (display) or RGBA16F (scene-linear, without tone mapping); no
                                   ///< RGBA8Srgb: its codes are those of RGBA8
    /// Of EngineOptions::display; none: headless. Its images are RGBA8, or RGB10A2 for displays of 10 bits. Destroy the
    /// swap chain before the window.
    NativeWindow window{};
    PresentMode presentMode = PresentMode::Fifo; ///< Fifo where the window has no such mode
    /// How the window reads its codes: one of Engine::outputSpaces(), and View::display.outputSpace of what is drawn to
    /// it. Rec2020Pq needs RGB10A2; LinearRec709, which is scRGB there, RGBA16F. docs/windows.md, "Colour spaces".
    OutputSpace outputSpace = OutputSpace::Srgb;
    float peakNits = 203; ///< cd/m^2 of the brightest pixel with Rec2020Pq, (0, 10 000]: DisplayTransform::whiteNits
    std::string name{};
};

} // namespace filament_core
