// SPDX-License-Identifier: Apache-2.0
/// Row: the entry of one function of shaders/lib in the numerics table; a new function needs a new row.
///   Inputs  up to ten numbers: s.x .. s.w, then the vectors u and v. Each has the interval that the function's comment
///           promises to support; the grid (Points.h) is dense at its ends and extends beyond them.
///   Call    a text that is valid in C++, in both precisions, and in GLSL: NUMERICS_CALL compiles it three times.
///   Limits  the largest relative error against the double-precision evaluation of the same, already rounded, inputs. A
///           function that cannot work in 16 bits gives the reason, and its comment in shaders/lib says "fp32 only".
///   Thread  any; rows are constants. Memory: the table is built once and kept.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::shader::numerics {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Kind : uint8_t {
    Number,    ///< any value in [low, high]
    Integer,   ///< integers in [low, high]
    Direction, ///< unit vectors, many of them nearly aligned with an axis or perpendicular to it
    Colour,    ///< three components in [low, high]
    Offset,    ///< vectors of any direction with lengths in [low, high]
    Rotation,  ///< unit quaternions, in s
};

/// An argument and its interval. The half interval is the one that 16 bits must support.
struct Argument {
    std::string_view name = "unused";
    Kind kind = Kind::Number;
    double low = 0, high = 0;
    double halfLow = low, halfHigh = high;
    bool open = false; ///< high is excluded
};

struct Interval {
    double low = -kInfinity, high = kInfinity;
};

enum class Monotone : uint8_t { No, Rising, Falling };

/// The result of a call: the first `count` numbers.
struct Packed {
    glm::dvec4 value{ 0.0 };
    uint32_t count = 1;
};

/// Largest relative error. The error of a result smaller than `negligible` is relative to `negligible`.
struct Limits {
    double cpp = 0, gpu = 0, half = 0;
    double negligible = 1e-30;
    double halfNegligible = std::max(negligible, 0x1p-14); ///< below the smallest normal number, digits are lost
    double halfLargest = 65504; ///< 16-bit results above it only have to be finite and in range
    std::string_view why;
};

struct Call {
    std::string_view text;
    Packed (*single)(glm::vec4 s, glm::vec3 u, glm::vec3 v) = nullptr;
    Packed (*truth)(glm::dvec4 s, glm::dvec3 u, glm::dvec3 v) = nullptr;
};

struct Row {
    std::string_view file;     ///< without .glsl
    std::string_view function; ///< name(types), as the source declares it
    std::string_view part;     ///< the case or result, if the function has several rows
    Call call;
    std::array<Argument, 4> s{};
    Argument u{}, v{};
    Interval range{};
    Monotone monotone = Monotone::No; ///< in the first argument of s, or in the greys of u where s has none
    Limits limits{};
    std::string_view noError;  ///< the reason why a relative error is meaningless
    std::string_view fp32Only; ///< the reason why 16 bits are not enough
    /// Results for arguments somewhat outside their intervals, by a step, 0.1, 1, or 100 (4 in 16 bits). Empty: the
    /// result may leave its range or overflow, but is a number. Otherwise anything is allowed; the text says for which
    /// arguments, and why. The largest numbers, infinities and NaN are always exempt: they overflow, and GLSL leaves
    /// min, max and clamp of NaN undefined. The table's last column shows what happened for all of them.
    std::string_view openOutside;
};

/// Every row, by file.
std::span<const Row> rows();

// The rows of one source file each; rows() joins them.
std::vector<Row> mathRows();
std::vector<Row> brdfRows();
std::vector<Row> scatterRows(); ///< cloth, refraction, scatter, specular, subsurface
std::vector<Row> detailRows();  ///< iridescence, normals, occlusion, parallax, plausible
std::vector<Row> layerRows();   ///< anisotropic GGX, coat, sheen
std::vector<Row> colorRows();
std::vector<Row> imageRows();    ///< aa, ao, ibl
std::vector<Row> areaRows();     ///< ltc, area_shadows, profiles, and the range of areas of light
std::vector<Row> geometryRows(); ///< light, sampling, tangent
std::vector<Row> screenRows();   ///< screen_occlusion
std::vector<Row> temporalRows();
std::vector<Row> gradingRows(); ///< grading, exposure
std::vector<Row> toneRows();    ///< tone, and night in grading
std::vector<Row> resolutionRows();
std::vector<Row> transparencyRows();
std::vector<Row> splatRows();
std::vector<Row> probeRows();
std::vector<Row> fieldRows();

/// An argument that the row does not use has an empty interval.
inline bool isUsed(Argument const& argument) { return argument.low != argument.high; }

/// The same limit for CPU and GPU. half: 0 if fp32Only is set.
inline Limits relative(double single, double half, std::string_view why) {
    return { .cpp = single, .gpu = single, .half = half, .why = why };
}
/// For results up to 1, where a small result may be the remainder of a difference.
inline Limits absolute(double single, double half, std::string_view why) {
    return { .cpp = single, .gpu = single, .half = half, .negligible = 1, .why = why };
}

inline Argument number(std::string_view name, double low, double high) { return { name, Kind::Number, low, high }; }
inline Argument inHalf(Argument argument, double low, double high) {
    argument.halfLow = low;
    argument.halfHigh = high;
    return argument;
}
inline Argument unit(std::string_view name) { return number(name, 0, 1); }
inline Argument fraction(std::string_view name) { return { .name = name, .high = 1, .open = true }; }
/// The ranges of clampPerceptualRoughness() and its medium variant, squared.
inline Argument alpha(std::string_view name = "alpha", double high = 1) {
    return inHalf(number(name, 0.002025, high), 0.007921, high);
}
inline Argument integer(std::string_view name, double low, double high) { return { name, Kind::Integer, low, high }; }
inline Argument direction(std::string_view name) { return { name, Kind::Direction, -1, 1 }; }
inline Argument colour(std::string_view name, double high) { return { name, Kind::Colour, 0, high }; }

} // namespace filament_core::shader::numerics
