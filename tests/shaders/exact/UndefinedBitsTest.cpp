// SPDX-License-Identifier: Apache-2.0
// What GLSL leaves undefined has one result on both devices: docs/materials-undefined.md, row by row.
#include "tests/shaders/exact/BothDevices.h"
#include "tests/shaders/exact/ExpressionRig.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::shader {
namespace {

using test::ExpressionRig;

struct Corner {
    const char* name;
    const char* expression; ///< undefined in GLSL for some or all of the inputs
    const char* meaning;    ///< what it is defined as; "nan" where it is not a number for every input
    const char* statements = "";
};

bool isSame(uint32_t x, uint32_t y) { // one NaN is as good as another: no operation but bit casts tells them apart
    const auto a = std::bit_cast<float>(x), b = std::bit_cast<float>(y);
    return x == y || (a != a && b != b);
}

class UndefinedBits : public test::BothDevices<ExpressionRig>, public ::testing::WithParamInterface<Corner> {
protected:
    static std::vector<uint32_t> values(ExpressionRig& rig, std::string const& expression) {
        const Result<std::vector<uint32_t>> result = rig.values(expression, true, GetParam().statements);
        EXPECT_TRUE(result) << (result ? "" : result.error().message);
        return result ? *result : std::vector<uint32_t>{};
    }

