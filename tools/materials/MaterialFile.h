// SPDX-License-Identifier: Apache-2.0
/// MaterialFile: a .mat file (compiled here) or a .fmat file, and how it wants to be looked at.
///   Show    a .mat file may say in one comment line on what it is shown and what its parameters and constants are:
///               // show: mesh=sphere tint=1,0.5,0.2 normalMap=brick/normal
///           mesh=sphere|plane|box|torus|scroll|screen|billboard (MaterialMeshes.h); slab=true puts a grey block
///           through the object; instances=N draws N of them, numbered, in a row. Every other key is a parameter or a
///           constant: numbers, true, false, or the name of a picture (MaterialPictures.h). "name[]" is an array, its
///           elements one after the other.
///   Thread  any.
///   Memory  packages are compiled once in a process for each text, and kept.
///   Fails   what the compiler says, or Unreadable with the path.
#pragma once

#include "base/Result.h"
#include "shaders/package/Package.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace filament::tools {

struct MaterialShow {
    std::string mesh = "sphere";
    bool slab = false;
    uint32_t instances = 1;                                  ///< [1, 16]
    std::vector<std::pair<std::string, std::string>> values; ///< parameters and constants, as written
};

struct MaterialFile {
    std::string name; ///< of the file, without folder and ending
    std::vector<std::byte> bytes;
    shader::MaterialPackage package; ///< what the bytes say
    MaterialShow show;
};

/// A piece of the text that is replaced before it is compiled; it must be there.
using TextEdit = std::pair<std::string, std::string>;

/// NotFound: an edit does not apply.
Result<std::shared_ptr<const MaterialFile>> readMaterialFile(std::filesystem::path const& path,
                                                             std::vector<TextEdit> const& edits = {});

/// Whether the path names a material, by its ending.
bool isMaterialFile(std::filesystem::path const& path);

/// The line "// show: ..." of a material's text; defaults where there is none.
Result<MaterialShow> readMaterialShow(std::string_view text, std::string_view fileName);

} // namespace filament::tools
