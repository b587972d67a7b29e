// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::shader::numerics {
namespace {

constexpr float kFloatMax = std::numeric_limits<float>::max();
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kHalfMax = 65504.0f;

/// The interval in one format, as floats inside it.
struct Bounds {
    float low = 0, high = 0;
    bool open = false;
    bool contains(float x) const { return x >= low && (open ? x < high : x <= high); }
};

Bounds boundsOf(Argument const& argument, Format format) {
    const bool half = format == Format::Half;
    return { static_cast<float>(half ? argument.halfLow : argument.low),
             static_cast<float>(half ? argument.halfHigh : argument.high), argument.open };
}

/// One step of the format towards `direction`.
float next(float x, float direction, Format format) {
    if (format == Format::Single) return std::nextafter(x, direction);
    const float sign = direction > x ? 1.0f : -1.0f;
    const float step = std::max(std::ldexp(1.0f, std::max(std::ilogb(x), -14) - 10), 0x1p-24f);
    const float near = halfRounded(x + sign * step * 0.5f);
    return near != x ? near : halfRounded(x + sign * step);
}

/// Numbers that are often handled wrongly: of both signs, the steps around 0 and 1, and one per decade.
std::vector<float> notableNumbers() {
    std::vector<float> numbers{ 0.0f,    1e-45f, 1e-40f, std::numeric_limits<float>::min(),
                                1e-30f,  1e-20f, 1e-15f, 1e-10f,
                                1e-9f,   1e-8f,  6e-8f,  1e-7f,
                                3e-7f,   1e-6f,  6e-6f,  1e-5f,
                                0x1p-14f };
    for (float decade = 1e-4f; decade < 1e38f; decade *= 10.0f)
        numbers.insert(numbers.end(), { decade, decade * 3.0f });
    for (const float below : { 0x1p-24f, 1e-7f, 1e-6f, 1e-5f, 1e-4f, 0x1p-11f, 1e-3f, 1e-2f }) {
        numbers.push_back(1.0f - below);
        numbers.push_back(1.0f + 2.0f * below);
    }
    for (const float edge : { 0.0031308f, 0.04045f, 0.089f, 0.7071068f, kHalfMax, kFloatMax }) numbers.push_back(edge);
    const size_t positive = numbers.size();
    for (size_t i = 0; i < positive; ++i) numbers.push_back(-numbers[i]);
    return numbers;
}

/// The ends, one step inside each, notable numbers, and even subdivisions of the interval or of its first unit.
std::vector<float> numbersIn(Bounds bounds, Format format, uint32_t divisions) {
    std::vector<float> numbers = notableNumbers();
    numbers.insert(numbers.end(), { bounds.low, next(bounds.low, kFloatMax, format), bounds.high,
                                    next(bounds.high, -kFloatMax, format) });
    for (const float width : { std::min(bounds.high - bounds.low, 1.0f), std::min(bounds.high - bounds.low, 32.0f) }) {
        for (uint32_t i = 1; i < divisions; ++i)
            numbers.push_back(bounds.low + width * static_cast<float>(i) / static_cast<float>(divisions));
    }
    if (format == Format::Half) std::transform(numbers.begin(), numbers.end(), numbers.begin(), halfRounded);
    std::erase_if(numbers, [&](float x) { return !bounds.contains(x); });
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

glm::vec4 rounded(glm::vec4 value, Format format) {
    if (format == Format::Single) return value;
    for (int i = 0; i < 4; ++i) value[i] = halfRounded(value[i]);
    return value;
}

/// Axes, diagonals, and directions that deviate from the z and the x axis by 1e-7 to 1.4 radians.
std::vector<glm::vec3> directions() {
    std::vector<glm::vec3> result{ { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
    for (const float x : { -1.0f, 1.0f }) {
        for (const float y : { -1.0f, 1.0f }) {
            for (const float z : { -1.0f, 1.0f }) result.push_back(glm::normalize(glm::vec3(x, y, z)));
        }
    }
    for (const float angle :
         { 1e-7f, 1e-6f, 1e-5f, 1e-4f, 3e-4f, 1e-3f, 3e-3f, 1e-2f, 3e-2f, 0.1f, 0.3f, 1.0f, 1.4f }) {
        const float c = std::cos(angle), s = std::sin(angle);
        result.insert(result.end(), { { s, 0, c }, { 0.6f * s, -0.8f * s, c }, { c, 0, -s } });
    }
    return result;
}

std::vector<glm::vec4> rotations() {
    std::vector<glm::vec4> result;
    for (const float sign : { -1.0f, 1.0f }) { // tiny w: the writer keeps it above zero
        for (const glm::vec3 axis : directions()) {
            for (const float w : { 1.0f, 0.92f, 0.5f, 1e-2f, 1.0f / 32767.0f }) {
                result.emplace_back(axis * std::sqrt(1.0f - w * w), sign * w);
            }
        }
    }
    return result;
}

/// Greys, then saturated and mixed colours; `high` scales them, and tiny ones are added.
std::vector<glm::vec3> colours(float high) {
    std::vector<glm::vec3> result;
    for (const float scale : { high, std::min(high, 1.0f), 1e-3f, 1e-7f }) {
        for (const glm::vec3 hue : { glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 1, 0),
                                     glm::vec3(0, 1, 1), glm::vec3(1, 0.5f, 0.02f), glm::vec3(0.9f, 0.6f, 0.4f) })
            result.push_back(hue * scale);
    }
    return result;
}

} // namespace

Grid gridOf(Argument const& argument, Format format, uint32_t divisions) {
    Grid grid;
    const Bounds bounds = boundsOf(argument, format);
    const auto add = [&](glm::vec4 value) { grid.values.push_back(rounded(value, format)); };
    switch (argument.kind) {
    case Kind::Direction:
        for (const glm::vec3 d : directions()) add({ d, 0 });
        break;
    case Kind::Rotation:
        for (const glm::vec4 q : rotations()) add(q);
        break;
    case Kind::Offset:
        for (const float length : numbersIn(bounds, format, divisions)) {
            for (const glm::vec3 d : { glm::vec3(0, 0, 1), glm::vec3(-1, 0, 0), glm::vec3(0.6f, -0.8f, 0) })
                add({ d * length, 0 });
        }
        break;
    case Kind::Colour:
        for (const float grey : numbersIn(bounds, format, divisions)) add(glm::vec4(glm::vec3(grey), 0));
        grid.orderedCount = static_cast<uint32_t>(grid.values.size());
        for (const glm::vec3 c : colours(bounds.high)) add({ c, 0 });
        break;
    case Kind::Integer:
        for (const float x : numbersIn(bounds, format, divisions)) {
            if (x == std::floor(x)) add({ x, 0, 0, 0 });
        }
        grid.orderedCount = static_cast<uint32_t>(grid.values.size());
        break;
    case Kind::Number:
        for (const float x : numbersIn(bounds, format, divisions)) add({ x, 0, 0, 0 });
        grid.orderedCount = static_cast<uint32_t>(grid.values.size());
    }
    return grid;
}

std::vector<Beyond> beyondOf(Argument const& argument, Format format) {
    std::vector<Beyond> result;
    if (argument.kind == Kind::Integer) return result; // converting it is undefined in both languages
    const bool vector = argument.kind != Kind::Number;
    const auto add = [&](glm::vec4 value, OutsideInput input) { result.push_back({ rounded(value, format), input }); };
    const auto spread = [&](float x) { return vector ? glm::vec4(x) : glm::vec4(x, 0, 0, 0); };
    const Bounds bounds = boundsOf(argument, format);
    const float huge = format == Format::Single ? kFloatMax : kHalfMax;
    const float far = format == Format::Single ? 100.0f : 4.0f; // its fifth power must stay moderate
    std::vector<float> near{
        next(bounds.low, -huge, format), next(bounds.high, huge, format), -1.0f, -0.1f, 2.0f, far
    };
    if (argument.kind == Kind::Direction || argument.kind == Kind::Rotation) near = { 0.0f, -1.0f, 1.0f, far };
    for (const float x : near) {
        if (vector || !bounds.contains(x)) add(spread(x), OutsideInput::Beyond);
    }
    for (const float x : { -huge, huge }) {
        if (vector || !bounds.contains(x)) add(spread(x), OutsideInput::Huge);
    }
    for (const float x : { kFloatInfinity, -kFloatInfinity }) add(spread(x), OutsideInput::Infinite);
    add(spread(kNaN), OutsideInput::NaN);
    if (vector) add({ 0, kNaN, 0, 0 }, OutsideInput::NaN);
    return result;
}

} // namespace filament_core::shader::numerics
