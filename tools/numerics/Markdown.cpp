// SPDX-License-Identifier: Apache-2.0
// markdownOf(): the whole of docs/numerics.md, text and tables.
#include "tools/numerics/Report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace filament::shader::numerics {
namespace {

constexpr std::string_view kIntroduction = R"(# Numerics of the shader library

Written by `filament-numerics --write docs/numerics.md`: change the rows in `tools/numerics/table`, not this file.

Every function of `shaders/lib` is evaluated over a grid of edges (0, denormals, one unit in the last place beside 0 and 1,
a value per decade, the ends of each interval; directions within 1e-7 of an axis) in five ways, and each result is compared
with the double-precision evaluation of the same text for the same, already rounded, inputs.

- **C++** is the library as the tests and the bakers compile it, **Vulkan** and **OpenGL ES** are fragment shaders in 32
  bits; these two agree to the bit.
- **fp16** is what materials in half precision get: `float16_t` on Vulkan and `mediump` on OpenGL ES out of the same text,
  both with real 16-bit arithmetic on the devices below.
  Inputs are numbers of 16 bits, so that the error is that of the arithmetic alone. A function that 16 bits cannot carry
  says "fp32 only" and why.
- **Error** is |result - truth| / max(|truth|, size), the largest and, behind the point, the 99th percentile. The size is the
  least that is told apart from 0: 1e-30, in 16 bits 6.1e-5, or what the row's reason says.
- Within their intervals no input gives NaN, infinity, a result out of its range, or, where the function is monotone, a step
  in the wrong direction beyond the rounding. Anything else, and an error above the limit, fails `numerics_tests`, which also
  puts defects into the text that the devices compile and expects each to be noticed.

Other devices than Mesa's CPU drivers need not round as IEEE 754 says: their errors, the order of their results and their bits
are shown, but not judged.

A new function gets a row in `tools/numerics/table/*Rows.cpp`, without which a test fails: its inputs and their intervals, its
range, its limits and the reason for them.

)";

constexpr std::string_view kOutside = R"(## Outside of the intervals

What the functions give for inputs that their comments exclude: *beyond* is a step, 0.1, 1 and 100 (in 16 bits 4) outside of
an interval, *huge* the largest number of the format, one argument at a time. Only "beyond" is tested, and only where no
reason is given: it must give numbers. Where the columns differ, which is where GLSL leaves `min`, `max` and `clamp` of NaN open, the cell
says whose result it is; GPU is both APIs in both precisions.

| function | beyond | huge | infinite | NaN | first finite input with NaN or inf | reason |
|---|---|---|---|---|---|---|
)";

std::string boundsOf(double low, double high, bool open) {
    return fmt::format("{:.4g}..{}{:.4g}", low, open ? "<" : "", high);
}

std::string intervalOf(Argument const& argument, bool half) {
    if (argument.kind == Kind::Direction) return fmt::format("{} unit", argument.name);
    if (argument.kind == Kind::Rotation) return fmt::format("{} unit quaternion", argument.name);
    std::string text =
            argument.kind == Kind::Offset ? fmt::format("\\|{}\\|", argument.name) : std::string(argument.name);
    text += " " + boundsOf(argument.low, argument.high, argument.open);
    const bool other = argument.halfLow != argument.low || argument.halfHigh != argument.high;
    if (half && other) text += fmt::format(" (fp16 {})", boundsOf(argument.halfLow, argument.halfHigh, argument.open));
    return text;
}

std::string inputsOf(Row const& row) {
    std::string text;
    const auto add = [&](Argument const& argument) {
        if (isUsed(argument)) text += (text.empty() ? "" : ", ") + intervalOf(argument, row.fp32Only.empty());
    };
    for (Argument const& argument : row.s) add(argument);
    add(row.u);
    add(row.v);
    return text.empty() ? "none" : text;
}

std::string shortError(double error) { return error == 0 ? "0" : fmt::format("{:.0e}", error); }

std::string errorCell(RowResult const& row, Column column) {
    if (!isMeasured(*row.row, column)) return "fp32 only";
    if (!row.of(column)) return "no device";
    Measurement const& m = *row.of(column);
    std::string trouble;
    for (std::string const& one : violations(*row.row, column, m)) trouble += fmt::format(" **{}**", one);
    if (!row.row->noError.empty()) return "finite" + trouble;
    return fmt::format("{} · {}{}", shortError(m.worst), shortError(m.percentile99), trouble);
}

std::string reasonOf(Row const& row) {
    std::string reason(row.noError.empty() ? row.limits.why : row.noError);
    if (!row.fp32Only.empty()) reason += fmt::format("; fp32 only: {}", row.fp32Only);
    return reason;
}

std::string limitsOf(Row const& row) {
    if (!row.noError.empty()) return "";
    const std::string single = shortError(row.limits.gpu);
    return row.fp32Only.empty() ? fmt::format("{}, {}", single, shortError(row.limits.half)) : single;
}

void appendErrors(std::string& text, RowResult const& row) {
    text += fmt::format("| `{}` | {} |", titleOf(*row.row), inputsOf(*row.row));
    for (const Column column : kColumns) text += fmt::format(" {} |", errorCell(row, column));
    text += fmt::format(" {} | {} |\n", limitsOf(*row.row), reasonOf(*row.row));
}

