// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/gpu/ShaderText.h"
#include "toolkit/paths/Paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace filament_core::shader::numerics {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kVertex = R"(#version 450
void main() {
    gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
)";

/// As in lit materials whose lighting runs in half precision (shaders/material/surface/half.glsl).
constexpr std::string_view kHalfPrelude = R"(
#define HALF_PRECISION 1
precision mediump float;
)";

constexpr std::string_view kInterface = R"(
layout(set = 0, binding = 0) uniform highp sampler2D inputS;
layout(set = 0, binding = 1) uniform highp sampler2D inputU;
layout(set = 0, binding = 2) uniform highp sampler2D inputV;
layout(location = 0) out highp vec4 result;
)";
/// Converts results of any type to four numbers. The type names become those of the precision.
constexpr std::string_view kPack = R"(
vec4 asVec4(bool x) { return vec4(x ? 1.0f : 0.0f, 0.0f, 0.0f, 0.0f); }
vec4 asVec4(float x) { return vec4(x, 0.0f, 0.0f, 0.0f); }
vec4 asVec4(vec2 x) { return vec4(x, 0.0f, 0.0f); }
vec4 asVec4(vec3 x) { return vec4(x, 0.0f); }
)";

Result<std::string> textOf(fs::path const& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!(text << file.rdbuf()))
        return fail(ErrorCode::NotFound, "{}: cannot be read; run where the project was built", path.string());
    return text.str();
}

/// Computes every row, and keeps the pixel's own.
std::string evaluateText(std::span<Row const* const> rows) {
    std::string text = "void evaluate(int row, vec4 s, vec3 u, vec3 v, OUT(vec4) x) {\n    x = vec4(0.0f);\n";
    for (size_t i = 0; i < rows.size(); ++i)
        text += fmt::format("    if (row == {}) x = asVec4({});\n", i, rows[i]->call.text);
    return text + "}\n";
}

constexpr std::string_view kMain = R"(
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    highp vec4 s = texelFetch(inputS, at, 0);
    highp vec4 u = texelFetch(inputU, at, 0);
    highp vec4 v = texelFetch(inputV, at, 0);
    vec4 x;
    evaluate(int(u.w), s, u.xyz, v.xyz, x);
    result = x;
}
)";

} // namespace

Result<std::string> libraryText() {
    const fs::path folder = tools::sourceDir() / "shaders/lib";
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; it != end; it.increment(error)) {
        if (it->path().extension() == ".glsl") files.push_back(it->path());
    }
    std::sort(files.begin(), files.end(), [](fs::path const& a, fs::path const& b) {
        const bool mathA = a.stem() == "math", mathB = b.stem() == "math";
        return mathA != mathB ? mathA : a < b;
    });
    files.emplace_back(tools::sourceDir() / "tools/numerics/table/Wrappers.glsl");
    std::string text;
    for (fs::path const& file : files) {
        const Result<std::string> one = textOf(file);
        if (!one) return one.error();
        text += *one;
    }
    return text;
}

Result<ProgramShaders> groupProgram(std::string const& library, std::span<Row const* const> rows, Format format) {
    const bool half = format == Format::Half;
    const std::string fragment = fmt::format("#version 450\n{}{}{}{}{}{}", half ? kHalfPrelude : "", kInterface,
                                             library, kPack, evaluateText(rows), kMain);
    return compileProgram(kVertex, fragment,
                          { .halfFragment = half,
                            .dynamicUniformBuffers = std::vector<SetBinding>{},
                            .fragmentName = half ? "shaders/lib in 16 bits" : "shaders/lib" });
}

} // namespace filament_core::shader::numerics
