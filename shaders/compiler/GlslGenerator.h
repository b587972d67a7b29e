// SPDX-License-Identifier: Apache-2.0
/// GLSL 450 of one stage of one variant: defines, engine files, declarations, the author's block, entry point.
///   In      a checked definition. Out: text for compileProgram(), with #line directives into the author's files.
///   Thread  any. Deterministic.
///   Fails   InvalidArgument: an include that cannot be found, a block that lacks its function.
#pragma once

#include "shaders/compiler/EngineNames.h"
#include "shaders/compiler/MaterialDefinition.h"

#include <string>
#include <vector>

namespace filament_core::shader {

/// What the author's code requires; equal for all variants.
struct MaterialNeeds {
    bool worldPosition = false, normal = false, tangent = false;
    bool clipSpaceTransform = false, clipSpacePosition = false;
    bool bump = false;           ///< calls applyBump()
    bool instanceIndex = false;  ///< getInstanceIndex() in the fragment stage
    bool colors = false;         ///< calls a function of the colour library (materials guide, 4.5.7)
    bool vertexTextures = false; ///< the vertex block reads textures
    bool callsPrepare = true;    ///< otherwise main() calls prepareMaterial() after material()
    uint8_t fragmentCustoms = 0; ///< bit n: the fragment block calls getCustomn()
    uint64_t terms = 0;          ///< bit n: the term of materialMembers()[n] (findTerms())
    std::vector<GlslDeclaration> vertexDeclarations, fragmentDeclarations; ///< by the author
    NameSet words;                                                         ///< of the author's code
    NameSet prefixed;                                                      ///< names of the engine among them

    bool has(std::string_view term) const;
};

/// Derived from the names in the code: getters and required functions. The terms come from findTerms().
///   Fails   also for functions with other parameters than the engine passes, and for names that are taken.
Result<MaterialNeeds> findNeeds(MaterialDefinition const& definition, IncludeResolver const& includes);

/// Depth is not the mesh's: the material is masked, or the author's code discards or moves fragments.
bool fragmentsDecideDepth(MaterialDefinition const& definition, MaterialNeeds const& needs);

/// The bits of a variant that change the text of a stage.
uint16_t variantBits(MaterialDefinition const& definition, MaterialNeeds const& needs, backend::ShaderStage stage);

Result<std::string> generateVertex(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                   uint16_t variantKey, IncludeResolver const& includes);
Result<std::string> generateFragment(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                     uint16_t variantKey, IncludeResolver const& includes);

/// The fragment stage up to the author's code, with a main() for findTerms().
Result<std::string> generateProbe(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                  IncludeResolver const& includes);

/// The fragment stage up to and including the author's code, with a main() that hands everything that material() sets
/// to the output, for checkTextureConditions(). Of post-process materials, and of those that shade lights themselves:
/// the whole stage.
Result<std::string> generateObserver(MaterialDefinition const& definition, MaterialNeeds const& needs,
                                     IncludeResolver const& includes);

/// The bind group layout that all variants share: the engine's View and Pass groups, and the material's own.
backend::ProgramLayout materialLayout(MaterialDefinition const& definition, MaterialNeeds const& needs);

} // namespace filament_core::shader
