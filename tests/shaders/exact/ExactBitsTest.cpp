// SPDX-License-Identifier: Apache-2.0
// The promise of DESIGN, "The same bits on both APIs", one built-in at a time.
#include "tests/shaders/exact/BothDevices.h"
#include "tests/shaders/exact/ExpressionRig.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::shader {
namespace {

using test::ExpressionRig;

struct Comparison {
    size_t different = 0, notANumber = 0, distinct = 0;
    std::string firstDifference;
};

Comparison compare(std::vector<uint32_t> const& vulkan, std::vector<uint32_t> const& gles) {
    Comparison result;
    for (size_t i = 0; i < vulkan.size(); ++i) {
        const auto x = std::bit_cast<float>(vulkan[i]), y = std::bit_cast<float>(gles[i]);
        result.notANumber += x != x;
        result.distinct += vulkan[i] != vulkan[0];
        if (vulkan[i] == gles[i]) continue;
        if (result.different++ == 0) result.firstDifference = std::to_string(x) + " and " + std::to_string(y);
    }
    return result;
}

struct Named {
    const char* name;
    const char* expression;
};

class ExactBits : public test::BothDevices<ExpressionRig>, public ::testing::WithParamInterface<Named> {
protected:
    static Comparison run(std::string const& expression, bool exact) {
        const Result<std::vector<uint32_t>> onVulkan = vulkan().values(expression, exact);
        const Result<std::vector<uint32_t>> onGles = gles().values(expression, exact);
        EXPECT_TRUE(onVulkan) << (onVulkan ? "" : onVulkan.error().message);
        EXPECT_TRUE(onGles) << (onGles ? "" : onGles.error().message);
        if (!onVulkan || !onGles) return { .different = 1 };
        EXPECT_EQ(onVulkan->size(), onGles->size());
        return compare(*onVulkan, *onGles);
    }
};

TEST_P(ExactBits, AreTheSameOnBothApis) {
    const Comparison result = run(GetParam().expression, true);
    EXPECT_EQ(result.different, 0u) << GetParam().expression << ": first " << result.firstDifference;
    EXPECT_EQ(result.notANumber, 0u) << "the test leaves the domain of the function";
    EXPECT_GT(result.distinct, 1000u) << "the test does not exercise the function";
}

INSTANTIATE_TEST_SUITE_P(
        Of, ExactBits,
        ::testing::Values(
                Named{ "dot2", "vec4(dot(a.xy, b.xy), dot(b.zw, c.zw), dot(a.xy, c.xy), dot(c.xy, b.xy))" },
                Named{ "dot3", "vec4(dot(a.xyz, b.xyz), dot(b.xyz, c.xyz), dot(a.yzw, c.yzw), dot(a.xyz, a.xyz))" },
                Named{ "dot4", "vec4(dot(a, b), dot(b, c), dot(a, c), dot(a, a))" },
                Named{ "normalize", "vec4(normalize(a.xyz), normalize(b).x)" },
                Named{ "length", "vec4(length(a), length(b.xyz), length(c.xy), length(a.x))" },
                Named{ "distance",
                       "vec4(distance(a, b), distance(b.xyz, c.xyz), distance(a.xy, c.xy), distance(a.x, b.x))" },
                Named{ "mix", "mix(a, b, p)" }, Named{ "mixScalar", "mix(a, b, p.x)" },
                Named{ "reflect", "vec4(reflect(a.xyz, normalize(b.xyz)), 0)" },
                Named{ "refract", "vec4(refract(normalize(a.xyz), normalize(b.xyz), 0.7), 0)" },
                Named{ "faceforward", "faceforward(a, b, c)" }, Named{ "cross", "vec4(cross(a.xyz, b.xyz), 0)" },
                Named{ "pow", "pow(abs(a), b)" }, Named{ "powConstant", "pow(p, vec4(2.2))" },
                Named{ "powFive", "pow(p, vec4(5.0))" }, Named{ "exp", "exp(a)" }, Named{ "exp2", "exp2(a)" },
                Named{ "log", "log(abs(a))" }, Named{ "log2", "log2(abs(a))" }, Named{ "sqrt", "sqrt(abs(a))" },
                Named{ "inversesqrt", "inversesqrt(abs(a))" }, Named{ "division", "a / b" },
                Named{ "reciprocal", "1.0 / a" }, Named{ "divisionByConstant", "a / 3.0" },
                Named{ "divisionByConstants", "a / vec4(3.0, 5.0, 7.0, 11.0)" }, Named{ "constantOver", "3.0 / a" },
                Named{ "divisionBySpecialisation", "a / kSpec" },
                Named{ "divisionByDerived", "a / (kSpec > 2.0 ? 7.0 : 5.0)" }, Named{ "divisionByScalar", "a / b.x" },
                Named{ "sin", "sin(a)" }, Named{ "cos", "cos(a)" }, Named{ "tan", "tan(a * 0.3)" },
                Named{ "asin", "asin(p * 2.0 - 1.0)" }, Named{ "acos", "acos(p * 2.0 - 1.0)" },
                Named{ "atan", "atan(a)" }, Named{ "atan2", "atan(a, b)" }, Named{ "atanInSum", "atan(a, b) * c + p" },
                Named{ "acosInSum", "acos(p) * c + p + atan(a)" }, Named{ "sinInSum", "sin(a) * c + cos(b) * p" },
                Named{ "powInSum", "pow(p, vec4(2.0)) * c + pow(p, vec4(0.5)) + sqrt(p) * 0.0" },
                Named{ "manyTerms", "a + b + c + p + a.yzwx + b.yzwx + c.yzwx" },
                Named{ "manyFactors", "a * b * c * p * a.yzwx * b.yzwx * c.yzwx" },
                Named{ "constantTerms", "(a + kSpec) + 2.7 + kSpec" },
                Named{ "sumOfTextures", "texture(smooth_, a.xy) + texture(smooth_, b.xy) + texture(smooth_, c.xy) + "
                                        "texture(smooth_, p.xy)" },
                Named{ "sinh", "sinh(a)" }, Named{ "cosh", "cosh(a)" }, Named{ "tanh", "tanh(a)" },
                Named{ "asinh", "asinh(a)" }, Named{ "acosh", "acosh(1.0 + abs(a))" },
                Named{ "atanh", "atanh(p * 1.9 - 0.95)" }, Named{ "radians", "radians(a)" },
                Named{ "degrees", "degrees(a)" }, Named{ "smoothstep", "smoothstep(min(a, b), max(a, b) + 0.1, c)" },
                Named{ "smoothstepConstant", "smoothstep(0.2, 0.7, p)" }, Named{ "step", "step(a, b) + p" },
                Named{ "clamp", "clamp(a, -p, p)" }, Named{ "saturate", "clamp(a * 0.3, 0.0, 1.0)" },
                Named{ "modulo", "mod(a, abs(b) + 0.1)" }, Named{ "moduloConstant", "mod(a, 0.3)" },
                Named{ "fract", "fract(a * 17.0)" }, Named{ "floor", "floor(a * 9.0) + ceil(b * 9.0) * 0.1" },
                Named{ "round", "roundEven(a * 9.0) + trunc(b * 9.0) * 0.1" }, Named{ "fma", "fma(a, b, c)" },
                Named{ "multiplyAdd", "a * b + c" }, Named{ "longSum", "a + b + c + p + a * c + b * p + 3.0 + a" },
                Named{ "longProduct", "a * b * c * p * 3.0 * a" },
                Named{ "polynomial", "((a * b + 0.25) * b - 1.5) * b + c" }, Named{ "matrixTimesVector", "m * a" },
                Named{ "vectorTimesMatrix", "a * m" }, Named{ "matrixTimesMatrix", "(m * n) * a" },
                Named{ "outerProduct", "outerProduct(a, b) * c" }, Named{ "transpose", "transpose(m) * a" },
                Named{ "determinant", "a * determinant(m) + determinant(mat3(n)) * b" },
                Named{ "inverse", "inverse(m) * a" },
                Named{ "inverse3", "vec4(inverse(mat3(a.xyz, b.xyz, c.xyz))[1], 0)" },
                Named{ "derivatives", "dFdx(a) + dFdy(b) + fwidth(c)" }, Named{ "texture", "texture(smooth_, a.xy)" },
                Named{ "textureSlow", "texture(smooth_, gl_FragCoord.xy * 0.013)" },
                Named{ "textureLod", "textureLod(smooth_, a.xy, p.x * 3.0)" },
                Named{ "textureGrad", "textureGrad(smooth_, a.xy, p.xy * 0.1, p.zw * 0.1)" },
                Named{ "textureCube", "textureLod(cube, a.xyz, p.x * 3.0)" },
                Named{ "textureCubeImplicit", "texture(cube, vec3(gl_FragCoord.xy * 0.03 - 1.0, 1.0))" },
                Named{ "fragCoord", "gl_FragCoord * a" },
                Named{ "integers", "vec4(ivec4(a * 100.0) % 7 + (ivec4(b * 100.0) << 2)) + p" },
                Named{ "select", "a.x < b.x ? a : b" }, Named{ "sign", "sign(a) * p" },
                Named{ "schlick", "p.xxxx + (1.0 - p.xxxx) * pow(1.0 - p.yyyy, vec4(5.0))" },
                Named{ "ggx", "vec4(p.x * p.x / (3.14159265 * pow((p.y * p.y) * (p.x * p.x - 1.0) + 1.0, 2.0)))" }),
        [](auto const& each) { return std::string(each.param.name); });

/// The formulas of ExactFormulas.h compute GLSL's functions: identities of the mathematical functions.
class ExactFormulas : public ExactBits {};

TEST_P(ExactFormulas, SatisfyTheIdentity) {
    const Result<std::vector<uint32_t>> residual = vulkan().values(GetParam().expression, true);
    ASSERT_TRUE(residual) << residual.error().message;
    float largest = 0;
    for (const uint32_t bits : *residual) largest = std::max(largest, std::abs(std::bit_cast<float>(bits)));
    EXPECT_LT(largest, 2e-5f) << GetParam().expression;
}

INSTANTIATE_TEST_SUITE_P(
        Of, ExactFormulas,
        ::testing::Values(
                Named{ "dot", "vec4(dot(a, b) - (a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w))" },
                Named{ "normalize", "vec4(length(normalize(a.xyz)) - 1.0, length(normalize(b)) - 1.0, "
                                    "cross(normalize(a.xyz), normalize(a.xyz) * 2.0).xy)" },
                Named{ "reflect", "vec4(dot(reflect(a.xyz, normalize(b.xyz)) + a.xyz, cross(normalize(b.xyz), c.xyz)) "
                                  "- 2.0 * dot(a.xyz, cross(normalize(b.xyz), c.xyz)))" },
                Named{ "refract", "vec4(length(cross(refract(-normalize(a.xyz), normalize(a.xyz + 0.3 * p.xyz), 0.7), "
                                  "normalize(a.xyz + 0.3 * p.xyz)))"
                                  " - 0.7 * length(cross(normalize(a.xyz), normalize(a.xyz + 0.3 * p.xyz))))" },
                Named{ "mix", "mix(a, b, p) - (a * (1.0 - p) + b * p)" },
                Named{ "asin", "sin(asin(p * 2.0 - 1.0)) - (p * 2.0 - 1.0)" },
                Named{ "acos", "cos(acos(p * 2.0 - 1.0)) - (p * 2.0 - 1.0)" },
                Named{ "atan", "sin(atan(a)) * inversesqrt(1.0 / (1.0 + a * a)) - a" },
                Named{ "atan2Sine", "sin(atan(a, b)) * sqrt(a * a + b * b) - a" },
                Named{ "atan2Cosine", "cos(atan(a, b)) * sqrt(a * a + b * b) - b" },
                Named{ "tanh", "tanh(a) - sinh(a) / cosh(a)" }, Named{ "asinh", "(sinh(asinh(a)) - a) * 0.5" },
                Named{ "acosh", "(cosh(acosh(1.0 + abs(a))) - 1.0 - abs(a)) * 0.5" },
                Named{ "atanh", "tanh(atanh(p * 1.8 - 0.9)) - (p * 1.8 - 0.9)" },
                Named{ "smoothstep", "smoothstep(0.0, 1.0, p) - p * p * (3.0 - 2.0 * p)" },
                Named{ "mod", "(mod(a, 0.75) + 0.75 * floor(a / 0.75) - a)" },
                Named{ "degrees", "(degrees(radians(a)) - a)" },
                Named{ "matrixProduct", "((m * n) * p - m * (n * p)) * 0.1" },
                Named{ "vectorTimesMatrix", "p * m - transpose(m) * p" },
                Named{ "inverse", "(inverse(m) * (m * p) - p) * 0.1" },
                Named{ "inverse3", "vec4((inverse(mat3(n)) * (mat3(n) * p.xyz) - p.xyz) * 0.1, 0)" },
                Named{ "determinant", "vec4((determinant(m * n) - determinant(m) * determinant(n)) * 0.001)" },
                Named{ "outerProduct", "outerProduct(p, p.yzwx) * p - p * dot(p.yzwx, p)" },
                Named{ "integerModulo", "vec4((int(a.x * 100.0) / 7) * 7 + int(a.x * 100.0) % 7 - int(a.x * 100.0))" }),
        [](auto const& each) { return std::string(each.param.name); });

/// The mutation that proves the test: without the pass, the results differ.
TEST_F(ExactBits, DifferSomewhereWithoutTheLowering) {
    size_t different = 0;
    std::string names;
    for (const char* expression :
         { "vec4(dot(a.xyz, b.xyz), dot(b, c), 0, 0)", "m * a", "mix(a, b, p)", "vec4(normalize(a.xyz), 0)", "a / 3.0",
           "asin(p * 2.0 - 1.0)", "inverse(m) * a", "reflect(a, b)", "sinh(a)" }) {
        const Comparison result = run(expression, false);
        if (result.different > 0)
            names += std::string(expression) + ": " + std::to_string(result.different) + " values\n";
        different += result.different;
    }
    EXPECT_GT(different, 0u);
    RecordProperty("different", names);
}

} // namespace
} // namespace filament_core::shader
