// SPDX-License-Identifier: Apache-2.0
/// Uniform blocks, bind groups and vertex locations shared by C++ and GLSL. C++ reads this file; the material compiler
/// puts shaders/interface/interface.glsl, its GLSL twin, before every shader; a test compares the two by reflection
/// (names, offsets, sizes).
///   std140 with float4 and float4x4 members only, so that both languages agree on the layout without padding rules.
///   Space   positions are relative to the camera: world axes, camera at the origin, metres.
///   Light   photometric values are pre-exposed on the CPU: multiplied by 1 / (1.2 * 2^EV100).
#pragma once

#include "base/math/Math.h"

#include <array>
#include <cstdint>

namespace filament_core::shader {

// clang-format off
// ---- vertex attribute locations (all shaders)
enum AttributeLocation : uint8_t {
    kAttributePosition = 0, ///< float3
    kAttributeTangents = 1, ///< float4 quaternion of the tangent frame; w < 0: the bitangent is flipped
    kAttributeColor = 2,    ///< float4, linear
    kAttributeUv0 = 3,      ///< float2
    kAttributeUv1 = 4,      ///< float2
    kAttributeJoints = 5,   ///< uint4
    kAttributeWeights = 6,  ///< float4
    kAttributeCustom0 = 7,  ///< float4, 7..14
    kAttributeJoints1 = 13,  ///< uint4, joints 5 to 8 of a vertex: the place of custom6
    kAttributeWeights1 = 14, ///< float4, their weights: the place of custom7
    kAttributeInstance = 15, ///< uint, per instance: index into ObjectUniforms::objects of the bound window
};

// ---- bind groups
// In the order of how seldom they change. What every program of the engine has: View; by what a material reads: Pass.
inline constexpr uint32_t kGroupView = 0;     ///< buffers alone: what all draws of a view share, and windows of objects
inline constexpr uint32_t kGroupPass = 1;     ///< the target, and the engine's textures: environment, what other passes
                                              ///< drew
inline constexpr uint32_t kGroupMaterial = 2; ///< MaterialParams block (binding 0) and the material's textures (1..)
inline constexpr uint32_t kGroupDeformation = 3; ///< of variants with kVariantSkinning only; read by the vertex stage
                                                 ///< only

enum ViewBinding : uint8_t {
    kBindingFrame = 0,       ///< FrameUniforms, dynamic
    kBindingObjects = 1,     ///< ObjectUniforms, dynamic: windows of kObjectsPerWindow objects
    kBindingLights = 2,      ///< LightBuffer, storage: PunctualLight; the lights of a view begin at froxelPlaces.y
    kBindingFroxels = 3,     ///< FroxelBuffer, storage: words; those of a view begin at froxelPlaces.z
};

enum PassBinding : uint8_t {
    kBindingPass = 0,        ///< PassUniforms
    kBindingShadowMaps = 1,  ///< sampler2D: the atlas of shadow maps: depths, or moments of vsm and evsm
    kBindingShadows = 2,     ///< ShadowUniforms
    kBindingSpecular = 3,    ///< samplerCube: pre-filtered environment, mip = roughness; with probes in view
                             ///< samplerCubeArray: first the environment, then the cubes of probes
    kBindingDfg = 4,         ///< sampler2D: split-sum terms
    kBindingIrradiance = 5,  ///< samplerCube: irradiance / pi
    kBindingOcclusion = 6,   ///< sampler2D: where surfaces are peeled (TransparencyTerm), the depth of a layer;
                             ///< otherwise ambient occlusion of opaque surfaces, for lit materials; r: visibility; with
                             ///< bent normals gba: encodeLean() of the open direction
    kBindingSceneDepth = 7,  ///< sampler2D: linear depth of opaque surfaces, in metres
    kBindingFog = 8,         ///< samplerCube: the environment, as fog sees it
    kBindingPicture = 9,     ///< sampler2D: scene colour of opaque surfaces, pre-exposed, with blurred levels
    kBindingFogCells = 10,   ///< FogCells, storage: of materials with fog; see FrameUniforms::fogGrid
    kBindingProbes = 11,     ///< ProbeUniforms: of what light reaches, and of debug views
};

/// Of kGroupMaterial, for the dispatch that writes FogCells (shaders/compute/fog_light.comp).
inline constexpr uint8_t kBindingWrittenFogCells = 0;
inline constexpr uint8_t kBindingFogHistory = 1;        ///< FogHistoryUniforms
inline constexpr uint8_t kBindingLastFogLight = 2;      ///< storage: as the last frame has left the next one
inline constexpr uint8_t kBindingWrittenFogLight = 3;   ///< storage: kFogCellBytes a cell, the light of a full one

/// FogCells: the columns of the grid row by row; of each, slices + 1 borders, the nearest first: four half floats,
/// rgb: pre-exposed light that fog scatters towards the camera before it, w: its opacity up to there.
inline constexpr uint32_t kFogCellBytes = 8;


// ---- FrameUniforms
struct FrameUniforms {
    float4x4 clipFromWorld;      ///< world relative to the camera
    float4x4 worldFromClip;
    float4x4 viewFromWorld;
    float4x4 clipFromView;
    float4 cameraPosition;       ///< xyz: absolute world position, for procedural materials; w: 1 if objects are
                                 ///< absolute, not relative to it
    float4 exposure;             ///< x: 1 / (1.2 * 2^EV100); y: EV100; z: radius of the dome over
                                 ///< skyGround; w: depth of infinity
    float4 time;                 ///< x: seconds; y: what a double has beyond x; z: its fraction, [0, 1); w: unused
    float4 sunDirection;         ///< xyz: towards the sun, unit; w: 1 if there is a sun
    float4 sunIlluminance;       ///< rgb: pre-exposed linear colour x lux
    float4 ambient;              ///< x: pre-exposed IBL lux; y: level of roughness 1; z: SH bands; w: light count
    float4 skyFactor;            ///< rgb: pre-exposed factor of the sky texture; w: first word of the profiles of the
                                 ///< view, if it has some
    std::array<float4, 9> irradianceSh; ///< rgb: pre-convolved, pre-scaled by 1/pi: polynomial coefficients
    float4x4 worldFromEnvironment;       ///< rotation of the environment
    std::array<float4, 4> materialGlobals; ///< View::materialGlobals
    float4 froxelGrid;           ///< x: columns, y: rows, z: slices; 0: every point reads all lights; w: first slice,
                                 ///< as depth bits >> shift
    float4 froxelPlaces;         ///< x: shift; y: first light; z: first word of the view; w: first word of kLtcTable,
                                 ///< if the view has areas
    float4 fogMedium;            ///< x: logarithm of the density at the camera's height; y: fall-off a metre; z: metres
                                 ///< where it begins, w: where it ends
    float4 fogLight;             ///< rgb: pre-exposed radiance of what is all fog; w: largest share of a pixel that is
                                 ///< fog
    float4 fogSun;               ///< the sun's light in the fog, whatever else the sun shines on: rgb: pre-exposed,
                                 ///< towards the sun; w: exponent of the cosine. Of volumetric fog: rgb: times
                                 ///< fogScattering; w: the share of it that reaches the camera, behind the cells
    float4 fogSunDirection;      ///< xyz: towards the sun, unit; w: metres where its light begins
    float4 fogGrid;              ///< of volumetric fog; xy: columns and rows over the image, z: slices, w: metres in
                                 ///< front of the camera where the last one ends; slice i begins at (i / slices)^2 of
                                 ///< these
    float4 fogScattering;        ///< rgb: albedo / (4 pi), w: asymmetry of henyeyGreenstein()
    float4 fogNoise;             ///< of volumetric fog; xyz: the camera in the lattice of noise, w: cells of it a metre
    float4 fogVariation;         ///< x: amplitude of the noise, y: octaves; zw: unused
    float4 contactShadows;       ///< x: metres towards the light; y: thickness in metres; z: steps; w: 1 if the sun has
                                 ///< them
    float4 skyGround;            ///< of a background that lies on the ground; xyz: the camera, from below the
                                 ///< panorama's; w: height of that one. exposure.z: radius of the dome
    float4 jitter;               ///< xy: by which clipFromWorld moves the image, times w of clip coordinates; z:
                                 ///< metres from which on transparencyWeight() falls; w: pixels of the guard band
    // What follows exists in materials with `sectionPlanes` alone:
    std::array<float4, 6> sectionPlanes; ///< of View::section; xyz: unit, w: signed distance of the camera, metres
    float4 section;           ///< x: count of planes; y: 1: SectionCut::Corner; z: 1: with caps; w: unused
    float4 sectionCap;        ///< rgb: base colour of caps; a: its share
    float4 sectionHatch;      ///< x: hatching lines a metre, 0: none; y, z: the camera between two sheets of the first
                              ///< and of the second direction; w: share of a line
    float4 sectionHatchColor; ///< rgb; w: unused
};

// ---- PassUniforms
struct PassUniforms {
    float4 target; ///< of the level that the pass draws to; xy: pixels, zw: 1 / pixels
    float4 raster; ///< x: samples a pixel; y: colour channel that a shadow map is drawn for, 1 to 3, 0: of all, or a
                   ///< SectionPart, < 0; z: last level of the scene colour behind, or the DebugView whose value
                   ///< surfaces leave; w: mip levels added to those of materials' textures
    float4 picture; ///< valid pixels of the scene colour behind: xy to zw
    float4 reflection; ///< of mirrored rays; x: cells that they visit at most; y: metres; z: thickness of what they
                       ///< hit, metres; w: last level of the hierarchical depth buffer
    float4x4 lastClipFromWorld; ///< of the previous frame, from this frame's world; this frame's, if there was none
    float4 lastAlongView; ///< linear depth in the previous frame: its product with a point of this frame's
                          ///< world, w = 1
    float4 lastTime; ///< FrameUniforms::time of the previous frame
};

inline constexpr uint32_t kMaxShadowMaps = 128; ///< of a view

/// What one light sees in one direction: a square of the atlas.
struct ShadowMapRecord {
    float4x4 atlasFromWorld; ///< from positions relative to the camera; xy: texels, z: depth, all times w
    float4 tile;             ///< texels; xy: first, zw: end; of the first channel
    float4 texel;            ///< width of a texel is x + y w metres; bias of a depth is z + w times the depth
    float4 softness;         ///< x: radius of the penumbra for each unit of depth in between, in texels; y: colour
                             ///< channels, 1 or 3: those of green and blue lie to the right of `tile` and below it.
                             ///< Moments: z: see momentDepth(), w: radius of the blur in texels
};

struct ShadowUniforms {
    float4 atlas; ///< x: 1 / texels of a side, y: texels; zw: unused
    float4 sun;   ///< x: first map, y: cascades; zw: unused
    std::array<ShadowMapRecord, kMaxShadowMaps> maps;
};

inline constexpr uint32_t kObjectsPerWindow = 256;

/// One instance: the rows of the affine transform from object to camera-relative world space.
struct ObjectData {
    float4 row0, row1, row2;
    float4 flags; ///< x: +1, or -1 if the transform mirrors (flips the bitangent and the front face); y: instance
                  ///< index; z: how far it has faded, of level_fade.mat; w: where its pose begins (DeformationUniforms)
};

struct ObjectUniforms {
    std::array<ObjectData, kObjectsPerWindow> objects; // 16 KiB: the least that every device offers
};

/// Diffuse light over the box of one object (irradiance grids). The first records of ObjectUniforms of a draw that has
/// one: the object alone, then this. u: where in the box a point is, in [-1, 1] along the axes of the world.
struct IrradianceField {
    ObjectData object;
    float4 center;      ///< xyz: of the box, relative to the camera; w: the object's number in debug views of numbers
    float4 inverseHalf; ///< xyz: 1 / half its sides, 1 / metres; w: unused
    /// Of the first four coefficients of irradiance / pi, as FrameUniforms::irradianceSh, red, green and blue each:
    /// xyz: change with u; w: in the middle. Before FrameUniforms::ambient.x.
    std::array<float4, 12> linear;
    std::array<float4, 5> constant; ///< rgb: the other five; w: unused
    std::array<float4, 9> unused;   ///< so that each begins where a uniform offset may
};

inline constexpr uint32_t kMaxPunctualLights = 4096; ///< of a view
inline constexpr uint32_t kMaxLightsOfFroxel = 256;

/// The word of a froxel: bits 0 to 8 count the lights of its list; the others say where it begins, in words from the
/// first word of the view. An entry of a list is the light's place among those of the view; entries ascend.
inline constexpr uint32_t kFroxelCountBits = 9;

/// Of PunctualLight::offset.z: the light has contact shadows.
inline constexpr uint32_t kContactShadowBit = 128;

/// What colorIntensity.w says of a light of the list. Of areas, positionRange is the centre, colorIntensity rgb the
/// pre-exposed luminance, and the half edges X = directionScale.xyz and Y = (directionScale.w, offset.x, offset.w):
/// radii of a disc; of a tube X is half its axis and Y.x its radius. cross(X, Y) is against the direction in which it
/// shines. offset.yz are the maps, as of other lights.
enum LightShape : uint8_t {
    kShapeSpot = 1,
    kShapeRect = 2,
    kShapeDisc = 3,
    kShapeTube = 4,
    kShapeTwoSided = 4, ///< added to rectangles and discs
    kShapeImaged = 8,   ///< times its ImagedLight + 1, added to a rectangle with an image
};

/// A point, a spot, an area, or a sun besides the one of FrameUniforms; pre-exposed.
struct PunctualLight {
    float4 positionRange;   ///< xyz: relative to the camera, or towards a sun, unit; w: 1 / range^2 (0: unlimited)
    float4 colorIntensity;  ///< rgb: pre-exposed linear colour x candela; x lux for suns; w: 1 for spots, 0 for points,
                            ///< -1 for suns; LightShape of areas
    float4 directionScale;  ///< xyz: direction in which a spot shines, unit; w: spot scale 1 / (cosInner - cosOuter)
    float4 offset;          ///< x: spot offset -cosOuter * scale; y: first shadow map + 1, 0: none; z: a set: bit n:
                            ///< face n, or cascade n of a sun, has a map; bit 6: these are a cube's; bit 7: it has
                            ///< contact shadows; w: its ProfiledLight + 1, 0: none; and kImagedLightStep times its
                            ///< ImagedLight + 1
};

/// Words of the light profiles of a view, behind the froxels: first what belongs to one light, its x axis, as float
/// bits, and where its table begins, counted from the first of these words. The frame of the profile:
/// directionScale.xyz is -z.
inline constexpr uint32_t kProfiledLightWords = 4;
/// Then the tables: rows, columns, rows a radian as float bits; then LightProfileTable::words.
inline constexpr uint32_t kProfileHeaderWords = 3;
inline constexpr uint32_t kMaxProfileWords = 1u << 22; ///< of the tables of a view: 16 MiB

/// What belongs to the image of one light: the first records of the light buffer. Its members are rows, whose products
/// with (x, y, z, 1) are x, y and z of a place in the image; the vector leads from the lamp to a point, of suns it is
/// the point. offset.x: where the table begins, in words from the first of FroxelBuffer; y: ImageMapping; z: texels a
/// metre where z is 1. Of rectangles offset.x alone counts.
using ImagedLight = PunctualLight;
inline constexpr uint32_t kImagedLightStep = 8192;
inline constexpr uint32_t kMaxImagedLights = 1024; ///< of a view
static_assert(kMaxPunctualLights < kImagedLightStep && (kMaxImagedLights + 1) * kImagedLightStep < 1u << 24,
              "a float holds both");
/// The tables of the images of the main view: columns and rows, the last mip level, a number of the image; where each
/// level begins, as words from the table's first; then the levels, RGB9E5, each with a border of one texel.
inline constexpr uint32_t kImageHeaderWords = 4;
inline constexpr uint32_t kMaxImageWords = 1u << 22; ///< of a view: 16 MiB
inline constexpr uint32_t kFirstImageWord = 4;       ///< 0 is no place

enum ImageMapping : uint32_t {
    kImageProjected = 0,  ///< (x, y) / z, in [0, 1] over the image; dark elsewhere
    kImageOctahedral = 1, ///< of the direction (x, y, z)
    kImageTiled = 2,      ///< the fractions of x and y
};

// ---- ProbeUniforms
/// A reflection probe of a view. Positions are relative to the camera.
struct ReflectionProbe {
    std::array<float4, 3> axes; ///< xyz: sides of the box, unit; w: half the length of each, metres
    float4 center;              ///< xyz: of the box; w: 1 / the blend distance in metres
    float4 capture;             ///< xyz: where the cube was captured; w: what its texels are multiplied by, before
                                ///< FrameUniforms::ambient.x
    /// rgb: as FrameUniforms::irradianceSh, along the axes of the world; w: of the first, the layer of passProbes; of
    /// the second, 1 if the coefficients count, otherwise the diffuse light inside is that of the others
    std::array<float4, 9> irradianceSh;
};
inline constexpr uint32_t kMaxProbesOfView = 8;

/// The smallest box first. Boxes that are not used hold nothing: the half of their sides is negative.
struct ProbeUniforms {
    std::array<ReflectionProbe, kMaxProbesOfView> probes;
};

// ---- deformation: skins and morph targets (shaders/interface/deformation.glsl)
enum DeformationBinding : uint8_t {
    kBindingBones = 0,           ///< sampler2D, RGBA32F: see kBonesPerRow
    kBindingDeformation = 1,     ///< DeformationUniforms, dynamic
    kBindingMorphDeltas = 2,     ///< sampler2D, RGBA32F: see kMorphTextureWidth
};

/// The rows of the affine transform from where a vertex was bound to object space.
struct BoneData {
    float4 row0, row1, row2;
};

/// The poses of all visible objects of a frame, and of the one before where they moved: bone b is texels
/// [3 * (b % kBonesPerRow), + 3) of row b / kBonesPerRow. Such a row fits into the smallest texture that OpenGL ES
/// guarantees, 2048 texels. The pose of an object without morph targets is the bones of its skin. With morph targets it
/// is a record that begins where a bone could. Its first texel: x: how many weights are not 0, y: the first bone of the
/// skin. A texel for each of these follows, over the ends of rows: x: weight, y: target.
inline constexpr uint32_t kBonesPerRow = 512;

/// Texel ((target * vertices + vertex) * texels) of the deltas, row after row of kMorphTextureWidth: the position's
/// difference, then the normal's, then the tangent's, as many as there are.
inline constexpr uint32_t kMorphTextureWidth = 4096;

/// What objects have in common that share a draw.
struct DeformationUniforms {
    float4 shape; ///< x: unused; y: texels a vertex and morph target, 1 to 3, 0: no targets; z: vertices; w: joint
                  ///< sets, 0 to 2
    glm::uvec4 bones; ///< x: skins that begin at a later bone are not there; y: bones of a skin - 1; z: bones for which
                      ///< there is room: records that begin behind them are not there; w: unused
};

// ---- specialisation constants that the material compiler declares in every lit material, besides the author's own
/// An int named quality_<name>, 0 by default, that counts the enumerators of <filament_core/Quality.h>.
struct QualityConstant {
    const char* name;
    uint32_t id;
};

enum QualityConstantId : uint32_t { ///< behind the author's, which count from 0
    kQualitySpecularVisibility = 1000,
    kQualityFresnel = 1001,
    kQualityDiffuse = 1002,
    kQualityWithoutEnergyCompensation = 1003, ///< 1: one bounce only
    kQualitySplitSum = 1004,
    kQualityDiffuseIrradiance = 1005, ///< DiffuseIrradiance, or kIrradianceOfField
    kQualityEnvironmentEncoding = 1006, ///< 1: RGBM (of the environment, not of the view)
    kQualityRoughnessMapping = 1007,    ///< (of the environment)
    kQualityWithoutDiffuseCoupling = 1008, ///< 1: lights give the diffuse lobe what is reflected, too
    kQualitySpecularLookUps = 1009,
    kQualityAnisotropicLookUps = 1010,
    kQualityAreaLights = 1012, ///< 0: no light of the view is an area; else 1 + Quality::areaLights
    kQualityLightProfiles = 1013, ///< 1: some light of the view has a profile
    kQualityColoredShadows = 1014, ///< 1: some shadow map of the view has three channels
    kQualityScreenOcclusion = 1015, ///< 0: none; 1: visibility; 2: with bent normals
    kQualityScreenRefraction = 1016, ///< 1: refraction reads the scene colour; 2: the level of the scene colour,
                                     ///< as a negative number in red
    kQualityScreenReflections = 1017, ///< 1: screen-space reflections are on; 2: -1 - the metres to the hit,
                                      ///< in red
    kQualityContactShadows = 1018, ///< 1: some light of the view has them
    kQualityFog = 1019,  ///< FogTerms; unlit materials have this one, too
    kQualityTransparency = 1020, ///< TransparencyTerm; unlit materials have this one, too
    kQualityMipBias = 1021, ///< 1: materials' textures are read at biased mip levels; all surfaces
                            ///< have this one
    kQualityReflectionProbes = 1022, ///< 0: no reflection probe lights what is visible; else ProbeTerms
    kQualityLightImages = 1023, ///< LightImageTerms
    kQualityShadowFilter = 1011, ///< ShadowFilter, or kShadowsOfShapes more; read by variants with
                                 ///< kVariantShadowReceiver only
};

/// Of kQualityShadowFilter, added to filters that compare depths: areas have the shadows of their shape.
inline constexpr uint32_t kShadowsOfShapes = 9;

/// Of kQualityDiffuseIrradiance, for objects with an IrradianceField.
inline constexpr uint32_t kIrradianceOfField = 3;

/// What shaders compute of fog; a set.
enum FogTerms : uint8_t {
    kFogOn = 1,
    kFogFromEnvironment = 2, ///< its colour is that of the environment behind
    kFogFromRgbm = 4,        ///< which is encoded
    kFogSun = 8,             ///< scatters the light of the sun: in a lobe, FrameUniforms::fogSun.w, or
    kFogScattering = 16,     ///< by its phase function: FrameUniforms::fogScattering
    kFogCells = 32,          ///< light of lamps and of the shadowed sun is in FogCells
    kFogVaries = kFogCells | kFogSun, ///< the opacity is there, too; volumetric fog has no lobe
};

/// What the dispatch that writes FogCells computes (shaders/compute/fog_light.comp): kQualityFog of it; a set.
enum FogLightTerms : uint8_t {
    kFogLightVaries = 1,       ///< the density, by FrameUniforms::fogNoise
    kFogLightIsWeakened = 2,   ///< on its way
    kFogLightOfFrames = 4,     ///< kept from frame to frame
};

/// What shaders compute of reflection probes: how many they look at, and whether the environment lights what no probe
/// does. The number is known when programs are compiled, because drivers read uniforms fast where their place is a
/// constant.
enum ProbeTerms : uint8_t {
    kNoProbe = 0,
    kOneProbeAlone = 1,
    kOneProbe = 2,
    kTwoProbesAlone = 3,
    kTwoProbes = 4,
    kThreeProbes = 5,
    kFourProbes = 6,
    kAllProbes = 7, ///< kMaxProbesOfView
};

/// What materials that blend in any order write (shaders/material/surface/transparency.glsl).
enum TransparencyTerm : uint8_t {
    kTransparencyInOrder = 0,       ///< their colour, to be blended in order
    kTransparencyWeightedLight = 1, ///< their colour and alpha by weight, to be added up
    kTransparencyCover = 2,         ///< their alpha alone, for how much they cover together
    kTransparencyDepth = 3,         ///< nothing: their depth counts
    kTransparencyNextDepth = 4,     ///< the nearest depth behind a layer
    kTransparencyLayer = 5,         ///< their colour, where they are that layer
    kTransparencyBeyond = 6,        ///< their colour, where they are farther than it
};

/// Which lights of a view have images; a set.
enum LightImageTerms : uint8_t {
    kLightCookies = 1, ///< points, spots or suns
    kAreaImages = 2,   ///< rectangles
};

inline constexpr std::array kQualityConstants{
    QualityConstant{ "specularVisibility", kQualitySpecularVisibility },
    QualityConstant{ "fresnel", kQualityFresnel },
    QualityConstant{ "diffuse", kQualityDiffuse },
    QualityConstant{ "withoutEnergyCompensation", kQualityWithoutEnergyCompensation },
    QualityConstant{ "splitSum", kQualitySplitSum },
    QualityConstant{ "diffuseIrradiance", kQualityDiffuseIrradiance },
    QualityConstant{ "environmentEncoding", kQualityEnvironmentEncoding },
    QualityConstant{ "roughnessMapping", kQualityRoughnessMapping },
    QualityConstant{ "withoutDiffuseCoupling", kQualityWithoutDiffuseCoupling },
    QualityConstant{ "specularLookUps", kQualitySpecularLookUps },
    QualityConstant{ "anisotropicLookUps", kQualityAnisotropicLookUps },
    QualityConstant{ "screenOcclusion", kQualityScreenOcclusion },
    QualityConstant{ "screenRefraction", kQualityScreenRefraction },
    QualityConstant{ "screenReflections", kQualityScreenReflections },
    QualityConstant{ "contactShadows", kQualityContactShadows },
    QualityConstant{ "fog", kQualityFog },
    QualityConstant{ "areaLights", kQualityAreaLights },
    QualityConstant{ "lightProfiles", kQualityLightProfiles },
    QualityConstant{ "lightImages", kQualityLightImages },
    QualityConstant{ "coloredShadows", kQualityColoredShadows },
    QualityConstant{ "shadowFilter", kQualityShadowFilter },
    QualityConstant{ "transparency", kQualityTransparency },
    QualityConstant{ "mipBias", kQualityMipBias },
    QualityConstant{ "reflectionProbes", kQualityReflectionProbes },
};

// clang-format on
static_assert(sizeof(BoneData) == 48 && sizeof(DeformationUniforms) == 32);
static_assert(sizeof(ProbeUniforms) == 1792);
static_assert(sizeof(IrradianceField) == 512 && sizeof(ObjectUniforms) % sizeof(IrradianceField) == 0);
static_assert(sizeof(ObjectUniforms) == 16384 && sizeof(PunctualLight) == 64);
static_assert(kMaxLightsOfFroxel < 1u << kFroxelCountBits);
static_assert(sizeof(FrameUniforms) % 16 == 0);
static_assert(sizeof(ShadowUniforms) <= 16384);

} // namespace filament_core::shader
