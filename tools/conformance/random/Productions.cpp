// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/random/Productions.h"

#include <array>
#include <sstream>

namespace filament_core::conformance {
namespace {

/// A family letter in `result` and `arguments` is expanded to the types with `least` to 4 components; in the text it
/// stands behind '%': "%F($0)". Lower-case letters are the scalars: f, i, u, b.
struct Row {
    const char* result;
    const char* text;
    const char* arguments;
    int least = 1;
    bool inVertex = true;
    int featureLevel = 1;
};

// GLSL ES 3.10, 5.9 (operators) and chapter 8 (functions).
constexpr Row kRows[] = {
    // operators
    { "F", "($0 + $1)", "F F" },
    { "F", "($0 - $1)", "F F" },
    { "F", "($0 * $1)", "F F" },
    { "F", "($0 / $1)", "F F" },
    { "F", "($0 * $1)", "F f", 2 },
    { "F", "($0 + $1)", "f F", 2 },
    { "F", "($0 / $1)", "F f", 2 },
    { "F", "(-$0)", "F" },
    { "F", "($0 ? $1 : $2)", "b F F" },
    { "I", "($0 + $1)", "I I" },
    { "I", "($0 - $1)", "I I" },
    { "I", "($0 * $1)", "I I" },
    { "I", "($0 / $1)", "I I" },
    { "I", "($0 % $1)", "I I" },
    { "I", "($0 & $1)", "I I" },
    { "I", "($0 | $1)", "I i" },
    { "I", "($0 ^ $1)", "I I" },
    { "I", "($0 << $1)", "I I" },
    { "I", "($0 >> $1)", "I I" },
    { "I", "(~$0)", "I" },
    { "I", "($0 ? $1 : $2)", "b I I" },
    { "U", "($0 + $1)", "U U" },
    { "U", "($0 - $1)", "U U" },
    { "U", "($0 * $1)", "U U" },
    { "U", "($0 / $1)", "U U" },
    { "U", "($0 % $1)", "U U" },
    { "U", "($0 & $1)", "U U" },
    { "U", "($0 ^ $1)", "U U" },
    { "U", "($0 << $1)", "U U" },
    { "U", "($0 >> $1)", "U U" },
    { "b", "($0 < $1)", "f f" },
    { "b", "($0 >= $1)", "f f" },
    { "b", "($0 > $1)", "i i" },
    { "b", "($0 <= $1)", "u u" },
    { "b", "($0 == $1)", "F F" },
    { "b", "($0 != $1)", "I I" },
    { "b", "($0 && $1)", "b b" },
    { "b", "($0 || $1)", "b b" },
    { "b", "($0 ^^ $1)", "b b" },
    { "b", "(!$0)", "b" },
    // components, constructors and conversions
    { "f", "$0.x", "F", 2 },
    { "f", "$0.y", "F", 2 },
    { "f", "$0[$1]", "F index", 2 },
    { "i", "$0.y", "I", 2 },
    { "u", "$0.x", "U", 2 },
    { "b", "$0.y", "B", 2 },
    { "vec2", "$0.yx", "F", 2 },
    { "vec3", "$0.zxy", "F", 3 },
    { "vec3", "$0.xxy", "F", 2 },
    { "vec4", "$0.wyzx", "vec4" },
    { "F", "%F($0)", "f", 2 },
    { "vec2", "vec2($0, $1)", "f f" },
    { "vec3", "vec3($0, $1, $2)", "f f f" },
    { "vec3", "vec3($0, $1)", "vec2 f" },
    { "vec4", "vec4($0, $1)", "vec3 f" },
    { "vec4", "vec4($0, $1)", "vec2 vec2" },
    { "vec4", "vec4($0, $1, $2, $3)", "f f f f" },
    { "F", "%F($0)", "I" },
    { "F", "%F($0)", "U" },
    { "F", "%F($0)", "B" },
    { "I", "%I($0)", "F" },
    { "I", "%I($0)", "U" },
    { "I", "%I($0)", "B" },
    { "U", "%U($0)", "F" },
    { "U", "%U($0)", "I" },
    { "B", "%B($0)", "F" },
    { "B", "%B($0)", "I" },
    { "I", "%I($0)", "i", 2 },
    { "ivec3", "ivec3($0, $1)", "ivec2 i" },
    { "U", "%U($0)", "u", 2 },
    // angles and trigonometry
    { "F", "radians($0)", "F" },
    { "F", "degrees($0)", "F" },
    { "F", "sin($0)", "F" },
    { "F", "cos($0)", "F" },
    { "F", "tan($0)", "F" },
    { "F", "asin($0)", "F" },
    { "F", "acos($0)", "F" },
    { "F", "atan($0)", "F" },
    { "F", "atan($0, $1)", "F F" },
    { "F", "sinh($0)", "F" },
    { "F", "cosh($0)", "F" },
    { "F", "tanh($0)", "F" },
    { "F", "asinh($0)", "F" },
    { "F", "acosh($0)", "F" },
    { "F", "atanh($0)", "F" },
    // exponential
    { "F", "pow($0, $1)", "F F" },
    { "F", "pow($0, %F(2.0))", "F" },
    { "F", "pow(abs($0), $1)", "F F" },
    { "F", "exp($0)", "F" },
    { "F", "log($0)", "F" },
    { "F", "exp2($0)", "F" },
    { "F", "log2($0)", "F" },
    { "F", "sqrt($0)", "F" },
    { "F", "sqrt(abs($0))", "F" },
    { "F", "inversesqrt($0)", "F" },
    // common
    { "F", "abs($0)", "F" },
    { "I", "abs($0)", "I" },
    { "F", "sign($0)", "F" },
    { "I", "sign($0)", "I" },
    { "F", "floor($0)", "F" },
    { "F", "trunc($0)", "F" },
    { "F", "round($0)", "F" },
    { "F", "roundEven($0)", "F" },
    { "F", "ceil($0)", "F" },
    { "F", "fract($0)", "F" },
    { "F", "mod($0, $1)", "F F" },
    { "F", "mod($0, $1)", "F f", 2 },
    { "F", "min($0, $1)", "F F" },
    { "F", "max($0, $1)", "F F" },
    { "F", "max($0, $1)", "F f", 2 },
    { "F", "clamp($0, $1, $2)", "F F F" },
    { "F", "clamp($0, 0.0, 1.0)", "F" },
    { "I", "min($0, $1)", "I I" },
    { "I", "clamp($0, $1, $2)", "I I I" },
    { "U", "max($0, $1)", "U U" },
    { "U", "clamp($0, $1, $2)", "U U U" },
    { "F", "mix($0, $1, $2)", "F F F" },
    { "F", "mix($0, $1, $2)", "F F f", 2 },
    { "F", "mix($0, $1, $2)", "F F B" },
    { "F", "step($0, $1)", "F F" },
    { "F", "smoothstep($0, $1, $2)", "F F F" },
    { "F", "smoothstep(0.0, 1.0, $0)", "F" },
    { "B", "isnan($0)", "F" },
    { "B", "isinf($0)", "F" },
    { "I", "floatBitsToInt($0)", "F" },
    { "U", "floatBitsToUint($0)", "F" },
    { "F", "intBitsToFloat($0)", "I" },
    { "F", "uintBitsToFloat($0)", "U" },
    // packing
    { "u", "packSnorm2x16($0)", "vec2" },
    { "u", "packUnorm2x16($0)", "vec2" },
    { "u", "packHalf2x16($0)", "vec2" },
    { "vec2", "unpackSnorm2x16($0)", "u" },
    { "vec2", "unpackUnorm2x16($0)", "u" },
    { "vec2", "unpackHalf2x16($0)", "u" },
    // geometric
    { "f", "length($0)", "F" },
    { "f", "distance($0, $1)", "F F" },
    { "f", "dot($0, $1)", "F F" },
    { "vec3", "cross($0, $1)", "vec3 vec3" },
    { "F", "normalize($0)", "F" },
    { "F", "faceforward($0, $1, $2)", "F F F" },
    { "F", "reflect($0, $1)", "F F" },
    { "F", "refract($0, $1, $2)", "F F f" },
    // matrices
    { "M", "%M($0)", "f", 2 },
    { "mat2", "mat2($0, $1)", "vec2 vec2" },
    { "mat3", "mat3($0, $1, $2)", "vec3 vec3 vec3" },
    { "mat3", "mat3($0)", "mat4" },
    { "M", "matrixCompMult($0, $1)", "M M", 2 },
    { "M", "outerProduct($0, $1)", "F F", 2 },
    { "M", "transpose($0)", "M", 2 },
    { "M", "inverse($0)", "M", 2 },
    { "M", "($0 * $1)", "M M", 2 },
    { "M", "($0 + $1)", "M M", 2 },
    { "M", "($0 * $1)", "M f", 2 },
    { "F", "($0 * $1)", "M F", 2 },
    { "F", "($0 * $1)", "F M", 2 },
    { "F", "$0[1]", "M", 2 },
    { "F", "$0[$1]", "M index", 2 },
    { "f", "determinant($0)", "M", 2 },
    // vector relations
    { "B", "lessThan($0, $1)", "F F", 2 },
    { "B", "greaterThanEqual($0, $1)", "I I", 2 },
    { "B", "equal($0, $1)", "F F", 2 },
    { "B", "notEqual($0, $1)", "U U", 2 },
    { "b", "any($0)", "B", 2 },
    { "b", "all($0)", "B", 2 },
    { "B", "not($0)", "B", 2 },
    // integers
    { "I", "bitfieldExtract($0, 3, 7)", "I", 1, true, 2 },
    { "U", "bitfieldInsert($0, $1, 5, 9)", "U U", 1, true, 2 },
    { "I", "bitfieldReverse($0)", "I", 1, true, 2 },
    { "I", "bitCount($0)", "U", 1, true, 2 },
    { "I", "findLSB($0)", "I", 1, true, 2 },
    { "I", "findMSB($0)", "U", 1, true, 2 },
    // the engine's own
    { "f", "saturate($0)", "f" },
    { "f", "max3($0)", "vec3" },
    { "f", "pow5($0)", "f" },
    { "f", "sq($0)", "f" },
    { "f", "luminance($0)", "vec3", 1, false },
    { "vec3", "inverseTonemap($0)", "vec3", 1, false },
    // derivatives
    { "F", "dFdx($0)", "F", 1, false },
    { "F", "dFdy($0)", "F", 1, false },
    { "F", "fwidth($0)", "F", 1, false },
};

std::string resolved(std::string const& word, int components) {
    if (word.size() != 1) return word;
    const char letter = word[0];
    return letter >= 'a' ? typeName(static_cast<char>(letter - 'a' + 'A'), 1) : typeName(letter, components);
}

bool hasFamily(std::string const& words) {
    for (size_t i = 0; i < words.size(); ++i) {
        const bool isAlone = (i == 0 || words[i - 1] == ' ') && (i + 1 == words.size() || words[i + 1] == ' ');
        if (isAlone && words[i] >= 'A' && words[i] <= 'Z') return true;
    }
    return false;
}

std::string resolvedText(std::string const& text, int components) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool isFamily = text[i] == '%' && i + 1 < text.size() && text[i + 1] >= 'A' && text[i + 1] <= 'Z';
        out += isFamily ? typeName(text[++i], components) : std::string(1, text[i]);
    }
    return out;
}

