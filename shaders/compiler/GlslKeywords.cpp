// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslKeywords.h"

#include <algorithm>

namespace filament_core::shader {
namespace {

// GLSL 4.50 and ESSL 3.10 specifications, 3.6, and GL_KHR_vulkan_glsl.
// clang-format off
constexpr std::string_view kKeywords[] = {
    "active", "asm", "atomic_uint", "attribute", "bool", "break",
    "buffer", "bvec2", "bvec3", "bvec4", "case", "cast",
    "centroid", "class", "coherent", "common", "const", "continue",
    "default", "discard", "dmat2", "dmat3", "dmat4", "do",
    "double", "dvec2", "dvec3", "dvec4", "else", "enum",
    "extern", "external", "false", "filter", "fixed", "flat",
    "float", "for", "fvec2", "fvec3", "fvec4", "goto",
    "half", "highp", "hvec2", "hvec3", "hvec4", "if",
    "iimage2D", "iimage2DArray", "iimage3D", "iimageCube", "image1D", "image2D",
    "image2DArray", "image3D", "imageBuffer", "imageCube", "imageCubeArray", "in",
    "inline", "inout", "input", "int", "interface", "invariant",
    "isampler1D", "isampler2D", "isampler2DArray", "isampler2DMS", "isampler3D", "isamplerBuffer",
    "isamplerCube", "isamplerCubeArray", "isubpassInput", "ivec2", "ivec3", "ivec4",
    "layout", "long", "lowp", "mat2", "mat2x2", "mat2x3",
    "mat2x4", "mat3", "mat3x2", "mat3x3", "mat3x4", "mat4",
    "mat4x2", "mat4x3", "mat4x4", "mediump", "namespace", "noinline",
    "noperspective", "out", "output", "partition", "patch", "precise",
    "precision", "public", "readonly", "resource", "restrict", "return",
    "sample", "sampler", "sampler1D", "sampler1DArray", "sampler1DShadow", "sampler2D",
    "sampler2DArray", "sampler2DArrayShadow", "sampler2DMS", "sampler2DRect", "sampler2DShadow", "sampler3D",
    "sampler3DRect", "samplerBuffer", "samplerCube", "samplerCubeArray", "samplerCubeArrayShadow", "samplerCubeShadow",
    "shared", "short", "sizeof", "smooth", "static", "struct",
    "subpassInput", "subpassInputMS", "subroutine", "superp", "switch", "template",
    "this", "true", "typedef", "uimage2D", "uimage2DArray", "uimage3D",
    "uimageCube", "uint", "uniform", "union", "unsigned", "usampler1D",
    "usampler2D", "usampler2DArray", "usampler2DMS", "usampler3D", "usamplerBuffer", "usamplerCube",
    "usamplerCubeArray", "using", "usubpassInput", "uvec2", "uvec3", "uvec4",
    "varying", "vec2", "vec3", "vec4", "void", "volatile",
    "while", "writeonly"
};
// clang-format on
static_assert(std::ranges::is_sorted(kKeywords));

} // namespace

std::span<const std::string_view> glslKeywords() { return kKeywords; }
bool isGlslKeyword(std::string_view word) { return std::ranges::binary_search(kKeywords, word); }

} // namespace filament_core::shader
