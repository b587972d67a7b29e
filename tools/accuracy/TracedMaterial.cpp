// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/TracedMaterial.h"

#include "base/NumberText.h"
#include "base/Suggest.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/lib/LibCppDouble.h"
#include "toolkit/materials/MaterialMeshes.h"
#include "toolkit/scenes/MaterialModel.h"
#include "tools/reference/Surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace filament_core::accuracy {
namespace {

namespace lib = shader::lib64;

using reference::SurfaceSample;
using tools::MaterialVertex;
using tools::SceneSpec;

/// The members of MaterialInputs that the path tracer must know, with their defaults.
struct Inputs {
    double3 baseColor{ 1.0 };
    double metallic = 0, roughness = 1, reflectance = 0.5, ior = 0; // ior 0: derived from the reflectance
    double clearCoat = 0, clearCoatRoughness = 0;
    double3 sheenColor{ 0.0 };
    double sheenRoughness = 0;
    double anisotropy = 0;
    double transmission = 1;
    double3 absorption{ 0.0 };
    double thickness = 0.5, microThickness = 0, dispersion = 0;
    double3 emissive{ 0.0 };
    double wallHeight = 0; // 0: no wall at the mesh's edge
};

constexpr std::pair<std::string_view, double Inputs::*> kNumbers[] = {
    { "metallic", &Inputs::metallic },
    { "roughness", &Inputs::roughness },
    { "reflectance", &Inputs::reflectance },
    { "ior", &Inputs::ior },
    { "clearCoat", &Inputs::clearCoat },
    { "clearCoatRoughness", &Inputs::clearCoatRoughness },
    { "sheenRoughness", &Inputs::sheenRoughness },
    { "anisotropy", &Inputs::anisotropy },
    { "transmission", &Inputs::transmission },
    { "thickness", &Inputs::thickness },
    { "microThickness", &Inputs::microThickness },
    { "dispersion", &Inputs::dispersion },
    { "wallHeight", &Inputs::wallHeight },
};
constexpr std::pair<std::string_view, double3 Inputs::*> kColors[] = {
    { "baseColor", &Inputs::baseColor },
    { "sheenColor", &Inputs::sheenColor },
    { "absorption", &Inputs::absorption },
    { "emissive", &Inputs::emissive },
};

bool read(std::string const& words, std::span<double> numbers) {
    std::stringstream stream(words);
    std::string word;
    for (double& number : numbers) {
        if (!std::getline(stream, word, ',')) return false;
        const std::optional<double> read = numberOf<double>(word);
        if (!read) return false;
        number = *read;
    }
    return stream.eof() || stream.peek() == std::char_traits<char>::eof();
}

Result<void> setInput(Inputs& inputs, std::string const& scene, std::string const& name, std::string const& words) {
    std::vector<std::string_view> known;
    bool isRead = false, isKnown = false;
    for (auto const& [key, member] : kNumbers) {
        known.push_back(key);
        if (key != name) continue;
        isKnown = true;
        isRead = read(words, std::span(&(inputs.*member), 1));
    }
    for (auto const& [key, member] : kColors) {
        known.push_back(key);
        if (key != name) continue;
        isKnown = true;
        isRead = read(words, std::span(&(inputs.*member).x, 3));
    }
    if (!isKnown) {
        return fail(ErrorCode::NotFound, "{}: the path tracer knows no member '{}' of MaterialInputs{}", scene, name,
                    suggestion(name, known));
    }
    if (!isRead) return fail(ErrorCode::InvalidArgument, "{}: {} '{}': give its numbers", scene, name, words);
    return {};
}

// Like edgeOf() and wallLight() of scenes/materials/corner.mat.
double3 edgeOf(double3 a, double3 b) {
    const double3 normal = glm::cross(a, b);
    const double size = std::max(glm::length(normal), 1e-9);
    return normal * (0.5 * std::atan2(size, glm::dot(a, b)) / size);
}

double3 wallLight(double2 point, double height) {
    const double away = std::max(1 - point.y, 1e-3), left = -1 - point.x, right = 1 - point.x;
    const double3 a(left, away, 0), b(right, away, 0), c(right, away, height), d(left, away, height);
    return edgeOf(b, a) + edgeOf(a, d) + edgeOf(d, c) + edgeOf(c, b);
}

void occlude(SurfaceSample& surface, double wallHeight, bool hasBentNormal) {
    const double3 open = double3(0, 0, lib::kPi) - wallLight(surface.uv * 2.0 - 1.0, wallHeight);
    surface.occlusion = lib::saturate(open.z * lib::kInversePi);
    if (!hasBentNormal) return;
    const double3 bitangent = glm::cross(surface.normal, surface.tangent);
    surface.bentNormal = glm::normalize(surface.tangent * open.x + bitangent * open.y + surface.normal * open.z);
}

/// Like shaders/material/surface/lit_shading.glsl.
void applyTo(SurfaceSample& surface, Inputs const& in, shader::MaterialPackage const& package) {
    const bool isCloth = package.shading == shader::ShadingModel::Cloth;
    surface.metallic = in.metallic;
    surface.diffuse = lib::diffuseColor(in.baseColor, in.metallic);
    const double dielectric = in.ior > 0 ? lib::f0FromIor(in.ior) : lib::f0FromReflectance(in.reflectance);
    surface.f0 = glm::mix(double3(dielectric), in.baseColor, in.metallic);
    surface.perceptualRoughness = lib::clampPerceptualRoughness(in.roughness);
    surface.cloth.isCloth = isCloth;
    if (isCloth) surface.cloth.sheenColor = in.sheenColor;
    surface.coat = { in.clearCoat, lib::clampPerceptualRoughness(in.clearCoatRoughness), surface.normal, surface.f0 };
    surface.f0 = reference::f0BelowCoat(surface.f0, in.clearCoat);
    surface.f90 = reference::f90Of(surface.f0);
    if (!isCloth) surface.sheen = { in.sheenColor, lib::clampPerceptualRoughness(in.sheenRoughness) };
    if (in.anisotropy != 0) {
        const double alpha = lib::alphaFromPerceptual(surface.perceptualRoughness);
        surface.anisotropy = in.anisotropy;
        surface.stretchedAlpha = lib::anisotropicAlpha(alpha, in.anisotropy, lib::kMinAlpha);
    }
    if (in.wallHeight > 0)
        occlude(surface, in.wallHeight, std::ranges::find(package.terms, "bentNormal") != package.terms.end());
    if (package.refractionMode == shader::RefractionMode::None) return;
    const bool isThin = package.refractionType == shader::RefractionType::Thin;
    surface.transmission = { .color = surface.diffuse * in.transmission,
                             .share = (1 - in.metallic) * in.transmission,
                             .isThin = isThin,
                             .ior = in.ior > 0 ? in.ior : lib::iorFromReflectance(in.reflectance),
                             .dispersion = in.dispersion,
                             .absorption = in.absorption,
                             .thickness = isThin ? in.microThickness : in.thickness };
    surface.diffuse *= 1 - in.transmission;
}

backend::VertexLayout layoutOfMesh() {
    using backend::VertexFormat;
    backend::VertexLayout layout;
    const auto add = [&](uint8_t location, VertexFormat format, size_t offset) {
        layout.attributes[layout.attributeCount++] = { location, 0, format, static_cast<uint16_t>(offset) };
    };
    add(shader::kAttributePosition, VertexFormat::Float3, offsetof(MaterialVertex, position));
    add(shader::kAttributeTangents, VertexFormat::Float4, offsetof(MaterialVertex, tangents));
    add(shader::kAttributeUv0, VertexFormat::Float2, offsetof(MaterialVertex, uv0));
    layout.buffers[0].stride = sizeof(MaterialVertex);
    layout.bufferCount = 1;
    return layout;
}

std::shared_ptr<const assets::ModelData> modelOf(tools::MaterialMesh const& mesh, std::string const& name,
                                                 double3 emissive, bool isDoubleSided) {
    assets::PrimitiveData primitive;
    primitive.layout = layoutOfMesh();
    const auto vertices = std::as_bytes(std::span(mesh.vertices)), indices = std::as_bytes(std::span(mesh.indices));
    primitive.vertices.assign(vertices.begin(), vertices.end());
    primitive.indices.assign(indices.begin(), indices.end());
    primitive.vertexCount = static_cast<uint32_t>(mesh.vertices.size());
    primitive.indexCount = static_cast<uint32_t>(mesh.indices.size());
    primitive.hasNormals = primitive.hasTangents = primitive.hasUv0 = true;
    primitive.material = 0;
    primitive.boundsMin = float3(-1), primitive.boundsMax = float3(1);
    auto model = std::make_shared<assets::ModelData>();
    model->name = name;
    model->materials.push_back({ .name = name, .emissiveFactor = float3(emissive), .doubleSided = isDoubleSided });
    model->meshes.push_back({ name, { std::move(primitive) } });
    model->nodes.push_back({ .name = name, .mesh = 0 });
    return model;
}

} // namespace

