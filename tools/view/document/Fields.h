// SPDX-License-Identifier: Apache-2.0
/// Fields: the members of what a Document consists of, with their names and ranges, for everything that visits all of
/// them: comparing, writing, reading, checking, and tests that change each one.
///   Complete  a member that is added to a struct and not listed here does not compile: isComplete().
///   Texts     Quality, Effects and DisplayTransform have names and texts of their own (optionsOf<Quality>() and so
///             on).
#pragma once

#include "tools/view/document/Document.h"

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace filament_core::view {

/// Beyond what a float holds, so no limit at all.
inline constexpr double kAnyNumber = 1e300, kFinite = 3e38;

/// A number, or every number of a vector, is in [low, high].
template <class T, class M>
struct Field {
    const char* name;
    M T::*member;
    double low, high;
};

template <class T, class M>
constexpr Field<T, M> field(const char* name, M T::*member, double low = -kAnyNumber, double high = kAnyNumber) {
    return { name, member, low, high };
}

/// `list`: a tuple of Field; `others`: how many members are no part of a Document.
template <class T>
struct Fields;

template <class T>
concept HasFields = requires {
    Fields<T>::list;
};

/// With the range of the option of that name, if T has options.
template <class T, class M>
Field<T, M> ranged(Field<T, M> field) {
    if constexpr (HasOptions<T>) {
        Option const* option = findOption(optionsOf<T>(), field.name);
        if (!option || (option->kind != OptionKind::Number && option->kind != OptionKind::Integer)) return field;
        const bool isFloat = option->storage == Option::Storage::Float; // limits as floats hold them: pi / 2 rounds up
        field.low = isFloat ? static_cast<double>(static_cast<float>(option->least)) : option->least;
        field.high = isFloat ? static_cast<double>(static_cast<float>(option->most)) : option->most;
    }
    return field;
}

/// Calls visit(field) for each.
template <HasFields T, class Visit>
void forEachField(Visit const& visit) {
    std::apply([&](auto const&... fields) { (visit(ranged(fields)), ...); }, Fields<T>::list);
}

struct AnyMember {
    template <class T>
    operator T() const;
};

/// How many members an aggregate has: as many as it can be initialised with.
template <class T, class... Given>
constexpr size_t memberCount() {
    if constexpr (requires { T{ Given{}..., AnyMember{} }; })
        return memberCount<T, Given..., AnyMember>();
    else
        return sizeof...(Given);
}

template <HasFields T>
constexpr bool isComplete() {
    return std::tuple_size_v<std::remove_cvref_t<decltype(Fields<T>::list)>> + Fields<T>::others == memberCount<T>();
}

// clang-format off
template <> struct Fields<Exposure> {
    static constexpr auto list = std::tuple{ field("aperture", &Exposure::aperture, 1e-6, 1e6),
                                             field("shutterSeconds", &Exposure::shutterSeconds, 1e-6, 1e6),
                                             field("iso", &Exposure::iso, 1e-6, 1e9) };
    static constexpr size_t others = 0;
};
template <> struct Fields<Lens> {
    static constexpr auto list = std::tuple{ field("verticalFovDegrees", &Lens::verticalFovDegrees, 1e-4, 179.9),
                                             field("nearMeters", &Lens::nearMeters, 0, kFinite),
                                             field("orthographicHeight", &Lens::orthographicHeight, 0, kFinite),
                                             field("farMeters", &Lens::farMeters, 0, kFinite),
                                             field("shift", &Lens::shift, -1e6, 1e6),
                                             field("aspect", &Lens::aspect, 0, 1e6) };
    static constexpr size_t others = 0;
};
template <> struct Fields<Camera> {
    static constexpr auto list = std::tuple{ field("worldFromView", &Camera::worldFromView),
                                             field("lens", &Camera::lens), field("exposure", &Camera::exposure) };
    static constexpr size_t others = 0;
};
template <> struct Fields<LevelsOfDetail> {
    static constexpr auto list = std::tuple{ field("pixels", &LevelsOfDetail::pixels, 0, LevelsOfDetail::kMostPixels) };
    static constexpr size_t others = 0;
};
template <> struct Fields<View> {
    static constexpr auto list = std::tuple{ field("camera", &View::camera), field("size", &View::size, 1, 16384),
                                             field("display", &View::display),
        field("quality", &View::quality),
                                             field("effects", &View::effects),
                                             field("clearColor", &View::clearColor, -kFinite, kFinite),
                                             field("samples", &View::samples, 1, 4),
                                             field("occlusionCulling", &View::occlusionCulling),
        field("lod", &View::lod), field("debugView", &View::debugView),
                                             field("timeSeconds", &View::timeSeconds),
                                             field("materialGlobals", &View::materialGlobals, -kFinite, kFinite),
                                             field("visibleLayers", &View::visibleLayers) };
    static constexpr size_t others = 5; // viewport, debugDraw, postProcess, aov, section
};
template <> struct Fields<GltfLoadOptions> {
    static constexpr auto list = std::tuple{ field("positions", &GltfLoadOptions::positions),
                                             field("tangents", &GltfLoadOptions::tangents),
                                             field("deformable", &GltfLoadOptions::deformable),
                                             field("allLevels", &GltfLoadOptions::allLevels),
                                             field("simplified", &GltfLoadOptions::simplified),
                                             field("normalMapRoughness", &GltfLoadOptions::normalMapRoughness),
                                             field("compressedTextures", &GltfLoadOptions::compressedTextures),
                                             field("sectionPlanes", &GltfLoadOptions::sectionPlanes),
                                             field("textureBudgetMegabytes", &GltfLoadOptions::textureBudgetMegabytes),
                                             field("filesFromAnywhere", &GltfLoadOptions::filesFromAnywhere) };
    static constexpr size_t others = 1; // progress
};
template <> struct Fields<EnvironmentLoadOptions> {
    static constexpr auto list = std::tuple{ field("faceSize", &EnvironmentLoadOptions::faceSize),
                                             field("format", &EnvironmentLoadOptions::format),
                                             field("roughnessMapping", &EnvironmentLoadOptions::roughnessMapping),
                                             field("samples", &EnvironmentLoadOptions::samples),
                                             field("sun", &EnvironmentLoadOptions::sun),
                                             field("lights", &EnvironmentLoadOptions::lights) };
    static constexpr size_t others = 1; // progress
};
template <> struct Fields<EnvironmentSettings> {
    static constexpr auto list = std::tuple{ field("illuminance", &EnvironmentSettings::illuminance),
                                             field("rotationRadians", &EnvironmentSettings::rotationRadians),
                                             field("skybox", &EnvironmentSettings::skybox),
                                             field("groundHeightMeters", &EnvironmentSettings::groundHeightMeters),
                                             field("groundLevelMeters", &EnvironmentSettings::groundLevelMeters),
                                             field("groundRadiusMeters", &EnvironmentSettings::groundRadiusMeters) };
    static constexpr size_t others = 0;
};
template <> struct Fields<SunLight> {
    static constexpr auto list = std::tuple{
        field("directionWorld", &SunLight::directionWorld),
        field("illuminance", &SunLight::illuminance),
        field("color", &SunLight::color), field("angularRadiusDegrees", &SunLight::angularRadiusDegrees),
        field("showsDisc", &SunLight::showsDisc), field("haloSize", &SunLight::haloSize),
        field("haloFalloff", &SunLight::haloFalloff), field("castsShadows", &SunLight::castsShadows),
        field("contactShadows", &SunLight::contactShadows), field("lightChannels", &SunLight::lightChannels) };
    static constexpr size_t others = 4; // cookie and its place
};
template <> struct Fields<PointLight> {
    static constexpr auto list = std::tuple{
        field("positionWorld", &PointLight::positionWorld), field("intensity", &PointLight::intensity),
        field("color", &PointLight::color), field("rangeMeters", &PointLight::rangeMeters),
        field("sourceRadiusMeters", &PointLight::sourceRadiusMeters),
        field("castsShadows", &PointLight::castsShadows), field("contactShadows", &PointLight::contactShadows),
        field("lightChannels", &PointLight::lightChannels),
        field("directionWorld", &PointLight::directionWorld),
        field("upWorld", &PointLight::upWorld) };
    static constexpr size_t others = 2; // profile, cookie
};
template <> struct Fields<SpotLight> {
    static constexpr auto list = std::tuple{
        field("positionWorld", &SpotLight::positionWorld),
        field("directionWorld", &SpotLight::directionWorld),
        field("intensity", &SpotLight::intensity), field("color", &SpotLight::color),
        field("rangeMeters", &SpotLight::rangeMeters),
        field("innerConeRadians", &SpotLight::innerConeRadians),
        field("outerConeRadians", &SpotLight::outerConeRadians),
        field("sourceRadiusMeters", &SpotLight::sourceRadiusMeters),
        field("castsShadows", &SpotLight::castsShadows), field("contactShadows", &SpotLight::contactShadows),
        field("lightChannels", &SpotLight::lightChannels), field("upWorld", &SpotLight::upWorld) };
    static constexpr size_t others = 2; // profile, cookie
};
template <> struct Fields<RectLight> {
    static constexpr auto list = std::tuple{
        field("positionWorld", &RectLight::positionWorld),
        field("directionWorld", &RectLight::directionWorld),
        field("upWorld", &RectLight::upWorld), field("widthMeters", &RectLight::widthMeters),
        field("heightMeters", &RectLight::heightMeters), field("luminance", &RectLight::luminance),
        field("color", &RectLight::color), field("rangeMeters", &RectLight::rangeMeters),
        field("isTwoSided", &RectLight::isTwoSided), field("castsShadows", &RectLight::castsShadows),
        field("isVisible", &RectLight::isVisible),
        field("lightChannels", &RectLight::lightChannels) };
    static constexpr size_t others = 1; // image
};
template <> struct Fields<DiscLight> {
    static constexpr auto list = std::tuple{
        field("positionWorld", &DiscLight::positionWorld),
        field("directionWorld", &DiscLight::directionWorld),
        field("radiusMeters", &DiscLight::radiusMeters), field("luminance", &DiscLight::luminance),
        field("color", &DiscLight::color), field("rangeMeters", &DiscLight::rangeMeters),
        field("isTwoSided", &DiscLight::isTwoSided), field("castsShadows", &DiscLight::castsShadows),
        field("isVisible", &DiscLight::isVisible),
        field("lightChannels", &DiscLight::lightChannels) };
    static constexpr size_t others = 0;
};
template <> struct Fields<TubeLight> {
    static constexpr auto list = std::tuple{
        field("positionWorld", &TubeLight::positionWorld), field("axisWorld", &TubeLight::axisWorld),
        field("lengthMeters", &TubeLight::lengthMeters),
        field("radiusMeters", &TubeLight::radiusMeters),
        field("luminance", &TubeLight::luminance), field("color", &TubeLight::color),
        field("rangeMeters", &TubeLight::rangeMeters), field("castsShadows", &TubeLight::castsShadows),
        field("isVisible", &TubeLight::isVisible),
        field("lightChannels", &TubeLight::lightChannels) };
    static constexpr size_t others = 0;
};
template <> struct Fields<DocumentModel> {
    static constexpr auto list = std::tuple{ field("file", &DocumentModel::file),
        field("options", &DocumentModel::options),
                                             field("fit", &DocumentModel::fit),
        field("variant", &DocumentModel::variant) };
    static constexpr size_t others = 0;
};
template <> struct Fields<DocumentEnvironment> {
    static constexpr auto list = std::tuple{ field("file", &DocumentEnvironment::file),
                                             field("prefersModels", &DocumentEnvironment::prefersModels),
                                             field("options", &DocumentEnvironment::options),
                                             field("settings", &DocumentEnvironment::settings) };
    static constexpr size_t others = 0;
};
template <> struct Fields<NodeEdit> {
    static constexpr auto list = std::tuple{ field("node", &NodeEdit::node), field("isVisible", &NodeEdit::isVisible),
                                             field("parentFromNode", &NodeEdit::parentFromNode) };
    static constexpr size_t others = 0;
};
template <> struct Fields<MaterialEdit> {
    static constexpr auto list = std::tuple{ field("material", &MaterialEdit::material),
                                             field("parameter", &MaterialEdit::parameter),
                                             field("value", &MaterialEdit::value) };
    static constexpr size_t others = 0;
};
template <> struct Fields<TextureEdit> {
    static constexpr auto list = std::tuple{ field("material", &TextureEdit::material),
                                             field("parameter", &TextureEdit::parameter),
                                             field("file", &TextureEdit::file), field("isData", &TextureEdit::isData) };
    static constexpr size_t others = 0;
};
template <> struct Fields<DocumentLight> {
    static constexpr auto list = std::tuple{ field("name", &DocumentLight::name), field("isOn", &DocumentLight::isOn),
                                             field("light", &DocumentLight::light),
                                             field("profileFile", &DocumentLight::profileFile) };
    static constexpr size_t others = 0;
};
template <> struct Fields<DocumentProbe> {
    static constexpr auto list = std::tuple{
        field("name", &DocumentProbe::name), field("isOn", &DocumentProbe::isOn),
        field("centerWorld", &DocumentProbe::centerWorld, -1e9, 1e9),
        field("halfExtentMeters", &DocumentProbe::halfExtentMeters, 1e-4, 1e6),
        field("blendMeters", &DocumentProbe::blendMeters, 0, 1e6), field("file", &DocumentProbe::file),
        field("intensity", &DocumentProbe::intensity, 0, 1e9),
        field("lightsDiffuse", &DocumentProbe::lightsDiffuse) };
    static constexpr size_t others = 0;
};
template <> struct Fields<DocumentGrid> {
    static constexpr auto list = std::tuple{ field("file", &DocumentGrid::file), field("isOn", &DocumentGrid::isOn),
                                             field("intensity", &DocumentGrid::intensity, 0, 1e6) };
    static constexpr size_t others = 0;
};
template <> struct Fields<ModelLightEdit> {
    static constexpr auto list = std::tuple{ field("light", &ModelLightEdit::light),
        field("isOn", &ModelLightEdit::isOn),
                                             field("replacement", &ModelLightEdit::replacement) };
    static constexpr size_t others = 0;
};
template <> struct Fields<MorphEdit> {
    static constexpr auto list = std::tuple{ field("target", &MorphEdit::target),
                                             field("weight", &MorphEdit::weight, -1e6, 1e6) };
    static constexpr size_t others = 0;
};
template <> struct Fields<Playback> {
    static constexpr auto list = std::tuple{ field("animation", &Playback::animation),
        field("seconds", &Playback::seconds),
                                             field("isPlaying", &Playback::isPlaying),
                                             field("speed", &Playback::speed, -100, 100),
        field("loops", &Playback::loops) };
    static constexpr size_t others = 0;
};
template <> struct Fields<Bookmark> {
    static constexpr auto list = std::tuple{ field("name", &Bookmark::name), field("camera", &Bookmark::camera) };
    static constexpr size_t others = 0;
};
template <> struct Fields<CameraKey> {
    static constexpr auto list = std::tuple{ field("seconds", &CameraKey::seconds, -1e9, 1e9),
                                             field("camera", &CameraKey::camera) };
    static constexpr size_t others = 0;
};
template <> struct Fields<CameraPath> {
    static constexpr auto list = std::tuple{ field("name", &CameraPath::name), field("keys", &CameraPath::keys),
                                             field("isClosed", &CameraPath::isClosed),
                                             field("closingSeconds", &CameraPath::closingSeconds, 1e-6, 1e9) };
    static constexpr size_t others = 0;
};
template <> struct Fields<Document> {
    static constexpr auto list = std::tuple{
        field("model", &Document::model), field("environment", &Document::environment),
        field("nodes", &Document::nodes),
        field("materials", &Document::materials), field("textures", &Document::textures), field("lights", &Document::lights),
        field("probes", &Document::probes), field("grids", &Document::grids),
        field("modelLights", &Document::modelLights), field("playback", &Document::playback),
        field("morphs", &Document::morphs), field("view", &Document::view), field("look", &Document::look),
        field("dirt", &Document::dirt), field("bookmarks", &Document::bookmarks), field("paths", &Document::paths) };
    static constexpr size_t others = 0;
};
// clang-format on

template <class... T>
constexpr bool areComplete() {
    return (isComplete<T>() && ...);
}
static_assert(areComplete<Exposure, Lens, Camera, LevelsOfDetail, View, GltfLoadOptions, EnvironmentLoadOptions,
                          EnvironmentSettings>());
static_assert(areComplete<SunLight, PointLight, SpotLight, RectLight, DiscLight, TubeLight>());
static_assert(areComplete<DocumentModel, DocumentEnvironment, NodeEdit, MaterialEdit, TextureEdit, DocumentLight,
                          ModelLightEdit>());
static_assert(areComplete<DocumentProbe, DocumentGrid>());
static_assert(areComplete<MorphEdit, Playback, Bookmark, CameraKey, CameraPath, Document>());

// ---- what a field may be

template <class T>
struct VectorOf : std::false_type {};
template <int N, class T, glm::qualifier Q>
struct VectorOf<glm::vec<N, T, Q>> : std::true_type {
    static constexpr int size = N;
};
template <class T>
concept IsVector = VectorOf<T>::value;

template <class T>
struct MatrixOf : std::false_type {};
template <int N, class T, glm::qualifier Q>
struct MatrixOf<glm::mat<N, N, T, Q>> : std::true_type {
    static constexpr int size = N;
};
template <class T>
concept IsMatrix = MatrixOf<T>::value;

/// Lux, Candela, Nits.
template <class T>
concept IsUnit = std::is_class_v<T> && requires(T unit) {
    { unit.value } -> std::same_as<float&>;
};

/// Has names: nameOf(), fromName() and validNames().
template <class T>
concept IsNamed = std::is_enum_v<T>;

/// Has texts for each of its options.
template <class T>
concept IsOptions = std::is_same_v<T, Quality> || std::is_same_v<T, Effects> || std::is_same_v<T, DisplayTransform>;

template <class T>
struct IsListType : std::false_type {};
template <class T>
struct IsListType<std::vector<T>> : std::true_type {};
template <class T>
concept IsList = IsListType<T>::value;

template <class T>
struct IsOptionalType : std::false_type {};
template <class T>
struct IsOptionalType<std::optional<T>> : std::true_type {};
template <class T>
concept IsOptional = IsOptionalType<T>::value;

template <class T>
concept IsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

using Globals = std::array<float4, 4>; ///< View::materialGlobals

// ---- names

template <NamedEnum E>
const char* nameOf(E value) {
    return toString(value);
}
template <NamedEnum E>
std::optional<E> fromName(E, std::string_view name) {
    return enumFromName<E>(name);
}
template <NamedEnum E>
std::string validNames(E) {
    return listed(enumNames<E>());
}

/// Of the alternatives of LightDesc.
inline constexpr std::array<const char*, std::variant_size_v<LightDesc>> kLightKinds{ "sun",  "point", "spot",
                                                                                      "rect", "disc",  "tube" };
/// Of an alternative of ParameterValue: "float3".
const char* parameterTypeName(size_t index);

} // namespace filament_core::view