/// "number", "number, inf": the kinds of results.
std::string outcomesOf(OutsideCount const& count) {
    std::string text;
    const auto add = [&](uint32_t n, std::string_view name) {
        if (n > 0) text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
    };
    add(count.number, "number");
    add(count.infinite, "inf");
    add(count.nan, "NaN");
    return text;
}

/// "fp16" for both of its columns, and so on; the names of the columns if there is no common word.
std::string nameOf(std::vector<Column> const& columns) {
    const std::vector<Column> single{ Column::VulkanSingle, Column::GlesSingle };
    const std::vector<Column> half{ Column::VulkanHalf, Column::GlesHalf };
    std::vector<Column> gpu = single, fp32{ Column::Cpp, Column::VulkanSingle, Column::GlesSingle };
    gpu.insert(gpu.end(), half.begin(), half.end());
    if (columns == half) return "fp16";
    if (columns == fp32) return "fp32";
    if (columns == gpu) return "GPU";
    if (columns == single) return "fp32 GPU";
    std::string text;
    for (const Column column : columns) text += fmt::format("{}{}", text.empty() ? "" : ", ", toString(column));
    return text;
}

std::string outsideCell(RowResult const& row, size_t input) {
    std::vector<std::pair<std::string, std::vector<Column>>> groups; // columns with equal outcomes
    for (const Column column : kColumns) {
        if (!row.of(column)) continue;
        const std::string outcomes = outcomesOf(row.of(column)->outside[input]);
        if (outcomes.empty()) continue; // the interval extends to the limits of the format
        auto known = std::find_if(groups.begin(), groups.end(), [&](auto const& g) { return g.first == outcomes; });
        if (known == groups.end()) known = groups.insert(known, { outcomes, {} });
        known->second.push_back(column);
    }
    if (groups.empty()) return "none";
    if (groups.size() == 1) return groups[0].first;
    std::string text;
    for (auto const& [outcomes, columns] : groups)
        text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", outcomes, nameOf(columns));
    return text;
}

std::string firstNotFinite(RowResult const& row) {
    for (const Column column : kColumns) {
        if (row.of(column) && row.of(column)->firstOutsideNotFinite)
            return fmt::format("{} ({})", describe(*row.row, *row.of(column)->firstOutsideNotFinite), toString(column));
    }
    return "";
}

void appendOutside(std::string& text, RowResult const& row) {
    text += fmt::format("| `{}` |", titleOf(*row.row));
    for (size_t input = 0; input < kOutsideInputs; ++input) text += fmt::format(" {} |", outsideCell(row, input));
    text += fmt::format(" {} | {} |\n", firstNotFinite(row), row.row->openOutside);
}

struct Totals {
    size_t columns = 0, inputs = 0, notFinite = 0, halfInputs = 0, halfDiffering = 0;
    std::string halfNames; ///< of the functions that differ
};

Totals totalsOf(Study const& study) {
    Totals totals;
    for (RowResult const& row : study.rows) {
        for (const Column column : kColumns) {
            if (!row.of(column)) continue;
            Measurement const& m = *row.of(column);
            ++totals.columns;
            totals.inputs += m.inputs;
            totals.notFinite += m.nan + m.infinite;
            if (column == Column::GlesHalf) totals.halfInputs += m.inputs;
        }
        totals.halfDiffering += row.differing[static_cast<size_t>(Format::Half)];
        if (row.differing[static_cast<size_t>(Format::Half)] == 0) continue;
        totals.halfNames += fmt::format("{}`{}`", totals.halfNames.empty() ? "" : ", ",
                                        row.row->function.substr(0, row.row->function.find('(')));
    }
    return totals;
}

std::string summaryOf(Study const& study) {
    const Totals totals = totalsOf(study);
    std::string text =
            fmt::format("This run: {} functions and cases in {} columns, {} evaluations of inputs in range, of which "
                        "**{} gave NaN or infinity**; {} broken promises in all. Vulkan on {}; OpenGL ES on {}.\n",
                        study.rows.size(), totals.columns, totals.inputs, totals.notFinite, violationCount(study),
                        study.devices[0], study.devices[1]);
    if (totals.halfDiffering > 0)
        text += fmt::format(
                "In 16 bits the two APIs agree to the bit about {:.1f} % of {} results; they differ in {}.\n",
                100.0 * static_cast<double>(totals.halfInputs - totals.halfDiffering) /
                        static_cast<double>(totals.halfInputs),
                totals.halfInputs, totals.halfNames);
    return text;
}

} // namespace

std::string markdownOf(Study const& study) {
    std::string text = std::string(kIntroduction) + summaryOf(study);
    std::string_view file;
    for (RowResult const& row : study.rows) {
        if (row.row->file != file) {
            file = row.row->file;
            text += fmt::format("\n## {}.glsl\n\n| function | inputs | C++ fp32 | Vulkan fp32 | ES fp32 | Vulkan fp16 "
                                "| ES fp16 | limits fp32, fp16 | because |\n|---|---|---|---|---|---|---|---|---|\n",
                                file);
        }
        appendErrors(text, row);
    }
    text += "\n" + std::string(kOutside);
    for (RowResult const& row : study.rows) {
        const bool constant = inputsOf(*row.row) == "none";
        if (!constant) appendOutside(text, row);
    }
    return text;
}

} // namespace filament::shader::numerics
