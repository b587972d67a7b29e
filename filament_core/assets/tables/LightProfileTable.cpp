// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/LightProfileTable.h"

#include "base/math/Elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace filament_core::assets {
namespace {

using std::numbers::pi;

constexpr double kRadians = pi / 180;
constexpr double kLeastDegrees = 0.01; // of a table: floats divide by it

/// The coarsest step of which all angles are multiples, or the finest one.
template <size_t N>
double stepOf(std::vector<double> const& angles, std::array<double, N> const& steps) {
    const auto isMultiple = [&](double step) {
        return std::ranges::all_of(
                angles, [&](double angle) { return std::abs(angle / step - std::round(angle / step)) * step < 1e-3; });
    };
    const auto found = std::ranges::find_if(steps, isMultiple);
    return found == steps.end() ? steps.back() : *found;
}

constexpr std::array kRowSteps{ 5.0, 2.5, 2.0, 1.0, 0.5 };
constexpr std::array kColumnSteps{ 22.5, 15.0, 10.0, 5.0, 2.5 };

double3 directionOf(double polar, double around) {
    return { elementary::sin(polar) * elementary::cos(around), elementary::sin(polar) * elementary::sin(around),
             -elementary::cos(polar) };
}

/// The mean of the candelas over the cells around the rows, times their solid angles: exact for what is linear between.
double lumensOf(LightProfileTable const& table) {
    constexpr uint32_t kSteps = 8; // between two rows
    const uint32_t steps = (table.rows - 1) * kSteps;
    const double step = static_cast<double>(table.lastRadians) / steps;
    double sum = 0;
    for (uint32_t column = 0; column < table.columns; ++column) {
        const double around = 2 * pi * column / table.columns;
        for (uint32_t i = 0; i < steps; ++i) {
            const double polar = (i + 0.5) * step;
            sum += table.shareAt(directionOf(polar, around)) * elementary::sin(polar);
        }
    }
    return sum * step * 2 * pi / table.columns * static_cast<double>(table.peak);
}

} // namespace

double LightProfileTable::shareAt(double3 const& direction) const {
    const double polar = elementary::atan2(elementary::hypot(direction.x, direction.y), -direction.z);
    const double turn = elementary::atan2(direction.y, direction.x) / (2 * pi);
    const double down = polar / static_cast<double>(lastRadians) * (rows - 1);
    const double around = (turn < 0 ? turn + 1 : turn) * columns;
    if (down > rows - 1 + 1e-3) return 0;
    const auto entry = [&](uint32_t column, uint32_t row) {
        const uint32_t at = column % columns * rows + std::min(row, rows - 1);
        return static_cast<double>(words[at / 2] >> at % 2 * 16 & 0xFFFFu) / 65535;
    };
    const auto row = static_cast<uint32_t>(down), column = static_cast<uint32_t>(around);
    const double s = down - row, t = around - column;
    const auto along = [&](uint32_t at) { return entry(at, row) + (entry(at, row + 1) - entry(at, row)) * s; };
    return along(column) + (along(column + 1) - along(column)) * t;
}

LightProfileTable makeLightProfileTable(IesFile const& file) {
    LightProfileTable table;
    table.peak = file.peak;
    const bool isC = file.type == IesType::C;
    const double rowStep = isC ? stepOf(file.vertical, kRowSteps) : kRowSteps.back();
    const double columnStep = isC ? stepOf(file.horizontal, kColumnSteps) : kColumnSteps.back();
    const double last = isC ? std::max(file.vertical.back(), kLeastDegrees) : 180.0;
    table.rows = static_cast<uint32_t>(std::max(std::ceil(last / rowStep - 1e-3), 1.0)) + 1;
    table.columns = isC && file.horizontal.size() == 1 ? 1 : static_cast<uint32_t>(std::lround(360 / columnStep));
    table.lastRadians = static_cast<float>(last * kRadians);
    const size_t entries = size_t{ table.rows } * table.columns;
    table.words.resize((entries + 1) / 2);
    for (size_t i = 0; i < entries; ++i) {
        // Beside the poles: there a direction does not say in which plane it is.
        const double row = last * kRadians * static_cast<double>(i % table.rows) / (table.rows - 1);
        const double polar = std::clamp(row, 1e-6, pi - 1e-6);
        const double around = 2 * pi * static_cast<double>(i / table.rows) / table.columns;
        const double share = file.candelasAt(directionOf(polar, around)) / static_cast<double>(file.peak);
        const auto code = static_cast<uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * 65535));
        table.words[i / 2] |= code << i % 2 * 16;
    }
    table.lumens = lumensOf(table);
    return table;
}

} // namespace filament_core::assets
