// SPDX-License-Identifier: Apache-2.0
/// MaterialFile: a .mat file (compiled here) or a .fmat file, and how to show it.
///   Show    one comment line of a .mat file may choose the mesh and the values of its parameters and constants:
///               // show: mesh=sphere tint=1,0.5,0.2 normalMap=brick/normal
///           mesh=sphere|plane|box|torus|scroll|lines|screen|billboard (MaterialMeshes.h); slab=true puts a grey
///           block through the object; instances=N draws N numbered copies in a row. Every other key is a parameter or
///           a constant: numbers, true, false, or the name of an image (MaterialPictures.h). "name[]" is an array, its
///           elements one after the other.
///   Thread  any.
///   Memory  readMaterialFile() compiles each text once per process and keeps it; compileMaterialFile() keeps the
///           latest eight packages. Both query the package cache of the environment first (PackageCache.h).
///   Fails   errors of the compiler, or Unreadable with the path.
#pragma once

#include "base/Result.h"
#include "shaders/package/Package.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::tools {

struct MaterialShow {
    std::string mesh = "sphere";
    bool slab = false;
    uint32_t instances = 1;                                  ///< [1, 16]
    std::vector<std::pair<std::string, std::string>> values; ///< parameters and constants, as written
};

struct MaterialFile {
    std::string name; ///< the file's name without folder and extension
    std::vector<std::byte> bytes;
    shader::MaterialPackage package; ///< the contents of the bytes
    MaterialShow show;
};

/// A piece of the text to replace before compiling; it must occur.
using TextEdit = std::pair<std::string, std::string>;

/// `filteredVariants`: VariantBits that are never requested; ignored for .fmat files.
///   Fails  NotFound: an edit does not apply.
Result<std::shared_ptr<const MaterialFile>> readMaterialFile(std::filesystem::path const& path,
                                                             std::vector<TextEdit> const& edits = {},
                                                             uint16_t filteredVariants = 0);

/// The same from the file as it is now. If its text (except for what follows "// show:") and the files that it includes
/// are those of one of the latest eight compilations, the package of that one is used again.
Result<MaterialFile> compileMaterialFile(std::filesystem::path const& path, std::vector<TextEdit> const& edits = {},
                                         uint16_t filteredVariants = 0);

/// How many texts this process has compiled.
uint64_t compiledMaterialFiles();

/// Forgets the latest compilations, for tests of concurrent ones: from now on this process also compiles what
/// the package cache has.
void forgetCompiledMaterialFiles();

/// Whether the path names a material, judged by its extension.
bool isMaterialFile(std::filesystem::path const& path);

/// Parses the line "// show: ..." of a material's text; defaults if there is none.
Result<MaterialShow> readMaterialShow(std::string_view text, std::string_view fileName);

} // namespace filament_core::tools
