// SPDX-License-Identifier: Apache-2.0
// Every complete example of the materials guide, extracted from its text, compiles unchanged, or is listed here with
// its errors.
#include "shaders/compiler/MaterialCompiler.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace filament_core::shader {
namespace {

/// What the guide's examples show, in our own words, for machines without the guide.
constexpr const char* kOwnExamples[] = {
    R"(material {
    name : "Painted wood", // quotes, a comment and trailing commas
    parameters : [
        { type : sampler2d, name : paint, },
        { type : float3, name : tint },
        { type : "float[3]", name : layers }
    ],
    constants : [ { name : isWet, type : bool, default : true } ],
    requires : [ uv0, color ],
    "shadingModel" : Lit,
}

fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = texture(materialParams_paint, getUV0()) * getColor();
        material.baseColor.rgb *= materialParams.tint * materialParams.layers[1];
        material.roughness = materialConstants_isWet ? 0.1 : 0.8;
    }
})",
    R"(material {
    name : Sky,
    parameters : [ { type : samplerCubemap, name : sky } ],
    variables : [ direction, { name : glow, precision : medium } ],
    vertexDomain : device,
    depthWrite : false,
    shadingModel : unlit
}

vertex {
    void materialVertex(inout MaterialVertexInputs material) {
        float3 p = getPosition().xyz;
        float3 u = mulMat4x4Float3(getViewFromClipMatrix(), p).xyz;
        material.direction.xyz = mulMat3x3Float3(getWorldFromViewMatrix(), u);
        material.glow = float4(0.5);
    }
}

fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.baseColor = texture(materialParams_sky, variable_direction.xyz) * variable_glow;
    }
})",
    R"(material {
    shadingModel : unlit, blending : custom, variantFilter : [ skinning, fog ],
    blendFunction : { srcRGB : one, srcA : one, dstRGB : oneMinusSrcColor, dstA : oneMinusSrcAlpha },
    postLightingBlending : add, featureLevel : 2, quality : high, transparentShadow : true
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.postLightingColor = float4(getNormalizedViewportCoord(), 0.5);
    }
})",
};

/// Errors of the guide itself, by a line of the example, and our compiler's message.
struct KnownMistake {
    std::string_view containing, message, reason;
};

constexpr KnownMistake kMistakes[] = {
    { "material.roughness = texture(materialParams_roughness, getUV0());", "cannot convert from",
      "a texture gives four numbers and roughness is one: .r is missing" },
    { "name : \"Double sided material\"", "'materialParams'",
      "reads materialParams.albedo, which it does not declare" },
    { "name : \"Alpha to coverage\"", "'materialParams'", "reads materialParams.albedo, which it does not declare" },
    { "name : \"Clear plastic with stickers\"", "'materialParams_baseColor'",
      "leaves its parameters out, as its \"// ...\" says" },
};

KnownMistake const* mistakeOf(std::string const& example, Error const& error) {
    const auto found = std::ranges::find_if(kMistakes, [&](KnownMistake const& mistake) {
        return example.find(mistake.containing) != std::string::npos &&
               error.message.find(mistake.message) != std::string::npos;
    });
    return found != std::end(kMistakes) ? found : nullptr;
}

/// The line of the closing brace of the block that begins in line `begin`; the end of the text if there is none.
size_t endOfBlock(std::vector<std::string> const& lines, size_t begin) {
    int depth = 0;
    for (size_t i = begin; i < lines.size(); ++i) {
        for (const char c : lines[i]) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        if (depth == 0) return i;
    }
    return lines.size();
}

bool opensBlock(std::string const& line) { return line == "material {" || line == "fragment {" || line == "vertex {"; }

/// Runs of blocks separated only by blank lines that include a material and a fragment block.
std::vector<std::string> completeExamples(std::vector<std::string> const& lines) {
    std::vector<std::string> examples;
    for (size_t i = 0; i < lines.size(); ++i) {
        if (lines[i] != "material {") continue;
        std::string example;
        bool hasFragment = false;
        size_t next = i;
        while (next < lines.size() && opensBlock(lines[next]) && (next == i || lines[next] != "material {")) {
            hasFragment = hasFragment || lines[next] == "fragment {";
            const size_t end = endOfBlock(lines, next);
            for (; next <= end && next < lines.size(); ++next) example += lines[next] + "\n";
            while (next < lines.size() && lines[next].find_first_not_of(" \t\r") == std::string::npos) ++next;
        }
        i = next - 1;
        const bool isSkeleton = example.find("// material properties") != std::string::npos;
        if (hasFragment && !isSkeleton) examples.push_back(example);
    }
    return examples;
}

std::vector<std::string> linesOf(std::filesystem::path const& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

TEST(GuideExamples, CompileAsTheyStand) {
    const std::filesystem::path assets(tools::assetDir());
    const std::filesystem::path guide = assets.parent_path() / "reference/materials-guide.txt";
    if (assets.empty()) GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set, beside which the guide lies";
    ASSERT_TRUE(std::filesystem::exists(guide)) << guide << " is missing: it belongs beside FILAMENT_ASSET_DIR";
    const std::vector<std::string> examples = completeExamples(linesOf(guide));
    ASSERT_GE(examples.size(), 8u) << "the text of the guide has another form than expected";
    size_t compiled = 0;
    std::set<KnownMistake const*> met;
    for (std::string const& example : examples) {
        const Result<MaterialPackage> package = compileMaterial(example, "guide.mat");
        compiled += package.ok();
        if (package) continue;
        KnownMistake const* const mistake = mistakeOf(example, package.error());
        EXPECT_TRUE(mistake) << example << package.error().message;
        if (!mistake) continue;
        met.insert(mistake);
        std::printf("%s: %.*s\n", package.error().message.c_str(), static_cast<int>(mistake->reason.size()),
                    mistake->reason.data());
    }
    std::printf("%zu of %zu examples of the guide compile as they stand; it is wrong in the others\n", compiled,
                examples.size());
    EXPECT_EQ(met.size(), std::size(kMistakes)) << "a mistake in this list is in no example any more";
    EXPECT_EQ(compiled + met.size(), examples.size());
}

TEST(GuideExamples, CompileInOurOwnWords) {
    for (const char* example : kOwnExamples) {
        const Result<MaterialPackage> package = compileMaterial(example, "own.mat");
        EXPECT_TRUE(package) << example << (package ? "" : package.error().message);
    }
}

} // namespace
} // namespace filament_core::shader
