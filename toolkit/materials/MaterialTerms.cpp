// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/MaterialTerms.h"
#include "toolkit/paths/Paths.h"

namespace filament_core::tools {
namespace {

using Edits = std::vector<TextEdit>;

constexpr const char* kNormal = "material.normal = texture(materialParams_normalMap, getUV0()).xyz * 2.0 - 1.0;";
constexpr const char* kCoat = "material.clearCoat = materialParams.strength;\n"
                              "material.clearCoatRoughness = materialParams.smallRoughness;\n";
constexpr const char* kAnisotropy = "material.anisotropy = materialParams.strength;\n";
constexpr const char* kSheen = "material.sheenColor = materialParams.tint;\n"
                               "material.sheenRoughness = materialParams.roughness;\n";

Edits with(std::string const& after) { return { { "// AFTER", after } }; }
Edits of(std::string const& model, std::string const& after) {
    Edits edits = with(after);
    edits.emplace_back("shadingModel : lit", "shadingModel : " + model);
    if (model != "subsurface") edits.emplace_back("material.metallic = materialParams.metallic;", "");
    return edits;
}
Edits refracting(std::string const& properties, std::string const& after) {
    Edits edits = with("material.ior = 1.45;\nmaterial.roughness = materialParams.smallRoughness;\n" + after);
    edits.emplace_back("// PROPERTIES", "refractionMode : cubemap, " + properties);
    return edits;
}

} // namespace

std::vector<MaterialTerm> materialTerms() {
    Edits glossy = of("specularGlossiness", "material.specularColor = materialParams.tint;\n"
                                            "material.glossiness = materialParams.strength;");
    glossy.emplace_back("material.roughness = materialParams.roughness;", "");
    return {
        { "standard", {} },
        { "normal map", { { "// BEFORE", kNormal } } },
        { "specular anti-aliasing", { { "// PROPERTIES", "specularAntiAliasing : true," } } },
        { "anisotropy", with(kAnisotropy) },
        { "sheen", with(kSheen) },
        { "clear coat", with(kCoat) },
        { "clear coat with its normal",
          { { "// BEFORE", std::string("material.clearCoatNormal = ") + (kNormal + 18) }, { "// AFTER", kCoat } } },
        { "iridescence", with("material.iridescence = materialParams.strength;") },
        { "diffuse transmission", with("material.diffuseTransmission = materialParams.strength;") },
        { "specular-glossiness", glossy },
        { "cloth", of("cloth", "material.sheenColor = materialParams.tint;") },
        { "cloth with subsurface colour",
          of("cloth", "material.sheenColor = materialParams.tint;\nmaterial.subsurfaceColor = materialParams.color;") },
        { "subsurface", of("subsurface", "material.thickness = materialParams.strength;\n"
                                         "material.subsurfaceColor = materialParams.tint;") },
        { "refraction, solid", refracting("", "material.thickness = materialParams.strength;") },
        { "refraction, thin", refracting("refractionType : thin,", "material.microThickness = 0.01;") },
        { "refraction with dispersion",
          refracting("",
                     "material.thickness = materialParams.strength;\nmaterial.dispersion = materialParams.strength;") },
        { "refraction with scattering",
          refracting("", "material.thickness = materialParams.strength;\nmaterial.absorption = materialParams.tint;\n"
                         "material.multiscatterColor = materialParams.color;") },
        { "all layers", { { "// BEFORE", kNormal }, { "// AFTER", std::string(kCoat) + kAnisotropy + kSheen } } },
    };
}

Result<std::shared_ptr<const MaterialFile>> readMaterialTerm(MaterialTerm const& term, uint16_t filteredVariants) {
    auto file = readMaterialFile(sourceDir() / "toolkit/materials/terms.mat", term.edits, filteredVariants);
    if (!file) return fail(file.error().code, "{}: {}", term.name, file.error().message);
    return file;
}

} // namespace filament_core::tools
