// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/HalfPrecision.h"

#include "filament_core/math/Half.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

namespace filament::shader {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordPart(char c) { return isDigit(c) || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

struct Renamed {
    std::string_view from, to;
};
constexpr std::array<Renamed, 7> kTypes{ { { "float", "float16_t" },
                                           { "vec2", "f16vec2" },
                                           { "vec3", "f16vec3" },
                                           { "vec4", "f16vec4" },
                                           { "mat2", "f16mat2" },
                                           { "mat3", "f16mat3" },
                                           { "mat4", "f16mat4" } } };

std::string_view renamed(std::string_view word) {
    for (Renamed const& type : kTypes) {
        if (word == type.from) return type.to;
    }
    return word;
}

/// A digit, or a point before one, begins a number: letters, digits and points, and a sign behind a decimal exponent.
size_t numberLength(std::string_view text) {
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    size_t length = 0;
    while (length < text.size()) {
        const char c = text[length];
        const bool sign = (c == '+' || c == '-') && !hexadecimal && length > 0 &&
                          (text[length - 1] == 'e' || text[length - 1] == 'E');
        if (!isWordPart(c) && c != '.' && !sign) break;
        ++length;
    }
    return length;
}

bool isFloatLiteral(std::string_view number) {
    if (number.starts_with("0x") || number.starts_with("0X")) return false;
    return number.find_first_of(".eE") != std::string_view::npos;
}

void appendNumber(std::string& result, std::string_view number) {
    if (!isFloatLiteral(number)) {
        result += number;
        return;
    }
    // glslang would cut the digits that do not fit; the nearest number of 16 bits survives as it is
    const float nearest = floatFromHalf(halfFromFloat(std::strtof(std::string(number).c_str(), nullptr)));
    result += fmt::format("{:#.12g}hf", nearest);
}

} // namespace

std::string float16FromGlsl(std::string_view glsl) {
    std::string result;
    result.reserve(glsl.size() + glsl.size() / 8);
    while (!glsl.empty()) {
        const bool number = isDigit(glsl[0]) || (glsl[0] == '.' && glsl.size() > 1 && isDigit(glsl[1]));
        size_t length = 1;
        if (number) {
            length = numberLength(glsl);
            appendNumber(result, glsl.substr(0, length));
        } else if (isWordPart(glsl[0])) {
            while (length < glsl.size() && isWordPart(glsl[length])) ++length;
            result += renamed(glsl.substr(0, length));
        } else {
            result += glsl[0];
        }
        glsl.remove_prefix(length);
    }
    return result;
}

} // namespace filament::shader