    static void expectSame(std::vector<uint32_t> const& actual, std::vector<uint32_t> const& expected,
                           const char* what) {
        ASSERT_EQ(actual.size(), expected.size());
        size_t different = 0, first = 0;
        for (size_t i = 0; i < actual.size(); ++i) {
            if (!isSame(actual[i], expected[i]) && different++ == 0) first = i;
        }
        EXPECT_EQ(different, 0u) << what << ", " << GetParam().expression << ": first at " << first << ": "
                                 << std::bit_cast<float>(actual[first]) << " instead of "
                                 << std::bit_cast<float>(expected[first]);
    }
};

TEST_P(UndefinedBits, AreDefinedAndTheSameOnBothApis) {
    const std::vector<uint32_t> onVulkan = values(vulkan(), GetParam().expression);
    const std::vector<uint32_t> onGles = values(gles(), GetParam().expression);
    expectSame(onGles, onVulkan, "OpenGL ES against Vulkan");
    expectSame(onVulkan, values(vulkan(), GetParam().meaning), "Vulkan against the definition");
}

// zero and izero are 0, but only at run time.
constexpr const char* kNan = "vec4(uintBitsToFloat(0x7FC00000u))";
constexpr const char* kZero = "float zero = floor(p.x); int izero = int(zero);";
constexpr const char* kUnset = "vec4 unset; if (a.x > 0.0) unset = b;";
constexpr const char* kUnsetArray = "float list[4]; list[int(p.x * 3.9)] = a.x;";
constexpr const char* kList = "float list[4]; list[0] = a.x; list[1] = a.y; list[2] = a.z; list[3] = a.w;";
INSTANTIATE_TEST_SUITE_P(
        Of, UndefinedBits,
        ::testing::Values(
                Corner{ "pow1", "pow(a, vec4(1.0))", "a" }, Corner{ "pow2", "pow(a, vec4(2.0))", "a * a" },
                Corner{ "pow3", "pow(a, vec4(3.0))", "a * a * a" },
                Corner{ "pow4", "pow(a, vec4(4.0))", "(a * a) * (a * a)" },
                Corner{ "pow5", "pow(a, vec4(5.0))", "(a * a) * (a * a) * a" },
                Corner{ "pow8", "pow(a, vec4(8.0))", "((a * a) * (a * a)) * ((a * a) * (a * a))" },
                Corner{ "pow0", "pow(a * zero, vec4(0.0))", "vec4(1.0)", kZero },
                Corner{ "powReciprocal", "pow(a, vec4(-2.0))", "1.0 / (a * a)" },
                Corner{ "powMixed", "pow(a, vec4(1.0, 2.0, 3.0, 4.0))",
                        "vec4(a.x, a.y * a.y, a.z * a.z * a.z, (a.w * a.w) * (a.w * a.w))" },
                Corner{ "powSpecialised", "pow(p, vec4(kSpec))", "pow(p, vec4(kSpec))" },
                Corner{ "powOfTwo", "pow(vec4(2.0), a)", "exp2(a)" },
                Corner{ "powOfOne", "pow(vec4(1.0), a)", "vec4(1.0)" }, Corner{ "powNegative", "pow(-p, b)", kNan },
                Corner{ "powNegativeRoot", "pow(-p, vec4(2.5))", kNan },
                Corner{ "intTooLarge", "vec4(int(1e20 * p.x), int(1e20 * -p.y), int(3e9 * (p.z + 1.0)), 0)",
                        "vec4(2147483520.0, -2147483648.0, 2147483520.0, 0)" },
                Corner{ "intVector", "vec4(ivec4(a * 1e15))",
                        "mix(vec4(-2147483648.0), vec4(2147483520.0), "
                        "greaterThan(a, vec4(0)))" },
                Corner{ "uintTooLarge", "vec4(uvec4(1e20 * p))", "vec4(4294967040.0)" },
                Corner{ "uintNegative", "vec4(uvec4(-p * 100.0))", "vec4(0)" },
                Corner{ "intOfNan", "vec4(int(sqrt(-p.x)), uint(sqrt(-p.x)), 0, 0)", "vec4(-2147483648.0, 0, 0, 0)" },
                Corner{ "divisionByZero", "vec4(p.x / zero, -p.y / zero, 0, 0)",
                        "vec4(uintBitsToFloat(0x7F800000u), uintBitsToFloat(0xFF800000u), 0, 0)", kZero },
                Corner{ "zeroByZero", "vec4(zero / zero)", kNan, kZero },
                Corner{ "intByZero",
                        "vec4(int(a.x * 100.0) / izero, int(a.y * 100.0) % izero, "
                        "float(uint(p.x * 100.0) / uint(izero)), float(uint(p.y * 100.0) % uint(izero)))",
                        "vec4(0, int(a.y * 100.0) + izero, 4294967295.0, 4294967295.0)", kZero },
                Corner{ "normalizeZero", "vec4(normalize(a.xyz * zero), 0)", "vec4(a.xyz * zero, 0)", kZero },
                Corner{ "normalizeKnownZero", "vec4(normalize(a.xyz * 0.0), normalize(b.xy * 0.0).x)", "vec4(0)" },
                Corner{ "asinOutside", "asin(vec4(1.1, -1.1, 1.0, 5.0) + vec4(zero))",
                        "vec4(asin(1.0), -asin(1.0), asin(1.0), asin(1.0))", kZero },
                Corner{ "acosOutside", "acos(vec4(1.1, -1.1, 1.0, -5.0) + vec4(zero))",
                        "vec4(0.0, 2.0 * asin(1.0), 0.0, 2.0 * asin(1.0))", kZero },
                Corner{ "acoshOutside", "acosh(p)", kNan }, Corner{ "atanhOutside", "atanh(1.5 + p)", kNan },
                Corner{ "sqrtNegative", "sqrt(-p)", kNan }, Corner{ "inversesqrtNegative", "inversesqrt(-p)", kNan },
                Corner{ "inversesqrtZero", "inversesqrt(vec4(zero))", "vec4(uintBitsToFloat(0x7F800000u))", kZero },
                Corner{ "logNegative", "log(-p)", kNan }, Corner{ "log2Negative", "log2(-p)", kNan },
                Corner{ "logZero", "vec4(log2(zero))", "vec4(uintBitsToFloat(0xFF800000u))", kZero },
                Corner{ "modZero", "mod(a, vec4(zero))", kNan, kZero }, Corner{ "modZeroConstant", "mod(a, 0.0)", "a" },
                Corner{ "modOfKnownZeros",
                        "vec4(mod(unset, unset), mod(a.xy, vec2(0.0, 0.5)), clamp(mod(unset, 0.0), -1.0, 1.0))",
                        "vec4(0.0, a.x, mod(a.y, 0.5), 0.0)", "float unset;" },
                Corner{ "quotientsOfKnownZeros",
                        "vec4(unset / unset, smoothstep(0.5, 0.5, unset + 0.5), clamp(unset / 0.0, -1.0, 1.0), 0.0)",
                        "vec4(sqrt(-p.x), 0.0, -1.0, 0.0)", "float unset;" },
                Corner{ "atanZero", "vec4(atan(zero, zero))", "vec4(0)", kZero },
                Corner{ "clampReversed", "clamp(a, vec4(2.0), b)", "min(max(a, vec4(2.0)), b)" },
                Corner{ "clampReversedConstant", "clamp(a, 2.0, 1.0)", "vec4(1.0)" },
                Corner{ "clampReversedUnit", "clamp(a, 1.0, 0.0)", "vec4(0.0)" },
                Corner{ "clampReversedInt", "vec4(clamp(ivec4(a * 10.0), ivec4(5), ivec4(izero - 5)))", "vec4(-5.0)",
                        kZero },
                Corner{ "clampNan", "clamp(sqrt(-p), 0.0, 1.0)", "vec4(0.0)" },
                Corner{ "minOfNan", "min(sqrt(-p), a)", "a" }, Corner{ "maxOfNan", "max(a, sqrt(-p))", "a" },
                Corner{ "minOfAKnownNan", "min(p, atanh(vec4(-0.5, 0.1, 3.0, 3.0))) + min(atanh(vec4(3.0)), a)",
                        "min(p, vec4(atanh(vec2(-0.5, 0.1) + zero), 2.0, 2.0)) + a", kZero },
                Corner{ "maxOfAKnownNan", "max(p, atanh(vec4(0.5, 0.1, 3.0, 3.0))) + max(atanh(vec4(3.0)), a)",
                        "max(p, vec4(atanh(vec2(0.5, 0.1) + zero), -1.0, -1.0)) + a", kZero },
                Corner{ "limitsOfKnownNans",
                        "clamp(vec4(0.5), p, atanh(vec4(-0.5, 0.1, 3.0, 0.2))) + clamp(a, acosh(-b * 0.0), vec4(0.5)) "
                        "+ "
                        "vec4(min(none, none + 1.0), max(1.0, none), clamp(2.0, none, 3.0), clamp(none, -1.0, 1.0))",
                        "vec4(min(max(p.xy, 0.5), atanh(vec2(-0.5, 0.1) + zero)), max(0.5, p.z), "
                        "min(max(0.5, p.w), atanh(0.2 + zero))) + min(a, vec4(0.5)) + "
                        "vec4(sqrt(-1.0 - zero), 1.0, 2.0, -1.0)",
                        "float zero = floor(p.x); float unset; float none = atanh(unset + 3.0);" },
                Corner{ "arcsOfKnownNans",
                        "vec4(asin(atanh(3.0)), acos(atanh(3.0)), atan(atanh(3.0)), atan(2.0, atanh(3.0)))", kNan },
                Corner{ "signOfNan", "sign(sqrt(-p)) * 0.0 + sign(atanh(vec4(3.0)))", "sign(sqrt(-p))" },
                Corner{ "smoothstepEqual", "smoothstep(vec4(zero), vec4(zero), a)", "step(vec4(0), a)", kZero },
                Corner{ "smoothstepEqualConstant", "smoothstep(0.5, 0.5, a)", "step(0.5, a)" },
                Corner{ "smoothstepReversed", "smoothstep(1.0, 0.0, p)", "(1.0 - p) * (1.0 - p) * (1.0 + 2.0 * p)" },
                Corner{ "shiftBy32", "vec4(uvec4(p * 100.0) << (uvec4(32, 33, 0, 35) + uint(izero)))",
                        "vec4(uvec4(p * 100.0) << uvec4(0, 1, 0, 3))", kZero },
                Corner{ "shiftByNegative", "vec4(ivec4(p * 100.0) << (izero - 31))", "vec4(ivec4(p * 100.0) << 1)",
                        kZero },
                Corner{ "shiftRightBy32", "vec4(ivec4(a * 100.0) >> (izero + 32))", "vec4(ivec4(a * 100.0) + izero)",
                        kZero },
                Corner{ "indexTooLarge", "vec4(list[4 + int(p.x * 100.0)])", "vec4(a.w)", kList },
                Corner{ "indexNegative", "vec4(list[-1 - int(p.x * 100.0)])", "vec4(a.x)", kList },
                Corner{ "indexOfVector", "vec4(a[4 + int(p.x * 100.0)])", "vec4(a.w)" },
                Corner{ "indexOfVectorNegative", "vec4(a[-1 - int(p.x * 100.0)])", "vec4(a.x)" },
                Corner{ "stepOfNan",
                        "step(vec4(0.5), vec4(nan, b.x, nan, c.x)) + step(vec4(nan, nan, a.xy), vec4(0.5))",
                        "vec4(2.0, b.x < 0.5 ? 1.0 : 2.0, 0.5 < a.x ? 1.0 : 2.0, "
                        "(c.x < 0.5 ? 0.0 : 1.0) + (0.5 < a.y ? 0.0 : 1.0))",
                        "float nan = sqrt(-p.x) * exp(b.x);" },
                Corner{ "bitsOfNan",
                        "vec4(float(floatBitsToInt(nan) >> 16), float(floatBitsToUint(-nan) >> 16u), "
                        "float(packHalf2x16(vec2(nan, -nan)) >> 16u), float(packHalf2x16(vec2(nan, -nan)) & 0xFFFFu))",
                        "vec4(32704.0, 32704.0, 32256.0, 32256.0)",
                        "float nan = sqrt(-p.x) * exp(b.x) + intBitsToFloat(-1);" },
                Corner{ "functionsOfFunctions",
                        "log(exp2(b)) + exp2(log2(p)) * sqrt(exp2(a)) + log2(sqrt(p)).x + inversesqrt(exp2(c)).yxzw + "
                        "log2(pow(p, b)) + exp(log(exp2(c).x))",
                        "log(exp2(b) + zero) + exp2(log2(p) + zero) * sqrt(exp2(a) + zero) + log2(sqrt(p) + zero).x + "
                        "inversesqrt(exp2(c) + zero).yxzw + log2(pow(p, b) + zero) + exp(log(exp2(c).x + zero) + zero)",
                        kZero },
                Corner{ "unpackedConstants",
                        "vec4(unpackHalf2x16(uint(three) * 0x14001C00u), unpackUnorm2x16(uint(three) * 0x15555u).y, "
                        "unpackSnorm2x16(uint(three) * 0x15552AAAu).y)",
                        "vec4(unpackHalf2x16(0x3C005400u + uint(izero)), unpackUnorm2x16(0x3FFFFu + uint(izero)).y, "
                        "unpackSnorm2x16(0x3FFF7FFEu + uint(izero)).y)",
                        "float three = sqrt(9.0); float zero = floor(p.x); int izero = int(zero);" },
                Corner{ "bitCountBesideALargeNumber",
                        "vec4(bitCount(bits) == 0x60000000, findLSB(bits) == 0x10000 + firstBit, "
                        "findMSB(bits) == 0x7FFF0000 + lastBit, findMSB(int(bits)) != 0x30000 + lastBit)",
                        "vec4(0.0, 0.0, 0.0, 1.0)",
                        "uint bits = uint(p.x) * 7u; int firstBit = findLSB(bits), lastBit = findMSB(bits);" },
                Corner{ "indexFoldedToAConstant", "vec4((a + b)[five], list[five], square[five].x, (a + b)[-five])",
                        "vec4(a.w + b.w, a.w, p.x, a.x + b.x)",
                        "int five = 5; mat4 square = mat4(a, b, c, p); float list[4]; list[0] = a.x; list[1] = a.y; "
                        "list[2] = a.z; list[3] = a.w;" },
                Corner{ "indexOfMatrix", "square[4 + int(p.x * 100.0)]", "p", "mat4 square = mat4(a, b, c, p);" },
                Corner{ "storeTooLarge", "vec4(list[0], list[1], list[2], list[3])", "vec4(a.xyz, b.x)",
                        "float list[4]; list[0] = a.x; list[1] = a.y; list[2] = a.z; list[4 + int(p.x * 9.0)] = b.x;" },
                Corner{ "uninitialised", "unset", "a.x > 0.0 ? b : vec4(0)", kUnset },
                Corner{ "uninitialisedArray", "vec4(list[0], list[1], list[2], list[3])",
                        "mix(vec4(0), vec4(a.x), equal(ivec4(p.x * 3.9), ivec4(0, 1, 2, 3)))", kUnsetArray },
                Corner{ "reflectLength0", "vec4(refract(vec3(zero), vec3(zero), 0.5), 0)", "vec4(0)", kZero }),
        [](auto const& each) { return std::string(each.param.name); });

} // namespace
} // namespace filament_core::shader
