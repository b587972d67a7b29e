// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Points.h"

#include "tools/numerics/table/Grid.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>

namespace filament_core::shader::numerics {
namespace {

/// Which numbers an argument takes, and where they go.
struct Axis {
    enum class Slot : uint8_t { X, Y, Z, W, S, U, V } slot{};
    Argument const* argument = nullptr;
    Grid grid;
};

void set(Point& point, Axis::Slot slot, glm::vec4 value) {
    switch (slot) {
    case Axis::Slot::S:
        point.s = value;
        break;
    case Axis::Slot::U:
        point.u = glm::vec3(value);
        break;
    case Axis::Slot::V:
        point.v = glm::vec3(value);
        break;
    default:
        point.s[static_cast<int>(slot)] = value.x;
    }
}

uint32_t argumentCount(Row const& row) {
    return static_cast<uint32_t>(std::count_if(row.s.begin(), row.s.end(), isUsed)) + isUsed(row.u) + isUsed(row.v);
}

std::vector<Axis> axesOf(Row const& row, Format format) {
    std::vector<Axis> axes;
    const uint32_t first = argumentCount(row) == 1 ? 1024 : 64; // divisions of the argument that varies along a line
    const auto add = [&](Argument const& argument, Axis::Slot slot) {
        if (isUsed(argument)) axes.push_back({ slot, &argument, gridOf(argument, format, axes.empty() ? first : 16) });
    };
    const bool rotation = row.s[0].kind == Kind::Rotation;
    for (uint32_t i = 0; i < row.s.size(); ++i) add(row.s[i], rotation ? Axis::Slot::S : static_cast<Axis::Slot>(i));
    add(row.u, Axis::Slot::U);
    add(row.v, Axis::Slot::V);
    return axes;
}

/// A permutation-like hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", PCG).
uint32_t hash(uint32_t x) {
    const uint32_t state = x * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

/// Sets all axes but the first for line `line` of `lines`.
Point lineStart(std::vector<Axis> const& axes, uint32_t line, uint64_t combinations) {
    Point point;
    uint64_t rest = line;
    for (uint32_t i = 1; i < axes.size(); ++i) {
        std::vector<glm::vec4> const& values = axes[i].grid.values;
        size_t index = rest % values.size();
        if (combinations > kMaxLines) {
            const bool corner = line < (1u << (axes.size() - 1));
            index = corner ? ((line >> (i - 1)) & 1u) * (values.size() - 1) : hash(line * 8 + i) % values.size();
        }
        rest /= values.size();
        set(point, axes[i].slot, values[index]);
    }
    return point;
}

void addInside(Points& points, std::vector<Axis> const& axes) {
    uint64_t combinations = 1;
    for (size_t i = 1; i < axes.size(); ++i) combinations *= axes[i].grid.values.size();
    const auto lines = static_cast<uint32_t>(std::min<uint64_t>(combinations, kMaxLines));
    for (uint32_t line = 0; line < lines; ++line) {
        Point point = lineStart(axes, line, combinations);
        for (glm::vec4 const& value : axes[0].grid.values) {
            set(point, axes[0].slot, value);
            points.inside.push_back(point);
        }
    }
    points.lineLength = static_cast<uint32_t>(axes[0].grid.values.size());
    points.orderedLength = axes[0].grid.orderedCount;
}

/// The other arguments take four values inside.
void addOutside(Points& points, std::vector<Axis> const& axes, Axis const& axis, Format format) {
    for (Beyond const& beyond : beyondOf(*axis.argument, format)) {
        for (uint32_t place = 0; place < 4; ++place) {
            Point point;
            for (Axis const& other : axes) {
                std::vector<glm::vec4> const& values = other.grid.values;
                set(point, other.slot, values[(values.size() - 1) * place / 3]);
            }
            set(point, axis.slot, beyond.value);
            points.outside.push_back(point);
            points.outsideInputs.push_back(beyond.input);
        }
    }
}

} // namespace

float halfRounded(float value) { return glm::unpackHalf1x16(glm::packHalf1x16(value)); }

Points pointsOf(Row const& row, Format format) {
    Points points;
    const std::vector<Axis> axes = axesOf(row, format);
    if (axes.empty()) { // a constant
        points.inside.resize(1);
        points.lineLength = points.orderedLength = 1;
        return points;
    }
    addInside(points, axes);
    for (Axis const& axis : axes) addOutside(points, axes, axis, format);
    return points;
}

} // namespace filament_core::shader::numerics