void expand(Row const& row, std::vector<Production>& out) {
    const bool isFamily = hasFamily(std::string(row.result) + " " + row.arguments);
    for (int components = row.least; components <= (isFamily ? 4 : row.least); ++components) {
        Production production{ .type = resolved(row.result, components),
                               .text = resolvedText(row.text, components),
                               .arguments = {},
                               .inVertex = row.inVertex,
                               .featureLevel = row.featureLevel };
        std::istringstream words(row.arguments);
        for (std::string word; words >> word;) production.arguments.push_back(resolved(word, components));
        out.push_back(std::move(production));
    }
}

} // namespace

std::string typeName(char family, int components) {
    static constexpr std::array kScalars{ "float", "int", "uint", "bool" };
    static constexpr std::array kVectors{ "vec", "ivec", "uvec", "bvec" };
    const size_t index = std::string_view("FIUB").find(family);
    if (index == std::string_view::npos) return "mat" + std::to_string(components);
    return components == 1 ? kScalars[index] : kVectors[index] + std::to_string(components);
}

int componentsOf(std::string_view type) {
    const char last = type.empty() ? '1' : type.back();
    return last >= '2' && last <= '4' ? last - '0' : 1;
}

std::vector<Production> const& languageProductions() {
    static const std::vector<Production> all = [] {
        std::vector<Production> list;
        for (Row const& row : kRows) expand(row, list);
        return list;
    }();
    return all;
}

} // namespace filament_core::conformance