Result<TracedMaterial> tracedMaterialOf(SceneSpec const& spec, size_t copy) {
    const Result<tools::MaterialModelFile> read = tools::readMaterialModel(spec);
    if (!read) return read.error();
    shader::MaterialPackage const& package = read->file->package;
    if (package.shading != shader::ShadingModel::Lit && package.shading != shader::ShadingModel::Cloth) {
        return fail(ErrorCode::Unsupported, "{}: the path tracer has no model for this material; use lit or cloth",
                    spec.name);
    }
    if (package.parameters.empty()) {
        return fail(ErrorCode::Unsupported,
                    "{}: the path tracer knows a material by its parameters, and this one has none", spec.name);
    }
    const std::string name = read->mesh.empty() ? read->file->show.mesh : read->mesh;
    const std::optional<tools::MaterialMesh> mesh = tools::makeMaterialMesh(name);
    if (!mesh) return fail(ErrorCode::NotFound, "{}: there is no mesh '{}'", spec.name, name);
    Inputs inputs;
    for (auto const& [key, words] : valuesOfCopy(*read, spec, copy)) {
        if (const Result<void> done = setInput(inputs, spec.name, key, words); !done) return done.error();
    }
    TracedMaterial traced;
    traced.model.data =
            modelOf(*mesh, spec.name, inputs.emissive, package.doubleSided || package.culling == Culling::None);
    traced.model.finish = [inputs, package](SurfaceSample& surface) { applyTo(surface, inputs, package); };
    traced.features = { .coat = inputs.clearCoat > 0,
                        .sheen = inputs.sheenColor != double3(0.0),
                        .refraction = package.refractionMode != shader::RefractionMode::None,
                        .solid = package.refractionMode != shader::RefractionMode::None &&
                                 package.refractionType == shader::RefractionType::Solid };
    return traced;
}

} // namespace filament_core::accuracy
