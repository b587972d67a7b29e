// SPDX-License-Identifier: Apache-2.0
/// MaterialRows: the materials that are drawn, and the parameters of one, from what the engine says of it: a new
/// parameter of a material appears by itself.
///   Thread  the app thread.   Cost: proportional to the parameters of one material.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Engine.h>
#include <filament_core/Material.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

class Stage;

enum class ParameterKind : uint8_t {
    Number,  ///< of any type of numbers and of 1 to 4 components
    Color,   ///< three or four floats whose name implies colour
    Switch,  ///< bools
    Texture, ///< an image file can take its place: takesPicture()
    Other,   ///< matrices and arrays: shown by their type
};

struct ParameterRow {
    ParameterDescription description{};
    ParameterKind kind = ParameterKind::Other;
    std::optional<ParameterValue> value{}; ///< as drawn now; none: textures and arrays
    std::optional<TextureEdit> texture{};  ///< as edited
    bool isEdited = false;
};

ParameterKind parameterKind(ParameterDescription const& description);
/// Two-dimensional and of floats.
bool takesPicture(ParameterDescription const& description);
/// Whether the name says that its images are no colours: "normalMap", "roughnessMap".
bool holdsData(std::string_view parameter);

struct MaterialRow {
    std::string name{};
    MaterialInstance instance{}; ///< the first of them
    Material material{};
    uint32_t renderables = 0;
    uint32_t edits = 0;
};

/// One of each name: a MaterialEdit is of all instances of a name.
std::vector<MaterialRow> materialRows(Stage const& stage, Document const& document, std::string_view filter = {});
std::vector<ParameterRow> parameterRows(Stage& stage, MaterialRow const& material, Document const& document);

/// "lit, transparent, double sided; sets baseColor, roughness": what it is and which terms it pays for.
std::string describeMaterial(MaterialDescription const& description);

/// The components of a value as numbers, and back with the same type. Bools are 0 and 1; whole types are rounded and
/// kept in their range. Empty for matrices.
std::vector<double> componentsOf(ParameterValue const& value);
ParameterValue withComponents(ParameterValue const& value, std::vector<double> const& components);

} // namespace filament_core::view
